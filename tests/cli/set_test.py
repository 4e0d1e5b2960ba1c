"""Tests of `pt render --set`: values that replace the scene's reach the picture, and mistakes are blamed on the option.

Arguments: see command_line.py.
"""

import json

from command_line import COURSEWORK, PT, RESULT, CommandLineTest, main, read_png


class Set(CommandLineTest):
    def test_settings_of_the_picture(self):
        self.expect(0, "render", COURSEWORK, "-o", "a.png", "--set", "film.width=5", "--set=film.height=3", "--set",
                    "render.spp=2", "--set", "film.exposure=-2.5", "--stats", "s.json")
        stats = json.loads(self.read("s.json"))
        self.assertEqual((stats["width"], stats["height"], stats["spp"]), (5, 3, 2))
        self.assertEqual(stats["tone_map"]["exposure"], -2.5)
        self.expect(0, "render", COURSEWORK, "-o", "a.png", "--set", "film.width=5", "--size", "2x2", "--spp", "1")
        self.assertEqual(read_png(self.path("a.png"))[:2], (2, 2))  # other options count more

    def test_mistakes_are_the_options(self):
        for setting, error in (("camera", "--set camera: must be a value within a section"),
                               ("camera.fov=3", '--set camera.fov=3: camera: unknown key "fov"'),
                               ("spheres[99].radius=3", "--set spheres[99].radius=3: the scene has no spheres[99]")):
            self.expect(2, "render", COURSEWORK, "-o", "a.png", "--set", setting, error=f"pt: {error}")
        for function, code in ("set_scene:", 2), ("set_camera:", 2):
            self.expect(code, "render", COURSEWORK, "-o", "a.png", "--set", "spheres[0].radius=-1",
                        FAKE_PT_FAIL=function + str(RESULT["INVALID_SCENE"]),
                        FAKE_PT_RULE="spheres,0,radius,-1,,-1,must be > 0",
                        error="pt: --set spheres[0].radius=-1: spheres[0].radius = -1: must be > 0")
        self.expect(2, "render", COURSEWORK, "-o", "a.png", "--set", "film.width=5",
                    FAKE_PT_FAIL=f"set_render:{RESULT['INVALID_ARGUMENT']}",
                    FAKE_PT_RULE="render,-1,width,-1,,0,must be >= 1",
                    error="pt: --set film.width=5: film.width = 0: must be >= 1")
        self.assertEqual(self.files(), [])


class RealDevice(CommandLineTest):
    program = PT

    def test_the_picture_is_that_of_the_changed_scene(self):
        lamp = ('{"materials": {"l": {"emission": %s}}, '
                '"spheres": [{"center": [0, 0, -5], "radius": %s, "material": "l"}]}')
        arguments = ("--size", "8x4", "--spp", "4", "--exposure", "0", "-q", "-o")
        self.write("a.json", lamp % (0.25, 3))
        self.write("b.json", lamp % (0.5, 1))
        self.expect(0, "render", "a.json", *arguments, "a.png")
        self.expect(0, "render", "b.json", *arguments, "b.png", "--set", "materials.l.emission=0.25", "--set",
                    "spheres[0].radius=3")
        self.assertEqual(read_png(self.path("a.png")), read_png(self.path("b.png")))
        self.expect(0, "render", "b.json", *arguments, "b.png")
        self.assertNotEqual(read_png(self.path("a.png")), read_png(self.path("b.png")))


if __name__ == "__main__":
    main()
