"""All files cloud.* have the same particles."""

import bz2
import gzip
import importlib.util
import lzma
import os
import pathlib
import tempfile
import threading
import unittest

import numpy as np
from pt.figures import frames, load
from pt.figures._cell import Cell
from pt.figures._errors import DataError
from pt.figures.readers import _rows

DATA = pathlib.Path(__file__).resolve().parents[2] / "tests/data/particles"

DUMP = ("ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS pp ff pp\n0 1\n0 2\n0 4\n"
        "ITEM: ATOMS id type x y z\n1 1 0.5 1 2\n2 2 0.25 1e-1 +3\n")
PLY = "ply\nformat {}\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\nend_header\n"
HEAD = "ITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS "
ATOMS = "ITEM: ATOMS id xs ys zs\n1 0.5 0.25 0.125\n"


class InAFolder(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))

    def read(self, name, content, **options):
        path = self.folder / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return load(path, **options)

    def refusal(self, name, content, **options):
        with self.assertRaises(DataError) as raised:
            self.read(name, content, **options)
        return str(raised.exception).replace(f"{self.folder}/", "")


class Stored(unittest.TestCase):
    def test_files_of_all_writers_hold_the_same(self):
        expected = load(DATA / "cloud.csv")
        self.assertEqual(len(expected), 24)
        # Tolerances are half a unit of the last digit. Positions are up to 5, and charges up to 1.
        for name, place, charge in (("cloud.csv.gz", 0, 0), ("cloud.tsv", 0, 0), ("cloud.extxyz", 0.5e-8, 0.5e-8),
                                    ("rows.npy", 0, 0), ("columns.npy", 0, 0), ("big.npy", 2**-22, 2**-24),
                                    ("records.npy", 0, 2**-25), ("stored.npz", 0, 0), ("deflated.npz", 0, 2**-25),
                                    ("text.ply", 0, 2**-25), ("little.ply", 0, 2**-25), ("big.ply", 0, 2**-25),
                                    ("lists.ply", 0, 2**-25), ("text_lists.ply", 0, 2**-25)):
            with self.subTest(name):
                found = load(DATA / name, frame=0)
                np.testing.assert_allclose(found.positions, expected.positions, 0, place)
                np.testing.assert_allclose(found.column("charge" if "charge" in found.columns else "4"),
                                           expected.column("charge"), 0, charge)
                np.testing.assert_array_equal(found.column("z"), found.positions[:, 2])

    def test_fractions_of_a_cell(self):
        """Fractions have 7 digits. Edges are at most 8 long, and each coordinate is the sum of three products."""
        for name in "melt", "tilted":
            scaled, plain = load(DATA / f"{name}.dump"), load(DATA / f"{name}_plain.dump")
            np.testing.assert_allclose(scaled.positions, plain.positions, 0, 3 * 8 * 0.5e-7)
            np.testing.assert_array_equal(scaled.types, plain.types)
        # The file was made from a cell at 0 with xy 1.5, xz -0.7 and yz 0.9.
        np.testing.assert_allclose(scaled.cell.origin, 0, 0, 1e-14)
        np.testing.assert_allclose(scaled.cell.vectors[np.tril_indices(3, -1)], [1.5, -0.7, 0.9], 0, 1e-14)


