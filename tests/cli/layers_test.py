import math
import struct

from command_line import COURSEWORK, PT, CommandLineTest, read_exr_attributes, read_exr_channels, read_png

WIDTH, HEIGHT = 9, 37
SIZE = ("--size", f"{WIDTH}x{HEIGHT}", "--spp", "2")
ALL = "mean,standard-error,sample-count,depth,normal,albedo,object-id"
CHANNELS = ["B", "G", "N.X", "N.Y", "N.Z", "R", "Z", "albedo.B", "albedo.G", "albedo.R", "id", "sample_count",
            "standard_error.B", "standard_error.G", "standard_error.R"]


def as_float(number):
    return struct.unpack("f", struct.pack("f", number))[0]


class LayersTest(CommandLineTest):
    def render(self, *options, code=0, error=None, **environment):
        size = () if "--size" in options else SIZE
        self.expect(code, "render", COURSEWORK, *size, *options, error=error, **environment)


class Layers(LayersTest):
    def test_each_is_where_it_belongs(self):
        for crop, pieces in (((0, 0, WIDTH, HEIGHT), ()), ((2, 3, 5, 33), ("--piece-rows", "10"))):
            with self.subTest(crop=crop):
                self.render("-o", "a.exr", "--layers", ALL, "--crop", ",".join(map(str, crop)), *pieces)
                channels = read_exr_channels(self.path("a.exr"))
                self.assertEqual(list(channels), CHANNELS)
                x, y, width, height = crop
                self.assertEqual(channels["id"], [[row * WIDTH + column for column in range(x, x + width)]
                                                  for row in range(y, y + height)])
                across = [[as_float(column / (WIDTH - 1)) for column in range(x, x + width)]] * height
                down = [[as_float(row / (HEIGHT - 1))] * width for row in range(y, y + height)]
                for name in "R", "N.X", "albedo.R", "standard_error.R", "Z", "sample_count":
                    self.assertEqual(channels[name], across, name)
                for name in "G", "N.Y", "albedo.G", "standard_error.G":
                    self.assertEqual(channels[name], down, name)
                for name in "B", "N.Z", "albedo.B", "standard_error.B":
                    self.assertEqual(channels[name], [[2.0] * width] * height, name)

    def test_those_alone_that_are_asked_for(self):
        for layers, names in ("depth", ["B", "G", "R", "Z"]), ("object-id,normal", ["B", "G", "N.X", "N.Y", "N.Z", "R", "id"]):
            self.render("-o", "a.exr", "--layers", layers)
            self.assertEqual(list(read_exr_channels(self.path("a.exr"))), names)
        self.render("-o", "b.exr")
        self.render("-o", "a.exr", "--layers", "mean")
        self.assertEqual(self.contents("a.exr"), self.contents("b.exr"))

    def test_what_makes_no_sense_is_refused(self):
        for layers, error in (("depht", '--layers: unknown layer "depht", did you mean "depth"?'),
                              ("", "--layers: unknown layer"), ("depth,", "--layers: unknown layer"),
                              ("depth,normal,depth", "--layers: must name a layer once")):
            self.render("-o", "a.exr", "--layers", layers, code=2, error=error)
        for output in (("-o", "a.png"), ("-o", "a.jpg", "-o", "b.png"), ("-o", "-", "--format", "png"),
                       ("--film", "a.ptfilm")):
            self.render(*output, "--layers", "depth", code=2,
                        error="--layers: needs -o and a name in .exr, because no other format has layers")
        self.assertEqual(self.files(), [])


