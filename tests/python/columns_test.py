import unittest

import numpy as np
import pt
from pictures import LAMP, WHITE, cloud, radiance

COUNT = 120  # The scene has a tree from 113 spheres on.
POSITIONS, COLORS = cloud(COUNT)
RADII = np.linspace(0.05, 0.2, COUNT, dtype=np.float32)
MATERIALS = [WHITE, pt.Material(diffuse=0.5, specular=0.4, glossiness=20)]
INDICES = (np.arange(COUNT) % 2).astype(np.uint32)
SUN = pt.Sphere((3, 8, 6), 3, LAMP)


def scene_of(array):
    return pt.Scene([SUN], sphere_arrays=[array], materials=MATERIALS)


def swapped(array):
    return array.astype(array.dtype.newbyteorder())


class Columns(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.context = cls.enterClassContext(pt.Context())
        cls.plain = radiance(cls.context, scene_of(
            pt.SphereArray(POSITIONS.copy(), RADII.copy(), INDICES.copy(), color=COLORS.copy())))

    def check(self, copied, positions=POSITIONS, radii=RADII, indices=INDICES, colors=COLORS, **columns):
        array = pt.SphereArray(positions, radii, indices, color=colors, **columns)
        self.assertEqual(array.copied, copied)
        np.testing.assert_array_equal(radiance(self.context, scene_of(array)), self.plain)

    def test_the_plain_picture_shows_something(self):
        self.assertGreater(len(np.unique(self.plain)), 100)
        without = pt.SphereArray(POSITIONS, RADII, INDICES)
        self.assertFalse(np.array_equal(radiance(self.context, scene_of(without)), self.plain))

    def test_ends_make_capsules(self):
        self.check((), end=POSITIONS)
        ends = POSITIONS + np.float32([0.3, 0, 0])
        capsules = radiance(self.context, scene_of(pt.SphereArray(POSITIONS, RADII, INDICES, color=COLORS, end=ends)))
        self.assertTrue(self.context.stats().features & pt.Feature.CAPSULES)
        self.assertFalse(np.array_equal(capsules, self.plain))
        self.check(("end",), end=np.asfortranarray(POSITIONS))

    def test_layouts_that_are_read_in_place(self):
        particles = np.zeros(COUNT, [("charge", "i1"), ("position", "f4", 3), ("radius", "f8"), ("kind", "u4")])
        particles["position"], particles["radius"], particles["kind"] = POSITIONS, RADII, INDICES
        self.assertFalse(particles["position"].flags.aligned)
        self.check((), particles["position"], particles["radius"], particles["kind"])
        table = np.full((2 * COUNT, 7), np.nan)
        table[::2, 1:4], table[::2, 5] = POSITIONS, RADII
        table.flags.writeable = False
        self.check((), table[::2, 1:4], table[::2, 5])
        self.check((), POSITIONS.astype(float), RADII.astype(float), colors=COLORS.astype(float))

    def test_layouts_that_are_copied(self):
        self.check(("center", "color"), np.asfortranarray(POSITIONS), colors=np.asfortranarray(COLORS))
        table = np.full((COUNT, 6), np.nan)
        table[:, ::2] = POSITIONS
        self.check(("center",), table[:, ::2])
        self.check(("center", "radius"), POSITIONS[::-1].copy()[::-1], RADII[::-1].copy()[::-1])
        self.check(("center", "radius", "material", "color"), swapped(POSITIONS), swapped(RADII), swapped(INDICES),
                   swapped(COLORS))
        self.check(("center", "material"), POSITIONS.tolist(), indices=INDICES.astype(np.int64))
        self.assertEqual(pt.SphereArray(POSITIONS.astype(np.float16), 1, 0).center.dtype, np.float32)
        self.assertEqual(pt.SphereArray(swapped(POSITIONS), 1, 0).center.dtype, np.float32)
        for wider in (int, np.longdouble):
            self.assertEqual(pt.SphereArray(POSITIONS.astype(wider), 1, 0).center.dtype, np.float64)

    def test_one_value_for_all(self):
        color = np.array((0.5, 0.2, 0.1))
        array = pt.SphereArray(POSITIONS, 0.1, MATERIALS[1], color=color)
        repeated = pt.SphereArray(POSITIONS, np.full(COUNT, 0.1), np.ones(COUNT, np.uint32), color=np.tile(color, (COUNT, 1)))
        np.testing.assert_array_equal(radiance(self.context, scene_of(array)), radiance(self.context, scene_of(repeated)))
        self.check(("radius",), radii=RADII.tolist(), motion=np.broadcast_to(np.zeros(3), (COUNT, 3)))

    def test_nothing_is_copied(self):
        positions, radii, colors = np.zeros_like(POSITIONS), RADII.astype(float), np.zeros_like(COLORS)
        array = pt.SphereArray(positions, radii, INDICES, color=colors)
        self.assertTrue(np.shares_memory(array.center, positions))
        positions[:], colors[:] = POSITIONS, COLORS
        image = radiance(self.context, scene_of(array))
        np.testing.assert_array_equal(image, self.plain)
        positions[:] = np.nan
        self.context.set_render(pt.RenderSettings(image.shape[1], image.shape[0]))
        self.context.accumulate(4)
        np.testing.assert_array_equal(self.context.readback(), self.plain)
        with self.assertRaisesRegex(pt.InvalidSceneError, r"sphere_arrays\[0\].center\[0\] = \(nan, nan, nan\)"):
            self.context.set_scene(scene_of(array))

    def test_what_does_not_fit_is_refused(self):
        for error, words, arguments, *colors in (
                (ValueError, rf"center.shape = \({COUNT},\): must be \(n, 3\)", (RADII, RADII, 0)),
                (ValueError, rf"radius.shape = \({COUNT - 1},\): must be \({COUNT},\) or \(\)", (POSITIONS, RADII[1:], 0)),
                (ValueError, "indices of materials", (POSITIONS, RADII, -1)),
                (ValueError, "indices of materials", (POSITIONS, RADII, 2**32)),
                (TypeError, "must be of real numbers", (POSITIONS.astype(complex), RADII, 0)),
                (TypeError, "must be of real numbers", (POSITIONS > 0, RADII, 0)),
                (TypeError, "must be of integers", (POSITIONS, RADII, RADII)),
                (TypeError, r"color.dtype = .*: must be uint8 \(sRGB", (POSITIONS, RADII, 0), COLORS.astype(np.uint16)),
                (TypeError, r"color.dtype = .*: must be uint8 \(sRGB", (POSITIONS, RADII, 0), COLORS > 0),
                (ValueError, "end", (POSITIONS, RADII, 0), None, POSITIONS[1:]),
        ):
            with self.subTest(words=words), self.assertRaisesRegex(error, words):
                pt.SphereArray(*arguments, **dict(zip(("color", "end"), colors)))
        with self.assertRaisesRegex(pt.InvalidSceneError, r"sphere_arrays\[0\].radius\[7\] = -1: must be > 0"):
            self.context.set_scene(scene_of(pt.SphereArray(POSITIONS, np.where(np.arange(COUNT) == 7, -1, RADII), 0)))

    def test_no_spheres(self):
        empty = pt.SphereArray(np.zeros((0, 3)), np.zeros(0), WHITE)
        np.testing.assert_array_equal(radiance(self.context, scene_of(empty)),
                                      radiance(self.context, pt.Scene([SUN])))
