"""Files that are cut short or have a wrong byte: refused with a message that names the file, or read as they are.
Arguments: the folder of the files."""

import pathlib
import sys
import tempfile
import unittest

import numpy as np
from pt.figures._accept import load
from pt.figures._errors import DataError

DATA = pathlib.Path(sys.argv.pop(1))
COUNT = 200  # of each kind and file
FILES = {  # and whether a row says where it ends
    "cloud.csv": False, "cloud.csv.gz": True, "cloud.tsv": False, "cloud.xyz": True, "cloud.extxyz": True, "rows.npy": True,
    "records.npy": True, "stored.npz": True, "deflated.npz": True, "little.ply": True, "lists.ply": True,
    "text.ply": True, "text_lists.ply": True, "melt_plain.dump": True, "tilted.dump": True}


class Damaged(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))

    def read(self, name, data):
        """Particles, or None where they are refused as they should be."""
        path = self.folder / name
        path.write_bytes(data)
        try:
            return load(path)
        except DataError as error:
            self.assertTrue(str(error).startswith(str(path)) and len(str(error)) > len(str(path)) + 10, error)
            self.assertLess(len(str(error)), 600)
            return None

    def test_files_that_end_too_early(self):
        refused = 0
        for name, is_counted in FILES.items():
            data = (DATA / name).read_bytes()
            whole = load(DATA / name)
            for size in np.random.default_rng(1).integers(0, len(data), COUNT).tolist():
                with self.subTest(name, size=size):
                    found = self.read(name, data[:size])
                    if found is None:
                        refused += 1
                        continue
                    # What is read is there: all of it, or the rows before; a number that may be cut is told.
                    is_first = name == "cloud.extxyz" and size < 3 * len(data) // 4  # of two frames
                    whole_frame = load(DATA / name, frame=0) if is_first else whole
                    kept = len(found) if found.positions[-1:].tolist() == whole_frame.positions[len(found) - 1:].tolist() \
                        or not any("may be cut" in note for note in found.notes) else len(found) - 1
                    self.assertEqual(len(found) == len(whole), is_counted or len(found) == len(whole))
                    np.testing.assert_array_equal(found.positions[:kept], whole_frame.positions[:kept])
        self.assertGreater(refused, COUNT * len(FILES) * 3 // 4)

    def test_bytes_that_are_wrong(self):
        generator = np.random.default_rng(2)
        refused = changed = 0
        for name in FILES:
            data = (DATA / name).read_bytes()
            whole = load(DATA / name)
            for place, byte in generator.integers(0, (len(data), 256), (COUNT, 2)).tolist():
                with self.subTest(name, place=place, byte=byte):
                    found = self.read(name, data[:place] + bytes([byte]) + data[place + 1:])
                    if found is None:
                        refused += 1
                        continue
                    self.assertTrue(np.isfinite(found.positions).all())
                    if found.positions.shape == whole.positions.shape:
                        rows = (found.positions != whole.positions).any(1).sum()
                        changed += rows > 0
                        # Behind all heads one row differs, unless its number has become so large that others are
                        # negligible, or a row that is packed is not what it was.
                        if place > 2 * len(data) // 3 and np.abs(found.positions).max() < 1e10:
                            self.assertLess(rows, 2)
        self.assertGreater(refused, COUNT * len(FILES) // 4)
        self.assertGreater(changed, COUNT)  # as a digit for another is


if __name__ == "__main__":
    unittest.main()
