import json
import os
import pty
import signal
import struct
import time

from command_line import (COURSEWORK, RESULT, CommandLineTest, parse_png, png_chunks,
                          read_exr_attributes, read_png)

WIDTH, HEIGHT = 9, 7
SIZE = ("--size", f"{WIDTH}x{HEIGHT}")
CROP = (2, 3, 5, 4)
CROP_TEXT = ",".join(map(str, CROP))


def cut(image, rectangle):
    x, y, width, height = rectangle
    return [row[3 * x:3 * (x + width)] for row in image[y:y + height]]


def texts_of(data):
    return dict(body.decode("latin-1").split("\0") for kind, body in png_chunks(data) if kind == "tEXt")


class ImagesTest(CommandLineTest):
    def render(self, *options, code=0, error=None, **environment):
        samples = () if "--spp" in options else ("--spp", "2")
        self.expect(code, "render", COURSEWORK, *SIZE, *samples, *options, error=error, **environment)


class Crop(ImagesTest):
    def test_it_is_a_part_of_the_picture(self):
        display = ("--exposure", "-1.5")
        self.render("-o", "whole.png", *display)
        _, _, whole = read_png(self.path("whole.png"))
        for crop, rows in ((CROP, "7"), (CROP, "1"), (CROP, "3"), ((0, 0, 1, 1), "7"), ((8, 6, 1, 1), "1"),
                           ((0, 0, WIDTH, HEIGHT), "3"), ((0, 2, WIDTH, 1), "7"), ((3, 0, 1, HEIGHT), "3")):
            with self.subTest(crop=crop, rows=rows):
                self.render("-o", "crop.png", *display, "--crop", ",".join(map(str, crop)), "--piece-rows", rows)
                width, height, image = read_png(self.path("crop.png"))
                self.assertEqual((width, height, image), (*crop[2:], cut(whole, crop)))

    def test_an_exr_says_where_it_is_and_what_its_colors_are(self):
        def windows(name):
            attributes = read_exr_attributes(self.path(name))
            rec709 = (0.64, 0.33, 0.30, 0.60, 0.15, 0.06, 0.3127, 0.3290)
            self.assertEqual(attributes["chromaticities"], ("chromaticities", struct.pack("<8f", *rec709)))
            return [struct.unpack("<4i", attributes[key][1]) for key in ("dataWindow", "displayWindow")]

        self.render("-o", "a.exr", "--crop", CROP_TEXT)
        x, y, width, height = CROP
        self.assertEqual(windows("a.exr"), [(x, y, x + width - 1, y + height - 1), (0, 0, WIDTH - 1, HEIGHT - 1)])
        self.render("-o", "b.exr", "--crop", f"0,0,{WIDTH},{HEIGHT}")
        self.assertEqual(windows("b.exr")[0], windows("b.exr")[1])
        self.assertIn(f"wrote b.exr: {WIDTH}x{HEIGHT}, ", self.output)

    def test_no_row_more_is_rendered(self):
        self.render("-o", "a.png", "--crop", CROP_TEXT, FAKE_PT_MAX_ROWS=CROP[3])
        self.assertEqual(self.errors, "")
        self.render("-o", "a.png", "--crop", CROP_TEXT, FAKE_PT_MAX_ROWS=CROP[3] - 1)
        self.assertIn("2 pieces of up to 2 rows: ", self.errors)

    def test_it_has_to_be_a_part(self):
        for text in "0,0,10,7", "9,0,1,1", "0,7,1,1", "5,5,5,1", "0,0,0,1", "0,0,1,0", "4294967295,0,2,1":
            self.render("-o", "a.png", "--crop", text, code=2,
                        error=f"pt: --crop {text}: must be a part of the picture of 9x7 pixels, with at least one pixel",
                        FAKE_PT_FAIL=f"create:{RESULT['NO_DEVICE']}")
        for text in "1,2,3", "1,2,3,4,5", "-1,0,1,1", "", "a,0,1,1", "0,0,1,4294967296", "0 0 1 1", "1,2,3,":
            self.render("-o", "a.png", "--crop", text, code=2, error="--crop: must be four whole numbers")
        self.assertEqual(self.files(), [])

    def test_what_is_said_of_it(self):
        self.render("-o", "a.png", "--crop", CROP_TEXT, "--stats", "s.json")
        self.assertIn("wrote a.png: 5x4 at 2,3 of 9x7, 2 spp in ", self.output)
        self.assertEqual(json.loads(self.read("s.json"))["crop"], list(CROP))
        self.assertEqual(texts_of(self.contents("a.png"))["pt.crop"], "5x4 at 2,3 of 9x7")
        self.render("-o", "a.png", "--stats", "s.json")
        self.assertIn('"crop": null', self.read("s.json"))
        self.assertNotIn("pt.crop", texts_of(self.contents("a.png")))


