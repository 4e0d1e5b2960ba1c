import itertools
import unittest
import unittest.mock
from dataclasses import replace

import numpy as np
import pt
from pt.figures import _neighbours
from pt.figures._bonds import bonds_of, whole
from pt.figures._cell import Cell
from pt.figures._drawn import prepare
from pt.figures._options import Options
from pt.figures._overlay import rays_per_side
from pt.figures._particles import Bonds, Particles
from pt.figures._series import frames

ANGLES = np.arange(6)[:, None] * np.pi / 3
RING = np.hstack([np.cos(ANGLES), np.sin(ANGLES), 0 * ANGLES])
BENZENE = Particles(np.vstack([1.397 * RING, (1.397 + 1.084) * RING]), elements=np.repeat(np.uint8([6, 1]), 6))
PAIR = Particles(np.array([[-1.0, 0, 0], [1, 0, 0]]), elements=np.uint8([6, 6]))


def found_in(particles, bonds=True, wall_bonds="halves"):
    return bonds_of(particles, Options(bonds=bonds, wall_bonds=wall_bonds), np.ones(1), [])


def residues(*atoms, **more):
    """Builds particles from rows of residue, residue number, name, atomic number, and place along x."""
    names, numbers, words, elements, places = zip(*atoms)
    positions = np.array([[place, 0, 0] for place in places], float)
    columns = {"resname": np.array(names), "resid": np.array(numbers), "name": np.array(words)}
    return Particles(positions, columns, np.array(elements, np.uint8), **more)


class Automatic(unittest.TestCase):
    def pairs(self, particles, notes=None):
        found = bonds_of(particles, Options(bonds=True), np.ones(1), [] if notes is None else notes)
        half = len(found.atoms) // 2
        return sorted(sorted(pair) for pair in zip(found.atoms[:half].tolist(), found.others[:half].tolist()))

    def test_the_limit_is_the_sum_of_the_radii_and_the_tolerance(self):
        """The radii are 0.76 for C and 0.31 for H (Cordero 2008). The tolerance is 0.45, so C-C bonds end at 2 * 0.76 + 0.45 = 1.97
        angstroms and C-H bonds at 1.52. These are 1.410 and 1.402 times the lengths in benzene."""
        # Atoms closer than 0.4 angstroms are alternative positions of one atom.
        for particles, factor, expected in ((BENZENE, 1.40, 12), (BENZENE, 1.405, 6), (BENZENE, 1.415, 0),
                                            (PAIR, 0.195, 0), (PAIR, 0.205, 1)):
            scaled = Particles(particles.positions * factor, elements=particles.elements)
            self.assertEqual(len(self.pairs(scaled)), expected, factor)

    def test_names_of_atoms_and_residues(self):
        near = residues(("ALA", 1, "N", 7, 0), ("ALA", 1, "CA", 6, 1.45), ("ALA", 1, "O", 8, 2.7), ("ALA", 1, "XYZ", 6, 4.0))
        hydrogens = residues(("SOL", 1, "HW1", 1, 0), ("SOL", 1, "OW", 8, 0.9), ("SOL", 1, "HW2", 1, 1.7), ("SOL", 2, "OW", 8, 2.9),
                             ("SOL", 2, "HW1", 1, 3.85))
        between = residues(("ALA", 1, "CB", 6, 0), ("ALA", 1, "HB1", 1, 1.0), ("ALA", 1, "C", 6, 2.1))
        chain = residues(("GLY", 1, "C", 6, 0), ("GLY", 2, "N", 7, 1.3), ("CYS", 3, "SG", 16, 2.5), ("CYS", 4, "SG", 16, 4.5),
                         ("LIG", 5, "C1", 6, 6.2))
        ions = residues(("K", 1, "K", 19, 0), ("SOL", 2, "OW", 8, 2.7), ("LIG", 3, "C1", 6, -2.8))
        nameless = Particles(near.positions, elements=near.elements)
        for particles, expected in ((near, [[0, 1], [2, 3]]), (nameless, [[0, 1], [1, 2], [2, 3]]), (hydrogens, [[0, 1], [1, 2], [3, 4]]),
                                    (between, [[0, 1]]), (chain, [[0, 1], [2, 3], [3, 4]]), (ions, [])):
            self.assertEqual(self.pairs(particles), expected)

    def test_bonds_of_the_data_come_first(self):
        stretched = residues(("LIG", 1, "C1", 6, 0), ("LIG", 1, "C2", 6, 5), ("LIG", 1, "C3", 6, 6.5), ("LIG", 1, "C4", 6, 8),
                             bonds=Bonds.of([[1, 0], [0, 1], [0, 2]]))
        self.assertEqual(self.pairs(stretched), [[0, 1], [0, 2]])
        notes = []
        stretched.bonds = Bonds.of([[0, 1], [0, 2]], is_complete=False)
        self.assertEqual(self.pairs(stretched, notes), [[0, 1], [0, 2], [2, 3]])
        self.assertEqual(notes, ["bonds: 2 of the data, and 1 by distance"])
        self.assertEqual(self.pairs(stretched.select(np.array([True, False, True, True]))), [[0, 1], [1, 2]])


