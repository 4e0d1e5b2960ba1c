import unittest

import numpy as np
import pt
from pictures import ready


class Compare(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.context = cls.enterClassContext(pt.Context())
        cls.films = [cls.film(seed) for seed in (1, 2)]

    @classmethod
    def film(cls, seed, **fields):
        ready(cls.context, width=64, height=64, seed=seed, **fields).accumulate(64)
        return cls.context.film()

    def test_equal_and_different_light(self):
        first, second = self.films
        self.assertEqual(pt.compare(first, first).light, pt.Light.EQUAL_BITS)
        same = pt.compare(first, second, min_change=0.05)
        self.assertEqual(same.light, pt.Light.SAME, same)
        self.assertLess(same.smallest_change, 0.05)
        self.assertEqual(str(same), same.summary)
        pt.assert_same_light(first, second, min_change=0.05)
        brighter = first.readback() * np.float32(1.1)
        different = pt.compare(brighter, second)
        self.assertEqual(different.light, pt.Light.DIFFERENT)
        whole = different.regions[0]
        self.assertEqual((whole.x, whole.y, whole.width, whole.height), (0, 0, 64, 64))
        np.testing.assert_allclose(whole.light, second.readback().mean((0, 1), dtype=float), rtol=1e-6)
        np.testing.assert_allclose(whole.difference, (brighter - second.readback()).mean((0, 1), dtype=float), rtol=1e-4)
        self.assertLessEqual(different.probability, 1e-6)

    def test_the_assertion_says_where(self):
        first, second = self.films
        changed = first.readback()
        changed[32:, :32] *= 1.5
        with self.assertRaisesRegex(AssertionError, r"^different light: \+.*\n.*32x32 pixels at 0,32: difference \("):
            pt.assert_same_light(changed, second)
        with self.assertRaisesRegex(AssertionError, "^too few samples to tell: .*, not 0.001%$"):
            pt.assert_same_light(first, second, min_change=1e-5)

    def test_images_and_arrays(self):
        first, second = self.films
        expected = pt.compare(first, second)
        self.assertEqual(pt.compare(first.image(), second.image()), expected)
        self.assertEqual(pt.compare(first.readback(), second.readback()).light, expected.light)
        image = first.image()
        image.raw, image.radiance = image.radiance, image.radiance * 2
        self.assertEqual(pt.compare(image, second), expected)

    def test_an_estimator_that_may_have_missed_lamps(self):
        darker = self.film(3, estimator=pt.Estimator.COSINE).image()
        darker.radiance = self.films[0].readback() / 2
        self.assertNotEqual(pt.compare(darker, self.films[1]).light, pt.Light.DIFFERENT)
        darker.estimator = pt.Estimator.BEST
        self.assertEqual(pt.compare(darker, self.films[1]).light, pt.Light.DIFFERENT)

    def test_what_cannot_be_compared(self):
        first, second = self.films
        halton = self.film(3, sampler=pt.Sampler.HALTON)
        for each in halton, halton.image(), self.context.image():
            with self.assertRaisesRegex(pt.InvalidArgumentError, "first.sampler = 2: must not be"):
                pt.compare(each, second)
        with self.assertRaisesRegex(ValueError, r"shapes = \[\(64, 64, 3\), \(2, 2, 3\)\]: must both be"):
            pt.compare(first, np.zeros((2, 2, 3)))
        with self.assertRaisesRegex(pt.InvalidArgumentError, "compare.rate = 2: must be in"):
            pt.compare(first, second, rate=2)
