import json
import os
import struct

from command_line import (COURSEWORK, PT, CommandLineTest, png_chunks, read_exr_attributes, read_exr_channels,
                          read_png)

DENOISE = "--denoise=" + os.environ["OPEN_IMAGE_DENOISE"]
SIZE = ("--size", "40x24")
OTHER_SEED = str(2**63)


class DenoiseTest(CommandLineTest):
    def render(self, *options, code=0, error=None, **environment):
        self.expect(code, "render", COURSEWORK, *SIZE, *options, error=error, **environment)

    def channels(self, name):
        return read_exr_channels(self.path(name))


class Denoise(DenoiseTest):
    def test_what_does_not_go_with_it_is_refused(self):
        for options in (("--sampling", "adaptive", "--error", "1%"), ("--film", "a.ptfilm"), ("--checkpoint", "a.ptfilm"),
                        ("--preview-every", "9"), ("--alpha",), ("--layers", "depth,standard-error"),
                        ("--layers", "sample-count")):
            self.render("-o", "a.exr", DENOISE, *options, code=2, error=options[0])
            self.assertIn("--denoise", self.errors)
        self.render("-o", "a.png", DENOISE, "--error", "1%", "--piece-rows", "7", code=2,
                    error="--denoise with --error or --time: needs the whole image on the device, which --piece-rows 7")
        self.assertEqual(self.files(), [])

    def test_a_signal_leaves_the_last_round(self):
        for submission in "5", "20":
            self.render("-o", "a.png", DENOISE, "--spp", "8", code=130, FAKE_PT_SIGNAL=f"2:{submission}",
                        error="stopped by SIGINT after 0 of 8 samples per pixel; nothing was written")
        self.assertEqual(self.files(), [])
        for submission in "150", "180":
            self.render("-o", "a.exr", DENOISE, "--time", "999", code=130, FAKE_PT_SIGNAL=f"2:{submission}",
                        error="stopped by SIGINT after 32 of 65536 samples per pixel")
            self.render("-o", "b.exr", DENOISE, "--spp", "32")
            self.assertEqual(self.channels("a.exr"), self.channels("b.exr"))

    def test_rounds_end_in_time(self):
        self.render("-o", "a.png", DENOISE, "--time", "0.5", "--stats", "a.json", FAKE_PT_SAMPLE_MS=5)
        stats = json.loads(self.read("a.json"))
        self.assertEqual((stats["ended_by"], stats["spp_requested"]), ("time", 65536))
        self.assertTrue(32 <= stats["spp"] < 4096)

    def test_progress_is_of_both_halves(self):
        self.render("-o", "a.png", DENOISE, "--spp", "64", "--progress", "json", FAKE_PT_SAMPLE_MS=10)
        lines = [json.loads(line) for line in self.errors.splitlines() if line.startswith("{")]
        for key in "fraction", "samples_per_pixel", "seconds":
            self.assertEqual([line[key] for line in lines], sorted(line[key] for line in lines), key)
        self.assertEqual({line["samples_per_pixel_total"] for line in lines}, {64})
        self.assertTrue(any(0.0 < line["fraction"] < 0.5 for line in lines))
        self.assertEqual((lines[-1]["fraction"], lines[-1]["samples_per_pixel"]), (1.0, 64))