class Neighbours(unittest.TestCase):
    def test_all_pairs_in_an_oblique_cell(self):
        """Compares with the distances to all periodic images. Cells are thinner than the cutoff, particles lie far
        outside, and one edge may not be periodic."""
        random = np.random.default_rng(7)
        self.enterContext(unittest.mock.patch.object(_neighbours, "COMPARED_AT_ONCE", 999))
        for vectors, periodic, cutoff in (([[4, 0, 0], [1, 5, 0], [-1, 0.5, 6]], True, 1.3),
                                          ([[2, 0, 0], [1.2, 2, 0], [0.3, -0.8, 2]], True, 2.9),
                                          ([[4, 0, 0], [1, 5, 0], [-1, 0.5, 6]], (True, False, True), 1.7)):
            cell = Cell.of(vectors, (0.3, -1, 2), periodic)
            positions = random.uniform(-4, 6, (20, 3))
            found = found_in(Particles(positions, cell=cell), cutoff)
            reaches = [range(-11, 12) if repeats else range(1) for repeats in cell.periodic]
            shifts = np.array(list(itertools.product(*reaches))) @ cell.vectors
            expected = []
            for i, j in itertools.product(range(20), repeat=2):
                ways = positions[j] - positions[i] + shifts
                lengths = np.linalg.norm(ways, axis=1)
                expected += [(i, j, *way) for way in 0.5 * ways[(lengths > 1e-9) & (lengths <= cutoff)]]
            got = np.column_stack([found.atoms, found.others, found.ways])
            ordered = [rows[np.lexsort(rows.round(6).T[::-1])] for rows in (got, np.array(expected))]
            np.testing.assert_allclose(*ordered, atol=1e-9)
            self.assertGreater(len(expected), 20)

    def test_images_that_the_data_give(self):
        cell = Cell.of([10, 10, 10])
        given = Particles(np.array([[0.5, 0, 0], [11, 0, 0]]), elements=np.uint8([6, 6]), cell=cell,
                          bonds=Bonds.of([[0, 1]], np.array([[-2, 0, 0]])))
        for particles in given, given.wrapped():
            np.testing.assert_allclose(found_in(particles).ways[:, 0], [-4.75, 4.75])

    def test_given_pairs_take_the_nearest_image(self):
        particles = Particles(np.array([[0.5, 0, 0], [9.5, 0, 0], [5, 0, 0]]), cell=Cell.of([10, 10, 10]))
        found = found_in(particles, [[0, 1], [0, 2]])
        np.testing.assert_allclose(found.ways[:, 0], (-0.5, 2.25, 0.5, -2.25))
        self.assertEqual(found_in(particles, [[0, 1], [0, 2]], "none").others.tolist(), [2, 0])
        particles.cell = Cell.of([10, 10, 10], periodic=False)
        np.testing.assert_allclose(found_in(particles, [[0, 1]]).ways[:, 0], (4.5, -4.5))

    def test_molecules_are_made_whole(self):
        """Helices of 30 atoms span several cells. Each keeps the place of its first atom."""
        turns = 0.9 * np.arange(30)
        helix = np.stack([np.cos(turns), np.sin(turns), 0.4 * np.arange(30)], axis=1)
        cell, random = Cell.of([[7, 0, 0], [1, 6, 0], [-2, 1, 5]]), np.random.default_rng(2)
        order = random.permutation(60)
        molecules = np.concatenate([helix, helix @ [[0, 0, 1], [1, 0, 0], [0, 1, 0]] + (3.3, 3.3, 3.3)])[order]
        broken = Particles(molecules + random.integers(-2, 3, (60, 3)) @ cell.vectors, elements=np.full(60, 6, np.uint8), cell=cell).wrapped()
        place = np.argsort(order)
        pairs = [[place[i], place[i + 1]] for i in range(59) if i != 29]
        for bonds, rule in ((Bonds.of(pairs), None), (None, pairs)):
            drawn = prepare(replace(broken, bonds=bonds), Options(whole=True, bonds=rule, style="particles"))
            for atoms in (place[:30], place[30:]):
                root = atoms.min()
                np.testing.assert_allclose(drawn.centers[atoms] - broken.positions[root], molecules[atoms] - molecules[root], atol=1e-9)
        self.assertEqual(np.abs(whole(replace(broken, bonds=Bonds.of(pairs, np.zeros((58, 3), int))), Options()).positions - broken.positions).max(), 0)
        with self.assertRaisesRegex(ValueError, "whole: array has no cell"):
            prepare(PAIR, Options(whole=True))


