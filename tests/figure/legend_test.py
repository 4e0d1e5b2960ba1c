import pathlib
import sys
import tempfile
import unittest
import xml.etree.ElementTree

import numpy as np
import pt
from pt.figures._colors import ColorBar, Swatches
from pt.figures._legend import save_legend

try:
    import matplotlib
    from matplotlib.colors import LogNorm, Normalize
except ImportError:
    print("matplotlib is not installed")
    sys.exit(77)

VIRIDIS = matplotlib.colormaps["viridis"]
TABLE = np.floor(255 * VIRIDIS(np.arange(256))[:, :3] + 0.5).astype(int)  # the drawn colors
BAR = ColorBar("energy (eV)", -1.0, 2.5, Normalize(-1.0, 2.5), VIRIDIS, None)
NAMES = Swatches("type", ("a<b>&c", "$x", "Zn"), np.array([[255, 0, 0], [0, 255, 0], [0, 0, 255]], np.uint8))


def saved(legend, format="svg"):
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder, f"legend.{format}")
        save_legend(legend, path)
        return path.read_bytes()


class Files(unittest.TestCase):
    def test_formats_and_words(self):
        for legend, words in ((BAR, ["energy (eV)", "0", "2"]), (NAMES, ["type", "Zn"]),
                              (ColorBar("m", 1e-3, 1e6, LogNorm(1e-3, 1e6), VIRIDIS, (9, 9, 9)), ["no value", "m"])):
            drawn = "".join(xml.etree.ElementTree.fromstring(saved(legend)).itertext())
            for word in words:
                self.assertIn(word, drawn)
            self.assertEqual(saved(legend), saved(legend))
            self.assertEqual(saved(legend, "png")[:8], b"\x89PNG\r\n\x1a\n")
            self.assertEqual(saved(legend, "pdf")[:5], b"%PDF-")
        self.assertIn("a<b>&c", "".join(xml.etree.ElementTree.fromstring(saved(NAMES)).itertext()))
        with self.assertRaisesRegex(ValueError, "legend: is empty"):
            saved(None)


class InThePicture(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.context = cls.enterClassContext(pt.Context())

    def figure(self, **options):
        values = np.linspace(0, 1, 30)
        return pt.figure(np.random.default_rng(1).normal(size=(30, 3)), color=values, colorbar=True, samples=1,
                         size=(240, 160), context=self.context, **options)

    def test_the_picture_has_the_size_that_was_asked_for_and_the_bar_its_colors_in_order(self):
        for background, channels in (("white", 3), ("#203040", 3), ("transparent", 4)):
            picture = self.figure(background=background, title="$E$ / eV").to_srgb8()
            self.assertEqual(picture.shape, (160, 240, channels))
            strip = picture[:, -60:, :3].astype(int)
            best = max(range(60), key=lambda x: len({tuple(c) for c in strip[:, x]} & {tuple(c) for c in TABLE.tolist()}))
            found = [TABLE.tolist().index(c) for c in strip[:, best].tolist() if c in TABLE.tolist()]
            self.assertGreater(len(found), 80)
            self.assertEqual(found, sorted(found, reverse=True))
            self.assertLess(found[-1], 5)
            self.assertGreater(found[0], 250)
        self.assertEqual(picture[0, -1].tolist(), [0, 0, 0, 0])

    def test_without_a_legend_there_is_no_strip(self):
        plain = pt.figure(np.eye(3), colorbar=True, samples=1, size=(64, 48), context=self.context)
        self.assertEqual((plain.shape, plain.legend), ((48, 64, 3), None))
        with self.assertRaisesRegex(ValueError, "no room for particles beside the color bar"):
            pt.figure(np.eye(3), color=[1.0, 2, 3], colorbar=True, size=(48, 200))
