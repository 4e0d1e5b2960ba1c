import itertools
import math
import re
import unittest

import numpy as np
import pt
from pt.figures._cell import Cell
from pt.figures._drawn import prepare
from pt.figures._figure import Staged
from pt.figures._options import Options
from pt.figures._overlay import pixels_per_length
from pt.figures._particles import Particles
from pt.figures._radii import COVER, THIN, radii_of
from pt.figures._rods import cell_edges
from pt.figures._series import frames
from pt.figures._spread import reaches_of, usual_reach

RANDOM = np.random.default_rng(8)
CUBE = RANDOM.uniform(-1, 1, (2000, 3))
WATERS = np.array([[0.0, 0, 0], [0.96, 0, 0], [-0.24, 0.93, 0], [3, 0, 0], [3.96, 0, 0]])
TEN = Cell.of([10, 10, 10], periodic=(True, True, False))


def drawn_of(positions, cell=None, **options):
    return prepare(Particles(np.asarray(positions, float), cell=cell), Options(**{"radius": 0.1, **options}))


class FarAway(unittest.TestCase):
    def test_one_ion_far_away_does_not_decide_the_picture(self):
        elements = np.array([8, 1, 1, 8, 1, 11], np.uint8)
        whole = Particles(np.vstack([WATERS, [1000, 0, 0]]), elements=elements)
        staged, near = (Staged.of(each, Options(style="matte")) for each in (whole, Particles(WATERS, elements=elements[:5])))
        self.assertEqual((staged.layout.camera, len(staged.drawn.centers)), (near.layout.camera, 5))
        # The median of x is (0.96 + 3) / 2 = 1.98. An oxygen of radius 0.66 reaches 2.64 from it, and the ion of radius 1.66 reaches
        # 999.68.
        self.assertEqual(staged.notes, [f"1 of 6 balls is not drawn, up to {999.68 / 2.64:.3g} times as far away as the others: "
                                        "--frame-all (frame_all=True) draws all"])
        for options in ({"frame_all": True}, {"camera": pt.Camera((0, 0, 9), (0, 0, 0))}):
            self.assertEqual(len(Staged.of(whole, Options(**options)).drawn.centers), 6)

    def test_up_to_a_two_hundredth_is_left_out_and_no_corner_of_the_rest(self):
        """A ball as large as all others together stays."""
        far, few = RANDOM.uniform(50, 90, (11, 3)), np.vstack([CUBE[:3], [[900, 0, 0]]])
        gaussian = RANDOM.normal(size=(5000, 3))
        disc = RANDOM.exponential(size=(5000, 1)) * gaussian / np.linalg.norm(gaussian, axis=1)[:, None]
        one, near = (np.vstack([CUBE, [[place, 0, 0]]]) for place in (60, 3.8))
        small, large = (np.append(np.full(2000, 0.1), radius) for radius in (0.5, 50))
        for positions, radius, count in ((np.vstack([far[:10], CUBE]), 0.1, 2000), (np.vstack([far, CUBE]), 0.1, 2011),
                                         (few, 0.1, 4), (np.vstack([CUBE[:1], few]), 0.1, 4), (one, small, 2000), (one, large, 2001),
                                         (gaussian, 0.1, 5000), (disc, 0.1, 5000), (near, 0.1, 2001), (CUBE[:1], 0.1, 1)):
            drawn = drawn_of(positions, radius=radius)
            self.assertEqual((len(drawn.centers), len(drawn.notes)), (count, int(count < len(positions))))

    def test_only_particles_that_are_shown_count(self):
        particles = Particles(np.vstack([CUBE, CUBE + 1000]), {"kind": np.repeat([0, 1], 2000)})
        drawn = prepare(particles, Options(radius=0.1, where="kind == 1"))
        self.assertEqual((len(drawn.centers), drawn.notes), (2000, []))
        particles.positions[2000] = -5000
        drawn = prepare(particles, Options(radius=0.1, where="kind == 1"))
        np.testing.assert_array_equal(drawn.centers, CUBE[1:] + 1000)
        self.assertIn("1 of 2,000 balls is not drawn", drawn.notes[0])


