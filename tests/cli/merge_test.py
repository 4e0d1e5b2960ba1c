import json
import os
import random
import struct

from command_line import COURSEWORK, PT, CommandLineTest, read_exr_attributes, read_exr_blocks, read_png

PARTS = 4


class Merge(CommandLineTest):
    program = PT
    small = ("render", COURSEWORK, "--size", "24x13", "-q")

    made = {}

    def setUp(self):
        super().setUp()
        self.parts = [f"part {i} ü.ptfilm" for i in range(PARTS)]
        for i, part in enumerate(self.parts):
            if part not in self.made:
                self.expect(0, *self.small, "--film", part, "--first-sample", str(9 * i), "--spp", "9")
                self.made[part] = self.contents(part)
            self.write(part, self.made[part])

    def merge(self, code, *arguments, error=None):
        self.expect(code, "merge", *arguments, error=error)

    def test_any_order_equals_the_whole(self):
        whole = ["-o", "a.exr", "-o", "a.png", "--layers", "standard-error,sample-count", "--film", "a.ptfilm", "--stats", "a.json"]
        self.expect(0, *self.small, *whole, "--spp", str(9 * PARTS))
        sums = [word.replace("a.", "m.") for word in whole]
        order = random.Random(1)
        for _ in range(2):
            order.shuffle(self.parts)
            self.merge(0, *self.parts, *sums)
            self.assertEqual(self.contents("m.ptfilm"), self.contents("a.ptfilm"))
            self.assertEqual(read_exr_blocks(self.path("m.exr")), read_exr_blocks(self.path("a.exr")))
            self.assertEqual(read_png(self.path("m.png")), read_png(self.path("a.png")))
        self.assertIn("4 films of 24x13 pixels: 36 spp, samples [0, 36)\n", self.output)
        self.assertEqual(self.errors, "")
        found, rendered = json.loads(self.read("m.json")), json.loads(self.read("a.json"))
        for key in "width", "height", "spp", "seed", "max_path_length", "rejected_samples":
            self.assertEqual(found[key], rendered[key], key)
        for key in "rmse", "rmse_low", "rmse_high", "relative_rmse", "relative_rmse_low", "relative_rmse_high":
            self.assertAlmostEqual(found[key], rendered[key], delta=1e-5 * rendered[key])
        self.assertEqual(found["uncertain"], rendered["uncertain"])
        self.assertEqual((found["sampler"], found["estimator"]), ("sobol", "mis"))

    def test_what_is_wrong_is_told_of_all_parts_and_nothing_is_written(self):
        self.write("cut.ptfilm", self.contents(self.parts[3])[:-20])
        self.expect(0, *self.small, "--film", "stranger.ptfilm", "--first-sample", "900", "--spp", "9", "--seed", "5")
        self.write("picture.json", "{}")
        self.write("vast.ptfilm", b"\x28\xb5\x2f\xfd\xc0\0" + struct.pack("<Q", 2**40) + bytes(20))  # RFC 8878, 3.1.1.1
        self.merge(2, *self.parts[:3], self.parts[1], "cut.ptfilm", "stranger.ptfilm", "picture.json", "vast.ptfilm", "-o", "a.png", "--film", "a.ptfilm", "--stats", "a.json")
        lines = self.errors.splitlines()
        self.assertEqual(len(lines), 6, self.errors)
        starts = (f"pt: {self.parts[1]}: samples = [9, 18)", "pt: cut.ptfilm: damaged or cut short",
                  "pt: stranger.ptfilm: seed = 5: must be 0", "pt: picture.json: these bytes are not a film",
                  "pt: vast.ptfilm: damaged or cut short: the header of its zstd frame", "pt: nothing was written")
        for line, start in zip(lines, starts):
            self.assertTrue(line.startswith(start), line)
        self.assertFalse({"a.png", "a.ptfilm", "a.json"} & set(self.files()))
        self.merge(6, self.parts[0], "none.ptfilm", "-o", "a.png", error="cannot read none.ptfilm")

    def test_what_is_missing_is_told(self):
        some = [self.parts[i] for i in (3, 1)]
        self.merge(0, *some, "-o", "a.png", "--stats", "a.json")
        self.assertEqual(self.errors, "pt: 9 samples per pixel missing: [18, 27)\n")
        self.assertIn("18 spp, samples [9, 18), [27, 36)\n", self.output)
        stats = json.loads(self.read("a.json"))
        self.assertEqual((stats["samples"], stats["missing"]), ([[9, 18], [27, 36]], [[18, 27]]))
        self.assertEqual(self.run_pt("merge", *some, "-o", "b.png", "--first-sample", "0", "--spp", "36"), 7)
        self.assertEqual(self.errors, "pt: 18 samples per pixel missing: [0, 9), [18, 27)\n")
        self.assertEqual(self.contents("a.png"), self.contents("b.png"))
        self.merge(0, *self.parts, "-o", "c.png", "--first-sample", "0", "--spp", "36")
        self.assertEqual(self.errors, "")

    def test_rows_of_a_crop_are_shown_at_their_place(self):
        whole = ("--spp", "18", "--exposure", "0")
        self.expect(0, *self.small, "-o", "crop.exr", "-o", "crop.png", "--crop", "0,4,24,5", *whole)
        for i in 0, 1:
            self.expect(0, *self.small, "--crop", "6,4,3,5", "--film", f"{i}.ptfilm", "--first-sample", str(9 * i), "--spp",
                        "9")
        self.merge(0, "0.ptfilm", "1.ptfilm", "-o", "m.exr", "-o", "m.png", "--exposure", "0")
        self.assertEqual(read_exr_blocks(self.path("m.exr")), read_exr_blocks(self.path("crop.exr")))
        for window in "dataWindow", "displayWindow":
            found, rendered = (read_exr_attributes(self.path(name))[window] for name in ("m.exr", "crop.exr"))
            self.assertEqual(found, rendered)
        self.assertEqual(self.contents("m.png").split(b"IDAT")[1:], self.contents("crop.png").split(b"IDAT")[1:])

    def test_standard_output(self):
        self.merge(0, *self.parts, "-o", "a.png", "-q")
        done = self.piped("merge", *self.parts, "-o", "-", "--format", "png")
        self.assertEqual((done.returncode, done.stdout), (0, self.contents("a.png")))
        self.assertIn(b"4 films of 24x13 pixels", done.stderr)
        self.merge(2, *self.parts, "-o", "-", error="-o -: standard output needs --format")

    def test_a_part_is_kept(self):
        before = self.contents(self.parts[0])
        self.merge(2, *self.parts, "--film", "./" + self.parts[0], error="is the same file as the part")
        self.merge(2, *self.parts, error="there is nothing to write")
        self.merge(2, self.parts[0], "-o", "a.bmp", error="-o a.bmp: the name must end in")
        self.merge(6, self.parts[0], "-o", "none/a.png", error="cannot write none/a.png")
        self.assertEqual(self.contents(self.parts[0]), before)
        self.assertEqual(self.files(), sorted(self.parts))

    def test_it_needs_no_device(self):
        self.expect(0, "merge", *self.parts, "-o", "a.png", VK_DRIVER_FILES=os.devnull, VK_ICD_FILENAMES=os.devnull)
        self.expect(4, "render", COURSEWORK, "-o", "b.png", VK_DRIVER_FILES=os.devnull, VK_ICD_FILENAMES=os.devnull)