class Cells(InAFolder):
    def test_cells_are_those_of_the_text(self):
        # The edges (2, 0, 0), (1, 4, 0) and (1, -2, 8), starting at (1, -2, 10), have the bounds 1 to 5, -4 to 2 and 10
        # to 18.
        for name, text, vectors, periodic, position in (
                ("a.dump", f"{HEAD}pp ff ps\n1 3\n-2 2\n10 18\n{ATOMS}", np.diag((2, 4, 8)), (1, 0, 0), (2, -1, 11)),
                ("a.dump", f"{HEAD}xy xz yz pp pp pp\n1 5 1\n-4 2 1\n10 18 -2\n{ATOMS}",
                 [[2, 0, 0], [1, 4, 0], [1, -2, 8]], (1, 1, 1), (2.375, -1.25, 11)),
                ("a.dump", f"{HEAD}abc origin pp pp pp\n2 0 1 1\n0 4 0 -2\n1 0 8 10\n{ATOMS}",
                 [[2, 0, 1], [0, 4, 0], [1, 0, 8]], (1, 1, 1), (2.125, -1, 11.5)),
                ("a.xyz", "1\nLattice=\"1 2 3 4 5 6 7 8 1\" Origin='1 -2 10' pbc={F T F} Properties=pos:R:3\n0 1 2\n",
                 [[1, 2, 3], [4, 5, 6], [7, 8, 1]], (0, 1, 0), (0, 1, 2))):
            found = self.read(name, text)
            np.testing.assert_array_equal(found.cell.origin, (1, -2, 10))
            np.testing.assert_array_equal(found.cell.vectors, vectors)
            np.testing.assert_array_equal(found.cell.periodic, np.array(periodic, bool))
            np.testing.assert_array_equal(found.positions, [position])

    def test_wrapping_goes_by_whole_edges(self):
        edges = np.array([[2.0, 0, 0], [1, 4, 0], [1, -2, 8]])
        fractions = np.random.default_rng(1).uniform((0.01, -2, 0.01), (0.99, 3, 0.99), (50, 3))
        inside = fractions @ edges + (1, -2, 10)
        turns = np.random.default_rng(2).integers(-3, 4, (50, 3))
        turns[:, 1] = 0  # The cell is not periodic along this edge, so particles remain outside.
        outside = inside + turns @ edges
        found = load({"positions": outside.copy(), "v": np.arange(50)})
        found.cell = Cell.of(edges, (1, -2, 10), (True, False, True))
        wrapped = found.wrapped().select(np.arange(50) % 2 == 1)
        np.testing.assert_allclose(wrapped.positions, inside[1::2], 0, 30 * 2**-50)
        np.testing.assert_array_equal(wrapped.column("y"), wrapped.positions[:, 1])
        np.testing.assert_array_equal(wrapped.column("v"), np.arange(1, 50, 2))
        np.testing.assert_array_equal(found.positions, outside)


def many_frames(count):
    return "".join(f"1\nframe\nH {i} 0 0\n" for i in range(count))


class Frames(InAFolder):
    def test_frames_are_counted_from_both_ends_packed_or_not(self):
        text = many_frames(5000).encode()
        for pack, end in ((bytes, ""), (gzip.compress, ".gz"), (bz2.compress, ".bz2"), (lzma.compress, ".xz")):
            for frame in 0, 1, 4999, -1, -2, -5000:
                found = self.read(f"a.xyz{end}", pack(text), frame=frame)
                np.testing.assert_array_equal(found.positions, [[frame % 5000, 0, 0]])
            for frame in 5000, -5001:
                self.assertEqual(self.refusal(f"a.xyz{end}", pack(text), frame=frame),
                                 f"a.xyz{end}: frame {frame}: the data have 5000 frames, from 0 or -5000 to 4999")
        self.assertEqual([each.positions[0, 0] for each in frames(self.folder / "a.xyz.gz", 4990, -3)], list(range(4990, 4998)))

    def test_errors_of_other_frames_do_not_matter(self):
        self.assertEqual(len(self.read("a.xyz", "1\n\nH 0 zero 0\n" + many_frames(1))), 1)
        self.assertEqual(self.refusal("a.xyz.gz", gzip.compress((many_frames(7) + "1\n\nH 0 zero 0\n").encode())),
                         "a.xyz.gz:24: y = 'zero': must be a number")

    def test_pipes(self):
        pipe = self.folder / "pipe"
        os.mkfifo(pipe)
        writer = threading.Thread(target=lambda: pipe.write_text(many_frames(300)))
        writer.start()
        self.assertEqual(load(pipe, frame=-2).positions[0, 0], 298)
        writer.join()


