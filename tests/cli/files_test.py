"""Tests of which files the program reads and writes: standard streams, and outputs that would overwrite what is needed.

Arguments: see command_line.py.
"""

import json
import os
import subprocess

from command_line import COURSEWORK, CommandLineTest, default_signals, main

SCENE = '{"film": {"width": 4, "height": 3}, "render": {"spp": 2}}'
BENCH = ("--samplers", "random", "--spp", "1", "--rounds", "1", "--size", "2x2")


class StandardStreams(CommandLineTest):
    def pipe(self, code, text, *arguments):
        done = subprocess.run([self.program, *arguments], cwd=self.folder, input=text, preexec_fn=default_signals,
                              capture_output=True, text=True, timeout=120, check=False)
        self.output, self.errors = done.stdout, done.stderr
        self.assertEqual(done.returncode, code, done.stderr)

    def test_a_scene_is_read_from_standard_input(self):
        self.pipe(0, SCENE, "render", "-", "-o", "a.png", "--stats", "s.json")
        stats = json.loads(self.read("s.json"))
        self.assertEqual((stats["scene"], stats["width"], stats["spp"]), ("standard input", 4, 2))
        self.pipe(3, '{"speres": []}', "render", "-", "-o", "a.png")
        self.assertIn("pt: standard input: ", self.errors)
        self.pipe(3, "", "render", "-", "-o", "a.png")
        self.assertIn("pt: standard input:1:1: syntax error", self.errors)
        self.pipe(0, SCENE, "bench", "-", *BENCH, "--json", "b.json")
        self.assertEqual(self.files(), ["a.png", "b.json", "s.json"])

    def test_a_closed_standard_input_is_told(self):
        done = subprocess.run(["sh", "-c", '"$0" render - -o a.png <&-', self.program], cwd=self.folder,
                              capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stderr),
                         (6, "pt: cannot read standard input: Bad file descriptor\n"))

    def test_reports_have_standard_output_to_themselves(self):
        for arguments, line in ((("render", COURSEWORK, "-o", "a.png", "--spp", "2", "--stats", "-"), "wrote a.png: "),
                                (("bench", COURSEWORK, *BENCH, "--json", "-"), "reference: 64 spp"),
                                (("selftest", "--json", "-"), "device  fake device")):
            with self.subTest(command=arguments[0]):
                self.run_pt(*arguments)
                self.assertEqual(json.loads(self.output)["device"]["name"], "fake device")
                self.assertIn(line, self.errors)
                self.assertTrue(all(text.startswith("pt: ") for text in self.errors.splitlines()), self.errors)
        self.expect(0, "render", COURSEWORK, "-o", "a.png", "--spp", "2", "--stats", "-", "-q")
        self.assertEqual(self.errors, "")
        self.expect(0, "bench", COURSEWORK, *BENCH, "--csv", "-", "-q")
        self.assertEqual(len(self.output.splitlines()), 2)
        self.assertEqual(self.files(), ["a.png"])

    def test_a_full_standard_output_is_told(self):
        with open("/dev/full", "w", encoding="utf-8") as full:
            done = subprocess.run([self.program, "render", COURSEWORK, "-o", "a.png", "--spp", "1", "--stats", "-"],
                                  cwd=self.folder, stdout=full, stderr=subprocess.PIPE, text=True, check=False)
        self.assertEqual(done.returncode, 6, done.stderr)
        self.assertIn("pt: cannot write to standard output\n", done.stderr)

    def test_what_does_not_go_through_a_stream(self):
        for arguments, error in ((("-o", "-"), "-o -: images are not written"),
                                 (("-o", "a.png", "--standard-error", "-"), "--standard-error -: images are not")):
            self.expect(2, "render", COURSEWORK, *arguments, error=error)
        self.expect(2, "render", "-", "--watch", "-o", "a.png", error="--watch needs a file")
        self.assertEqual(self.files(), [])

    def test_a_file_may_have_that_name(self):
        self.write("-", SCENE)
        self.expect(0, "render", "./-", "-o", "a.png")
        self.assertIn("4x3, 2 spp", self.output)
        self.expect(0, "render", COURSEWORK, "-o", "a.png", "--stats", "./-", "--spp", "1")
        self.assertEqual(json.loads(self.read("-"))["spp"], 1)


if __name__ == "__main__":
    main()
