import importlib.util
import itertools
import unittest

import numpy as np
import pt
from pt.figures._cell import Cell
from pt.figures._drawn import prepare
from pt.figures._figure import view_of
from pt.figures._layout import MARGIN, Layout
from pt.figures._options import VIEWS, Options
from pt.figures._particles import Particles
from pt.figures._radii import typical_radius
from pt.figures._series import frames, turntable
from pt.figures._view import up_vector
from rays import rims

RANDOM = np.random.default_rng(3)


def balls(kind, count=200):
    centers = RANDOM.normal(size=(count, 3)) * {"cloud": 1, "layer": (3, 2, 0), "needle": (0.1, 0.1, 9)}.get(kind, 1)
    if kind == "one":
        centers = centers[:1]
    return centers + (1e4 if kind == "far" else 0), RANDOM.uniform(0.05, 0.4, len(centers))


def layout_of(particles, **look):
    look = Options(**look)
    drawn = prepare(particles, look)
    view = view_of(drawn, look)
    return drawn, Layout.of(view, view.reaches(drawn.balls), look.style, look.floor)


def aspect_of(layout):
    return layout.size[0] / layout.size[1]


class Fit(unittest.TestCase):
    def test_every_ball_is_in_the_picture_and_one_pair_of_sides_is_touched(self):
        for kind, view, projection, size in itertools.product(("cloud", "layer", "needle", "one", "far"), (*VIEWS, (1, -2, 0.5)),
                                                              ("perspective", "orthographic"), (None, (300, 100), (100, 300))):
            with self.subTest(kind=kind, view=view, projection=projection, size=size):
                centers, radii = balls(kind)
                _, layout = layout_of(Particles(centers), radius=radii, view=view, projection=projection, size=size)
                sides = np.array([rim.max() for rim in rims(layout.camera, aspect_of(layout), centers, radii)]) - (1 - 2 * MARGIN)
                self.assertLess(sides.max(), 1e-9)
                self.assertTrue((abs(sides.reshape(2, 2)) < 1e-9).all(axis=1).any(), sides)

    def test_corners_of_a_cell_are_in_the_picture_too(self):
        cell = Cell(np.array([-3.0, 0, 0]), np.array([[6.0, 0, 0], [2, 5, 0], [0, 1, 4]]), np.ones(3, bool))
        _, layout = layout_of(Particles(np.zeros((1, 3)), cell=cell), radius=0.1, box="lines")
        corners = np.array([cell.origin + np.array(k) @ cell.vectors for k in np.ndindex(2, 2, 2)])
        self.assertAlmostEqual(max(float(rim.max()) for rim in rims(layout.camera, aspect_of(layout), corners, 0.0)), 1 - 2 * MARGIN)

    def test_lamps_hold_everything_and_are_out_of_the_picture(self):
        centers, radii = balls("cloud")
        for style in ("matte", "ambient-occlusion"):
            _, layout = layout_of(Particles(centers), radius=radii, style=style)
            surround, *keys = layout.stage.lamps
            for center, radius in ((centers, radii), *((np.array([key.center]), key.radius) for key in keys),
                                   (np.array([layout.camera.position]), 0.0)):
                self.assertLess((np.linalg.norm(center - surround.center, axis=1) + radius).max(), surround.radius)
            for key in keys:
                back = layout.camera.axes()[2]
                self.assertGreater((np.array(key.center) - layout.camera.position) @ back, key.radius)

    def test_a_floor_is_below_all_and_not_before_the_camera(self):
        centers, radii = balls("cloud")
        for up, normal in (("z", (0, 0, 1)), ("-x", (-1, 0, 0))):
            _, layout = layout_of(Particles(centers), radius=radii, floor=True, up=up)
            gap = (centers @ np.array(layout.stage.floor.normal) + layout.stage.floor.offset - radii).min()
            self.assertTrue(0 < gap < 1e-3)
            self.assertEqual(layout.stage.floor.normal, normal)
        with self.assertRaisesRegex(ValueError, "floor: the view puts the camera below it"):
            layout_of(Particles(centers), radius=radii, floor=True, view="bottom")

    def test_the_best_view_is_along_the_shortest_axis(self):
        turn, _ = np.linalg.qr(RANDOM.normal(size=(3, 3)))
        sizes = np.random.default_rng(8).uniform(-1, 1, (4000, 3)) * (5, 2, 1)
        _, layout = layout_of(Particles(sizes @ turn.T), radius=0.1, view="best")
        right, above, back = layout.camera.axes()
        for axis, expected in ((right, turn[:, 0]), (above, turn[:, 1]), (back, turn[:, 2])):
            self.assertGreater(abs(axis @ expected), 0.995)
        self.assertGreater(above[2], 0)
        self.assertGreater(layout.size[0], 1.8 * layout.size[1])

    def test_a_given_camera_is_taken(self):
        centers, radii = balls("cloud")
        for factor in (1.0, 2.0**80):
            camera = pt.Camera((9 * factor, 0, 0), (0, 0, 0), (0, 0, 1), aperture=0.5 * factor, focus=2 * factor)
            drawn, layout = layout_of(Particles(centers * factor), radius=radii * factor, camera=camera)
            found = np.abs(drawn.centers).max(), layout.camera.aperture, layout.camera.focus
            np.testing.assert_allclose(found / np.linalg.norm(layout.camera.position), np.array([np.abs(centers).max(), 0.5, 2]) / 9)

    def test_what_is_refused(self):
        for words, look in (("view = 'sideways': must be three-quarter, front", {"view": "sideways"}),
                            ("view = '0,0,0'", {"view": "0,0,0"}), ("view = '1,2'", {"view": "1,2"}),
                            ("up = 'w'", {"up": "w"}), ("projection = 'flat'", {"projection": "flat"}),
                            ("style = 'shiny': must be auto, matte, glossy", {"style": "shiny"}),
                            ("wrap: data has no cell|has no cell", {"wrap": True})):
            with self.subTest(words=words), self.assertRaisesRegex(ValueError, words):
                layout_of(Particles(np.zeros((1, 3))), radius=1, **look)