class Rows(InAFolder):
    @unittest.skipUnless(importlib.util.find_spec("pandas"), "pandas is not installed")
    def test_pandas_reads_what_is_read_one_by_one(self):
        generator = np.random.default_rng(1)
        numbers = [f"{x:.17g}" for x in generator.normal(size=600) * 10.0**generator.integers(-20, 20, 600)]
        numbers += ["nan", "1e-400", "-0.0", "5e-324", "1e5", "+3", ".5", "7", "1D2"]
        for separator in ",", " ", "\t", "  ":
            for words in ["O", "Na", "NA", "H1"], ["1", "2", "30"]:
                for odd in None, "1{s}2{s}3", "1{s}2{s}3{s}4{s}5{s}6", "a{s}b{s}c{s}d{s}e", "", "# no", '"1"{s}2{s}3{s}4{s}O':
                    rows = [separator.join([*generator.choice(numbers, 4), generator.choice(words)]) for _ in range(99)]
                    rows[0] = separator.join("12345")[:-1] + words[0]
                    rows.insert(50, rows[1] if odd is None else odd.format(s=separator))
                    text = separator.join(("x", "y", "z", "v", "name")) + "\n" + "\n".join(rows) + "\n"
                    found = []
                    for _rows.FEW_BYTES in (0, 1 << 30):
                        try:
                            columns = self.read("a.csv", text, drop_nonfinite=True).columns
                            found.append({name: values.tolist() for name, values in columns.items()})
                        except DataError as error:
                            found.append(str(error))
                    np.testing.assert_equal(*found)
                    self.assertEqual(isinstance(found[0], str), odd is not None and odd[:1] in ("1", "a"), found[0])

    def tearDown(self):
        _rows.FEW_BYTES = 1 << 16

    def test_blocks_begin_and_end_anywhere(self):
        rows = [(i, -0.5, i % 1000 + 0.25, i if i < 58000 else i + 0.5) for i in range(60000)]
        for name, head, separator in (("a.csv", "x,y,z,v\n", ","), ("a.xyz", "60000\nProperties=pos:R:3:v:R:1\n", " "),
                                      ("a.dump", "ITEM: NUMBER OF ATOMS\n60000\nITEM: ATOMS x y z v\n", " ")):
            text = (head + "".join(f"{i}{separator}{' ' * (i % 67)}{y}{separator}{z}{separator}{v}\n" for i, y, z, v in rows)).encode()
            for data in text, text.replace(b"\n", b"\r\n"), b"\xef\xbb\xbf" + text, gzip.compress(text[:99991]) + \
                    gzip.compress(text[99991:]):
                found = self.read(name, data)
                np.testing.assert_array_equal(np.column_stack([found.positions, found.column("v")]), rows)
        self.assertIn("column t is taken for words: 'b' in line 3 is no number", self.read("a.csv", "x,y,z,t\n0,0,0,1\n1,0,0,b\n").notes)