class StandardOutput(ImagesTest):
    def test_it_gets_what_a_file_would(self):
        """Images do not tell when they were rendered. Time stamps of files have a resolution of a second."""
        self.render("-o", "a.exr", "-o", "a.png", "-o", "a.jpg", FAKE_PT_SAMPLE_MS=1)
        time.sleep(1.1)
        for name in "exr", "png", "jpg":
            with self.subTest(format=name):
                done = self.piped("render", COURSEWORK, *SIZE, "--spp", "2", "-o", "-", "--format", name,
                                  env={**os.environ, "TZ": "Pacific/Auckland"})
                self.assertEqual((done.returncode, done.stdout), (0, self.contents(f"a.{name}")), done.stderr)
                self.assertIn(b"pt: wrote standard output: 9x7, 2 spp", done.stderr)
        done = self.piped("render", COURSEWORK, *SIZE, "--spp", "2", "-o", "-", "--format", "jpeg", "-o", "b.png", "-q")
        self.assertEqual((done.stdout, done.stderr), (self.contents("a.jpg"), b""))
        self.assertEqual(self.contents("b.png"), self.contents("a.png"))
        self.assertNotIn("-", self.files())

    def test_it_gets_no_picture_so_far(self):
        arguments = ("render", COURSEWORK, *SIZE, "--spp", "20", "-o", "-", "--format", "png")
        once = self.piped(*arguments)
        asked = self.piped(*arguments, env={**os.environ, "FAKE_PT_SAMPLE_MS": "4",
                                            "FAKE_PT_SIGNAL": f"{int(signal.SIGUSR1)}:8"})
        self.assertEqual((asked.returncode, asked.stdout), (0, once.stdout), asked.stderr)
        self.render("-o", "-", "--format", "png", "--preview-every", "1", code=2,
                    error="--preview-every: needs -o and the name of a file")

    def test_it_gets_one_thing_of_a_given_format(self):
        self.render("-o", "-", code=2, error="-o -: standard output needs --format, one of exr, png, jpg, jpeg")
        self.render("-o", "a.png", "--format", "png", code=2, error="--format: must be used with `-o -`")
        self.render("-o", "-", "--format", "tiff", code=2, error='unknown format "tiff"')
        self.render("-o", "-", "-o", "-", "--format", "png", code=2, error="is the same file as -o -")
        self.render("-o", "-", "--format", "png", "--stats", "-", code=2, error="--stats -: is the same file as -o -")
        self.render("-o", "-", "--format", "png", "--watch", code=2, error="-o -: --watch needs a file")

    def test_a_terminal_is_spared(self):
        ours, theirs = pty.openpty()
        done = self.piped("render", COURSEWORK, *SIZE, "-o", "-", "--format", "png", stdout=theirs, text=True)
        os.close(theirs)
        os.close(ours)
        self.assertEqual((done.returncode, done.stderr),
                         (2, "pt: -o -: standard output is a terminal; send it to a file or a program\n"))


