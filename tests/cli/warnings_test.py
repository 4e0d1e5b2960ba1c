"""Tests of the warnings of `pt render`: where they are printed, and where not. Arguments: see command_line.py.

warnings_test.cpp tests what causes them."""

import json
import os

from command_line import COURSEWORK, PT, SCENES, CommandLineTest, main, read_png

MATERIALS = "materials[\"blue ball\"], materials[\"pale ball\"]: diffuse + specular = 1.9 at the most"


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
        coursework = os.path.join(SCENES, "coursework.json")
        warning, = self.warnings(scene=coursework)
        self.assertIn(MATERIALS, warning)
        self.assertEqual(self.warnings(scene=COURSEWORK), [])
        self.assertEqual(self.warnings("--error", "2", scene=COURSEWORK),
                         ["--error: the target is 200%; two percent are written 2% or 0.02"])
        self.assertEqual(self.warnings("--spp", "2", scene=COURSEWORK, FAKE_PT_FAIL="rejected:-1"),
                         ["3 samples (4.69%) were left out: not finite, negative or too bright"])

    def test_several(self):
        self.write("s.json", "{}")
        warnings = self.warnings("--error", "3", "--exposure", "0", "--spp", "4", code=7, FAKE_PT_FAIL="rejected:-1")
        self.assertEqual(len(warnings), 3, warnings)

    def test_an_error_comes_without(self):
        self.write("s.json", "{}")
        self.expect(3, "render", "s.json", "-o", "a.png", FAKE_PT_FAIL="set_scene:-2", FAKE_PT_MESSAGE="a rule")
        self.assertNotIn("warning", self.errors)


class RealDevice(CommandLineTest):
    program = PT

    def test_a_camera_that_is_shut_in_sees_nothing(self):
        scene = {"materials": {"lamp": {"emission": 1}, "ball": {"diffuse": 0.9}},
                 "spheres": [{"center": [0, 0, 1], "radius": 2, "material": "ball"},
                             {"center": [0, 0, 0], "radius": 9, "material": "lamp"}]}
        for radius, is_told in ((2, True), (0.5, False)):
            scene["spheres"][0].update(radius=radius, center=[0, 0, 1 if is_told else 5])
            self.write("s.json", json.dumps(scene))
            self.expect(0, "render", "s.json", "-o", "a.png", "--size", "4x2", "--spp", "4")
            self.assertEqual("is the camera inside of a ball" in self.errors, is_told, self.errors)
            self.assertEqual(read_png(self.path("a.png"))[2] == [[0] * 12] * 2, is_told)


if __name__ == "__main__":
    main()