class Users(unittest.TestCase):
    def test_what_they_hold(self):
        for name, count, expected in (
                ("arr0.npz", 20, {}), ("points.npz", 20, {}), ("one.npz", 20, {}), ("traj.npy", 20, {}),
                ("xy.npy", 20, {"notes": "the third one is 0"}), ("space.csv", 2, {}), ("ws.dat", 2, {}),
                ("upper.txt", 2, {}), ("noheader.csv", 3, {}), ("savetxt.csv", 10, {}), ("savetxt.txt", 10, {}),
                ("savetxt.xyz", 10, {}), ("comment.csv", 2, {}), ("units.csv", 3, {}), ("cat.csv", 60, {}),
                ("paraview.csv", 2, {"notes": "Points:0, Points:1, Points:2"}),
                ("posx.csv", 2, {"notes": "pos_x, pos_y, pos_z", "types": [1, 1]}),
                ("decimalcomma.csv", 2, {"positions": [[0.5, 0, 0], [1.5, 0, 0]]}),
                ("dexp.xyz", 2, {"positions": [[0, 0, 0], [0, 0, 0.74]], "elements": [1, 1]}),
                ("tiny.csv", 2, {"positions": [[0, 0, 0], [1, 0, 0]]}),
                ("tiny.xyz", 2, {"positions": [[0, 0, 0], [1.5, 0, 0]]}),
                ("colZ.xyz", 3, {"elements": [8, 1, 1], "positions": [[0, 0, 0.25], [0.76, 0.59, 0], [-0.76, 0.59, 0]]}),
                ("caps.xyz", 3, {"elements": [28, 17, 17]}), ("labels.xyz", 3, {"elements": [8, 1, 1]}),
                ("numbers.xyz", 3, {"elements": [8, 1, 1]}), ("heavywater.xyz", 3, {"elements": [8, 1, 1]}),
                ("types9.xyz", 12, {"elements": None}), ("diam.csv", 3, {"radii": [0.5, 0.5, 1.5]}),
                ("rgb_over1.csv", 3, {"colors": np.eye(3), "notes": "from 0 to 1:"}),
                ("ushort.ply", 3, {"colors": [[65535, 10000, 10000]]}),
                ("diffuse.ply", 2, {"colors": [[255, 0, 0]]}), ("splat.ply", 4, {"colors": [[0.6, 0.5, 0.4]]}),
                ("cc.asc", 2, {"colors": [[1, 0, 0], [0, 1, 0]], "notes": "from 0 to 255"}),
                ("nonl.dump", 2, {"notes": "may be cut"}), ("nonl.ply", 2, {"notes": "may be cut"}),
                ("nan.csv", 3, {}), ("empty_last.xyz", 2, {"notes": "have no particles are not counted (1)"})):
            with self.subTest(name):
                found = load(DATA / "trials" / name)
                self.assertEqual(found.positions.shape, (count, 3))
                for key, value in expected.items():
                    if key == "notes":
                        self.assertIn(value, " ".join(found.notes))
                    elif value is None:
                        self.assertIsNone(getattr(found, key))
                    else:
                        tolerance = 2**-24 if key == "colors" else 0  # Colors are float32.
                        np.testing.assert_allclose(getattr(found, key)[:len(value)], value, 0, tolerance)

    def test_what_is_said_of_them(self):
        for name, message in (("comment.dump", ":11: '##### note': has 2 values, must have 5"),
                              ("local.dump", ":3: 'ITEM: NUMBER OF ENTRIES': is not part of a dump of atoms"),
                              ("nan_pos.csv", ": particle 3 of 3: x = nan, y = nan, z = nan: must be finite"),
                              ("rnan.csv", ": particle 2 of 3: radius = nan: must be finite"),
                              ("inf.ply", ": particle 1 of 4: x = -inf, y = -inf, z = inf: must be finite")):
            with self.subTest(name), self.assertRaises(DataError) as raised:
                load(DATA / "trials" / name)
            self.assertIn(name + message, str(raised.exception))
        for name, count in (("nan_pos.csv", 2), ("rnan.csv", 2), ("inf.ply", 3), ("nan.ply", 3)):
            self.assertEqual(len(load(DATA / "trials" / name, drop_nonfinite=True)), count)

    def test_columns_by_name_and_by_number(self):
        for columns, expected in (("x=vel_x,y=pos_y,z=pos_x", [[3, 0, 0], [4, 0, 1]]), ("x=vel_x,y=pos_y,z=pos_y", [[3, 0, 0], [4, 0, 0]]),
                                  ({"x": "6", "y": "4", "z": "3"}, [[3, 0, 0], [4, 0, 1]])):
            np.testing.assert_array_equal(load(DATA / "trials/posx.csv", columns=columns).positions, expected)
        for columns, said in (("x=speed", "no column 'speed': the columns are id, type, pos_x"), ("w=id", "for one of x, y")):
            with self.assertRaisesRegex(DataError, said):
                load(DATA / "trials/posx.csv", columns=columns)

    def test_columns_that_are_radii_or_may_be(self):
        places = {"x": [0.0, 1.0], "y": [0.0, 0.0], "z": [0.0, 0.0]}
        for name, expected in (("Radius [nm]", [1, 2]), ("DIAMETER (m)", [0.5, 1]), ("radii", [1, 2])):
            self.assertEqual(load({**places, name: [1.0, 2.0]}).radii.tolist(), expected)
        self.assertEqual(load({**places, "Radius": [3, 4], "radius": [1, 2]}).radii.tolist(), [1, 2])
        found = load({**places, "R (m)": [1.0, 2.0]})
        self.assertEqual((found.radii, found.notes), (None, ['column R (m) is not taken for the radius: --columns "radius=R (m)" '
                                                             '(columns="radius=R (m)") takes it']))
        self.assertEqual(load({**places, "R (m)": [1.0, 2.0]}, columns="radius=R (m)").radii.tolist(), [1, 2])
        self.assertEqual(load({**places, "r": [1, 2], "g": [1, 2], "b": [1, 2]}).notes, ["colors r, g, b are taken to go from 0 to 255: the largest is 2"])
        with self.assertRaisesRegex(DataError, "column name has words, 'a': a radius must be a number"):
            load({**places, "name": ["a", "b"]}, columns="radius=name")


