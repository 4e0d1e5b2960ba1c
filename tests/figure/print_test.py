import importlib.util
import io
import pathlib
import sys
import tempfile
import unittest
import xml.etree.ElementTree

import numpy as np
import pt
from pt.figures._colors import ColorBar, Swatches
from pt.figures._drawn import prepare
from pt.figures._figure import view_of
from pt.figures._legend import save_legend
from pt.figures._marks import MARGIN
from pt.figures._options import Options
from pt.figures._particles import Particles

if importlib.util.find_spec("matplotlib") is None or importlib.util.find_spec("PIL") is None:
    print("matplotlib or Pillow is not installed")
    sys.exit(77)

import matplotlib
from matplotlib.colors import LogNorm, Normalize
from PIL import Image

POSITIONS = np.random.default_rng(5).normal(size=(40, 3)) * (3, 1, 1)
VIRIDIS = matplotlib.colormaps["viridis"]
TABLE = np.floor(255 * VIRIDIS(np.arange(256))[:, :3] + 0.5).astype(int).tolist()  # the drawn colors
NAMES = Swatches("type", ("a<b>&c", "$x", "Zn"), np.array([[255, 0, 0], [0, 255, 0], [0, 0, 255]], np.uint8))


class Paper(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.context = cls.enterClassContext(pt.Context())

    def figure(self, **options):
        return pt.figure(Particles(POSITIONS, {"v": POSITIONS[:, 0]}), radius=0.3, samples=1, context=self.context, **options)

    def test_the_width_is_exact(self):
        """8.5 cm at 50 dpi are 167.3 pixels."""
        for options in ({}, {"color": "v", "colorbar": True}):
            figure = self.figure(width="8.5cm", dpi=50.0, **options)
            for format, name in (("png", "PNG"), ("jpg", "JPEG")):
                picture = Image.open(io.BytesIO(figure.encode(format)))
                self.assertEqual((picture.format, picture.width, picture.size), (name, 167, figure.picture_size))
                np.testing.assert_allclose(picture.info["dpi"], 50, atol=0.02)
        self.assertEqual([Options(width=width, dpi=100).pixel_width for width in ("1in", "25.4mm", "72 pt", 1.0)], [100] * 4)

    def test_words_have_their_size(self):
        """A larger font needs a wider strip for the color bar, and more dpi need more pixels for it."""
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

    def test_the_bar_has_its_colors_in_order(self):
        for background, corner in (("white", [255] * 3), ("#306090", [48, 96, 144]), ("transparent", [0] * 4)):
            picture = self.figure(color="v", colorbar=True, size=(240, 160), background=background, title="$E$ / eV").to_srgb8()
            self.assertEqual((picture.shape[:2], picture[0, 0].tolist(), picture[0, -1].tolist()), ((160, 240), corner, corner))
            strip = picture[:, -60:, :3].astype(int)
            best = max(range(60), key=lambda x: len({tuple(c) for c in strip[:, x]} & {tuple(c) for c in TABLE}))
            found = [TABLE.index(c) for c in strip[:, best].tolist() if c in TABLE]
            self.assertGreater(len(found), 80)
            self.assertEqual(found, sorted(found, reverse=True))
            self.assertTrue(found[-1] < 5 and found[0] > 250)
        plain = self.figure(colorbar=True, size=(64, 48))
        self.assertEqual((plain.shape, plain.legend), ((48, 64, 3), None))

    def test_files_of_legends(self):
        def saved(legend, format="svg"):
            with tempfile.TemporaryDirectory() as folder:
                path = pathlib.Path(folder, f"legend.{format}")
                save_legend(legend, path)
                return path.read_bytes()

        for legend, words in ((ColorBar("energy (eV)", -1.0, 2.5, Normalize(-1.0, 2.5), VIRIDIS, None), ["energy (eV)", "0", "2"]),
                              (NAMES, ["type", "a<b>&c", "Zn"]),
                              (ColorBar("m", 1e-3, 1e6, LogNorm(1e-3, 1e6), VIRIDIS, (9, 9, 9)), ["no value", "m"])):
            drawn = "".join(xml.etree.ElementTree.fromstring(saved(legend)).itertext())
            for word in words:
                self.assertIn(word, drawn)
            self.assertEqual(saved(legend), saved(legend))
            self.assertEqual(saved(legend, "png")[:8], b"\x89PNG\r\n\x1a\n")
            self.assertEqual(saved(legend, "pdf")[:5], b"%PDF-")
        with self.assertRaisesRegex(ValueError, "legend: is empty"):
            saved(None)

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
        with self.assertRaisesRegex(ValueError, "no room for particles beside the color bar"):
            self.figure(size=(48, 200), color="v", colorbar=True)

    def test_the_height_follows_from_the_data(self):
        drawn = prepare(Particles(POSITIONS), Options(radius=0.3))
        free, printed = (view_of(drawn, Options(radius=0.3, **options)).size for options in ({}, {"width": "10cm"}))
        self.assertAlmostEqual(printed[0] / printed[1], free[0] / free[1], delta=0.01)
