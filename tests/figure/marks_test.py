import base64
import importlib.util
import io
import re
import sys
import unittest
import xml.etree.ElementTree

import numpy as np
import pt
from pt.figures._cell import Cell
from pt.figures._drawn import prepare
from pt.figures._marks import ARROW
from pt.figures._options import Options
from pt.figures._particles import Particles

if importlib.util.find_spec("matplotlib") is None or importlib.util.find_spec("PIL") is None:
    print("matplotlib or Pillow is not installed")
    sys.exit(77)

from PIL import Image

ROW = np.array([[0.0, -3, 0], [0.0, 3, 0], [3.0, 0, 4]])  # from the front, the second ball is behind the first one
CELL = Cell.of([[4.0, 0, 0], [1, 4, 0], [0, 1, 4]], (-2, -2, -2))


class Marks(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.context = cls.enterClassContext(pt.Context())

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
            arrows = dict(zip([each.get_text() for each in page.axes.texts if each.get_text()],
                              [each for each in page.axes.texts if not each.get_text()]))
            for name, arrow in arrows.items():
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