class Messages(InAFolder):
    def test_they_name_place_value_and_rule(self):
        most = "18446744073709551615"
        for name, text, message in (
                ("a", DUMP.replace("+3", "3x"), "a:11: z = '3x': must be a number"),
                ("a", DUMP.replace("+3", "1e999"), "a: particle 2 of 2: z = inf: must be finite"),
                ("a", DUMP.replace(" +3", ""), "a:11: '2 2 0.25 1e-1': has 4 values, must have 5"),
                ("a", DUMP.replace("2 2 0.25 1e-1 +3\n", ""), "a:10: the file ends after 1 of 2 particles of frame 0: it "
                                                              "was cut short"),
                ("a", DUMP.replace("\n2\n", "\n-2\n"), "a:4: '-2': must be the number of atoms"),
                ("a", DUMP.replace(" x y", " vx vy"), "a: no columns of positions, such as x, y, z: the columns are id, "
                                                      "type, vx, vy, z"),
                ("a.csv", "x,y,z\n1,2\n", "a.csv:2: '1,2': has 2 values, must have 3"),
                ("a.csv", "x,y,z\n1,2,\"3\n", "a.csv:2: '1,2,\"3': a quoted field must end in the line in which it begins"),
                ("a.csv", "x,y,x,z\n1,2,3,4\n", "a.csv:1: there are two columns 'x'"),
                ("a.csv", "x,y,z\n", "a.csv: has no particles"), ("a.csv", "", "a.csv: is empty"),
                ("a.csv", b"\xff\xfex\0", "a.csv: is UTF-16: save it as UTF-8"),
                ("a.dump", f"ITEM: NUMBER OF ATOMS\n{most}\nITEM: ATOMS x y z\n1 2 3\n",
                 f"a.dump:4: the file ends after 1 of {int(most):,} particles of frame 0: it was cut short"),
                ("a.ply", PLY.format("ascii 1.0") + "1 2 3\n", "a.ply:8: the file ends after 1 of 2 particles: it was cut short"),
                ("a.ply", PLY.format("binary_little_endian 1.0") + "1" * 23,
                 "a.ply:7: the file ends after 1 of 2 records of 12 bytes: it was cut short"),
                ("a.ply", PLY.format("ebcdic 1.0"), "a.ply:2: 'format ebcdic 1.0': is no line of a PLY file's header"),
                ("a.xyz", "1\n", "a.xyz:1: the file ends after the number of particles: it was cut short"),
                ("a.xyz", "1\nProperties=pos:R:x\n1 2 3\n", "a.xyz:2: Properties = 'pos:R:x': must be name:type:count for"),
                ("a.csv.gz", gzip.compress(b"x,y,z\n" * 99)[:-9], "a.csv.gz: after 0 unpacked bytes: Compressed file ended")):
            with self.subTest(message):
                self.assertEqual(self.refusal(name, text)[:len(message)], message)
