"""Tests of `pt figure`: the picture, its background and its legend, the scene that it writes, and what it refuses.

Arguments: see command_line.py."""

import json
import os
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

    def test_scenes_with_a_figure(self):
        """Each pair is one picture: the options, and the scene of a few lines."""
        for options, figure, particles in (
                ((), {}, {}),
                (("--view", "1,-2,0.5", "--up", "-y", "--projection", "orthographic", "--floor"),
                 {"view": [2, -4, 1], "up": "-y", "projection": "orthographic", "floor": True}, {}),
                (("--style", "glossy", "--color", "speed", "--colormap", "cividis", "--color-range", "-1,1"),
                 {"style": "glossy"}, {"color": {"column": "speed", "map": "cividis", "range": [-1, 1]}}),
                (("--style", "ambient-occlusion", "--radius", "0.3", "--where", "speed > 0", "--view", "top"),
                 {"style": "ambient-occlusion", "view": "top"}, {"radius": 0.3, "where": ["speed > 0"]})):
            with self.subTest(options=options):
                self.write("s.json", json.dumps({"figure": figure, "particles": [{"file": "a.xyz", **particles}],
                                                 "materials": {"unused": {"diffuse": 0.5, "emission": 3}}}))
                self.figure("-o", "a.exr", "--write-scene", "w.json", *options, *SMALL)
                self.expect(0, "render", "s.json", "-o", "b.exr", "-q", *SMALL)
                self.expect(0, "render", "w.json", "-o", "c.exr", "-q")
                for name in "b.exr", "c.exr":
                    self.expect(0, "compare", "a.exr", name, "--max-difference", "0", "-q")
        self.expect(0, "render", "s.json", "-o", "b.exr", "-q", *SMALL, "--set", "figure.view=front")
        self.expect(8, "compare", "a.exr", "b.exr", "--max-difference", "0", "-q")

    def test_transparent(self):
        self.figure("-o", "a.png", "--background", "transparent", *SMALL)
        rows = self.pixels("a.png", 4)
        self.assertEqual({alpha for *_, alpha in corners_of(rows)}, {0})
        self.assertEqual(max(alpha for row in rows for *_, alpha in row), 255)


