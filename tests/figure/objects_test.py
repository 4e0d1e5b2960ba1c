"""Packages that are not installed are replaced by objects with the attributes that pt reads."""

import gzip
import io
import sys
import types
import unittest
import unittest.mock

import numpy as np
import readers_test
from pt.figures import load
from pt.figures._errors import DataError

PLACES = np.array([[2.0, 1, 2], [3, 4, 5], [6, 7, 6]])
EDGES = np.array([[9.0, 0, 0], [1, 8, 0], [2, 3, 7]])


def stand_in(name, **attributes):
    kind = type(name.rpartition(".")[2], (types.SimpleNamespace,), {"__module__": name.rpartition(".")[0]})
    return kind(**attributes)


def installed(name):
    try:
        return __import__(name)
    except ImportError:
        return None


installed("gemmi")  # gemmi fails if it is imported twice


def ase_atoms(places):
    return stand_in("ase.atoms.Atoms", positions=places, arrays={"positions": places, "numbers": np.array([8, 1, 1])},
                    cell=types.SimpleNamespace(array=EDGES), pbc=np.array([True, False, True]))


class Steps(list):
    frame = 0

    def __getitem__(self, index):
        self.atoms.positions = list.__getitem__(self, index)
        return types.SimpleNamespace(dimensions=np.array([9, 8, 7, 90, 90, 90]), triclinic_dimensions=EDGES)


def universe():
    steps = Steps([PLACES, PLACES + 1])
    steps.atoms = stand_in("MDAnalysis.core.groups.AtomGroup", elements=np.array(["O", "H", "H"], object),
                           names=np.array(["OW", "HW1", "HW2"], object))
    return stand_in("MDAnalysis.core.universe.Universe", atoms=steps.atoms, trajectory=steps,
                    universe=types.SimpleNamespace(trajectory=steps))


class Property(np.ndarray):
    """An array with OVITO's particle types."""


def ovito_data(name):
    cell = np.column_stack([EDGES.T, (1, 2, 3)])
    matrix = type("Cell", (), {"__getitem__": lambda self, key: cell, "pbc": (True, False, True)})()
    columns = {"Position": PLACES, "Particle Type": np.array([1, 2, 2]).view(Property)}
    columns["Particle Type"].types = [types.SimpleNamespace(id=1, name=name), types.SimpleNamespace(id=2, name="")]
    return stand_in("ovito.data.DataCollection", particles=columns, cell=matrix)


class Objects(unittest.TestCase):
    def check(self, found, places=PLACES, elements=(8, 1, 1)):
        np.testing.assert_allclose(found.positions, places)
        self.assertEqual(None if found.elements is None else tuple(found.elements), elements)
        np.testing.assert_allclose(found.cell.vectors, EDGES, atol=1e-5)  # float32 angles in some formats
        return found

    def test_ase(self):
        ase = installed("ase")
        for atoms in [ase_atoms(PLACES), *([ase.Atoms("OHH", PLACES, cell=EDGES, pbc=(True, False, True))] if ase else [])]:
            self.assertEqual(self.check(load(atoms)).cell.periodic.tolist(), [True, False, True])
        images = [ase_atoms(PLACES), ase_atoms(PLACES + 1)]
        self.check(load(images), PLACES + 1)
        self.check(load(images, frame=0))
        with self.assertRaisesRegex(DataError, "frame 2: the data have 2 frames, from 0 or -2 to 1"):
            load(images, frame=2)

    def test_mdanalysis(self):
        data = universe()
        found = self.check(load(data))
        self.assertEqual(found.columns["name"].tolist(), ["OW", "HW1", "HW2"])
        self.check(load(data, frame=1), PLACES + 1)
        np.testing.assert_allclose(found.positions, PLACES)

    def test_ovito(self):
        self.assertEqual(load(ovito_data("")).types.tolist(), [1, 2, 2])
        found = self.check(load(ovito_data("O")), elements=None)
        self.assertEqual(found.types.tolist(), ["O", "type 2", "type 2"])
        self.assertEqual((found.cell.origin.tolist(), found.cell.periodic.tolist()), ([1, 2, 3], [True, False, True]))

    def test_tables(self):
        columns = {**dict(zip("xyz", PLACES.T)), "kind": np.array(["a", "b", "a"])}
        tables = [pandas.DataFrame(columns)] if (pandas := installed("pandas")) else []
        series = {key: types.SimpleNamespace(to_numpy=lambda values=values: np.frombuffer(values.tobytes(), values.dtype))
                  for key, values in columns.items()}
        frame = stand_in("polars.dataframe.frame.DataFrame", columns=list(columns))
        type(frame).__getitem__ = lambda self, key: series[key]
        for data in [columns, frame, *tables]:
            found = load(data)
            np.testing.assert_array_equal(found.positions, PLACES)
            self.assertEqual(found.columns["kind"].tolist(), ["a", "b", "a"])

    def test_columns_of_one_array_are_read_in_place(self):
        array = np.repeat(PLACES, 2, axis=0)
        self.assertTrue(np.shares_memory(load(dict(zip("xyz", array.T))).positions, array))
        np.testing.assert_array_equal(load(dict(zip("zyx", array.T))).positions, array[:, ::-1])
        np.testing.assert_array_equal(load(dict(zip("xyz", array[::2].T))).positions, PLACES)


