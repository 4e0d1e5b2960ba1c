import gzip
import importlib.util
import pathlib
import struct
import unittest
import unittest.mock
import warnings

import numpy as np
import readers_test
from pt.figures import frames, load
from pt.figures._elements import SYMBOLS
from pt.figures._errors import DataError
from structures_cases import CASES, MMCIF, REFUSED, gro, lammps

DAMAGES = 20
LETTERS = b" \n0123456789.-+eEdX\"'\t\xff\0"

DATA = pathlib.Path(__file__).resolve().parents[2] / "tests/data/structures"


class InAFolder(readers_test.InAFolder):
    def setUp(self):
        super().setUp()
        self.enterContext(warnings.catch_warnings(action="error"))

    def read(self, name, content, **options):
        try:
            return super().read(name, content, **options)
        except DataError as error:
            if "needs the module" in str(error):
                self.skipTest(str(error))
            raise

    def check(self, found, atoms, *, x=None, cell=0, origin=None, periodic=None, bonds=None, radii=None, note=None):
        if isinstance(atoms, str):
            self.assertEqual(" ".join(SYMBOLS[number] for number in found.elements), atoms)
        else:
            self.assertIsNone(found.elements)
            self.assertEqual(found.types.tolist(), atoms)
        if x is not None:
            np.testing.assert_allclose(found.positions[:, 0], x, atol=1e-6)
        if cell is None:
            self.assertIsNone(found.cell)
        elif cell != 0:
            np.testing.assert_allclose(np.linalg.norm(found.cell.vectors, axis=1), cell, atol=1e-4)
        for value, wanted in ((found.cell and found.cell.origin, origin), (found.cell and found.cell.periodic, periodic),
                              (found.radii, radii), (found.bonds and found.bonds.pairs, bonds)):
            if wanted is not None:
                self.assertEqual(value.tolist(), wanted)
        if note is not None:
            self.assertIn(note, " | ".join(found.notes))


class Small(InAFolder):
    def test_atoms_are_what_the_field_takes_them_for(self):
        for name, text, atoms, expected in CASES:
            with self.subTest(name):
                self.check(self.read(name, text), atoms, **expected)
                if name.endswith((".pdb", ".gro", ".cif", ".data", ".sdf", ".mol2")):
                    self.check(self.read(f"{name}.gz", gzip.compress(text.encode())), atoms, **expected)

    def test_what_is_refused(self):
        for name, text, message in REFUSED:
            with self.subTest(message):
                self.assertEqual(self.refusal(name, text)[:len(message)], message)

    def test_chains_of_mmcif_in_parts_and_of_long_names(self):
        for part, chain in ((5000, "Q"), (1, "Q"), (1, "'a long name'")):
            text = MMCIF.replace(" Q ", f" {chain} ")
            with unittest.mock.patch("pt.figures.readers._structures.PART", part):
                found = self.read("a.mmcif", text)
            self.check(found, "C S S", bonds=[[1, 2]])
            self.assertEqual(found.columns["chain"].tolist(), 2 * [chain.strip("'")] + ["R"])
        long = MMCIF.replace("ALA A 1", "ALA ABCDEFGHIJ 1")
        self.check(self.read("a.mmcif", long), "C S S", bonds=[[1, 2]])
        with self.assertRaisesRegex(DataError, "a.mmcif: gemmi cannot read it: .* residue names: ABCDEFGHIJ"):
            self.read("a.mmcif", MMCIF.replace(" ALA ", " ABCDEFGHIJ "))

    def test_options_of_reading(self):
        rows, one = lammps("1 1 2.0 1.0 5 6 7", types=1, more="1 bonds"), "1\n\nO 0 0 0\n"
        self.check(self.read("a.mmcif", MMCIF, model_number=5), "C", x=[1])
        self.check(self.read("a.data", rows, atom_style="sphere"), [1], radii=[1])
        for name, content, options, words in (("a.mmcif", MMCIF, {"model_number": 4}, "model_number = 4: must be one of 3, 5"),
                                              ("a.xyz", one, {"model_number": 1}, "model_number = 1: these data have no models"),
                                              ("a.data", rows, {"atom_style": "round"}, "atom_style = 'round': must be one of"),
                                              ("a.xyz", one, {"topology": "a.pdb"}, "topology = a.pdb: only trajectories"),
                                              ("a.xyz", one, {"atom_style": "full"}, "atom_style = full: only a LAMMPS data file has one")):
            with self.assertRaisesRegex(DataError, words):
                self.read(name, content, **options)


