"""Tests of `pt render --error` and of what is said about the error of an image. Arguments: see command_line.py."""

import json
import signal

from command_line import COURSEWORK, PT, CommandLineTest, main, read_exr_channels

KEYS = [name + end for name in ("rmse", "relative_rmse") for end in ("", "_low", "_high")]


class TargetError(CommandLineTest):
    """The stand-in's image of N samples has the relative error 0.5 / N with bounds of half and twice that, unknown below 16;
    the other error is twice as large."""

    def render(self, *options, code=0):
        arguments = ["render", COURSEWORK, "-o", "a.png", "--size", "4x3", "--stats", "s.json"]
        self.assertEqual(self.run_pt(*arguments, *options), code, self.errors)
        return json.loads(self.read("s.json"))

    def test_wrong_values(self):
        for value in ("0", "0%", "-1", "-1%", "inf", "nan", "1e999", "%", "", "1 %", "few"):
            with self.subTest(value=value):
                self.expect(2, "render", COURSEWORK, "-o", "a.png", "--error", value, error="--error: must be")
                self.assertIn(f'is "{value}"', self.errors)
        self.assertEqual(self.files(), [])

    def test_reached(self):
        for target in ("2.5%", "0.025"):
            stats = self.render("--error", target)
            self.assertEqual((stats["spp"], stats["spp_requested"]), (40, 65536))
            self.assertEqual((stats["target_error"], stats["target_reached"]), (0.025, True))
            self.assertEqual([stats[key] for key in KEYS], [0.025, 0.0125, 0.05, 0.0125, 0.00625, 0.025])
            self.assertRegex(self.output, r"\nerror 1.25% \(0.625% to 2.5%\); target reached after 40 samples\n$")

    def test_not_reached(self):
        stats = self.render("--error", "2.5%", "--spp", "32", code=7)
        self.assertEqual((self.errors, self.files()), ("", ["a.png", "s.json"]))
        self.assertEqual((stats["spp"], stats["target_reached"]), (32, False))
        self.assertIn("; target not reached: 3.12% is above 2.5% after 32 samples, raise --spp\n", self.output)
        self.render("--error", "2.5%", "--spp", "15", code=7)
        self.assertIn("target not reached: unknown error for 2.5% after 15 samples, raise --spp\n", self.output)

    def test_reached_with_the_last_sample(self):
        self.assertTrue(self.render("--error", "2.5%", "--spp", "40")["target_reached"])

    def test_without_a_target(self):
        stats = self.render("--spp", "16")
        self.assertEqual((stats["spp"], stats["target_error"], stats["target_reached"]), (16, None, False))
        self.assertTrue(self.output.endswith("\nerror 3.12% (1.56% to 6.25%)\n"), self.output)
        stats = self.render("--spp", "15", "-q")
        self.assertEqual(self.output, "")
        self.assertEqual([stats[key] for key in KEYS], [None, 0.0, None] * 2)

    def test_progress_never_falls_and_ends_at_1(self):
        for target, samples, code in (("2.5%", 40, 0), ("0.00001%", 120, 7)):
            self.assertEqual(self.run_pt("render", COURSEWORK, "-o", "a.png", "--size", "4x3", "--error", target, "--spp",
                                         "120", "--progress", "json", FAKE_PT_SAMPLE_MS=4), code)
            lines = [json.loads(line) for line in self.errors.splitlines()]
            fractions = [line["fraction"] for line in lines]
            self.assertEqual(fractions, sorted(fractions))
            self.assertEqual(fractions.count(1.0), 1)
            self.assertGreater(len(fractions), 1)
            self.assertEqual((lines[-1]["fraction"], lines[-1]["samples_per_pixel"]), (1.0, samples))

    def test_interrupted(self):
        submission = 4 * 17 + 1  # not in the first call, which takes the 16 samples that an error needs
        code = self.run_pt("render", COURSEWORK, "-o", "a.png", "--size", "2x2", "--error", "0.1%", "--stats", "s.json",
                           FAKE_PT_SIGNAL=f"{int(signal.SIGINT)}:{submission}")
        self.assertEqual(code, 130, self.errors)
        self.assertEqual(self.errors, "pt: stopped by SIGINT after 17 of 65536 samples per pixel\n")
        stats = json.loads(self.read("s.json"))
        self.assertEqual((stats["target_reached"], stats["spp"]), (False, 17))


class RealDevice(CommandLineTest):
    program = PT

    def test_target(self):
        arguments = ["render", COURSEWORK, "--size", "32x16", "--stats", "s.json"]
        self.expect(0, *arguments, "-o", "a.exr", "--sampling", "uniform", "--error", "10%")
        stats = json.loads(self.read("s.json"))
        self.assertTrue(stats["target_reached"])
        self.assertTrue(0 < stats["relative_rmse_low"] < stats["relative_rmse"] < stats["relative_rmse_high"] <= 0.1)
        self.assertTrue(0 < stats["rmse_low"] < stats["rmse"] < stats["rmse_high"])

        # The pixels are those of as many samples in one call, and one look at the error earlier was too early.
        self.expect(0, *arguments, "-o", "b.exr", "--spp", str(stats["spp"]))
        self.assertEqual(read_exr_channels(self.path("a.exr")), read_exr_channels(self.path("b.exr")))
        self.assertEqual(json.loads(self.read("s.json"))["rmse"], stats["rmse"])
        step = 2 ** ((stats["spp"] - 1).bit_length() - 1) // 4
        found = self.run_pt(*arguments, "-o", "b.exr", "--sampling", "uniform", "--error", "10%", "--spp",
                            str(stats["spp"] - step))
        self.assertEqual(found, 7)
        self.assertFalse(json.loads(self.read("s.json"))["target_reached"])


if __name__ == "__main__":
    main()
