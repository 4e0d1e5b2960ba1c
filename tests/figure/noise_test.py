import types
import unittest
from dataclasses import replace

import numpy as np
import pt
from pt._display import automatic_exposure, to_pixels
from pt.figures._noise import FIRST_SAMPLES, MOST_NOISE, Noise, until_invisible

POSITIONS = np.random.default_rng(5).normal(size=(60, 3))
SHAPE = 96, 128


class Sampled:
    """Takes samples from normal distributions with the standard deviation `spread` of each pixel. States `stated` times
    the true standard errors."""

    def __init__(self, spread, stated=1.0):
        self.random, self.spread, self.stated = np.random.default_rng(1), spread, stated

    def render(self, scene, camera, settings, samples, progress=None):
        self.counts, self.parts = np.zeros(SHAPE), np.zeros((2, *SHAPE, 3))
        self.accumulate_tiles(np.full((SHAPE[0] // 8, SHAPE[1] // 8), samples), progress=progress)
        return self.image()

    def accumulate_tiles(self, counts, *, progress=None):
        added = np.kron(counts, np.ones((8, 8)))
        for part in self.parts:
            part += 0.3 * added[..., None] / 2 + self.random.normal(size=(*SHAPE, 3)) * (self.spread * np.sqrt(added / 2))[..., None]
        self.counts += added
        if progress:
            progress(0.5)
            progress(1.0)

    def image(self):
        first, second = self.parts / (self.counts[..., None] / 2)
        return types.SimpleNamespace(radiance=((first + second) / 2).astype(np.float32), sample_count=self.counts,
                                     standard_error=(self.stated * np.abs(first - second) / 2).astype(np.float32))


def sampled(spread, covered, stated=1.0):
    shares = []
    image = until_invisible(Sampled(spread, stated), None, None, None, lambda light, *_: to_pixels(light, 0.0, np.uint16), covered,
                            shares.append)
    error = to_pixels(image.radiance, 0.0, np.uint16) - to_pixels(np.float32([0.3]).repeat(3), 0.0, np.uint16).astype(float)
    blocks = error.reshape(SHAPE[0] // 2, 2, SHAPE[1] // 2, 2, 3).mean(axis=(1, 3)) / 257
    chosen = covered[::2, ::2, None] & np.ones(3, bool)
    return image, float(np.sqrt(np.square(blocks).sum(where=chosen) / max(chosen.sum(), 1))), shares


class Rule(unittest.TestCase):
    def setUp(self):
        self.covered = np.zeros(SHAPE, bool)
        self.covered[16:80, 16:112] = True
        self.spread = np.where(self.covered, np.where(np.arange(128) < 64, 0.04, 0.16), 0.0)

    def test_the_noise_is_the_stated_one(self):
        """The mean square of 1,536 equal blocks lies within 5% of its expectation in 95% of cases."""
        image, measured, shares = sampled(self.spread, self.covered)
        self.assertLess(measured, 1.05 * MOST_NOISE)
        self.assertGreater(measured, 0.75 * MOST_NOISE)
        self.assertGreater(sampled(self.spread, self.covered, stated=0.5)[1], 1.5 * MOST_NOISE)
        self.assertEqual((shares[-1], shares), (1.0, sorted(shares)))
        counts = image.sample_count
        self.assertTrue((counts[~self.covered] == FIRST_SAMPLES).all())
        self.assertGreater(counts[40, 100], 2 * counts[40, 24])

    def test_pictures_without_noise_or_particles_end_at_once(self):
        for spread, covered in ((0 * self.spread, self.covered), (0 * self.spread, ~self.covered & False)):
            self.assertTrue((sampled(spread, covered)[0].sample_count == FIRST_SAMPLES).all())

    def test_a_dim_neighbourhood_is_not_left_noisy(self):
        spread = np.where(self.covered, 0.01, 0.0)
        spread[40:48, 40:48] = 0.5
        self.assertGreater(sampled(spread, self.covered)[0].sample_count[44, 44], 4 * FIRST_SAMPLES)


class Numbers(unittest.TestCase):

    def test_bounds(self):
        """Each square has one degree of freedom. The mean of n squares then has the relative standard deviation sqrt(2
        / n). The bound uses sqrt(3 / n) instead."""
        squares = np.square(np.random.default_rng(3).normal(size=3000))
        noise = Noise.of(squares)
        self.assertAlmostEqual(noise.rms, 1.0, delta=0.03)
        self.assertAlmostEqual(noise.high**2 - noise.rms**2, 1.96 * np.sqrt(3 / 3000), delta=0.01)
        self.assertLess(noise.low, noise.rms)
        self.assertEqual(Noise.of(np.zeros(0)).high, 0.0)


class Pictures(unittest.TestCase):
    def test_the_noise_of_a_picture_is_that_against_many_samples(self):
        with pt.Context() as context:
            def figure(**options):
                return pt.figure(POSITIONS, radius=0.3, size=(64, 48), context=context, **options)
            found, limit = figure(), figure(samples=512, seed=7)
            few = figure(samples=4)
        error = (found.picture(np.uint16) - limit.picture(np.uint16).astype(float)) / 257
        covered = (found._shares.shapes > 0).reshape(24, 2, 32, 2).all(axis=(1, 3))
        measured = np.sqrt(np.square(error.reshape(24, 2, 32, 2, 3).mean(axis=(1, 3)))[covered].mean())
        self.assertLess(found.noise.high, MOST_NOISE)
        self.assertTrue(found.noise.low < measured < 1.15 * found.noise.high, (found, measured))
        self.assertIn("noise ", repr(found))
        self.assertTrue((few.sample_count == 4).all() and few.noise.high == np.inf)

    def test_the_coverage_has_noise(self):
        """The rms difference of 1,190 pixels with 64 and with 1,024 rays has a relative standard deviation of 2%."""
        found, limit = (pt.figure(POSITIONS * 0.5, radius=0.1, opacity=0.5, style="glossy", size=(64, 48), samples=samples)
                        for samples in (32, 1024))
        apart = found._shares.shapes - limit._shares.shapes, np.hypot(found._shares.error, limit._shares.error)
        measured, expected = (np.sqrt(np.square(each)[found._shares.shapes > 0].mean()) for each in apart)
        self.assertTrue(0.9 < measured / expected < 1.1, (measured, expected))
        stated, found._shares = found.noise.rms, replace(found._shares, error=0.0)
        del found.noise
        self.assertGreater(stated, 1.2 * found.noise.rms)

    def test_an_automatic_exposure_hides_no_noise(self):
        """Separate exposures of the darker and the brighter picture would cancel most of their difference."""
        found = pt.figure(POSITIONS, radius=0.3, size=(64, 48), samples=16, exposure=None)
        same = pt.figure(POSITIONS, radius=0.3, size=(64, 48), samples=16, exposure=automatic_exposure(found.radiance))
        self.assertEqual(found.noise, same.noise)
