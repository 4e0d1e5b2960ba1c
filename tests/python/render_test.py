import unittest
from dataclasses import replace

import numpy as np
import pt
from pictures import CAMERA, HEIGHT, SCENE, WIDTH, cloud, ready, settings
from rays import rims

POSITIONS, COLORS = cloud(80)
SMALL = {"size": (WIDTH, HEIGHT), "samples": 16}


class Render(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.context = cls.enterClassContext(pt.Context())
        cls.image = pt.render(POSITIONS, 0.1, COLORS, context=cls.context, **SMALL)

    def test_it_is_what_the_calls_of_the_library_give(self):
        with pt.Context() as context:
            context.set_render(settings(max_path_length=3))
            context.set_camera(self.image.camera)
            context.set_scene(self.image.scene)
            for _ in range(2):
                context.accumulate(8)
            for quantity, found in ((pt.Quantity.RADIANCE, self.image.radiance),
                                    (pt.Quantity.STANDARD_ERROR, self.image.standard_error)):
                np.testing.assert_array_equal(found, context.readback(quantity))
            self.assertEqual(self.image.error_estimate, context.error_estimate())
        self.assertTrue((self.image.sample_count == 16).all())
        self.assertEqual(self.image.sample_count.shape, (HEIGHT, WIDTH))

    def test_options(self):
        self.assertEqual(pt.render(POSITIONS, 0.1, size=(8, 6)).stats.sample_count, 16)
        floor = pt.render(POSITIONS, 0.1, COLORS, context=self.context, floor=True, **SMALL)
        self.assertGreater(floor[-1, WIDTH // 2].min(), self.image[-1, WIDTH // 2].max())
        other_seed = pt.render(POSITIONS, 0.1, COLORS, context=self.context, seed=1, **SMALL)
        self.assertFalse(np.array_equal(other_seed, self.image))
        self.assertLess(np.abs(other_seed.radiance - self.image.radiance).mean(), 0.05)
        seen_by = pt.render(POSITIONS, 0.1, context=self.context, camera=CAMERA, **SMALL)
        self.assertFalse(np.array_equal(seen_by, self.image))
        through_lens = pt.render(POSITIONS, 0.1, context=self.context, camera=replace(CAMERA, aperture=0.5), **SMALL)
        self.assertFalse(np.array_equal(through_lens, seen_by))

    def test_until_an_error_is_reached(self):
        image = pt.render(POSITIONS, 0.1, context=self.context, size=(WIDTH, HEIGHT), error=0.05)
        self.assertLessEqual(image.error_bounds[1], 0.05)
        self.assertLessEqual(image.error, image.error_bounds[1])
        self.assertEqual(image.sample_count.min(), image.stats.sample_count)
        self.assertAlmostEqual(image.sample_count.mean(), image.stats.mean_sample_count)
        few = pt.render(POSITIONS, 0.1, context=self.context, size=(WIDTH, HEIGHT), error=1e-9, samples=20)
        self.assertEqual(few.stats.max_sample_count, 20)

    def test_the_camera_touches_the_spheres(self):
        """All spheres are in view, and one touches the edge."""
        radii = np.linspace(0.05, 0.4, len(POSITIONS))
        for aspect, direction in ((1.5, (0.5, 0.4, 1)), (0.5, (-1, 0.2, 0)), (3.0, (0, -1, 1))):
            camera = pt.Camera.around(POSITIONS, radii, direction=direction, aspect=aspect, margin=1)
            self.assertAlmostEqual(max(rim.max() for rim in rims(camera, aspect, POSITIONS, radii)), 1.0)
            with self.assertRaisesRegex(ValueError, "parallel"):
                pt.Camera.around(POSITIONS, radii, direction=(0, 1, 0))

    def test_projections_have_names(self):
        def camera(**fields):
            return pt.Camera((0, 0, 1), (0, 0, 0), **fields)

        parallel = camera(projection="orthographic", vertical_extent=3)
        self.assertEqual(parallel, camera(projection=pt.Projection.ORTHOGRAPHIC, vertical_extent=3))
        self.assertEqual(parallel, camera(vertical_extent=3), "calls of 0.3")
        self.assertNotEqual(parallel, camera(projection="orthographic", vertical_extent=2))
        self.assertEqual(camera(projection="perspective"), camera())
        for fields, words in (({"projection": "flat"}, "projection = 'flat': must be one of perspective, orthographic"),
                              ({"projection": "orthographic"}, "vertical_extent = None: must be > 0"),
                              ({"projection": "perspective", "vertical_extent": 3}, "vertical_extent = 3: must be None"),
                              ({"projection": "orthographic", "vertical_fov": 1}, "vertical_fov = 1: must be None")):
            with self.subTest(fields), self.assertRaisesRegex(ValueError, words):
                camera(**fields)

    def test_numbers_that_cannot_be_used_are_named_as_the_caller_knows_them(self):
        row, radii = POSITIONS.copy(), np.full(len(POSITIONS), 0.1)
        row[3, 1], radii[2] = np.nan, np.inf
        for words, arguments, options in (
                (r"positions\[3, 1\] = nan: must be finite", (row, 0.1), {}),
                (r"radii\[2\] = inf: must be > 0 and finite", (POSITIONS, radii), {}),
                ("radii = -1: must be > 0 and finite", (POSITIONS, -1), {}),
                ("error = nan: must be > 0 and finite", (POSITIONS, 0.1), {"error": float("nan"), "samples": 1}),
                ("no spheres", (np.zeros((0, 3)), 1.0), {}), ("device = '': must name a device", (POSITIONS, 0.1), {"device": ""})):
            with self.subTest(words=words), self.assertRaisesRegex(ValueError, words):
                pt.render(*arguments, **options)
        with self.assertRaisesRegex(ValueError, r"center\[3, 1\] = nan: must be finite"):
            pt.Camera.around(row, 0.1)


class Readback(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.context = ready(cls.enterClassContext(pt.Context()))
        cls.context.accumulate(4)
        cls.image = cls.context.readback()

    def test_a_new_array(self):
        self.assertEqual((self.image.shape, self.image.dtype), ((HEIGHT, WIDTH, 3), np.float32))
        self.assertGreater(self.image.max(), 0.5)
        rgba = self.context.readback(format=pt.Format.RGBA16F)
        self.assertEqual((rgba.shape, rgba.dtype), ((HEIGHT, WIDTH, 4), np.float16))
        np.testing.assert_array_equal(rgba[:, :, :3], self.image.astype(np.float16))
        self.assertTrue((rgba[:, :, 3] == 1).all())

    def test_a_part_of_a_larger_array(self):
        for channels, dtype in ((3, np.float32), (4, np.float32), (4, np.float16)):
            atlas = np.full((50, 50, channels), 7, dtype)
            part = atlas[10:10 + 2 * HEIGHT:2, 20:20 + WIDTH]
            self.assertIs(self.context.readback(out=part), part)
            np.testing.assert_array_equal(part[:, :, :3], self.image.astype(dtype))
            part[...] = 7
            self.assertTrue((atlas == 7).all())

    def test_other_quantities(self):
        self.assertTrue(np.isinf(self.context.readback(pt.Quantity.STANDARD_ERROR)).all())
        self.assertTrue((self.context.readback(pt.Quantity.SAMPLE_COUNT) == 4).all())
        objects = self.context.readback(pt.Quantity.OBJECT, format=pt.Format.R32UI)
        self.assertEqual((objects.shape, objects.dtype), ((HEIGHT, WIDTH, 1), np.uint32))
        met = objects[:, :, 0] != pt.NO_OBJECT
        np.testing.assert_array_equal(np.isfinite(self.context.readback(pt.Quantity.DEPTH))[:, :, 0], met)
        self.assertTrue(met.any() and not met.all())

    def test_what_does_not_fit_is_refused(self):
        plain = np.zeros((HEIGHT, WIDTH, 3), np.float32)
        locked = plain.copy()
        locked.flags.writeable = False
        for words, out in (
                ("dtype float64", plain.astype(float)), ("dtype >f4", plain.astype(">f4")), ("shape", plain[:, :, 0]),
                ("shape", plain[:, :, :2]), ("strides", np.asfortranarray(plain)), ("strides", plain[:, ::-1]),
                ("strides", np.zeros((HEIGHT, 2 * WIDTH, 3), np.float32)[:, ::2]), ("read-only", locked),
                ("rows -288 bytes apart", plain[::-1]), ("24x15 pixels: must have the 24x16", plain[1:]),
                ("dtype float16", plain.astype(np.float16))):
            with self.subTest(words=words), self.assertRaisesRegex(ValueError, words):
                self.context.readback(out=out)
        for rectangle in (0, 0, -1, 2), (-1, 0, 1, 2):
            with self.assertRaisesRegex(ValueError, "rectangle"):
                self.context.readback(rectangle=rectangle)
        np.testing.assert_array_equal(self.context.readback(), self.image)


class Warnings(unittest.TestCase):
    def test_of_what_rounding_moves(self):
        spheres = pt.SphereArray([(0.0, 1.0, 0.0), (0.0, 1.0, -1e9)], 1, pt.Material(diffuse=0.5), opacity=0.5)
        with pt.Context() as context:
            with self.assertWarnsRegex(UserWarning, r"^sphere_arrays\[0\]\.center\[1\] = \(0, 1, -1e\+09\): it reaches"):
                context.render(pt.Scene(sphere_arrays=[spheres]), CAMERA, settings(), 1)
            self.assertEqual((context.warning().index, context.warning().component), (0, 1))
            context.set_scene(SCENE)
            self.assertIsNone(context.warning())
