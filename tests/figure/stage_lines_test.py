import unittest
import unittest.mock

import numpy as np
import pt
from pt.figures import _figure, _overlay
from pt.figures._cell import Cell
from pt.figures._figure import Staged
from pt.figures._options import Options
from pt.figures._overlay import PER_SIDE, Overlaid, line_width, read_shares
from pt.figures._particles import Particles
from pt.figures._rods import cell_edges
from rays import rays, to_ball

SIZE = (60, 44)
CELL = Cell(np.array([-2.0, -2, -2]), np.array([[4.0, 0, 0], [1, 4, 0], [0, 0.5, 4]]), np.ones(3, bool))
CENTERS = np.array([[0.3, -0.5, 0.0], [1.5, 1, 1], [-1, -1.2, -1]])
RADII = np.array([1.6, 0.5, 0.7])


def shares_of(staged, context):
    context.set_scene(staged.scene)
    context.set_camera(staged.layout.camera)
    settings = pt.RenderSettings(*staged.layout.size)
    return read_shares(context, staged.layout.camera, settings, Overlaid(
        2, sum(map(len, staged.scene.sphere_arrays)), staged.drawn.radii, staged.options.outlines))


def are_hit(origins, ways, begins, ends, radius):
    """Returns whether rays hit balls or capsules."""
    distances = [to_ball(origins - center, ways, size) for center, size in zip(CENTERS, RADII)]
    for begin, end in zip(begins, ends):
        axis = (end - begin) / np.linalg.norm(end - begin)
        start, way = (each - (each @ axis)[..., None] * axis for each in (origins - begin, ways))  # parts perpendicular to the axis
        scale = np.linalg.norm(way, axis=-1)
        side = to_ball(start, way / scale[..., None], radius) / scale
        along = (origins - begin) @ axis + np.where(np.isfinite(side), side, 0) * (ways @ axis)
        side[(along < 0) | (along > np.linalg.norm(end - begin))] = np.inf
        distances += [side, to_ball(origins - begin, ways, radius), to_ball(origins - end, ways, radius)]
    return np.isfinite(distances).any(axis=0)


def share(hits):
    return hits.reshape(SIZE[1], PER_SIDE, SIZE[0], PER_SIDE).mean(axis=(1, 3))


class Lines(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.context = cls.enterClassContext(pt.Context())

    def test_coverage(self):
        """Rounding may change up to two of 16 hits at a border."""
        for projection in ("perspective", "orthographic"):
            staged = Staged.of(Particles(CENTERS, cell=CELL), Options(radius=RADII, size=SIZE, projection=projection, outlines=True))
            shares = shares_of(staged, self.context)
            with unittest.mock.patch.object(_overlay, "BAND_ROWS", 1000):
                whole = shares_of(staged, self.context)
            np.testing.assert_array_equal((shares.shapes, shares.outlines), (whole.shapes, whole.outlines))
            self.assertEqual(shares.shapes.max(), 1.0)  # inside balls
            seen, width = rays(staged.layout.camera, *np.multiply(SIZE, PER_SIDE)), staged.scene.sphere_arrays[1].radius[0]
            apart, apart_of_wider = (np.abs(shares.shapes - share(are_hit(*seen, *cell_edges(CELL), width * factor))).max()
                                     for factor in (1, 1.2))
            self.assertTrue(apart < 2.5 / 16 < apart_of_wider)

    def test_edges_have_their_width_in_pixels(self):
        """Measures two slanting edges in a plane perpendicular to the view, along 60 rows. Samples a quarter of a pixel apart give the
        width within 5%. Negative control: a width that is 20% larger."""
        flat = Particles(np.zeros((1, 3)), cell=Cell.of([[4.5, 0, 0], [0, 1e-5, 0], [2.3, 0, 6]], (-3.4, 0, -3)))
        for size in ((1250, 100), (200, 100)):
            for projection in ("perspective", "orthographic"):
                def width():
                    staged = Staged.of(flat, Options(radius=0.01, size=size, projection=projection, view="front", box="lines"))
                    shapes = shares_of(staged, self.context).shapes[20:80]
                    return shapes.sum(axis=1).mean() * 0.5 * np.cos(np.arctan(2.3 / 6))
                expected = 1.0 if size[0] == 200 else 2.0
                self.assertLess(abs(width() / expected - 1.0), 0.05)
        with unittest.mock.patch.object(_figure, "line_width", lambda size: 1.2 * line_width(size)):
            self.assertGreater(abs(width() / expected - 1.0), 0.05)

    def test_a_camera_among_the_particles(self):
        """A pixel's size is measured at a distance of half the extent."""
        camera = pt.Camera((0, 0, 0), (0, 0, -1), vertical_fov=np.pi / 2)
        particles = Particles(np.array([[0.0, 0, -3]]), cell=Cell.of([8, 8, 8], (-4, -4, -4)))
        edges = Staged.of(particles, Options(radius=0.1, camera=camera, size=(80, 64), box="lines")).scene.sphere_arrays[1]
        np.testing.assert_allclose(edges.radius, 0.5 * 8 / 64)

    def test_outlines_go_round_a_ball(self):
        """The axis of the view goes through the ball, whose silhouette is a circle."""
        for projection in ("perspective", "orthographic"):
            figure = pt.figure(np.zeros((1, 3)), radius=1.0, projection=projection, size=(96, 72), samples=1, outlines=True,
                               context=self.context)
            camera, outlines = figure.camera, figure._shares.outlines
            if camera.vertical_extent is None:
                radius = 36 * np.tan(np.arcsin(1 / np.linalg.norm(camera.position))) / np.tan(0.5 * camera.vertical_fov)
            else:
                radius = 72 / camera.vertical_extent
            rows, columns = np.indices(outlines.shape) + 0.5
            apart = abs(np.hypot(rows - 36, columns - 48) - radius)
            self.assertEqual(outlines[apart > 2].max(), 0)
            self.assertGreater(outlines[apart < 0.3].min(), 0)
