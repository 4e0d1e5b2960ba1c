"""`pt compare`: figures, limits, exit codes, refusals."""

import json

from command_line import COURSEWORK, PT, CommandLineTest, main

SIZE = ("--size", "5x3", "--spp", "1")
BRIGHTER = {"FAKE_PT_FAIL": "split:1"}
MSE, RELATIVE_MSE = 1 / 3, 1 / (4 + 0.01) / 3


class Compare(CommandLineTest):
    made = {}  # images, rendered once

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
        self.assertEqual((figures["not_finite"], figures["exceeded"]), (0, []))
        self.assertEqual(self.output, "mse           0.333333\nrelative_mse  0.0831255\nmaximum       1 at 0,0 in B\n")
        figures = self.figures("r.exr", "r.exr")
        self.assertEqual((figures["mse"], figures["relative_mse"], figures["maximum"]), (0, 0, 0))
        self.assertEqual(self.output, "mse           0\nrelative_mse  0\nmaximum       0\n")

    def test_pictures_are_compared_as_displays_take_them(self):
        def signal(light):
            return round(255 * (1.055 * (light / 16) ** (1 / 2.4) - 0.055)) / 255

        maximum = signal(3) - signal(2)
        figures = self.figures("a.png", "r.png")
        self.assertAlmostEqual(figures["maximum"], maximum, delta=1e-7)  # of float32
        self.assertAlmostEqual(figures["mse"], maximum ** 2 / 3, delta=1e-7)

    def test_limits(self):
        for option, figure, name in (("--max-mse", MSE, "mse"), ("--max-relative-mse", RELATIVE_MSE, "relative_mse"),
                                     ("--max-difference", 1, "maximum")):
            with self.subTest(option=option):
                below, above = repr(figure * (1 - 1e-12)), repr(figure * (1 + 1e-12))  # of sums of 45 numbers
                self.expect(0, "compare", "a.exr", "r.exr", option, above)
                self.expect(8, "compare", "a.exr", "r.exr", option, below)
                self.assertEqual(len(self.errors.splitlines()), 1)
                self.assertTrue(self.errors.startswith(f"pt: {name} is "), self.errors)
                self.expect(0, "compare", "r.exr", "r.exr", option, "0", "-q")
                self.assertEqual(self.output, "")
                self.expect(2, "compare", "a.exr", "r.exr", option, "-1", error=option)
                self.expect(2, "compare", "a.exr", "r.exr", option, "nan", error=option)
        figures = self.figures("a.exr", "r.exr", "--max-mse", "0.1", "--max-difference", "1", code=8)
        self.assertEqual(figures["exceeded"], ["mse is 0.333333, above the limit of 0.1"])
        self.figures("a.exr", "r.exr", "--max-mse", "0.1", "--max-difference", "0.5", code=8)
        self.assertEqual(len(self.errors.splitlines()), 2)

    def test_places_are_those_of_the_whole_picture(self):
        for name, environment in ("b.exr", BRIGHTER), ("s.exr", {}):
            self.expect(0, "render", COURSEWORK, *SIZE, "-o", name, "--crop", "2,1,2,2", **environment)
        self.assertEqual(self.figures("b.exr", "s.exr")["maximum_at"], {"x": 2, "y": 1, "channel": "B"})

    def test_what_cannot_be_compared(self):
        self.expect(0, "render", COURSEWORK, "--size", "3x5", "--spp", "1", "-o", "b.exr")
        self.expect(0, "render", COURSEWORK, *SIZE, "--crop", "1,0,3,3", "-o", "c.exr")
        self.expect(0, "render", COURSEWORK, *SIZE, "--crop", "2,0,3,3", "-o", "d.exr")
        for code, arguments, error in (
                (2, ("a.exr", "b.exr"), "a.exr is 5x3 at 0,0 of 5x3, b.exr is 3x5 at 0,0 of 3x5: they must be equally"),
                (2, ("a.exr", "c.exr"), "they must be equally large"), (2, ("c.exr", "d.exr"), "must be equally large"),
                (2, ("a.exr", "a.png"), "a.exr holds radiance, a.png numbers for a display: they must be of one kind"),
                (6, ("a.exr", "none.exr"), "cannot read none.exr"),
                (6, ("a.exr", "r.exr", "--layer", "albedo"), "R, G and B of the layer albedo, or a channel"),
                (2, ("a.exr", "r.exr", "--json", "r.exr"), "is the same file as the reference r.exr"),
                (2, ("a.exr", "r.exr", "--json", "a.exr"), "is the same file as the image a.exr"),
                (2, ("a.exr",), "REFERENCE is required")):
            with self.subTest(arguments=arguments):
                before = self.files()
                self.expect(code, "compare", *arguments, error=error)
                self.assertEqual(self.files(), before)

    def test_a_layer_of_one_channel(self):
        self.assertEqual(self.figures("a.exr", "r.exr", "--layer", "R")["maximum"], 0)
        self.assertEqual(self.figures("a.exr", "r.exr", "--layer", "B")["mse"], 1)

    def test_figures_to_standard_output(self):
        self.expect(0, "compare", "r.exr", "r.exr", "--json", "-")
        self.assertEqual(json.loads(self.output)["mse"], 0)
        self.assertIn("pt: mse", self.errors)


class RealDevice(CommandLineTest):
    program = PT

    def test_what_is_not_finite_exceeds_every_limit(self):
        # Fewer than 9 samples leave the second part empty.
        self.expect(0, "render", COURSEWORK, *SIZE, "-o", "e.exr", "--layers", "standard-error")
        compare = ("compare", "e.exr", "e.exr", "--layer", "standard_error")
        self.expect(0, *compare)
        self.assertIn("\nnot finite    15 pixels, left out above\n", self.output)
        for option in "--max-mse", "--max-relative-mse", "--max-difference":
            self.expect(8, *compare, option, "1e18", error="pt: 15 pixels are not finite")


if __name__ == "__main__":
    main()