class Looks(unittest.TestCase):
    def test_radii_and_halves(self):
        drawn = prepare(PAIR, Options(bonds=True))
        self.assertEqual(len(drawn.rods[0].atoms), 0)
        self.assertIn("no two particles are near enough", " ".join(drawn.notes))
        near = Particles(PAIR.positions * 0.7, elements=PAIR.elements)
        for options, ball, stick in (({"bonds": True}, 0.38, 0.07 * 1.4), ({"model": "sticks"}, 0.14 * 1.4, 0.14 * 1.4),
                                     ({"model": "ball-and-stick", "radius": 0.3, "bond_radius": 0.2}, 0.3, 0.2),
                                     ({"model": "space-filling", "bonds": 1.5}, 0.76, 0.07 * 1.4)):
            drawn = prepare(near, Options(**options))
            np.testing.assert_allclose((*drawn.radii, drawn.rods[0].radius), (ball, ball, stick), rtol=1e-6)
            np.testing.assert_allclose(drawn.ends(drawn.rods[0]), np.zeros((2, 3)), atol=1e-12)
        self.assertFalse(prepare(near, Options(bonds=False)).rods)
        far = prepare(Particles(near.positions * 1e-12), Options(bonds=2e-12, radius=1e-13))  # other units
        np.testing.assert_allclose(far.ends(far.rods[0]), np.zeros((2, 3)), atol=1e-9)
        np.testing.assert_allclose(far.rods[0].radius / far.scale, 0.07 * 1.4e-12)

    def test_halves_meet_in_the_middle_of_what_is_seen(self):
        radii = np.array([0.5, 0.1])
        walled = Particles(np.array([[0.5, 0, 0], [9.5, 0, 0]]), cell=Cell.of([10, 10, 10]))
        for particles, shown, ways in ((PAIR, radii, (1.2, -0.8)), (walled, 0.5 * radii, (-0.6, 0.4)),
                                       (PAIR, np.array([4.0, 0.1]), (2, 0))):
            np.testing.assert_allclose(prepare(particles, Options(bonds=2.5, radius=shown)).rods[0].ways[:, 0], ways, atol=1e-12)

    def test_bonds_are_between_shown_particles(self):
        rear = Particles(BENZENE.positions[::-1], elements=BENZENE.elements[::-1])
        drawn = prepare(rear, Options(bonds=True, where="element == C"))
        self.assertEqual((len(drawn.rods[0].atoms), drawn.rods[0].atoms.max()), (12, 5))
        np.testing.assert_allclose(np.linalg.norm(drawn.ends(drawn.rods[0]), axis=1), 1.397 * np.sqrt(0.75))
        self.assertEqual(len(prepare(BENZENE, Options(bonds=True, where="element == H")).rods[0].atoms), 0)

    def test_series_have_one_radius(self):
        both = [Particles(BENZENE.positions * factor, elements=BENZENE.elements) for factor in (1, 1.2)]
        first, second = frames(lambda: iter(both), Options(model="ball-and-stick", size=(40, 30)))
        self.assertEqual(first.drawn.rods[0].radius, second.drawn.rods[0].radius)
        np.testing.assert_array_equal(first.drawn.radii, second.drawn.radii)

    def test_halves_have_the_colors_of_their_atoms(self):
        options = {"radius": 0.2, "color": np.uint8([[255, 0, 0], [0, 0, 255]]), "size": (61, 31), "view": "front", "samples": 4}
        with pt.Context() as context:
            bonded = pt.figure(PAIR, bonds=2.5, bond_radius=0.15, context=context, **options).to_srgb8()
            bare = pt.figure(PAIR, context=context, **options).to_srgb8()
            walled = Particles(PAIR.positions, cell=Cell.of([4, 4, 4], (-2, -2, -2)))
            through, without = (pt.figure(walled, bonds=2.5, bond_radius=0.15, box="none", wall_bonds=rule, context=context, **options)
                                for rule in ("halves", "none"))
        left, right = bonded[15, 23].astype(int), bonded[15, 37].astype(int)
        self.assertTrue(left[0] > 2 * left[2] and right[2] > 2 * right[0], (left, right))
        self.assertTrue((bare[15, 20:41] == 255).all())
        self.assertEqual((len(through.scene.sphere_arrays[1]), len(without.scene.sphere_arrays[1])), (4, 2))
        self.assertTrue((through.to_srgb8()[:, [0, -1]] == 255).all())
        self.assertGreater(through.camera.position[1] / without.camera.position[1], 1.3)

    def test_vectors(self):
        """The longest vector is twice the distance of neighbours, sqrt(200). A given scale holds for all. Heads become thinner to the tip."""
        vectors, long = np.array([[0.0, 0, 3], [0, 0, 0], [4, 0, 3]]), 2 * np.sqrt(200)
        particles = Particles(10 * np.eye(3), dict(zip(("vx", "vy", "vz"), vectors.T)))
        for given in ("v", "vx,vy,vz", vectors):
            drawn = prepare(particles, Options(vectors=given, radius=0.5))
            begins, ends, radii = (each.reshape(21, 2, -1) for each in (drawn.begins(drawn.rods[0]), drawn.ends(drawn.rods[0]), drawn.rods[0].radius))
            np.testing.assert_allclose((begins[0], ends[-1]), ([[10, 0, 0], [0, 0, 10]], [[10, 0, 0.6 * long], [0.8 * long, 0, 10 + 0.6 * long]]))
            np.testing.assert_allclose(begins[1:], ends[:-1])
            self.assertTrue((np.diff(radii[1:], axis=0) < 0).all() and (radii[1] > 2 * radii[0]).all())
            np.testing.assert_allclose((radii[0, 1, 0], drawn.settled["vector_scale"]), (0.03 * long, 0.2 * long))
        drawn = prepare(particles, Options(vectors="v", vector_scale=2, where="vx > 0"))
        np.testing.assert_allclose(drawn.ends(drawn.rods[0])[-1], [8, 0, 16])
        self.assertAlmostEqual(float(drawn.radii[0]), np.sqrt(200) / 8)
        grown = [Particles(particles.positions, dict(zip(("v[0]", "v[1]", "v[2]"), k * vectors.T))) for k in (0, 1, 2)]
        staged = list(frames(lambda: iter(grown), Options(vectors="v", radius=0.5, size=(40, 30))))
        lengths = [np.linalg.norm(each.drawn.rods[0].ways, axis=1).reshape(21, -1).sum(axis=0) for each in staged]
        np.testing.assert_allclose(lengths[1], (0.6 * long, long))
        np.testing.assert_allclose(lengths[2], 2 * lengths[1])
        self.assertEqual(len(lengths[0]), 0)
        widths = [each.drawn.rods[0].radius.reshape(21, -1)[0].max() for each in staged[1:]]
        self.assertEqual(widths[0], widths[1])
        bonded = Particles(particles.positions / 10, particles.columns, elements=np.uint8([6, 1, 1]))
        drawn = prepare(bonded, Options(vectors="v", bonds=2.0))
        self.assertGreater(drawn.radii.min(), drawn.settled["bond_radius"])

    def test_opacity(self):
        """Each of two balls, and each half of their bond, transmits 1 - opacity. The tolerance is four standard errors
        of 128 samples in 49 pixels."""
        named = replace(PAIR, columns={"share": np.array([0.25, 0.75])})
        with pt.Context() as context:
            options = {"radius": 1.0, "bonds": 2.5, "size": (61, 31), "view": "front", "background": "transparent",
                       "context": context}
            image = pt.figure(named, opacity="share", **options)
            np.testing.assert_array_equal(image.to_srgb8(), pt.figure(PAIR, opacity=[0.25, 0.75], **options).to_srgb8())
        alpha = image.to_srgb8()[12:19, :, 3] / 255.0
        for columns, expected in ((slice(8, 15), 0.25), (slice(46, 53), 0.75)):
            error = 4 * np.sqrt(expected * (1 - expected) / (128 * 49))
            self.assertAlmostEqual(alpha[:, columns].mean(), expected, delta=error + 0.5 / 255)
        self.assertEqual([array.opacity.tolist() for array in image.scene.sphere_arrays], [[0.25, 0.75]] * 2)
        self.assertEqual(prepare(named, Options(opacity="0.5", where="share > 0.5")).opacities.tolist(), [0.5])

    def test_shares_of_hits(self):
        """Rays are spread evenly. The variance of the fractions is less than a tenth of p (1 - p) / 400, the variance
        with random rays."""
        image = pt.figure(np.zeros((1, 3)), radius=1.0, opacity=0.75, samples=400, size=(32, 32), view="front")
        share = image._shares.shapes[8:24, 8:24]
        self.assertAlmostEqual(share.mean(), 0.75, delta=5 * np.sqrt(0.25 * 0.75 / (400 * 256)))
        self.assertLess(share.var(), 0.1 * 0.25 * 0.75 / 400)
        self.assertEqual([rays_per_side(*each) for each in ((1, 1), (128, 640 * 480), (1e5, 9), (1e5, 3840 * 2160))], [4, 12, 32, 22])

    def test_what_is_refused(self):
        for words, options in (
                ("bonds = 'auto': array has no elements: must be a cutoff or pairs", {"bonds": True}),
                ("bonds = 'x': must be auto, a cutoff > 0, or pairs", {"bonds": "x"}), ("bonds = nan: must be", {"bonds": float("nan")}),
                (r"bonds = of shape \(1, 3\)", {"bonds": [[0, 1, 2]]}), (r"and float64: must be", {"bonds": [[0.0, 1]]}),
                (r"bonds\[1\] = \[1, 7\]: must be two different particles, from 0 to 2", {"bonds": [[0, 1], [1, 7]]}),
                (r"bonds\[0\] = \[1, 1\]", {"bonds": [[1, 1]]}), ("model = 'cartoon': must be auto", {"model": "cartoon"}),
                ("bond_radius = 0: must be > 0", {"bonds": 1, "bond_radius": 0}),
                ("vectors = 'u,w': must be three columns like vx,vy,vz", {"vectors": "u,w"}),
                (r"vectors = float64 of shape .2, 3.: must be numbers of shape .3, 3.", {"vectors": np.zeros((2, 3))}),
                (r"vectors\[1, 2\] = nan: must be finite", {"vectors": [[0, 0, 0], [0, 0, np.nan], [0, 0, 0]]}),
                ("opacity of particle 2 = 1.5: must lie in", {"opacity": [1, 1.5, 0]}),
                (r"opacity has shape .2,. of float64: must be one number or 3", {"opacity": [0.5, 1]}),
                ("vector_scale = 0: must be > 0", {"vector_scale": 0}), ("wall_bonds = 'x': must be halves, none", {"wall_bonds": "x"})):
            with self.subTest(words=words), self.assertRaisesRegex(ValueError, words):
                prepare(Particles(np.eye(3)), Options(**options))
        with self.assertRaisesRegex(ValueError, "the cutoff, or the covalent radii, must be about as large as"):
            found_in(Particles(np.eye(3), cell=Cell.of([1, 1, 1])), 1e3)
        with (unittest.mock.patch.object(_neighbours, "MOST_FOUND", 50),
              self.assertRaisesRegex(ValueError, "more than 5e[+]01 pairs are within about 9")):
            found_in(Particles(np.random.default_rng(0).uniform(size=(11, 3))), 9.0)
