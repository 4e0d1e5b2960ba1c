"""Tests of the warnings of `pt render`: where they are printed, and where not. Arguments: see command_line.py.

warnings_test.cpp tests what causes them."""

import json

from command_line import COURSEWORK, CommandLineTest, main


class Warnings(CommandLineTest):
    def warnings(self, *options, scene="s.json", code=0, **environment):
        """What --stats says, with -q and without; and that stderr says it once, or not with -q."""
        arguments = ["render", scene, "-o", "a.png", "--size", "8x4", "--stats", "stats.json", *options]
        self.expect(code, *arguments, **environment)
        told = json.loads(self.read("stats.json"))["warnings"]
        self.assertEqual(self.errors, "".join(f"pt: warning: {warning}\n" for warning in told))
        self.assertEqual(self.run_pt(*arguments, "-q", **environment), code)
        self.assertEqual((self.errors, self.output), ("", ""))
        self.assertEqual(json.loads(self.read("stats.json"))["warnings"], told)
        return told

    def test_each(self):
        self.write("s.json", "{}")
        self.assertEqual(self.warnings(), ["s.json: no surface emits light: the picture is black"])
        self.assertEqual(self.warnings(scene=COURSEWORK), [])
        self.assertEqual(self.warnings("--error", "2", "--spp", "16", scene=COURSEWORK, FAKE_PT_FAIL="rejected:-1"),
                         ["--error: the target is 200%; two percent are written 2% or 0.02",
                          "3 samples (0.586%) were left out: not finite, negative or too bright"])

    def test_an_error_comes_without(self):
        self.write("s.json", "{}")
        self.expect(3, "render", "s.json", "-o", "a.png", FAKE_PT_FAIL="set_scene:-2", FAKE_PT_MESSAGE="a rule")
        self.assertNotIn("warning", self.errors)


if __name__ == "__main__":
    main()
