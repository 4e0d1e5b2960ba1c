import pathlib
import pickle
import re
import sys
import tempfile
import unittest
from unittest import mock

import numpy as np
import pt
from pictures import HEIGHT, SCENE, WHITE, WIDTH, ready
from pt import _zstd

SAMPLES = 24


class Films(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.context = cls.enterClassContext(pt.Context())
        cls.whole, cls.image = cls.film(0, SAMPLES), cls.context.image()
        cls.parts = [cls.film(first, 8) for first in range(0, SAMPLES, 8)]

    @classmethod
    def film(cls, first, count, **fields):
        ready(cls.context, first_sample=first, **fields).accumulate(count)
        return cls.context.film()

    def test_they_add_to_one_rendering(self):
        first, second, third = self.parts
        before = first.to_bytes()
        for total in third + (first + second), sum(self.parts):
            self.assertEqual(total.to_bytes(), self.whole.to_bytes())
        total = kept = first + second
        self.assertNotEqual(total, self.whole)
        total += third
        self.assertIs(total, kept)
        self.assertEqual((total, first.to_bytes()), (self.whole, before))

    def test_coverage(self):
        film = self.film(0, 8, coverage=True)
        image = self.context.image()
        self.assertEqual((film.info.coverage, self.whole.info.coverage), (True, False))
        np.testing.assert_array_equal(film.image().coverage, image.coverage)
        self.assertEqual(image.coverage.shape, (HEIGHT, WIDTH))
        self.assertTrue(((image.coverage > 0) & (image.coverage < 1)).any())
        self.assertIsNone(self.image.coverage)
        with self.assertRaisesRegex(pt.InvalidArgumentError, "PT_RENDER_COVERAGE"):
            self.whole.readback(pt.Quantity.COVERAGE)

    def test_pickle(self):
        copies = pickle.loads(pickle.dumps(self.parts))
        self.assertEqual(copies, self.parts)

    def test_streams(self):
        pieces = []
        self.whole.stream(pieces.append)
        self.assertEqual(b"".join(pieces), self.whole.to_bytes())
        self.assertEqual(sum(map(len, pieces)), self.whole.size)
        self.assertGreater(len(pieces), 1)
        full = mock.Mock(side_effect=OSError(28, "No space left on device"))
        with self.assertRaisesRegex(OSError, "No space left"):
            self.whole.stream(full)
        full.assert_called_once_with(pieces[0])

    def test_files(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "kept.ptfilm")
            path.write_text("what was there before")
            self.whole.save(path)
            self.assertEqual(pt.Film.load(path), self.whole)
            self.assertEqual(path.read_bytes(), self.whole.to_bytes())
            with mock.patch("pathlib.Path.replace", side_effect=OSError), self.assertRaises(OSError):
                self.parts[0].save(path)
            self.assertEqual(pt.Film.load(path), self.whole)
            self.assertEqual([found.name for found in pathlib.Path(folder).iterdir()], ["kept.ptfilm"])

    def test_packed_files(self):
        """The module that unpacks the program's films may be missing."""
        packed = _zstd.MAGIC + b"frame"
        module = mock.Mock(decompress=lambda data: self.whole.to_bytes() if data == packed else b"")
        with mock.patch.dict(sys.modules, {"compression.zstd": None, "zstandard": module}):
            self.assertEqual(pt.Film(packed), self.whole)
        with mock.patch.dict(sys.modules, {"compression.zstd": None, "zstandard": None}):
            with self.assertRaisesRegex(pt.IncompatibleError, "install the Python module zstandard"):
                pt.Film(packed)

    def test_their_images_are_the_context_s(self):
        image = sum(self.parts).image()
        np.testing.assert_array_equal(image.radiance, self.image.radiance)
        np.testing.assert_array_equal(image.standard_error, self.image.standard_error)
        self.assertTrue((image.sample_count == SAMPLES).all())
        self.assertAlmostEqual(image.error, self.image.error, delta=1e-5 * image.error)
        part = np.zeros((4, 6, 4), np.float16)
        self.whole.readback(out=part, rectangle=(3, 5, 6, 4))
        np.testing.assert_array_equal(part[:, :, :3], self.image.radiance[5:9, 3:9].astype(np.float16))

    def test_what_they_are_of(self):
        info = self.film(8, 4, first_row=5, row_count=6, seed=2**40).info
        self.assertEqual((info.width, info.height, info.x, info.y, info.columns, info.rows),
                         (WIDTH, HEIGHT, 0, 5, WIDTH, 6))
        self.assertEqual((info.seed, info.estimator, info.sampler), (2**40, pt.Estimator.MIS, pt.Sampler.SOBOL))
        without_width = re.sub(r", \d+ bits", "", self.context.device.name)
        self.assertTrue(info.device.startswith(without_width), info.device)
        self.assertEqual(self.whole.tiles, [pt.FilmTile(0, 0, WIDTH, HEIGHT, (range(0, SAMPLES),))])
        self.assertEqual((self.parts[0] + self.parts[2]).tiles[0].samples, (range(0, 8), range(16, 24)))
        self.assertIn(f"{WIDTH}x{HEIGHT} pixels, {SAMPLES} samples", repr(self.whole))

    def test_a_context_goes_on_from_one(self):
        ready(self.context)
        self.context.add_film(self.parts[0])
        self.context.accumulate(SAMPLES - 8)
        self.assertEqual(self.context.film(), self.whole)

    def test_what_does_not_belong_is_refused(self):
        first, kept = self.parts[0], self.parts[0].to_bytes()
        with self.assertRaisesRegex(pt.IncompatibleError, "seed"):
            first += self.film(8, 8, seed=1)
        with self.assertRaises(pt.IncompatibleError):
            pt.Film(kept[:-1])
        self.assertEqual(first.to_bytes(), kept)
        ready(self.context, pt.Scene([*SCENE.spheres, pt.Sphere((9, 9, 9), 1, WHITE)]))
        with self.assertRaisesRegex(pt.IncompatibleError, "scene"):
            self.context.add_film(first)
        for other in 1, "film", None:
            with self.assertRaises(TypeError):
                first + other
            with self.assertRaises(TypeError):
                other + first
            self.assertNotEqual(first, other)
        with self.assertRaises(TypeError):
            hash(first)
        with self.assertRaisesRegex(pt.InvalidArgumentError, "target_error = nan: must be finite and > 0"):
            first.plan(float("nan"), 64)
        with self.assertRaisesRegex(pt.InvalidArgumentError, "tile_count = 2: must be the number of tiles, 6"):
            self.context.accumulate_tiles([1, 2])


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
