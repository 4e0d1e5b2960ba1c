import importlib.util
import sys
import unittest

import numpy as np
import pt
from pt.figures import Particles, panels

if importlib.util.find_spec("matplotlib") is None:
    print("matplotlib is not installed")
    sys.exit(77)

from matplotlib.figure import Figure

POSITIONS = np.random.default_rng(5).normal(size=(40, 3)) * (3, 1, 1)


def particles(factor, names=None):
    return Particles(factor * POSITIONS, {"v": factor * POSITIONS[:, 0], "w": POSITIONS[:, 1]}, types=names, name=f"/data/times-{factor}.xyz")


class Panels(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.context = cls.enterClassContext(pt.Context())

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

    def test_the_legend_has_the_names_of_all(self):
        found = self.panels(particles(1, np.array(["a", "b"] * 20)), particles(1, np.array(["b", "c"] * 20)), colorbar=True)
        self.assertEqual(found.legend.names, ("a", "b", "c"))

    def test_the_widest_legend_has_room(self):
        """The last columns of pixels are background, although the second panel has longer names and a wider range."""
        long = particles(1, np.array(["a", "a longer name"] * 20))
        for data, options in (((particles(1, np.array(["a"] * 40)), long), {}), ((particles(1), particles(1e5)), {"color": "v"})):
            picture = self.panels(*data, colorbar=True, size=(360, 60), **options).to_srgb8()
            self.assertTrue((picture[:, -4:] == 255).all())

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