class Cells(unittest.TestCase):
    def test_edges_of_cells_of_all_kinds(self):
        origin, rows = np.array([-3.0, 1, 2]), np.array([[4.0, 0, 0], [1, 5, 0], [0, 1, 6]])
        for kept in ((0, 1, 2), (0, 2), (2,)):
            vectors = np.zeros((3, 3))
            vectors[:len(kept)] = rows[list(kept)]
            cell = Cell(origin, vectors, vectors.any(axis=1))
            begins, ends = cell_edges(cell)
            self.assertEqual(len(begins), len(kept) * 2 ** (len(kept) - 1))
            for edge in kept:
                self.assertEqual(int((np.abs(ends - begins - rows[edge]) < 1e-12).all(axis=1).sum()), 2 ** (len(kept) - 1))

    def test_which_cells_are_drawn(self):
        crystal = Cell(TEN.origin, TEN.vectors, TEN.periodic, is_crystal_of_macromolecule=True)
        for cell, box, is_drawn in ((TEN, "auto", True), (TEN, "lines", True), (TEN, "none", False), (None, "lines", False),
                                    (crystal, "auto", False), (crystal, "lines", True)):
            self.assertEqual(drawn_of(CUBE + 5, cell, box=box).cell is not None, is_drawn, (cell, box))

    def test_particles_outside_are_counted_along_periodic_edges(self):
        drifted, strays, near = CUBE[80:100] + 5, CUBE[80:88] + (15, 5, 5), CUBE[:20] * 0.01
        for outside, told in ((drifted + (10, 0, 0), 1), (drifted - (0, 10, 0), 1), (drifted + (0, 0, 10), 0), (drifted + (0.5, 0.5, 0), 0),
                              (strays, 0), (near + (5, 10.05, 5), 0), (near + (5, 10.15, 5), 1)):
            notes = drawn_of(np.vstack([CUBE[:80] + 5, outside]), TEN).notes
            self.assertEqual(notes, ["20 of 100 particles are outside of their periodic cell: --wrap (wrap=True) brings them back"] * told)
        self.assertEqual(drawn_of(CUBE + 15, TEN, box="none").notes, [])
        self.assertEqual(drawn_of(CUBE * 2 + 15, TEN, wrap=True).notes, [])

    def test_a_cell_far_from_its_particles_or_much_larger_is_not_drawn(self):
        chain = np.arange(8.0)[:, None] * (3, 2, 0) + (872, -495, 2.5)
        half, most = (np.vstack([CUBE[:count] * 2 + (15, 5, 5), CUBE[count:100] * 2 + 5]) for count in (50, 51))
        for positions, radius, is_drawn, notes in ((chain, 0.1, False, 2), (half, 0.1, True, 1), (most, 0.1, False, 2),
                                                   ([[5, 5, 5]], 0.52, True, 0), ([[5, 5, 5]], 0.48, False, 1)):
            drawn = drawn_of(positions, TEN, radius=radius)
            self.assertEqual((drawn.cell is not None, len(drawn.notes)), (is_drawn, notes))
            self.assertIsNotNone(drawn_of(positions, TEN, radius=radius, box="lines").cell)