class Large(InAFolder):
    def test_sections_with_comments_blank_lines_and_labels(self):
        count = 40_000
        generator = np.random.default_rng(1)
        numbers, places = generator.permutation(count) + 1, generator.integers(-9999, 9999, (count, 3)) / 1000
        kinds = np.where(numbers % 3 == 1, "OW", "HW")
        rows = [f"{number} 1 {kind} -0.8 {x} {y} {z} # {kind} water" + ("\n" if number % 1000 == 0 else "")
                for number, kind, (x, y, z) in zip(numbers, kinds, places)]
        masses = "\nAtom Type Labels\n\n1 OW\n2 HW\n\nMasses\n\nOW 15.9994\nHW 1.008\n"
        text = lammps(*rows, more="1 bonds", masses=masses, hint=" # full")
        found = self.read("a.data", f"{text}\nVelocities\n\n1 0 0 0\n\nBonds\n\n1 1 {count} 7\n")
        np.testing.assert_array_equal(found.positions, places)
        np.testing.assert_array_equal(found.elements, np.where(kinds == "OW", 8, 1))
        self.assertEqual(found.columns["id"].tolist(), numbers.tolist())
        self.assertEqual(sorted(numbers[found.bonds.pairs[0]]), [7, count])


class Damaged(InAFolder):
    """A damaged file must be read, or be refused with a message that names the file."""

    def test_damages(self):
        generator = np.random.default_rng(1)
        refused = 0
        paths = sorted([*DATA.iterdir(), *readers_test.DATA.glob("*.*")])
        files = [(name, text.encode()) for name, text, *_ in CASES] + [(path.name, path.read_bytes()) for path in paths]
        for name, data in files:
            for _ in range(DAMAGES):
                kind, start, size = generator.integers(0, (4, len(data), 9))
                rows = data.split(b"\n")
                row = int(generator.integers(0, len(rows)))
                damaged = (data[:start], data[:start] + data[start + size:],
                           data[:start] + bytes(generator.choice(np.frombuffer(LETTERS, np.uint8), size)) + data[start + size:],
                           b"\n".join([*rows[:row], *rows[row + 1:]]))[kind]
                with self.subTest(name, kind=kind, start=start):
                    try:
                        found = self.read(name, damaged)
                        self.assertTrue(np.isfinite(found.positions).all())
                    except DataError as error:
                        refused += 1
                        self.assertTrue(str(error).startswith(f"{self.folder}/{name}"), error)
        self.assertGreater(refused, DAMAGES * len(files) // 4)


class Binary(InAFolder):
    @unittest.skipUnless(importlib.util.find_spec("gsd"), "gsd is not installed")
    def test_gsd_is_centred(self):
        from gsd import hoomd
        frame = getattr(hoomd, "Frame", getattr(hoomd, "Snapshot", None))()
        frame.particles.N, frame.particles.position = 2, [[-1, 0, 0], [1, 0, 0]]
        frame.particles.types, frame.particles.typeid = ["A", "B"], [0, 1]
        frame.bonds.N, frame.bonds.group = 1, [[0, 1]]
        frame.configuration.box = [4, 6, 8, 0.5, 0, 0]
        path = self.folder / "a.gsd"
        with hoomd.open(str(path), "w" if hasattr(hoomd, "Frame") else "wb") as file:
            file.append(frame)
        found = load(path)
        self.check(found, ["A", "B"], x=[-1, 1], cell=[4, 45**0.5, 8], origin=[-3.5, -3, -4], bonds=[[0, 1]])
        self.assertIsNone(found.radii)  # The file omits HOOMD's default diameter.

    @unittest.skipUnless(importlib.util.find_spec("chemfiles"), "chemfiles is not installed")
    def test_trajectories_take_their_atoms_from_the_topology(self):
        import chemfiles
        path, topology = self.folder / "a.xtc", self.folder / "a.gro"
        with chemfiles.Trajectory(str(path), "w") as file:
            for step in range(3):
                frame = chemfiles.Frame()
                frame.cell = chemfiles.UnitCell([20, 20, 20])
                for i in range(4):
                    frame.add_atom(chemfiles.Atom("X"), (i + 0.5 * step, 0, 0))
                file.write(frame)
        topology.write_text(gro(("SOL", "OW", 0), ("SOL", "HW1", 0.1), ("SOL", "MW", 0.2), ("NA", "NA", 0.3)))
        found = load(path, topology=str(topology))
        np.testing.assert_allclose(found.positions[:, 0], [1, 2, 4], atol=0.01)  # XTC rounds to 0.01 angstroms
        self.check(found, "O H Na", cell=[20, 20, 20])
        psf = self.folder / "a.psf"
        psf.write_text("PSF\n\n       1 !NTITLE\n made up\n\n       4 !NATOM\n" + "".join(
            f"{i:8} A    1    SOL  {name:<4} T {0:10.6f} {mass:13.4f} 0\n" for i, (name, mass) in enumerate(
                (("OW", 15.999), ("HW1", 1.008), ("MW", 0), ("NA", 22.99)), 1)) + "\n       1 !NBOND: bonds\n       1       2\n")
        found = load(path, topology=str(psf), frame=0)
        np.testing.assert_allclose(found.positions[:, 0], [0, 1, 3], atol=0.01)
        self.check(found, "O H Na", bonds=[[0, 1]])
        topology.write_text(gro(("SOL", "OW", 0)))
        with self.assertRaisesRegex(DataError, "has 4 atoms, and the topology 1: they must be of one system"):
            load(path, topology=str(topology))


    def test_dcd_without_a_cell(self):
        def record(data):
            return struct.pack("<i", len(data)) + data + struct.pack("<i", len(data))
        path, topology = self.folder / "a.dcd", self.folder / "a.gro"
        topology.write_text(gro(("SOL", "OW", 0), ("SOL", "HW1", 0.1), ("SOL", "HW2", 0.2)))
        places = np.arange(18, dtype="<f4").reshape(2, 3, 3)  # frames, axes, atoms
        control = struct.pack("<20i", 2, 0, 1, *7 * [0], 1, *8 * [0], 24)
        steps = b"".join(record(struct.pack("<6d", 0, 1, 0, 1, 1, 0)) + b"".join(record(row.tobytes()) for row in frame) for frame in places)
        path.write_bytes(record(b"CORD" + control) + record(struct.pack("<i", 1) + bytes(80)) + record(struct.pack("<i", 3)) + steps)
        for frame in (0, 1):
            found = load(path, topology=str(topology), frame=frame)
            np.testing.assert_array_equal(found.positions, places[frame].T)
            self.assertIsNone(found.cell)
        self.assertEqual(len(list(frames(path, topology=str(topology)))), 2)


class Reported(InAFolder):
    def test_files_of_reports(self):
        for name, atoms, expected in (
                ("03-unsorted-and-empty-frames.dump", [2, 1, 2, 1], {"note": "have no particles are not counted (1)"}),
                ("04-extxyz-odd-header.xyz", "Si Si O H", {"periodic": [True, True, False], "cell": [4, 4, 20]}),
                ("05-plain-xyz-trailer.xyz", "O H H", {"note": "from line 6 on"}),
                ("06-xyz-mathematica-exponent.xyz", "C H H H H", {"x": [-0.0126981359, 0.002150416, 1.0117308433, -0.540815069, -0.5238136345]}),
                ("08-altloc-icode-models.pdb", "N C H C O Ca Cl H",
                 {"x": [0, 1.46, 2, 2, 1.25, 6, 9, 6], "note": "1 atoms are not drawn: their alternative"}),
                ("09-touching-columns.gro", "H O Na Cl Ca", {"x": [90.98, 90, -1001.23, 20, 25], "cell": [100, 94.8683, 84.4097]}),
                ("10-six-decimals.gro", "C O", {"x": [1.23456, 2.43456]}),
                ("13-shared-sites.cif", "La La O O O O O O O O O O",
                 {"cell": [3.9, 3.9, 12.5], "note": "share a place with another one of no lower occupancy are not drawn: Sr1"}),
                ("14-bonds-no-style.data", "C H C C H H", {"bonds": [[0, 1], [1, 2], [3, 4], [3, 5]]}),
                ("20-ellipsoids-2d.dump", [1, 1, 2, 2], {"radii": [5 / 6, 5 / 6, 0.75, 0.75], "origin": [0, 0, -0.5]}),
                ("23-far-outside-cell.xyz", "Ar Ar Ar Ar Ar Ar Ar Ar", {"cell": [14.3, 14.3, 5]}),
                ("24-left-handed-cell.xyz", "Na Cl", {"cell": [4, 4, 0], "periodic": [True, True, False]}),
                ("30-bonds-in-file.sdf", "C S S C", {"bonds": [[0, 1], [1, 2], [2, 3]]}),
                ("31-one-ion-far-away.xyz", "O H H O H Na", {"x": [0, 0.96, -0.24, 3, 3.96, 1000]})):
            with self.subTest(name):
                self.check(self.read(name, (DATA / name).read_bytes()), atoms, **expected)
        self.check(self.read("a.xyz", (DATA / "24-left-handed-cell.xyz").read_bytes(), frame=0), "Na Cl Na", cell=[4, 4, 4])
        found = self.read("a.ply", (DATA / "15-double-list-crlf.ply").read_bytes())
        self.assertIsNone(found.colors)
        self.assertIn("colors need red, green, blue: one of them is missing", found.notes)
        self.assertEqual(self.read("a.csv", (DATA / "27-astronomy.csv").read_bytes()).types.tolist(),
                         ["Sun", "Earth, with Moon", "Moon", "Jupiter"])
