import re
import unittest

import numpy as np
from pt.figures._bonds import models_of
from pt.figures._cell import Cell
from pt.figures._colors import colors_of
from pt.figures._drawn import prepare
from pt.figures._options import Options
from pt.figures._particles import Particles
from pt.figures._radii import opacities_of, radii_of
from pt.figures._select import chosen

RANDOM = np.random.default_rng(4)
COUNT = 300
POSITIONS = RANDOM.uniform(0, 20, (COUNT, 3))
RESIDUES, CHAINS = RANDOM.choice(["ALA", "HOH", "XK2"], COUNT), RANDOM.choice(["A", "B"], COUNT)
NUMBERS, ELEMENTS = RANDOM.integers(1, 40, COUNT), RANDOM.choice([1, 6, 8], COUNT).astype(np.uint8)


def particles(cell=None):
    x, y, z = POSITIONS.T
    return Particles(POSITIONS, {"x": x, "y": y, "z": z, "resname": RESIDUES, "chain": CHAINS, "resid": NUMBERS, "kind of": NUMBERS},
                     elements=ELEMENTS, name="data", cell=cell)


def apart(cell=None):
    ways = POSITIONS[:, None] - POSITIONS
    if cell:
        ways -= 20 * np.rint(ways / 20)
    return np.linalg.norm(ways, axis=2)


class Language(unittest.TestCase):
    def test_it_selects_what_python_selects(self):
        a, z = CHAINS == "A", POSITIONS[:, 2]
        near = (apart()[:, a & (z > 15)] <= 3).any(axis=1)
        for text, expected in (
                ("resname XK2", RESIDUES == "XK2"), ("resn XK2 HOH and chain A", (RESIDUES != "ALA") & a),
                ("chain B or chain A and z<5", ~a | (a & (z < 5))), ("(chain B or chain A) and z < 5", z < 5),
                ("not (resname HOH or element H C)", (RESIDUES != "HOH") & (ELEMENTS == 8)), ("not not water", RESIDUES == "HOH"),
                ("within 3 of (chain A and z > 15)", near), ("within 3 of chain A and z > 15", (apart()[:, a] <= 3).any(axis=1) & (z > 15)),
                ("resid 3-7, 12", ((NUMBERS >= 3) & (NUMBERS <= 7)) | (NUMBERS == 12)), ("resid 4:6", abs(NUMBERS - 5) <= 1),
                ("element != H", ELEMENTS != 1), ("kind of >= 30", NUMBERS >= 30), ('"kind of" 3', NUMBERS == 3),
                ("index 0 5", np.isin(np.arange(COUNT), (0, 5))), ("all", a | ~a), ("protein", RESIDUES == "ALA"),
                ('resname "or"', a & ~a)):
            with self.subTest(text=text):
                np.testing.assert_array_equal(chosen(particles(), text), expected)
        cell = Cell.of((20, 20, 20))
        np.testing.assert_array_equal(chosen(particles(cell), "within 3 of chain A and z > 15"),
                                      (apart(cell)[:, a] <= 3).any(axis=1) & (z > 15))

    def test_errors_name_the_word_and_its_position(self):
        for text, place, word, rule in (
                ("chain A andd z < 5", 9, "andd", "is no chain; must be and, or, or the end"), ("chain A z < 5", 11, "<", "must be and"),
                ("within x of all", 8, "x", "must be a distance > 0"), ("within 5 chain A", 10, "chain", "must be of"),
                ("(chain A", 9, "the end", "must be and, or, or ."), ("chain A)", 8, ")", "must be and, or, or the end"),
                ("z < a", 5, "a", "must be a number, because z has numbers"), ("chain < B", 7, "<", "must be == or !="),
                ("cchain A", 1, "cchain", "there is no column 'cchain': the columns are x"), ("chain", 6, "the end", "must be a value of"),
                ("not", 4, "the end", "must be a column"), ("z = 5", 3, "=", "== compares"), ("resid A", 7, "A", "must be a number"),
                ("z <", 4, "the end", "must be a number or a word")):
            with self.subTest(text=text), self.assertRaisesRegex(ValueError, f"^where = '.*': position {place}, '{re.escape(word)}'") as raised:
                chosen(particles(), text)
            self.assertRegex(str(raised.exception), rule)


class Uses(unittest.TestCase):
    def test_colors_radii_opacities_and_models(self):
        ligand, data = RESIDUES == "XK2", particles()
        for color in ("resname XK2=#010203,chain A and not resname XK2=#040506", {"resname XK2": "#010203", "chain A and not "
                                                                                 "resname XK2": "#040506"}):
            colors, legend = colors_of(data, Options(color=color), [])
            np.testing.assert_array_equal((colors == (1, 2, 3)).all(axis=1), ligand)
            np.testing.assert_array_equal((colors == (4, 5, 6)).all(axis=1), (CHAINS == "A") & ~ligand)
            self.assertEqual(legend.names[-2:], ("resname XK2", "chain A and not resname XK2"))
        self.assertEqual(colors_of(data, Options(color="O=#070809,water=#010101"), [])[1].names[-1], "water")
        self.assertEqual(colors_of(data, Options(color="resid,chain A=#010101", categories=False), [])[1].title, "resid")
        radii = radii_of(data, "2,resname XK2=0.5", [])
        np.testing.assert_array_equal(radii, np.where(ligand, 0.5, 2))
        np.testing.assert_allclose(radii_of(data, {"element O": 3}, [])[ELEMENTS == 8], 3)
        np.testing.assert_array_equal(opacities_of(data, "0.9,resname XK2=0.25"), np.where(ligand, 0.25, 0.9))
        np.testing.assert_array_equal(opacities_of(data, {"chain A": 0.25}), np.where(CHAINS == "A", 0.25, 1))
        models = models_of(data, Options(model="space-filling,resname XK2=sticks"))
        np.testing.assert_array_equal(models == "sticks", ligand)

    def test_sticks_are_between_particles_of_models_with_sticks(self):
        ligand = RESIDUES == "XK2"
        drawn = prepare(particles(), Options(radius=0.5, bonds=3.0, bond_radius=0.1, model="space-filling,resname XK2=sticks"))
        np.testing.assert_array_equal(drawn.radii, np.where(ligand, 0.1, 0.5))
        rods, = drawn.rods
        expected = np.triu(apart() <= 3, 1)[np.ix_(ligand, ligand)].sum()
        self.assertEqual((len(rods.atoms), ligand[rods.atoms].all()), (2 * expected, True))

    def test_what_is_refused(self):
        for words, options in (("color = 'chain A xor B': position 9, 'xor'", {"color": "chain A xor B=red"}),
                               ("model = 'stick': must be auto, space-filling", {"model": "space-filling,chain A=stick"}),
                               ("opacity: 'A' must be a selection", {"opacity": "A=0.5"}),
                               ("radius = 'chain A=x': must be like", {"radius": "chain A=x"})):
            with self.subTest(words=words), self.assertRaisesRegex(ValueError, words):
                prepare(particles(), Options(**options))