class Scale(unittest.TestCase):
    def test_lengths_of_any_unit_give_the_same_bits(self):
        centers, radii = balls("cloud", 40)
        with pt.Context() as context:
            images = [pt.figure(Particles(centers * 2.0**power), radius=radii * 2.0**power, size=(32, 24), samples=2,
                                context=context) for power in (0, 90, -120, 300)]
        for image in images[1:]:
            np.testing.assert_array_equal(image.radiance, images[0].radiance)
            np.testing.assert_array_equal(image.to_srgb8(), images[0].to_srgb8())


class Series(unittest.TestCase):
    @unittest.skipUnless(importlib.util.find_spec("matplotlib"), "matplotlib is not installed")
    def test_frames_have_one_camera_one_range_and_one_rule_of_radii(self):
        trajectory = []
        for k in range(3):
            centers, _ = balls("cloud")
            trajectory.append(Particles(centers * (1 + 2 * k), {"v": np.arange(200.0) * (k + 1) - k}))
        look = Options(color="v", size=(90, 60))
        staged = list(frames(lambda: iter(trajectory), look))
        first = staged[0]
        for each, particles in zip(staged, trajectory, strict=True):
            self.assertEqual(each.layout, first.layout)
            self.assertEqual((each.drawn.legend.low, each.drawn.legend.high), (-2.0, 595.0))
            self.assertEqual(float(each.drawn.radii[0]), typical_radius(trajectory[0].positions))
            sides = [float(rim.max()) for rim in rims(each.layout.camera, 1.5, particles.positions, each.drawn.radii[0])]
            self.assertLess(max(sides), 1 - 2 * MARGIN + 1e-9)
        self.assertAlmostEqual(max(sides), 1 - 2 * MARGIN)

    def test_types_keep_their_colors_where_some_are_missing(self):
        trajectory = [Particles(np.eye(3)[:2], types=np.array(names)) for names in (["b", "d"], ["a", "d"])]
        colors = [dict(zip(each.drawn.legend.names, map(tuple, each.drawn.legend.colors)))
                  for each in frames(lambda: iter(trajectory), Options())]
        self.assertEqual(colors[0]["d"], colors[1]["d"])
        self.assertEqual(len({*colors[0].values(), *colors[1].values()}), 3)

    def test_a_turntable_keeps_its_distance_and_has_all_in_view(self):
        centers, radii = balls("cloud", 30)
        for view, up in (("three-quarter", "z"), ("front", "y"), ((1, 2, 2), "-x")):
            staged = list(turntable(Particles(centers), 40, Options(radius=radii, view=view, up=up)))
            self.assertEqual(len({each.layout.size for each in staged}), 1)
            spans = [[rim.max() for rim in rims(each.layout.camera, aspect_of(each.layout), centers, radii)] for each in staged]
            self.assertLess(np.max(spans), 1 - 2 * MARGIN + 1e-9)
            # The farthest ball may lie between two of the 40 turns, so its reach is too small by up to (pi / 40)^2 / 2.
            self.assertGreater(np.max(spans), 0.995 * (1 - 2 * MARGIN))
            axis = np.cross(np.subtract(staged[10].layout.camera.position, staged[0].layout.camera.position),
                            np.subtract(staged[20].layout.camera.position, staged[0].layout.camera.position))
            self.assertAlmostEqual(abs(axis @ staged[0].layout.stage.lamps[0].center - axis @ np.array(
                staged[7].layout.stage.lamps[0].center)), 0.0)
            self.assertGreater(axis @ up_vector(up), 0)
            distances = [np.linalg.norm(np.subtract(each.layout.camera.position, each.layout.stage.lamps[0].center)) for each in staged]
            np.testing.assert_allclose(distances, distances[0])


class TypicalRadius(unittest.TestCase):
    def test_it_is_half_of_what_neighbours_are_apart(self):
        lattice = np.stack(np.meshgrid(*3 * [np.arange(12.0)]), -1).reshape(-1, 3)
        clumps = np.concatenate([RANDOM.normal(size=(3000, 3)) * 0.01, RANDOM.uniform(-50, 50, (30, 3))])
        sphere = RANDOM.normal(size=(2000, 3))
        sphere /= np.linalg.norm(sphere, axis=1)[:, None]
        for name, points in (("lattice", lattice), ("layer", lattice[lattice[:, 2] == 0]), ("row", lattice[:12] * 1e-7),
                             ("twice", np.repeat(lattice, 2, axis=0)), ("cloud", RANDOM.normal(size=(1500, 3))),
                             ("clumps", clumps), ("surface", sphere)):
            with self.subTest(name=name):
                apart = np.linalg.norm(points[:, None] - points[None], axis=2)
                apart[apart == 0] = np.inf
                nearest = np.sort(apart, axis=1)[:, :4]
                expected = np.median(nearest[:, 0])
                if np.quantile(nearest[:, 0], 0.05) < 0.5 * expected:
                    expected = np.median(nearest[:, 3])
                np.testing.assert_allclose(typical_radius(points.astype(np.float32)), 0.5 * expected, rtol=0.1)
        self.assertEqual(typical_radius(np.ones((5, 3))), 1.0)
