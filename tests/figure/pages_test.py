import base64
import importlib.util
import io
import re
import sys
import unittest
import xml.etree.ElementTree

import numpy as np
import pt
from pt.figures import panels
from pt.figures._cell import Cell
from pt.figures._drawn import prepare
from pt.figures._marks import ARROW
from pt.figures._options import Options
from pt.figures._particles import Particles

if importlib.util.find_spec("matplotlib") is None or importlib.util.find_spec("PIL") is None:
    print("matplotlib or Pillow is not installed")
    sys.exit(77)

from matplotlib.figure import Figure
from PIL import Image

ROW = np.array([[0.0, -3, 0], [0.0, 3, 0], [3.0, 0, 4]])  # from the front, the second ball is behind the first one
POSITIONS = np.random.default_rng(5).normal(size=(40, 3)) * (3, 1, 1)
CELL = Cell.of([[4.0, 0, 0], [1, 4, 0], [0, 1, 4]], (-2, -2, -2))


class InAContext(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.context = cls.enterClassContext(pt.Context())


class Marks(InAContext):
    def page(self, positions=ROW, cell=None, **options):
        particles = Particles(positions, {"n": np.arange(len(positions)), "v": 0.5 * np.arange(len(positions))}, cell=cell)
        figure = pt.figure(particles, **{"radius": 1.0, "view": "front", "projection": "orthographic", "size": (120, 80), "samples": 1,
                                         "frame_all": True, "context": self.context, **options})
        page = figure._page()
        return figure, page, {each.get_text(): np.array(each.get_position()) for each in page.axes.texts if each.get_text()}

    def pixel(self, figure, point):
        """Parallel rays along y, with z upward."""
        scale = 80 / figure.camera.vertical_extent
        return np.array([60 + scale * (point[0] - figure.camera.position[0]), 40 - scale * (point[2] - figure.camera.position[2])])

    def test_labels_are_in_the_middle_of_balls_that_nothing_hides(self):
        for labels, expected in (("n", {"0": 0, "2": 2}), ("v", {"0": 0, "1": 2}), (["a", "b", ""], {"a": 0}), ("n == 2=v", {"1": 2}),
                                 ({"n < 2": "near by"}, {"near by": 0})):
            figure, _, words = self.page(labels=labels)
            self.assertEqual(set(words), set(expected))
            for word, row in expected.items():
                np.testing.assert_allclose(words[word], self.pixel(figure, ROW[row]), atol=1e-6)
        camera = pt.Camera((0, 20, 0), (0, 0, 0), (0, 0, 1), vertical_fov=0.5)
        self.assertEqual(set(self.page(labels="n", camera=camera)[2]), {"1", "2"})
        self.assertEqual(set(self.page(labels="n", opacity=np.array([0.2, 1, 1]))[2]), {"0", "1", "2"})

    def test_distances_have_their_lengths(self):
        for positions in (ROW, ROW * 2.0**90):
            figure, page, words = self.page(positions, radius=positions.max() / 4, distances=[(0, 2), (0, 1)])
            self.assertEqual([each.get_text() for each in page.axes.texts], [f"{positions[2, 0] * np.sqrt(34) / 3:.3g}", f"{2 * positions[2, 0]:.3g}"])
            scale = figure._staged.drawn.scale
            first, last = np.transpose(page.axes.lines[0].get_data())
            np.testing.assert_allclose((first, last), [self.pixel(figure, positions[row] * scale) for row in (0, 2)], atol=1e-6)

    def test_axes_have_the_directions_of_the_picture(self):
        for cell, vectors in ((None, dict(zip("xyz", np.eye(3)))), (CELL, dict(zip("abc", CELL.vectors)))):
            figure, page, words = self.page(axes=True, cell=cell, box="lines", view=(1, -2, 0.5))
            self.assertEqual(set(words), set(vectors))
            right, above, _ = figure.camera.axes()
            for name, arrow in zip(words, [each for each in page.axes.texts if not each.get_text()], strict=True):
                way = np.subtract(arrow.xy, arrow.xyann)
                unit = vectors[name] / np.linalg.norm(vectors[name])
                np.testing.assert_allclose(way, ARROW * page.em * np.array([unit @ right, -(unit @ above)]), atol=1e-6)

    def test_axes_and_bar_are_in_corners_without_particles(self):
        balls = np.array([[-3.0, 0, -2], [3, 0, -2], [0, 0, 2]])
        for turned in (balls, balls * (1, 1, -1)):
            figure, page, _ = self.page(turned, axes=True, scale_bar="1", size=(360, 240))
            bar = page.axes.patches[0]
            places = [bar.get_xy(), np.add(bar.get_xy(), (bar.get_width(), bar.get_height())), *(each.get_position() for each in page.axes.texts)]
            self.assertEqual([figure._shares.shapes[int(down), int(across)] for across, down in places], [0.0] * len(places))

    def test_vectors_are_over_the_picture_at_the_exact_size(self):
        """8.5 cm are 240.945 points. The embedded picture equals the picture without words, bit for bit."""
        options = {"color": "v", "colorbar": True, "labels": "n", "axes": True, "scale_bar": "2 nm", "title": "E"}
        for background in ("white", "transparent"):
            figure, _, _ = self.page(**options, size=None, width="8.5cm", dpi=50, background=background)
            width, height = figure.picture_size
            root = xml.etree.ElementTree.fromstring(figure.encode("svg"))
            sides = [float(root.get(name).removesuffix("pt")) for name in ("width", "height")]
            np.testing.assert_allclose(sides, np.array([1, height / width]) * 8.5 / 2.54 * 72, rtol=1e-6)
            words = [each.text for each in root.iter("{http://www.w3.org/2000/svg}text")]
            self.assertLessEqual({"0", "2", "x", "y", "z", "2 nm", "E"}, set(words))
            images = [each for each in root.iter("{http://www.w3.org/2000/svg}image")]
            inside = Image.open(io.BytesIO(base64.b64decode(images[0].get("{http://www.w3.org/1999/xlink}href").partition(",")[2])))
            bare = figure._bare(np.uint8, None)
            np.testing.assert_array_equal(np.asarray(inside.convert("RGBA"))[:, :, :bare.shape[2]], bare)
            document = figure.encode("pdf")
            box = re.search(rb"/MediaBox \[ 0 0 ([\d.]+) ([\d.]+) \]", document)
            np.testing.assert_allclose([float(side) for side in box.groups()], sides, rtol=1e-6)
            self.assertEqual((document, figure.encode("svg")), (figure.encode("pdf"), figure.encode("svg")))

    def test_what_is_refused(self):
        for words, options in (("labels has shape .2,.: must be .3,.", {"labels": ["a", "b"]}), ("distances: 3: must be an index", {"distances": [(0, 3)]}),
                               ("distances = '0-1': must be pairs", {"distances": "0-1"}),
                               ("labels = 'm 2': position 1, 'm'", {"labels": "m 2=n"})):
            with self.subTest(words=words), self.assertRaisesRegex(ValueError, words):
                prepare(Particles(ROW, {"n": np.arange(3)}), Options(radius=1.0, **options))
        with self.assertRaisesRegex(ValueError, "labels: has 1,001 words: must have at most 1,000"):
            prepare(Particles(np.eye(3).repeat(334, axis=0)[:1001]), Options(radius=1.0, labels="x"))


def particles(factor, names=None):
    return Particles(factor * POSITIONS, {"v": factor * POSITIONS[:, 0], "w": POSITIONS[:, 1]}, types=names, name=f"/data/times-{factor}.xyz")


class Panels(InAContext):
    def panels(self, *data, columns=(), **options):
        return panels(data, columns, **{"samples": 1, "size": (240, 60), "context": self.context, **options})

    def test_data_sets_share_camera_radius_and_range(self):
        """Each panel equals the figure with the same options, except that its lamps follow from the extent of all data."""
        found = self.panels(particles(1), particles(2), color="v", colorbar=True)
        first, second = found.figures
        self.assertEqual((first.camera, first.shape, found.titles), (second.camera, second.shape, ["times-1", "times-2"]))
        values = POSITIONS[:, 0]
        self.assertEqual((found.legend.low, found.legend.high), (2 * values.min(), 2 * values.max()))
        picture = found.to_srgb8()
        self.assertEqual((picture.shape, found.picture_size), ((60, 240, 3), (240, 60)))
        height, width = first.shape[:2]
        for k, (factor, radius) in enumerate(zip((1, 2), (first._staged.drawn.radii, second._staged.drawn.radii))):
            self.assertEqual(float(radius[0]), float(first._staged.drawn.radii[0]))
            alone = pt.figure(particles(factor), color="v", range=(2 * values.min(), 2 * values.max()), camera=first.camera, size=(width, height),
                              radius=float(radius[0]), samples=1, context=self.context, style=first._staged.options.style)
            apart = [np.abs(picture[20:, start:start + width].astype(float) - alone.to_srgb8()[20:]).mean() for start in (k * width, (1 - k) * width)]
            self.assertLess(20 * apart[0], min(apart[1], 2))

    def test_columns_have_a_panel_each(self):
        found = self.panels(particles(2), columns=["v", "w", "v", "w"], size=None, width="4cm", dpi=100.0)
        self.assertEqual((found.picture_size[0], found.columns, found.titles), (157, 2, ["v", "w"] * 2))
        height, width = found.figures[0].shape[:2]
        self.assertEqual((found.picture_size[1], width), (2 * height, 78))
        self.assertEqual((found.legend.low, found.legend.title), (2 * POSITIONS.min(), " "))
        words = [each.get_text() for each in found._page().axes.texts]
        self.assertEqual(words, found.titles)
        self.assertEqual(found.encode("pdf")[:5], b"%PDF-")

    def test_the_widest_legend_has_room(self):
        """The last columns of pixels are background, although the second panel has longer names and a wider range."""
        long = particles(1, np.array(["a", "a longer name"] * 20))
        for data, options, names in (((particles(1, np.array(["a", "b"] * 20)), long), {}, ("a", "b", "a longer name")),
                                     ((particles(1), particles(1e5)), {"color": "v"}, None)):
            found = self.panels(*data, colorbar=True, size=(360, 60), **options)
            self.assertTrue((found.to_srgb8()[:, -4:] == 255).all())
            self.assertEqual(getattr(found.legend, "names", None), names)

    def test_what_is_refused(self):
        with self.assertRaisesRegex(ValueError, "panels: must have one data set with columns"):
            self.panels(particles(1), particles(1), columns=["v"])
        with self.assertRaisesRegex(ValueError, "has no room for particles"):
            self.panels(particles(1), particles(1), size=(30, 30))

    def test_axes_of_matplotlib_get_the_picture(self):
        axes = Figure(figsize=(2, 1), dpi=100).add_axes((0.5, 0.25, 0.4, 0.5))
        figure = pt.figure(POSITIONS, radius=0.3, samples=1, ax=axes, context=self.context)
        self.assertEqual(figure.picture_size, (80, 50))
        np.testing.assert_array_equal(axes.images[0].get_array(), figure.to_srgb8())
