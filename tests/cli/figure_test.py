"""Tests of `pt figure`: the picture, its background and its legend, the scene that it writes, and what it refuses.

Arguments: see command_line.py."""

import json
import xml.etree.ElementTree

from command_line import PT, CommandLineTest, main, read_png

WIDTH, HEIGHT = 64, 48
SMALL = ("--size", f"{WIDTH}x{HEIGHT}", "--spp", "2")
LIGHT = 0.4375  # of the surround
SPEEDS = (-1.5, 0.25, 2.0)
PARTICLES = """3
Properties=species:S:1:pos:R:3:speed:R:1
H 0 0 0 -1.5
O 1.5 0 0 0.25
<C> 0 1.5 1 2
"""


class FigureTest(CommandLineTest):
    def setUp(self):
        super().setUp()
        self.write("a.xyz", PARTICLES)

    def figure(self, *options, code=0, error=None):
        self.expect(code, "figure", "a.xyz", *options, error=error)

    def contents(self, name):
        with open(self.path(name), "rb") as file:
            return file.read()

    def pixels(self, name, channels):
        """Rows of pixels."""
        width, height, rows = read_png(self.path(name))
        self.assertEqual((width, height), (WIDTH, HEIGHT))
        self.assertEqual({len(row) for row in rows}, {channels * WIDTH})
        return [[tuple(row[i:i + channels]) for i in range(0, len(row), channels)] for row in rows]


def corners_of(rows):
    return {rows[y][x] for y in (0, -1) for x in (0, -1)}


class Pictures(FigureTest):
    program = PT

    def test_white_and_its_scene(self):
        self.figure("-o", "a.png", "-o", "a.exr", "--write-scene", "a.json", *SMALL)
        rows = self.pixels("a.png", 3)
        self.assertEqual(corners_of(rows), {(255, 255, 255)})
        # The margin is 3% of a side: of the frame of pixels that lie in it as a whole none has anything but white, and
        # the balls, which come up to it at two opposite sides, are next to it.
        outer = [row[x] for row in rows for x in (0, WIDTH - 1)] + rows[0] + rows[-1]
        self.assertEqual(set(outer), {(255, 255, 255)})
        coloured = [(x, y) for y in range(HEIGHT) for x in range(WIDTH) if rows[y][x] != (255, 255, 255)]
        extents = [(min(axis), max(axis)) for axis in zip(*coloured)]
        self.assertTrue(any(low <= 0.03 * size + 1 and high >= 0.97 * size - 2
                            for (low, high), size in zip(extents, (WIDTH, HEIGHT))), extents)
        self.assertGreater(len({rows[y][x] for x, y in coloured}), 50)  # shaded

        self.expect(0, "render", "a.json", "-o", "b.exr", "-q")
        self.assertEqual(self.contents("a.exr"), self.contents("b.exr"))
        self.expect(0, "render", "a.json", "-o", "c.exr", "--seed", "1", "-q")
        self.assertNotEqual(self.contents("a.exr"), self.contents("c.exr"))

    def test_transparent(self):
        self.figure("-o", "a.png", "--background", "transparent", *SMALL)
        rows = self.pixels("a.png", 4)
        self.assertEqual({alpha for *_, alpha in corners_of(rows)}, {0})
        self.assertEqual(max(alpha for row in rows for *_, alpha in row), 255)


class Files(FigureTest):
    """What needs no device."""

    def legend(self, column):
        self.figure("--color", column, "--legend", "l.svg")
        self.assertEqual(self.files(), ["a.xyz", "l.svg"])
        names = {"svg": "http://www.w3.org/2000/svg"}
        root = xml.etree.ElementTree.parse(self.path("l.svg")).getroot()
        self.assertEqual(root.tag, "{%s}svg" % names["svg"])
        return root, names, [text.text for text in root.findall("svg:text", names)]

    def test_legend_of_numbers(self):
        root, names, (title, *numbers) = self.legend("speed")
        self.assertEqual(title, "speed")
        bar = root.find("svg:rect", names).attrib
        bottom, top = float(bar["y"]) + float(bar["height"]), float(bar["y"])
        heights = [float(line.attrib["y1"]) for line in root.findall("svg:line", names)]
        self.assertGreater(len(numbers), 2)
        # The ticks are where their numbers are in the range, to the six digits that are written of the heights.
        for number, height in zip(numbers, heights, strict=True):
            share = (float(number) - SPEEDS[0]) / (SPEEDS[-1] - SPEEDS[0])
            self.assertAlmostEqual(height, bottom + share * (top - bottom), delta=1e-3)

    def test_legend_of_types(self):
        root, names, texts = self.legend("type")
        self.assertEqual(sorted(texts[1:]), ["<C>", "H", "O"])
        colours = {circle.attrib["fill"] for circle in root.findall("svg:circle", names)}
        self.assertEqual(len(colours), 3)

    def test_the_scene_has_the_particles(self):
        self.figure("--write-scene", "a.json", "--radius", "0.25", *SMALL)
        scene = json.loads(self.read("a.json"))
        balls = [sphere for sphere in scene["spheres"] if sphere["radius"] == 0.25]
        self.assertEqual([ball["center"] for ball in balls], [[0, 0, 0], [1.5, 0, 0], [0, 1.5, 1]])
        self.assertEqual(len({ball["material"] for ball in balls}), 3)
        self.assertEqual(scene["materials"]["surround"], {"emission": LIGHT})
        self.assertEqual((scene["film"]["width"], scene["film"]["height"], scene["render"]["spp"]), (WIDTH, HEIGHT, 2))


class Refusals(FigureTest):
    def test_options(self):
        for options, said in ((["--style", "shiny"], '--style: unknown style "shiny", known: matte, glossy'),
                              (["--view", "1,2"], "--view: must be three-quarter|front"),
                              (["--view", "0,0,0"], "--view: must be three-quarter|front"),
                              (["--view", "frnt"], "--view: must be three-quarter|front"),
                              (["--up", "w"], "--up: must be x, y or z"),
                              (["--radius", "0"], "--radius: must be a number from"),
                              (["--projection", "fisheye"], '--projection: unknown projection "fisheye"'),
                              (["--floor", "--view", "bottom"], "--floor: the camera is below it, by --view"),
                              (["--color", "mass"], 'a.xyz: unknown column "mass", known: '),
                              (["--frame", "1"], "frame 1: the file has 1 frame"),
                              (["--legend", "a.xyz"], "--legend"),
                              (["-o", "b.jpg", "--background", "transparent"], "--background transparent: -o b.jpg")):
            with self.subTest(options=options):
                self.figure("-o", "a.png", *SMALL, *options, code=2, error=said)
                self.assertEqual(self.files(), ["a.xyz"])

    def test_nothing_to_write(self):
        self.figure(code=2, error="-o, --write-scene or --legend is missing")

    def test_data(self):
        self.expect(6, "figure", "none.xyz", "-o", "a.png", error="pt: cannot read none.xyz: ")
        self.write("b.xyz", "2\n\nH 0 0 0\n")
        self.expect(3, "figure", "b.xyz", "-o", "a.png", error="pt: b.xyz")
        self.write("b.xyz", "0\n\n")
        self.expect(6, "figure", "b.xyz", "-o", "a.png", error="pt: b.xyz: has no particles")
        self.assertEqual(self.files(), ["a.xyz", "b.xyz"])


if __name__ == "__main__":
    main()
