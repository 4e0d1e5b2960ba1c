"""What is laid over figures: coverage, lines of cells that balls hide, outlines; against rays in double precision."""

import unittest
import unittest.mock

import numpy as np
import pt
from pt.figures import _overlay
from pt.figures._figure import Staged
from pt.figures._options import Options
from pt.figures._overlay import PER_SIDE, Overlaid, cell_edges, line_width, read_shares
from pt.figures._particles import Cell, Particles

SIZE = (60, 44)
CELL = Cell(np.array([-2.0, -2, -2]), np.array([[4.0, 0, 0], [1, 4, 0], [0, 0.5, 4]]), np.ones(3, bool))
CENTERS = np.array([[0.3, -0.5, 0.0], [1.5, 1, 1], [-1, -1.2, -1]])
RADII = np.array([1.6, 0.5, 0.7])


def shares_of(projection, outlines, context, size):
    staged = Staged.of(Particles(CENTERS, cell=CELL), Options(radius=RADII, size=size, projection=projection))
    camera = staged.layout.camera
    context.set_scene(staged.scene)
    context.set_camera(camera)
    settings = pt.RenderSettings(*size)
    return camera, read_shares(context, camera, settings, Overlaid(2, staged.drawn.radii, cell_edges(
        CELL.origin, CELL.vectors), outlines))


def rays(camera, size):
    """Of the centres of hits: origins and unit directions, shape (rows, columns, 3)."""
    right, above, back = camera.axes()
    rows, columns = np.indices((size[1] * PER_SIDE, size[0] * PER_SIDE)) + 0.5
    x, y = 2 * columns / columns.shape[1] - 1, 1 - 2 * rows / rows.shape[0]
    aspect, position = size[0] / size[1], np.array(camera.position)
    if camera.vertical_extent is not None:
        half = camera.vertical_extent / 2
        origins = position + (x * aspect * half)[..., None] * right + (y * half)[..., None] * above
        return origins, np.broadcast_to(-back, origins.shape)
    half = np.tan(camera.vertical_fov / 2)
    ways = (x * aspect * half)[..., None] * right + (y * half)[..., None] * above - back
    return np.broadcast_to(position, ways.shape), ways / np.linalg.norm(ways, axis=-1, keepdims=True)


def first_hits(origins, ways):
    """Distance and index of the ball that each ray meets first."""
    distances = np.full((*ways.shape[:-1], len(CENTERS)), np.inf)
    for k, (center, radius) in enumerate(zip(CENTERS, RADII)):
        to = center - origins
        along = (to * ways).sum(axis=-1)
        square = radius**2 - ((to * to).sum(axis=-1) - along**2)
        distances[..., k] = np.where(square >= 0, along - np.sqrt(np.maximum(square, 0)), np.inf)
    return distances.min(axis=-1), np.where(np.isfinite(distances.min(axis=-1)), distances.argmin(axis=-1), -1)


def share(hits, size=SIZE):
    return hits.reshape(size[1], PER_SIDE, size[0], PER_SIDE).mean(axis=(1, 3))


class Lines(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.context = pt.Context()

    @classmethod
    def tearDownClass(cls):
        cls.context.close()

    def test_coverage_and_lines(self):
        """A ray is on a line where it passes an edge nearer than half the line's width, measured in the picture, before
        what it meets. One or two hits of 16 at a border may round otherwise."""
        for projection in ("perspective", "orthographic"):
            camera, shares = shares_of(projection, False, self.context, SIZE)
            origins, ways = rays(camera, SIZE)
            depths, balls = first_hits(origins, ways)
            self.assertEqual(shares.particles.max(), 1.0)  # within balls
            self.assertLess(np.abs(shares.particles - share(balls >= 0)).max(), 2.5 / 16)
            right, above, back = camera.axes()
            covered = np.zeros(balls.shape, bool)
            seen = depths * -(ways @ back)  # along the view
            for begin, end in cell_edges(CELL.origin, CELL.vectors):
                points = begin + np.linspace(0, 1, 1000)[:, None] * (end - begin)
                to = points - np.array(camera.position)
                depth = -(to @ back)
                half = camera.vertical_extent / 2 if camera.vertical_extent else depth * np.tan(camera.vertical_fov / 2)
                scale = 0.5 * SIZE[1] * PER_SIDE / half
                x, y = 0.5 * SIZE[0] * PER_SIDE + scale * (to @ right), 0.5 * SIZE[1] * PER_SIDE - scale * (to @ above)
                for column, row, far in zip(x, y, depth):
                    window = tuple(slice(max(int(place) - 3, 0), int(place) + 4) for place in (row, column))
                    down, across = np.mgrid[window] + 0.5
                    near = np.hypot(across - column, down - row) <= 0.5 * line_width(SIZE) * PER_SIDE
                    covered[window] |= near & (far <= seen[window] * (1 + 1e-5))
            self.assertLess(np.abs(shares.lines - share(covered)).max(), 2.5 / 16)
            hidden = share(covered)[share(balls == 0) == 1]
            self.assertTrue((hidden == 0).any() and share(covered).max() >= 0.25)
            self.assertTrue((shares.outlines == 0).all())

    def test_depths_along_a_line_into_the_distance(self):
        """Against points of the line, which go through the pinhole of a wide view."""
        size, camera = (80, 60), pt.Camera((0, 0, 0), (0, 0, -1), vertical_fov=np.pi / 2)
        begin, end = np.array([-1.0, 0, -1.2]), np.array([3, 1.0, -8])
        rows, columns, depths = _overlay._line_hits(camera, size, [(begin, end)], 2.0)
        points = begin + np.linspace(0, 1, 20_000)[:, None] * (end - begin)
        scale = 0.5 * size[1] * PER_SIDE / -points[:, 2]
        x, y = 0.5 * size[0] * PER_SIDE + scale * points[:, 0], 0.5 * size[1] * PER_SIDE - scale * points[:, 1]
        self.assertGreater(len(rows), 200)
        for row, column, depth in zip(rows + 0.5, columns + 0.5, depths):
            nearest = np.hypot(x - column, y - row).argmin()
            self.assertAlmostEqual(depth / -points[nearest, 2], 1.0, places=2)

    def test_outlines_go_round_the_balls(self):
        """Of a ball before nothing and before others; inside of a ball and away from balls there are none."""
        for projection in ("perspective", "orthographic"):
            size = (160, 120)
            camera, shares = shares_of(projection, True, self.context, size)
            with unittest.mock.patch.object(_overlay, "BAND_ROWS", 1000):  # bands make no seams
                whole = shares_of(projection, True, self.context, size)[1]
            for name in ("particles", "lines", "outlines"):
                np.testing.assert_array_equal(getattr(shares, name), getattr(whole, name))
            _, balls = first_hits(*rays(camera, size))
            edges, rims = np.zeros(balls.shape, bool), np.zeros(balls.shape, bool)
            for axis in (0, 1):
                for step in (1, -1):
                    other = np.roll(balls, step, axis)
                    edges |= (balls >= 0) & (balls != other)
                    rims |= (balls >= 0) & (other < 0)
            outline, near = shares.outlines, share(edges, size) > 0
            reach = 2
            around = np.zeros_like(near)
            for down in range(-reach, reach + 1):
                for across in range(-reach, reach + 1):
                    around |= np.roll(near, (down, across), (0, 1))
            self.assertTrue((outline[~around] == 0).all())
            self.assertGreater((outline[share(rims, size) > 0] > 0).mean(), 0.98)


if __name__ == "__main__":
    unittest.main()