class Blank(unittest.TestCase):
    def staged(self, radius):
        return Staged.of(Particles(CUBE[:100] * 50), Options(radius=radius, size=(400, 300), frame_all=True))

    def test_balls_narrower_than_a_pixel_are_told(self):
        radii = np.where(np.arange(100) < 7, 5, 0.01)
        for projection, factor in itertools.product(("perspective", "orthographic"), (1.0, 2.0**100)):
            staged = Staged.of(Particles(CUBE[:100] * 50 * factor), Options(radius=radii * factor, size=(400, 300), projection=projection))
            pixels = pixels_per_length(staged.layout.camera, 300, staged.layout.distance) * staged.drawn.scale
            pattern = r"narrower than a pixel: 93 of 100 balls. --radius (\S+) \(radius=\1\) makes balls 8 pixels wide"
            note = re.fullmatch(pattern, staged.notes[0])
            self.assertLess(abs(2 * float(note[1]) * pixels / 8 - 1), 0.05)  # The note rounds the number.
        pixels = pixels_per_length(self.staged(0.01).layout.camera, 300, self.staged(0.01).layout.distance)
        for width, told in ((0.95, 1), (1.05, 0)):
            self.assertEqual([note[23:33] for note in self.staged(0.5 * width / pixels).notes], ["100 of 100"] * told)

    def test_many_that_cover_the_picture_are_not(self):
        places = RANDOM.uniform(0, 1, (60_000, 3)) * (1, 1, 0)
        staged = Staged.of(Particles(places), Options(radius=0.001, size=(400, 400)))
        self.assertLess(0.002 * pixels_per_length(staged.layout.camera, 400, staged.layout.distance), 1)
        self.assertEqual(staged.notes, [])

    def test_a_camera_that_sees_nothing(self):
        camera = pt.Camera(position=(0, 0, 9), target=(0, 0, 19))
        away, toward = (pt.figure(CUBE, radius=0.1, size=(8, 6), samples=1, camera=each)
                        for each in (camera, pt.Camera((0, 0, 9), (0, 0, 0))))
        self.assertEqual((away.notes, toward.notes), (["the picture is blank: no ball is in view"], []))


class Radii(unittest.TestCase):
    def automatic(self, positions):
        notes = []
        return float(radii_of(Particles(positions), None, notes)[0]), notes

    def test_pairs_far_apart_and_lines_are_seen(self):
        pairs = np.vstack([CUBE[:200], CUBE[:200] + 1e-5])
        line = np.linspace(-1, 1, 20_000)[:, None] * (1, 0.5, 0)
        for positions, share in ((pairs, math.sqrt(COVER / (math.pi * 400))), (line, THIN)):
            radius, notes = self.automatic(positions)
            span = 2 * usual_reach(reaches_of(positions, np.zeros(1)))
            self.assertAlmostEqual(radius / span, share)
            self.assertRegex(notes[0], "^the radius is .* would hardly be seen$")
        self.assertEqual(self.automatic(CUBE)[1], [])

    def test_atoms_that_are_not_bonded_are_larger(self):
        """The covalent radius of the element is 1.06 angstroms. The atoms are on a lattice."""
        for apart, radius in ((2.5, 1.06), (2.6, 1.3), (3.8, 1.9), (20, 3.18)):
            particles = Particles(np.stack(np.meshgrid(*3 * [np.arange(4.0)]), -1).reshape(-1, 3) * apart,
                                  elements=np.full(64, 18, np.uint8))
            drawn = prepare(particles, Options())
            np.testing.assert_allclose(drawn.radii, radius, rtol=1e-6)
            self.assertEqual(len(drawn.notes), int(radius != 1.06))
            for model, share in (("auto", 1.0), ("ball-and-stick", 0.5)):
                options = Options(style="particles", model=model, bonds=None if model == "auto" else apart * 1.01)
                staged = list(frames(lambda: iter([particles, particles]), options))
                np.testing.assert_allclose(staged[1].drawn.radii, share * radius, rtol=1e-6)

    def test_few_atoms_far_apart_cover_a_hundredth_of_the_picture(self):
        positions = np.array([[0.0, 0, 0], [4, 0, 0], [100, 0, 0], [104, 0, 0]])  # Balls of radius 2 would touch.
        radii = prepare(Particles(positions, elements=np.full(4, 18, np.uint8)), Options()).radii
        span = 2 * usual_reach(reaches_of(positions, np.zeros(1)))
        self.assertAlmostEqual(4 * np.pi * float(radii.max())**2 / span**2, 0.01)

    def test_one_far_away_is_not_the_fourth_neighbour_of_all_others(self):
        for count in (5, 8, 11):
            cloud = CUBE[:count].copy()
            cloud[1] = cloud[0] + 0.01  # The fourth neighbor decides, because the nearest may be close by chance.
            cloud[-1] = 1000
            self.assertLess(self.automatic(cloud)[0], 2)