class RealDeviceDenoise(DenoiseTest):
    program = PT

    def stated(self, *options):
        self.render("-o", "a.exr", DENOISE, "--spp", "17", "--stats", "a.json", *options)
        return json.loads(self.read("a.json"))

    def test_the_raw_image_is_beside_it(self):
        noisy = "--sampler", "random"
        stats = self.stated(*noisy)
        self.assertEqual((stats["denoised"], stats["spp"], stats["spp_requested"]), (True, 16, 16))
        self.assertIn("40x24, 16 spp, denoised, in ", self.output)
        self.render("-o", "first.exr", "--spp", "8", "--layers", "depth,normal", *noisy)
        first, denoised = self.channels("first.exr"), self.channels("a.exr")
        self.assertEqual(list(denoised), ["B", "G", "R", "raw.B", "raw.G", "raw.R"])
        for name in "RGB":
            self.assertNotEqual(denoised[name], denoised[f"raw.{name}"])
        attributes = read_exr_attributes(self.path("a.exr"))
        self.assertEqual(attributes["pt.quantity"], ("string", b"denoised radiance"))
        self.assertEqual(attributes["samplesPerPixel"], ("int", struct.pack("<i", 16)))
        self.assertEqual(attributes["pt.relativeError"], ("float", struct.pack("<f", stats["relative_rmse"])))
        self.render("-o", "b.exr", "-o", "b.png", DENOISE, "--spp", "16", "--layers", "depth,normal", "--piece-rows", "7",
                    *noisy)
        self.assertEqual(self.channels("b.exr"),
                         {**denoised, **{name: first[name] for name in ("N.X", "N.Y", "N.Z", "Z")}})
        self.assertIn(("tEXt", b"pt.quantity\0tone-mapped denoised radiance"), list(png_chunks(self.contents("b.png"))))
        self.expect(0, "tonemap", "b.exr", "c.png")
        self.assertEqual(read_png(self.path("c.png")), read_png(self.path("b.png")))

    def test_a_target_error_is_that_of_the_result(self):
        stats = self.stated()
        target = stats["relative_rmse_high"] / 2
        self.render("-o", "a.exr", DENOISE, "--error", str(target), "--stats", "a.json")
        stats = json.loads(self.read("a.json"))
        self.assertEqual((stats["ended_by"], stats["target_reached"]), ("error", True))
        self.assertTrue(32 <= stats["spp"] < 4096)
        self.assertLessEqual(stats["relative_rmse_high"], target)
        self.assertEqual(self.run_pt("render", COURSEWORK, *SIZE, "-o", "a.exr", DENOISE, "--error", "1e-9", "--spp", "40"), 7)
        self.assertIn("after 40 samples, raise --spp", self.output)

    def denoise(self, *films, guides="first.exr", code=0, error=None):
        self.expect(code, "denoise", *films, guides, "-o", "b.exr", "--stats", "b.json", DENOISE, error=error)

    def test_films_denoise_to_the_same_picture(self):
        whole = self.stated()
        self.render("-o", "first.exr", "--film", "first.ptfilm", "--spp", "8", "--layers", "albedo,normal")
        for first in "0", "5":
            self.render("--film", f"part{first}.ptfilm", "--spp", "5" if first == "0" else "3", "--seed", OTHER_SEED,
                        "--first-sample", first)
        self.expect(0, "merge", "part5.ptfilm", "part0.ptfilm", "--film", "second.ptfilm")
        self.denoise("first.ptfilm", "second.ptfilm")
        self.assertEqual(self.channels("b.exr"), self.channels("a.exr"))
        stats = json.loads(self.read("b.json"))
        self.assertEqual(stats, {key: whole[key] for key in stats})
        self.assertEqual((stats["spp"], stats["denoised"]), (16, True))

        files = self.files()
        for name, options in {"seed": ("--spp", "8"), "part": ("--spp", "7", "--seed", "3"),
                              "length": ("--spp", "8", "--seed", "3", "--max-path-length", "3"),
                              "uneven": ("--spp", "4096", "--error", "5%")}.items():
            self.render("--film", f"{name}.ptfilm", *options)
        self.render("-o", "plain.exr", "--spp", "1")
        self.render("-o", "crop.exr", "--spp", "1", "--layers", "albedo,normal", "--crop", "0,0,9,9")
        rest = self.files()
        for second, guides, code, error in (
                ("seed", "first", 2, "seed.ptfilm: seed = 0: must differ from the other film's"),
                ("part", "first", 2, "part.ptfilm: is 40x24 with 7 samples per pixel, first.ptfilm is 40x24 with 8"),
                ("length", "first", 2, "length.ptfilm: max_path_length = 3: must be "),
                ("uneven", "first", 2, "uneven.ptfilm: has "),
                ("second", "plain", 6, "plain.exr"),
                ("second", "crop", 2, "crop.exr: is 9x9 at 0,0 of 40x24: must be 40x24")):
            self.denoise("first.ptfilm", f"{second}.ptfilm", guides=f"{guides}.exr", code=code, error=error)
        self.assertEqual(self.files(), rest)
        self.assertLess(set(files), set(rest))

    def test_without_the_library_nothing_is_rendered(self):
        for name in "none.so", os.devnull:
            self.render("-o", "a.png", f"--denoise={name}", "--device", "none", code=6,
                        error=f'--denoise = "{name}": Open Image Denoise 2 cannot be loaded')
            self.assertIn("; pip install pyoidn installs it", self.errors)
        self.assertEqual(self.files(), [])