class Files(readers_test.InAFolder):
    def read(self, name, content, **modules):
        with unittest.mock.patch.dict(sys.modules, modules):
            return super().read(name, content)

    def test_pcd(self):
        head = "# .PCD v0.7\nFIELDS x y z rgb _\nSIZE 4 4 4 4 1\nTYPE F F F {} U\nCOUNT 1 1 1 1 3\nPOINTS {}\nDATA {}\n"
        packed = np.array([0x102030, 0x405060, 0x708090], np.uint32)
        records = np.zeros(3, "f4,f4,f4,u4,V3")
        for key, values in zip(records.dtype.names, [*PLACES.T, packed]):
            records[key] = values
        text = "".join(f"{x} {y} {z} {color} 0 0 0\n" for (x, y, z), color in zip(PLACES, packed))
        for data in (*(head.format(kind, 3, "binary").encode() + records.tobytes() for kind in "FU"),
                     (head.format("U", 3, "ascii") + text).encode()):
            found = self.read("a.pcd", data)
            np.testing.assert_array_equal(found.positions, PLACES)
            np.testing.assert_array_equal(found.colors, packed.byteswap().view(np.uint8).reshape(3, 4)[:, 1:])
        for content, words in ((head.format("U", 4, "ascii") + text, "ends after 3 of 4 particles"),
                               (head.format("U", 3, "binary_compressed"), "must be ascii or binary"),
                               (head.format("X", 3, "ascii"), "the header must have FIELDS"),
                               (head[:30], "within its header")):
            with self.assertRaisesRegex(DataError, words):
                self.read("a.pcd", content.encode())

    def test_las(self):
        columns = {"X": [0] * 3, "intensity": [0] * 3, "red": [255, 0, 0], "green": [0, 255, 0], "blue": [0, 0, 255]}
        las = type("Las", (), {"xyz": PLACES, "__getitem__": lambda self, key: np.array(columns[key], np.uint16),
                               "point_format": types.SimpleNamespace(dimension_names=columns)})()
        found = self.read("a.las", b"LASF", laspy=types.SimpleNamespace(read=lambda path: las))
        np.testing.assert_allclose(found.positions, PLACES, atol=0.005)
        np.testing.assert_array_equal(found.colors, 255 * np.eye(3))
        self.assertIn("intensity", found.columns)

    def test_a_package_that_is_not_there_or_cannot_read(self):
        unknown = "neither its name nor its first lines say the format; trying others"
        for name, package, extra in (("a.traj", "ase", ""), ("a.las", "laspy", "-points"), ("a.vtk", "pyvista", "-points"),
                                     ("a.stl", "trimesh", "-points"), ("a.tpr", "MDAnalysis", "")):
            way = f"'pt.figure{extra}" if extra else package
            what = unknown if package == "ase" else "this format"
            with self.assertRaisesRegex(DataError, f"{name}: {what} needs the module {package}: pip install {way}"):
                self.read(name, b"data", **{package: None, f"{package}.io": None})

            def read(*_, **__):
                raise KeyError("no such thing")
            with self.assertRaisesRegex(DataError, f"{name}: .* cannot read it: 'no such thing'"):
                module = types.SimpleNamespace(read=read, load=read, Universe=read, io=None)
                self.read(name, b"data", **{package: module, f"{package}.io": module})

    def test_cells_of_dl_poly_have_their_middle_at_the_origin(self):
        for kind, origin in (("dlp4", -0.5 * EDGES.sum(axis=0)), ("dlp-history", -0.5 * EDGES.sum(axis=0)), ("castep-cell", np.zeros(3))):
            formats = types.SimpleNamespace(filetype=lambda path, kind=kind: kind)
            ase_io = types.SimpleNamespace(read=lambda path, index: [ase_atoms(PLACES)], formats=formats)
            found = self.read("CONFIG", b"made up", **{"ase.io": ase_io, "ase.io.formats": formats})
            np.testing.assert_array_equal(found.cell.origin, origin)

    def test_standard_input(self):
        """Only the package's own readers accept standard input, which may be compressed."""
        def given(data):
            return unittest.mock.patch("sys.stdin", io.TextIOWrapper(io.BytesIO(data)))

        buffer = io.BytesIO()
        np.save(buffer, PLACES)
        rows = "".join(f"{x} {y} {z}\n" for x, y, z in PLACES).encode()
        for data in (buffer.getvalue(), gzip.compress(rows), b"x,y,z\n" + rows.replace(b" ", b","),
                     b"3\n\n" + rows + b"3\nProperties=pos:R:3\n" + rows[::-1]):
            with given(data):
                np.testing.assert_array_equal(load("-", frame=0).positions, PLACES)
        with given(b"LASF"), self.assertRaisesRegex(DataError, "standard input: laspy reads files: standard input must be one of"):
            load("-")
