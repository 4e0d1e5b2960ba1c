import os
import pathlib
import sys
import tempfile
import unittest
import unittest.mock

import numpy as np
import pt
from pictures import CAMERA, HEIGHT, SCENE, WIDTH, cloud, settings

FAKE = os.environ["OPEN_IMAGE_DENOISE"]
POSITIONS, COLORS = cloud(80)


class Denoise(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = cls.enterClassContext(tempfile.TemporaryDirectory())
        module = pathlib.Path(folder, "pyoidn")
        (module / "oidn" / "lib").mkdir(parents=True)
        (module / "__init__.py").write_text("raise ImportError('nothing of it is to be run')")
        (module / "oidn" / "lib" / "libOpenImageDenoise.so.2").symlink_to(FAKE)
        sys.path.insert(0, folder)
        cls.context = cls.enterClassContext(pt.Context())

    def rendered(self, samples, estimator=pt.Estimator.BEST, **more):
        return self.context.render(SCENE, CAMERA, settings(estimator=estimator, coverage=True), samples, denoise=True, **more)

    def half(self, seed, samples, estimator=pt.Estimator.BEST):
        return self.context.render(SCENE, CAMERA, settings(seed=seed, estimator=estimator, coverage=True), samples)

    def test_an_image_is_made_of_two(self):
        noisy = pt.Estimator.UNIFORM
        image = self.rendered(5, noisy)
        first, second = self.half(0, 2, noisy), self.half(2**63, 2, noisy)
        np.testing.assert_array_equal(image.raw, (first.radiance + second.radiance) / 2)
        np.testing.assert_array_equal(image.standard_error, np.abs(first.radiance - second.radiance) / 2)
        np.testing.assert_array_equal(image.coverage, (first.coverage + second.coverage) / 2)
        self.assertEqual((image.stats.sample_count, image.sample_count.max(), image.sample_count.shape),
                         (4, 4, (HEIGHT, WIDTH)))
        radiance, error = pt.denoise(first, second, self.context.readback(pt.Quantity.ALBEDO),
                                     self.context.readback(pt.Quantity.NORMAL), library_path=FAKE)
        np.testing.assert_array_equal(image, radiance)
        self.assertEqual(image.error_estimate, error)
        self.assertFalse(np.array_equal(image, image.raw))
        self.assertIsNone(first.raw)

    def test_a_target_error_is_that_of_the_result(self):
        first = self.rendered(32)
        self.assertTrue(0 < first.error_bounds[1] < np.inf)
        image = self.rendered(4096, target_error=first.error_bounds[1] / 2)
        self.assertLessEqual(image.error_bounds[1], first.error_bounds[1] / 2)
        self.assertTrue(32 < image.stats.sample_count < 4096)
        np.testing.assert_array_equal(image, self.rendered(image.stats.sample_count))
        self.assertEqual(self.rendered(40, target_error=1e-9).stats.sample_count, 40)
        self.assertEqual(self.rendered(40, time_limit=1e-9).stats.sample_count, 32)

    def test_figures(self):
        options = {"size": (WIDTH, HEIGHT), "samples": 16, "context": self.context, "floor": True}
        figure = pt.render(POSITIONS, 0.1, COLORS, denoise=True, **options)
        self.assertEqual(figure.raw.shape, figure.shape)
        self.assertFalse(np.array_equal(figure.picture(), pt.render(POSITIONS, 0.1, COLORS, **options).picture()))

    def test_progress(self):
        shares = []
        self.rendered(256, target_error=1e-9, progress=shares.append)
        self.assertEqual(shares, sorted(shares))
        self.assertEqual(shares[-1], 1.0)
        with self.assertRaises(pt.InvalidStateError):
            self.rendered(256, progress=lambda share: share > 0.25)
        image = self.rendered(256, target_error=1e-9, progress=lambda share: share > 0.5)
        self.assertTrue(32 <= image.stats.sample_count < 256)

    def test_refusals(self):
        grey = np.full((4, 4, 3), 0.5, np.float32)
        with self.assertRaisesRegex(ValueError, "shapes"):
            pt.denoise(grey, grey[:2], grey, grey)
        with self.assertRaisesRegex(pt.InvalidArgumentError, r"denoise.first\[0\] = nan"):
            pt.denoise(grey * np.nan, grey, grey, grey)
        with unittest.mock.patch.dict(os.environ, FAKE_OIDN="gpu"):
            with self.assertRaisesRegex(pt.UnsupportedError, "as planted"):
                pt.denoise(grey, grey, grey, grey)
            pt.denoise(grey, grey, grey, grey, any_device=True)
        with self.assertRaisesRegex(pt.UnsupportedError, "pip install pyoidn"):
            pt.denoise(grey, grey, grey, grey, library_path=os.devnull)