class Alpha(LayersTest):
    SHARES = [as_float(column / (WIDTH - 1)) for column in range(WIDTH)]

    def test_an_exr_has_it_beside_the_colors(self):
        self.render("-o", "a.exr", "--alpha")
        self.render("-o", "b.exr")
        channels, without = (read_exr_channels(self.path(name)) for name in ("a.exr", "b.exr"))
        self.assertEqual(list(channels), ["A", "B", "G", "R"])
        self.assertEqual(channels.pop("A"), [self.SHARES] * HEIGHT)
        self.assertEqual(channels, without)
        self.render("-o", "a.exr", "--alpha", "--layers", "depth", "--crop", "2,3,5,33", "--piece-rows", "10")
        self.assertEqual(read_exr_channels(self.path("a.exr"))["A"], [self.SHARES[2:7]] * 33)

    def test_a_png_made_of_an_exr_has_it_too(self):
        self.render("-o", "a.exr", "-o", "a.png", "--alpha", "--tonemap", "agx")
        self.expect(0, "tonemap", "a.exr", "b.png", "--tonemap", "agx")
        self.assertEqual(read_png(self.path("b.png")), read_png(self.path("a.png")))
        self.render("-o", "b.exr")
        for name in "a", "b":
            self.expect(0, "tonemap", f"{name}.exr", f"{name}.jpg", "--exposure", "0")
        self.assertEqual(self.contents("a.jpg"), self.contents("b.jpg"))

    def test_what_is_no_share_or_not_finite_is_refused(self):
        for red, said in ("-0.25", ": A = -0.250000: must be from 0 to 1"), ("inf", " is not finite"):
            self.render("-o", "a.exr", "--alpha", FAKE_PT_RED=red)
            self.expect(6, "tonemap", "a.exr", "a.png", error=f"cannot read a.exr: pixel 0,0{said}")
        self.assertEqual(self.files(), ["a.exr"])

    def test_what_has_no_alpha_is_refused(self):
        self.render("-o", "a.png", "-o", "b.jpg", "--alpha", code=2, error="--alpha: -o b.jpg: .jpg has no alpha; .exr and .png have")
        self.render("-o", "-", "--format", "jpg", "--alpha", code=2, error="--alpha: -o -: .jpg has no alpha")
        self.assertEqual(self.files(), [])


class RealDeviceLayers(LayersTest):
    program = PT

    def test_they_agree_with_the_picture(self):
        width, height = 32, 20
        size = ("--size", f"{width}x{height}", "--spp", "2")
        self.render("-o", "a.exr", "--layers", ALL, *size)
        self.render("-o", "b.exr", *size)
        with_layers, without = (read_exr_channels(self.path(name)) for name in ("a.exr", "b.exr"))
        for channel in "RGB":
            self.assertEqual(with_layers[channel], without[channel])
        self.assertEqual(read_exr_attributes(self.path("a.exr"))["pt.quantity"], ("string", b"radiance"))
        pixels = [{name: rows[y][x] for name, rows in with_layers.items()} for y in range(height) for x in range(width)]
        self.assertEqual({pixel["sample_count"] for pixel in pixels}, {2.0})
        self.assertGreater(len({pixel["id"] for pixel in pixels}), 5)
        for pixel in pixels:
            if pixel["id"] == 5:
                self.assertAlmostEqual(pixel["Z"], 19.5, 5)
            self.assertLessEqual(math.hypot(*(pixel[f"N.{axis}"] for axis in "XYZ")), 1 + 1e-6)

    def test_alpha_is_that_of_the_samples(self):
        self.write("ball.json", """{"materials": {"white": {"emission": 1}},
                                    "spheres": [{"center": [0, 0, -4], "radius": 1, "material": "white"}]}""")
        self.expect(0, "render", "ball.json", *SIZE, "-o", "a.exr", "-o", "a.png", "--alpha", "--exposure", "0")
        channels = read_exr_channels(self.path("a.exr"))
        self.assertEqual(channels["A"], channels["R"])
        values = {value for row in channels["A"] for value in row}
        self.assertEqual(values, {0.0, 0.5, 1.0})
        for row, alphas in zip(read_png(self.path("a.png"))[2], channels["A"]):
            for x, alpha in enumerate(alphas):
                color = 255 if alpha > 0 else 0
                self.assertEqual(row[4 * x:4 * x + 4], [color, color, color, math.floor(alpha * 255 + 0.5)])

    def test_films_keep_alpha(self):
        def take(*options):
            self.expect(0, "render", COURSEWORK, "--size", "9x37", *options)

        take("-o", "whole.exr", "--film", "whole.ptfilm", "--alpha", "--spp", "9")
        take("--film", "0.ptfilm", "--alpha", "--spp", "3")
        take("--film", "3.ptfilm", "--alpha", "--spp", "6", "--first-sample", "3")
        take("--film", "bare.ptfilm", "--spp", "6", "--first-sample", "3")
        self.expect(0, "merge", "3.ptfilm", "0.ptfilm", "-o", "sum.exr", "--film", "sum.ptfilm", "--alpha")
        self.assertEqual(self.contents("whole.ptfilm"), self.contents("sum.ptfilm"))
        self.assertEqual(read_exr_channels(self.path("whole.exr")), read_exr_channels(self.path("sum.exr")))
        self.expect(2, "merge", "whole.ptfilm", "bare.ptfilm", "-o", "c.exr", error="bare.ptfilm: coverage = nothing: must be 1")
        self.expect(2, "merge", "bare.ptfilm", "-o", "c.exr", "--alpha", error="--alpha: the films have no alpha")
