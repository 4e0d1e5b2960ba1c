"""Tests of `pt bench` as its users meet it. Arguments: see command_line.py."""

import csv
import json
import signal

from command_line import COURSEWORK, PT, CommandLineTest, main


class Bench(CommandLineTest):
    COLUMNS = ["sampler", "estimator", "target_error", "spp", "rounds", "seconds", "processor_seconds", "mse", "rel_mse",
               "efficiency", "slope", "near_reference_noise"]

    def test_wrong_values(self):
        for option, value, error in (("--samplers", "random,sobl", 'did you mean "sobol"?'),
                                     ("--estimators", "mss", 'did you mean "mis"?'), ("--samplers", "random,", ""),
                                     ("--spp", "16,0", "--spp"), ("--spp", "4294967295", "give --reference-spp"),
                                     ("--rounds", "0", "--rounds"), ("--reference-spp", "1", "--reference-spp")):
            with self.subTest(option=option, value=value):
                self.expect(2, "bench", COURSEWORK, option, value, "--csv", "b.csv", error=error)
        self.expect(6, "bench", COURSEWORK, "--json", "none/b.json", error="cannot write none/b.json")
        self.expect(6, "bench", COURSEWORK, "--reference", "none.exr", error="cannot read none.exr")
        self.expect(0, "render", COURSEWORK, "-o", "a.exr", "--size", "4x3", "--spp", "1")
        self.expect(2, "bench", COURSEWORK, "--reference", "a.exr", "--size", "4x2", error="is 4x3, the picture is 4x2")
        self.expect(2, "bench", COURSEWORK, "--reference", "a.exr", "--reference-spp", "9", error="excludes")
        self.assertEqual(self.files(), ["a.exr"])

    def test_target_errors_stand_in_place_of_numbers_of_samples(self):
        for arguments, error in ((("--errors", "5%"), "needs --reference or --reference-spp"),
                                 (("--errors", "5%,0"), "must be a number above 0"),
                                 (("--errors", "5%", "--spp", "4"), "excludes")):
            self.expect(2, "bench", COURSEWORK, *arguments, error=error)

    def test_a_given_reference_is_compared_with(self):
        # The stand-in always shows the same picture.
        arguments = ["bench", COURSEWORK, "--samplers", "random", "--spp", "1", "--rounds", "1", "--csv", "b.csv"]
        self.expect(0, "render", COURSEWORK, "-o", "a.exr", "--size", "4x3", "--spp", "1")
        self.expect(0, *arguments, "--reference", "a.exr", "--size", "4x3")
        row, = csv.DictReader(self.read("b.csv").splitlines())
        self.assertEqual((row["mse"], row["efficiency"], row["near_reference_noise"]), ("0", "", "0"))

    def test_an_interrupted_bench_reports_what_is_done(self):
        # Four submissions a sample: 2 of the reference, 2 and one for the kernel, and after one more in the second run.
        submission = 4 * (2 + 1 + 2 + 1 + 5) + 1
        code = self.run_pt("bench", COURSEWORK, "--samplers", "random", "--spp", "2,100", "--size", "2x2",
                           "--reference-spp", "2", "--csv", "b.csv",
                           FAKE_PT_SIGNAL=f"{int(signal.SIGINT)}:{submission}")
        self.assertEqual(code, 130, self.errors)
        self.assertIn("pt: stopped by SIGINT; the runs done so far are reported", self.errors)
        rows = list(csv.DictReader(self.read("b.csv").splitlines()))
        self.assertEqual([(row["spp"], row["rounds"]) for row in rows], [("2", "1")])
        self.assertIn("random", self.output)
        self.assertEqual(self.files(), ["b.csv"])


class RealDevice(CommandLineTest):
    program = PT

    def test_bench(self):
        self.expect(0, "bench", COURSEWORK, "--size", "16x8", "--samplers", "random,sobol", "--estimators", "mis",
                    "--spp", "16,4", "--rounds", "2", "--reference-spp", "512", "--csv", "b.csv", "--json", "b.json")
        for text in ("reference: 512 spp", "efficiency", "random", "sobol"):
            self.assertIn(text, self.output)
        rows = list(csv.DictReader(self.read("b.csv").splitlines()))
        self.assertEqual(list(rows[0]), Bench.COLUMNS)
        self.assertEqual([(row["sampler"], row["spp"]) for row in rows],
                         [("random", "4"), ("random", "16"), ("sobol", "4"), ("sobol", "16")])
        cells = json.loads(self.read("b.json"))["cells"]
        for row, cell in zip(rows, cells, strict=True):
            self.assertEqual(list(cell), Bench.COLUMNS)
            self.assertEqual((cell["sampler"], cell["rounds"]), (row["sampler"], 2))
            self.assertGreater(cell["seconds"], 0)
            self.assertGreater(cell["mse"], 0)
        for few, many in (cells[0:2], cells[2:4]):
            self.assertIsNone(few["slope"])
            self.assertLess(many["slope"], 0)  # more samples, less error
        self.assertEqual(self.files(), ["b.csv", "b.json"])


if __name__ == "__main__":
    main()
