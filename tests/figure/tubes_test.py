import unittest

import numpy as np
from pt.figures._elements import VAN_DER_WAALS_RADII
from pt.figures._drawn import prepare
from pt.figures._options import Options
from pt.figures._particles import Particles
from pt.figures._radii import radii_of
from pt.figures._styles import styled
from pt.figures._tubes import PIECES, WIDTH, trace_of, tubes_of

TURNS = np.radians(100.0) * np.arange(12)
HELIX = np.stack([2.3 * np.cos(TURNS), 2.3 * np.sin(TURNS), 1.5 * np.arange(12)], axis=1)  # Pauling's alpha helix


def chain(positions, letter="A", names="CA", residues="ALA"):
    count = len(positions)
    return {"positions": positions, "name": np.array([names] * count), "resname": np.array([residues] * count),
            "chain": np.array([letter] * count)}


def particles_of(*parts, elements=6):
    columns = {key: np.concatenate([part[key] for part in parts]) for key in parts[0]}
    positions = columns.pop("positions")
    return Particles(positions, columns, elements=np.full(len(positions), elements, np.uint8))


class Tubes(unittest.TestCase):
    def test_the_tube_goes_through_the_atoms_in_one_piece(self):
        particles = particles_of(chain(HELIX))
        rods = tubes_of(particles, trace_of(particles), None)
        begins = HELIX[rods.atoms] + rods.starts
        ends = begins + rods.ways
        self.assertEqual(len(begins), 11 * PIECES)
        np.testing.assert_allclose(begins[1:], ends[:-1], atol=1e-12)
        np.testing.assert_allclose(np.vstack([begins[::PIECES], ends[-1:]]), HELIX, atol=1e-12)
        self.assertAlmostEqual(rods.radius, WIDTH * np.linalg.norm(HELIX[1] - HELIX[0]))
        near = np.linalg.norm(0.5 * (begins + ends) - HELIX[rods.atoms], axis=1)
        far = np.linalg.norm(0.5 * (begins + ends)[:, None] - HELIX, axis=2).min(axis=1)
        np.testing.assert_allclose(near, far, atol=1e-9)
        a, b, c, d = HELIX[3:7]  # Halfway between two atoms, Catmull and Rom's curve is (9 (b + c) - (a + d)) / 16.
        np.testing.assert_allclose(begins[4 * PIECES + PIECES // 2], (9 * (b + c) - (a + d)) / 16, atol=1e-12)

    def test_chains_gaps_and_bases_interrupt_it(self):
        for parts, pieces in (((chain(HELIX[:6]), chain(HELIX[6:], "B")), 10), ((chain(HELIX[:6]), chain(HELIX[6:] + (0, 0, 9))), 10),
                              ((chain(HELIX[:6]), chain(2 * HELIX[6:], "A", "P", "DA")), 10), ((chain(HELIX[:1]),), 0)):
            particles = particles_of(*parts, elements=0)
            self.assertEqual(len(tubes_of(particles, trace_of(particles), 0.5).atoms), pieces * PIECES)

    def test_a_calcium_ion_is_no_alpha_carbon(self):
        self.assertFalse(trace_of(particles_of(chain(HELIX, residues="CA"))).any())
        self.assertFalse(trace_of(particles_of(chain(HELIX), elements=20)).any())


class Models(unittest.TestCase):
    def test_other_residues_are_balls_and_sticks(self):
        ligand = chain(np.array([[9.0, 0, 0], [10.4, 0, 0]]), "A", "C1", "XK2")
        side = chain(HELIX + 0.5, "A", "CB")
        particles = particles_of(chain(HELIX), side, ligand)
        drawn = prepare(particles, Options(model="tube"))
        bonds, tube = drawn.rods
        self.assertEqual((len(drawn.centers), len(bonds.atoms), len(tube.atoms)), (14, 2, 11 * PIECES))
        np.testing.assert_allclose(drawn.radii[:12], tube.radius)
        for shown in (drawn, prepare(particles, Options(model="tube", where="index 3-8"))):
            np.testing.assert_allclose(shown.begins(shown.rods[1])[1:], shown.ends(shown.rods[1])[:-1], atol=1e-9)
        with self.assertRaisesRegex(ValueError, "model = 'tube': array has no atoms CA"):
            prepare(particles_of(side), Options(model="tube"))
        picked = prepare(particles, Options(model="space-filling,within 1 of index 0-5=tube"))
        self.assertEqual(len(picked.rods[-1].atoms), 5 * PIECES)

    def test_alpha_carbons_alone_have_a_tube_by_default(self):
        particles = particles_of(chain(np.vstack([HELIX, HELIX + (0, 0, 18)])))
        drawn = prepare(particles, styled(particles, Options(), []))
        self.assertEqual((len(drawn.rods), drawn.notes), (1, []))
        particles.columns["resid"] = np.arange(24)
        options = styled(particles, Options(), [])
        self.assertEqual((options.model, options.style, options.color), ("tube", "matte", "resid"))

    def test_the_solvent_accessible_surface(self):
        radii = radii_of(particles_of(chain(HELIX)), "solvent-accessible", [])
        np.testing.assert_allclose(radii, VAN_DER_WAALS_RADII[6] + 1.4, rtol=1e-6)
