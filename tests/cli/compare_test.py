import json
import os
import shutil

from command_line import COURSEWORK, PT, SCENES, CommandLineTest, read_png

SHADERS = os.path.join(SCENES, "..", "..", "shaders")
MODULE = os.path.join(os.path.dirname(os.path.dirname(PT)), "lib", "pt", "libpt-glsl.so")

SIZE = ("--size", "5x3", "--spp", "1")
BRIGHTER = {"FAKE_PT_FAIL": "split:1"}
MSE, RELATIVE_MSE = 1 / 3, 1 / (4 + 0.01) / 3


class Compare(CommandLineTest):
    made = {}

    def setUp(self):
        super().setUp()
        if not self.made:
            self.expect(0, "render", COURSEWORK, *SIZE, "-o", "r.exr", "-o", "r.png", "--exposure", "-4")
            self.expect(0, "render", COURSEWORK, *SIZE, "-o", "a.exr", "-o", "a.png", "--exposure", "-4", **BRIGHTER)
            self.made.update((name, self.contents(name)) for name in self.files())
        for name, data in self.made.items():
            self.write(name, data)

    def figures(self, *arguments, code=0):
        self.expect(code, "compare", *arguments, "--json", "c.json")
        return json.loads(self.read("c.json"))

    def test_figures(self):
        figures = self.figures("a.exr", "r.exr")
        self.assertAlmostEqual(figures["mse"], MSE, places=15)
        self.assertAlmostEqual(figures["relative_mse"], RELATIVE_MSE, places=15)
        self.assertEqual((figures["maximum"], figures["maximum_at"]), (1, {"x": 0, "y": 0, "channel": "B"}))
        self.assertEqual(self.output, "mse           0.333333\nrelative_mse  0.0831255\nmaximum       1 at 0,0 in B\n")
        figures = self.figures("r.png", "r.png")
        self.assertEqual((figures["mse"], figures["relative_mse"], figures["maximum"]), (0, 0, 0))
        self.assertEqual(self.output, "mse           0\nrelative_mse  0\nmaximum       0\n")
        self.assertEqual(self.figures("a.exr", "r.exr", "--layer", "R")["maximum"], 0)
        self.assertEqual(self.figures("a.exr", "r.exr", "--layer", "B")["mse"], 1)
        self.expect(0, "compare", "r.png", "r.png", "--json", "-")
        self.assertEqual(json.loads(self.output)["mse"], 0)
        self.assertIn("pt: mse", self.errors)

    def test_pictures_are_compared_as_displays_take_them(self):
        def signal(light):
            return round(255 * (1.055 * (light / 16) ** (1 / 2.4) - 0.055)) / 255

        maximum = signal(3) - signal(2)
        figures = self.figures("a.png", "r.png")
        self.assertAlmostEqual(figures["maximum"], maximum, delta=1e-7)
        self.assertAlmostEqual(figures["mse"], maximum ** 2 / 3, delta=1e-7)

    def test_limits(self):
        figures = self.figures("a.png", "r.png")
        for option, name in (("--max-mse", "mse"), ("--max-relative-mse", "relative_mse"), ("--max-difference", "maximum")):
            with self.subTest(option=option):
                below, above = repr(figures[name] * (1 - 1e-12)), repr(figures[name] * (1 + 1e-12))
                self.expect(0, "compare", "a.png", "r.png", option, above)
                self.expect(8, "compare", "a.png", "r.png", option, below)
                self.assertEqual(len(self.errors.splitlines()), 1)
                self.assertTrue(self.errors.startswith(f"pt: {name} is "), self.errors)
                self.expect(0, "compare", "r.png", "r.png", option, "0", "-q")
                self.assertEqual(self.output, "")
                for wrong in "-1", "nan":
                    self.expect(2, "compare", "a.png", "r.png", option, wrong, error=option)
        figures = self.figures("a.exr", "r.exr", "--max-mse", "0.1", "--max-difference", "1", code=8)
        self.assertEqual(figures["exceeded"], ["mse is 0.333333, above the limit of 0.1"])
        self.figures("a.png", "r.png", "--max-mse", "1e-9", "--max-difference", "1e-9", code=8)
        self.assertEqual(len(self.errors.splitlines()), 2)

    def test_places_are_those_of_the_whole_picture(self):
        for name, environment in ("b.exr", BRIGHTER), ("s.exr", {}):
            self.expect(0, "render", COURSEWORK, *SIZE, "-o", name, "--crop", "2,1,2,2", **environment)
        self.assertEqual(self.figures("b.exr", "s.exr")["maximum_at"], {"x": 2, "y": 1, "channel": "B"})

    def test_what_cannot_be_compared(self):
        self.expect(0, "render", COURSEWORK, "--size", "3x5", "--spp", "1", "-o", "b.png")
        self.expect(0, "render", COURSEWORK, *SIZE, "--crop", "1,0,3,3", "-o", "c.exr")
        self.expect(0, "render", COURSEWORK, *SIZE, "--crop", "2,0,3,3", "-o", "d.exr")
        self.expect_refusals("compare", (
                (2, ("a.png", "b.png"), "a.png is 5x3 at 0,0 of 5x3, b.png is 3x5 at 0,0 of 3x5: they must be equally"),
                (2, ("c.exr", "d.exr"), "must be equally large"),
                (2, ("a.exr", "a.png"), "a.exr holds radiance, a.png holds numbers for displays: both must hold the same"),
                (6, ("a.png", "none.png"), "cannot read none.png"),
                (6, ("a.exr", "r.exr", "--layer", "albedo"), "R, G and B of the layer albedo, or a channel"),
                (2, ("a.png", "r.png", "--json", "r.png"), "is the same file as the reference r.png"),
                (2, ("a.png", "r.png", "--json", "a.png"), "is the same file as the image a.png"),
                (2, ("a.png",), "REFERENCE is required")))