class Metadata(CommandLineTest):
    def texts(self, *options):
        self.expect(0, "render", COURSEWORK, "-o", "a.png", "--spp", "16", "--size", "4x3", *options)
        return texts_of(self.contents("a.png"))

    def test_a_png_says_how_it_was_made(self):
        texts = self.texts("--seed", "7", "--max-path-length", "3", "--first-sample", "9", "--sampler", "random",
                           "--estimator", "mis", "--exposure", "-2.5", "--tonemap", "agx")
        software = texts.pop("software")
        self.assertRegex(software, r"^pt \d+\.\d+\.\d+$")
        self.assertIn("sRGB", dict(png_chunks(self.contents("a.png"))))
        self.assertEqual(texts, {
            "samplesPerPixel": "16", "pt.quantity": "tone-mapped radiance", "pt.toneMap": "agx", "pt.exposure": "-2.5",
            "pt.encoding": "sRGB", "pt.scene": os.path.basename(COURSEWORK), "pt.seed": "7", "pt.firstSample": "9",
            "pt.maxPathLength": "3", "pt.sampler": "random", "pt.estimator": "mis", "pt.rejectedSamples": "0",
            "pt.relativeError": "0.03125", "pt.device": "fake device", "pt.driver": "fake driver 1.0"})
        texts = self.texts("--exposure", "1.5", "--gamma", "2.2")
        self.assertEqual((texts["pt.gamma"], texts["pt.toneMap"], texts["pt.exposure"]), ("2.2", "none", "1.5"))
        chunks = dict(png_chunks(self.contents("a.png")))
        self.assertEqual(("sRGB" in chunks, "cHRM" in chunks, chunks["gAMA"]), (False, True, struct.pack(">I", 45455)))  # 1e5 / 2.2


class Tonemap(ImagesTest):
    def check(self, display, *options):
        self.render("-o", "a.exr", "-o", "a.png", "-o", "a.jpg", *options, *display)
        for name in "b.png", "b.jpg":
            self.expect(0, "tonemap", "a.exr", name, *display)
        for read in parse_png, texts_of:
            self.assertEqual(read(self.contents("b.png")), read(self.contents("a.png")))
        self.assertEqual(self.scan_of("b.jpg"), self.scan_of("a.jpg"))

    def scan_of(self, name):
        """Returns the JPEG without metadata: everything from the quantisation tables on."""
        data = self.contents(name)
        return data[data.index(b"\xff\xdb"):]

    def test_the_picture_has_the_bits_of_the_rendered_one(self):
        self.check(())
        self.check(("--tonemap", "reinhard", "--gamma", "2.2"))
        self.check(("--exposure", "-2.25", "--tonemap", "agx"), "--crop", CROP_TEXT)

    def test_what_is_told(self):
        self.render("-o", "a.exr", "-o", "r.png", "--crop", CROP_TEXT)
        exposure = self.output.splitlines()[1]
        self.expect(0, "tonemap", "a.exr", "a.png")
        self.assertEqual(self.output, f"wrote a.png: 5x4 at 2,3 of 9x7\n{exposure}\n")
        self.expect(0, "tonemap", "a.exr", "a.png", "--exposure", "2")
        self.assertEqual(self.output, "wrote a.png: 5x4 at 2,3 of 9x7\n")
        self.expect(0, "tonemap", "a.exr", "a.png", "-q")
        self.assertEqual(self.output, "")
        done = self.piped("tonemap", "a.exr", "-", "--format", "png")
        self.assertEqual((done.returncode, done.stdout), (0, self.contents("a.png")), done.stderr)
        self.assertIn(b"pt: wrote standard output: 5x4", done.stderr)

    def test_what_it_refuses(self):
        self.render("-o", "a.exr", "-o", "a.png")
        self.write("text.exr", "no image")
        self.expect_refusals("tonemap", ((2, ("a.exr", "b.exr"), "b.exr: the name must end in one of .png, .jpg, .jpeg"),
                                       (2, ("a.exr", "b.tiff"), "b.tiff: the name must end in"),
                                       (2, ("a.exr", "-"), "needs --format"),
                                       (2, ("a.exr", "-", "--format", "exr"), "known: png, jpg, jpeg"),
                                       (2, ("a.png", "./a.png"), "is the same file as the image a.png"),
                                       (2, ("a.exr",), "OUT is required"),
                                       (6, ("a.png", "b.png"), "a.png: holds whole numbers"),
                                       (6, ("none.exr", "b.png"), "cannot read none.exr"),
                                       (6, ("text.exr", "b.png"), "cannot read text.exr"),
                                       (6, ("a.exr", "no/b.png"), "cannot write no/b.png")))