class Files(FigureTest):
    """What needs no device."""

    def legend(self, column, *options):
        self.figure("--color", column, "--legend", "l.svg", *options)
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

    def test_legend_has_the_range(self):
        for options, ends in (((), SPEEDS[::2]), (("--color-range", "-3,2.75"), (-3, 2.75))):
            _, _, texts = self.legend("speed", *options)
            self.assertEqual((float(texts[1]), float(texts[-1])), ends)
            self.assertEqual("pt: --color: speed from -1.5 to 2\n" in self.errors, not options)

    def test_the_scene_names_the_particles(self):
        os.mkdir(self.path("out"))
        self.figure("--write-scene", "out/a.json", "--radius", "H=0.25,O=0.5,<C>=1", "--where", "y < 1", "--frame", "0",
                    "--wrap", "--color", "speed", "--colormap", "magma", *SMALL)
        scene = json.loads(self.read("out/a.json"))
        self.assertEqual(scene["particles"], [
            {"file": "../a.xyz", "frame": 0, "wrap": True, "where": ["y < 1"],
             "radius": {"types": {"<C>": 1, "H": 0.25, "O": 0.5}},
             "color": {"column": "speed", "map": "magma", "range": [-1.5, 0.25]}, "material": "particles"}])
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
                              (["--floor", "--view", "bottom"], "--floor: the camera is below it, by the view"),
                              (["--color", "mass"], '--color mass: a.xyz: unknown column "mass", known: '),
                              (["--color", "sped"], 'unknown column "sped", did you mean "speed"?'),
                              (["--color", "x,y,mass"], '--color x,y,mass: a.xyz: unknown column "mass"'),
                              (["--radius", "mass"], '--radius mass: a.xyz: unknown column "mass"'),
                              (["--where", "mass > 1"], '--where mass > 1: a.xyz: unknown column "mass"'),
                              (["--where", "speed"], '--where: "speed": must be a column, one of <'),
                              (["--radius", "covalent"], "--radius covalent: a.xyz: the type <C>: must be an element"),
                              (["--radius", "O=1,H=2"],
                               "--radius O=1,H=2: a.xyz: the type <C> is none of those with a radius, H and O"),
                              (["--radius", "O=1,O=2"], "--radius: must be a number from"),
                              (["--radius", "O=-1"], "--radius: must be a number from"),
                              (["--colormap", "magna"], 'unknown colour map "magna", did you mean "magma"?'),
                              (["--colormap", "magma"], "--colormap: needs --color and a column of numbers"),
                              (["--color", "type", "--color-range", "0,1"],
                               "--color-range: needs --color and columns of numbers, which type is not"),
                              (["--color-range", "1,1"], "--color-range: must be two numbers like"),
                              (["--frame", "1"], "frame 1: the file has 1 frame"),
                              (["--legend", "a.xyz"], "--legend"),
                              (["-o", "b.jpg", "--background", "transparent"], "--background transparent: -o b.jpg")):
            with self.subTest(options=options):
                self.figure("-o", "a.png", *SMALL, *options, code=2, error=said)
                self.assertEqual(self.files(), ["a.xyz"])

    def test_scenes(self):
        """Faults of "figure" and of "particles", by the rest of the scene and what is said."""
        particles = {"file": "a.xyz"}
        material = {"materials": {"a": {"diffuse": 1}}}
        for scene, said in (
                ({"particles": [particles]}, 'particles[0]: "material" is missing, which only particles of a figure'),
                ({"figure": {}}, "figure: the scene has no particles"),
                ({"figure": {}, "particles": [particles], "camera": {"position": [0, 0, 1], "look_at": [0, 0, 0]}},
                 "camera: a scene has either a camera or a figure"),
                ({"figure": {"view": "frnt"}}, 'figure.view: unknown view "frnt", did you mean "front"?'),
                ({"figure": {"up": "1,0,0"}}, "figure.up: must be x, y or z"),
                ({"figure": {"up": [0, 0, 0]}}, "figure.up: must not be [0, 0, 0]"),
                ({"figure": {"floor": 1}}, "figure.floor: must be true or false, is 1"),
                ({"figure": {"floor": True, "view": "bottom"}, "particles": [particles]},
                 "figure.floor: the camera is below it"),
                ({"figure": {}, "particles": [{**particles, "where": ["x > 9"]}]}, "figure: its particles are none"),
                ({"figure": {}, "particles": [{**particles, "radius": {"types": {"H": 1, "O": 1}}}]},
                 "particles[0].radius: a.xyz: the type <C> is none of those with a radius, H and O"),
                ({"figure": {}, "particles": [{**particles, "color": {"types": {"H": 1}}}]},
                 "particles[0].color: a.xyz: the type O is none of those with a colour, H"),
                ({"figure": {}, "particles": [{**particles, "color": {"types": {"H": 1.5}}}]},
                 "particles[0].color.types.H: must be from 0 to 1, is 1.5"),
                ({"figure": {}, "particles": [{**particles, "radius": {"types": {"H": 0}}}]},
                 "particles[0].radius.types.H: must be > 0, is 0"),
                ({"figure": {}, "particles": [{**particles, "radius": {"types": {"H": 1}, "column": "x"}}]},
                 'particles[0].radius: must be a number, or have one of "column", "elements" or "types"'),
                ({**material, "particles": [{**particles, "material": "a", "color": {"column": "mass"}}]},
                 'particles[0].color: a.xyz: unknown column "mass", known: ')):
            with self.subTest(scene=scene):
                self.write("s.json", json.dumps(scene))
                self.expect(3, "render", "s.json", "-o", "a.png", error=said)
                self.assertEqual(self.files(), ["a.xyz", "s.json"])
        self.write("s.json", json.dumps({"figure": {}, "particles": [particles]}))
        self.expect(2, "render", "s.json", "-o", "a.png", "--stats", "a.xyz",
                    error="--stats a.xyz: is the same file as the particles")

    def test_data_without_a_name(self):
        self.expect(2, "figure", "-", "--write-scene", "a.json", error="--write-scene: a scene names the file")

    def test_nothing_to_write(self):
        self.figure(code=2, error="-o, --write-scene or --legend is missing")

    def test_data(self):
        self.expect(6, "figure", "none.xyz", "-o", "a.png", error="pt: cannot read none.xyz: ")
        self.write("b.xyz", "2\n\nH 0 0 0\n")
        self.expect(3, "figure", "b.xyz", "-o", "a.png", error="pt: b.xyz")
        self.write("b.xyz", "0\n\n")
        self.expect(6, "figure", "b.xyz", "-o", "a.png", error="pt: b.xyz: has no particles")
        self.expect(6, "figure", "a.xyz", "--where", "x > 9", "-o", "a.png",
                    error="pt: a.xyz: has no particles for which --where holds")
        self.assertEqual(self.files(), ["a.xyz", "b.xyz"])


if __name__ == "__main__":
    main()