class RealDevice(CommandLineTest):
    program = PT

    def test_what_is_not_finite_exceeds_every_limit(self):
        # The estimate uses two parts of the samples. With fewer than 9 samples, the second part is empty.
        self.expect(0, "render", COURSEWORK, *SIZE, "-o", "e.exr", "--layers", "standard-error")
        compare = ("compare", "e.exr", "e.exr", "--layer", "standard_error")
        self.expect(0, *compare)
        self.assertIn("\nnot finite    15 pixels, not counted above\n", self.output)
        for option in "--max-mse", "--max-difference":
            self.expect(8, *compare, option, "1e18", error="pt: 15 pixels are not finite")


class LightOnDevice(CommandLineTest):
    program = PT
    SIZE = ("--size", "64x48", "--spp", "32", "-q")

    def film(self, name, *more):
        self.expect(0, "render", COURSEWORK, *self.SIZE, "--film", f"{name}.ptfilm", *more)

    def test_verdicts_and_exit_codes(self):
        layers = ("--layers", "mean,sample-count", "-o")
        self.film("a", *layers, "a.exr")
        self.film("b", "--seed", "1")
        self.film("darker", "--seed", "2", "--set", "materials.floor.diffuse=0.72", *layers, "darker.exr")
        self.expect(0, "compare", "a.ptfilm", "a.ptfilm")
        self.assertIn("\nequal bits\n", self.output)
        self.expect(0, "compare", "a.ptfilm", "b.ptfilm", "--min-change", "5%")
        self.assertRegex(self.output, r"\nsame light: a change by [\d.]+% of all light.* would have been found\n")
        self.expect(9, "compare", "a.ptfilm", "b.ptfilm", "--min-change", "1e-5")
        self.assertIn("\ntoo few samples to tell: ", self.output)
        for ending in "ptfilm", "exr":
            self.expect(8, "compare", f"darker.{ending}", f"a.{ending}", "--json", "j.json", "--difference", "d.png")
            self.assertRegex(self.output, r"\ndifferent light: -.*\n  \d+x\d+ pixels at \d+,\d+: difference \(-")
            verdict = json.loads(self.read("j.json"))
            self.assertEqual((verdict["light"], verdict["rate"]), ("different", 1e-6))
            self.assertLess(verdict["probability"], 1e-6)
            self.assertEqual([verdict["regions"][0][name] for name in ("x", "y", "width", "height")], [0, 0, 64, 48])
            self.assertLess(verdict["regions"][0]["difference"][0], 0)
            width, height, rows = read_png(self.path("d.png"))
            self.assertEqual((width, height), (64, 48))
            self.assertEqual(rows[47][2::3], [255] * 64)  # The floor is darker than the limit, so it is shown in blue.
            self.assertLess(max(rows[47][0::3]), 255)

    def test_what_cannot_be_tested(self):
        self.film("a")
        self.film("h", "--sampler", "halton")
        self.expect(0, "render", COURSEWORK, "--size", "64x48", "--error", "5%", "-q", "--film", "u.ptfilm")
        self.expect(2, "compare", "a.ptfilm", "h.ptfilm", error="the reference: sampler = 2: must not be")
        self.expect(2, "compare", "u.ptfilm", "a.ptfilm", error="must be min_samples")
        self.expect(0, "render", COURSEWORK, *self.SIZE, "-o", "plain.png")
        for option in ("--rate", "0.1"), ("--min-change", "1%"), ("--difference", "d.png"):
            self.expect(2, "compare", "plain.png", "plain.png", *option, error="need two films, or two .exr with")
        self.expect(2, "compare", "a.ptfilm", "a.ptfilm", "--min-change", "0", error="must be above 0 and at most 1")
        self.expect(2, "compare", "a.ptfilm", "a.ptfilm", "--difference", "d.exr", error="must end in .png")
        self.expect(2, "compare", COURSEWORK, "a.ptfilm", "--shader-dir", ".", error="no REFERENCE")

    def test_kernels(self):
        if not os.path.exists(MODULE):
            self.skipTest("built without glslang")
        shutil.copytree(SHADERS, self.path("shaders"))
        scene = ("compare", COURSEWORK, "--shader-dir", "shaders", "--set", "film.width=64", "--set", "film.height=48")
        self.expect(0, *scene)
        self.assertTrue(self.output.endswith("256 samples: equal bits\n"), self.output)
        phong = self.read("shaders/phong.glsl")
        self.assertEqual(phong.count("vec3 f = material.diffuse;"), 1)
        self.write("shaders/phong.glsl", phong.replace("vec3 f = material.diffuse;", "vec3 f = 0.97 * material.diffuse;"))
        self.expect(8, *scene, "--json", "j.json")
        self.assertEqual(json.loads(self.read("j.json"))["light"], "different")
        self.expect(9, *scene, "--set", "render.spp=2")
        self.expect(2, *scene, "--set", "render.sampler=halton", error="sampler = 2: must not be")
