import importlib.util
import io
import sys
import unittest

import numpy as np
import pt
from pt.figures._drawn import prepare
from pt.figures._figure import view_of
from pt.figures._marks import MARGIN
from pt.figures._options import Options
from pt.figures._particles import Particles

if importlib.util.find_spec("matplotlib") is None or importlib.util.find_spec("PIL") is None:
    print("matplotlib or Pillow is not installed")
    sys.exit(77)

from PIL import Image

POSITIONS = np.random.default_rng(5).normal(size=(40, 3)) * (3, 1, 1)


class Paper(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.context = cls.enterClassContext(pt.Context())

    def figure(self, **options):
        return pt.figure(Particles(POSITIONS, {"v": POSITIONS[:, 0]}), radius=0.3, samples=1, context=self.context, **options)

    def test_the_width_is_exact(self):
        """8.5 cm at 50 dpi are 167.3 pixels."""
        for options in ({}, {"color": "v", "colorbar": True}, {"color": "v", "colorbar": True, "font_size": 5.0}):
            figure = self.figure(width="8.5cm", dpi=50.0, **options)
            for format, name in (("png", "PNG"), ("jpg", "JPEG")):
                picture = Image.open(io.BytesIO(figure.encode(format)))
                self.assertEqual((picture.format, picture.width, picture.size), (name, 167, figure.picture_size))
                np.testing.assert_allclose(picture.info["dpi"], 50, atol=0.02)
        self.assertEqual([Options(width=width, dpi=100).pixel_width for width in ("1in", "25.4mm", "72 pt", 1.0)], [100] * 4)
        self.assertEqual(Options(width="8.5cm").pixel_width, 1004)

    def test_words_have_their_size(self):
        """Twice the dpi and the font give the same layout with twice the pixels. A larger font needs a wider strip for the color bar."""
        def strip(**options):
            figure = self.figure(width="6cm", color="v", colorbar=True, **options)
            return figure.picture_size[0] - figure.shape[1]
        self.assertGreater(strip(dpi=50.0, font_size=9.0), strip(dpi=50.0, font_size=5.0))
        self.assertGreater(strip(dpi=100.0, font_size=7.0), 1.7 * strip(dpi=50.0, font_size=7.0) - 16)

    def test_the_scale_bar_has_its_length(self):
        figure = self.figure(size=(300, 200), projection="orthographic", view="front", scale_bar="2 nm", background="#ffffff")
        plain = self.figure(size=(300, 200), projection="orthographic", view="front", background="#ffffff")
        apart = plain.to_srgb8().astype(float) - figure.to_srgb8()
        row = 200 - round(MARGIN * 200) - 1
        expected = 2 * 200 / figure.camera.vertical_extent
        self.assertAlmostEqual(apart[row, :, 0].sum() / (255 - 0x22), expected, delta=0.05)
        self.assertGreater(apart[row - 30:row - 3].max(), 100)
        clear = self.figure(size=(300, 200), projection="orthographic", view="front", scale_bar=2, background="transparent")
        self.assertEqual(clear.to_srgb8()[row, round(MARGIN * 200) + 5].tolist(), [0x22, 0x22, 0x22, 255])

    def test_what_is_refused(self):
        for words, options in (("scale_bar: must have an orthographic projection", {"scale_bar": 2}),
                               ("width: must not be given with size", {"width": "8cm", "size": (90, 60)}),
                               ("width = '8 miles': must be like 8.5cm", {"width": "8 miles"}),
                               ("dpi = 0.5: must be from 1", {"dpi": 0.5}),
                               ("font_size = 0.0: must be > 0", {"font_size": 0.0})):
            with self.subTest(words=words), self.assertRaisesRegex(ValueError, words):
                Options(**options)
        with self.assertRaisesRegex(ValueError, "scale_bar = 900: is longer than the picture"):
            self.figure(size=(60, 40), projection="orthographic", scale_bar=900).to_srgb8()

    def test_the_height_follows_from_the_data(self):
        drawn = prepare(Particles(POSITIONS), Options(radius=0.3))
        free, printed = (view_of(drawn, Options(radius=0.3, **options)).size for options in ({}, {"width": "10cm"}))
        self.assertAlmostEqual(printed[0] / printed[1], free[0] / free[1], delta=0.01)
