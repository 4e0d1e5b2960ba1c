import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

PACKAGE = pathlib.Path(__file__).resolve().parents[2] / "lib/python"

USES = """
import numpy as np
import pt

image = pt.render(np.zeros((2, 3)), 1.0, colors=np.zeros((2, 3), np.uint8))
reveal_type(image.error)
reveal_type(pt.Film.load("x") + pt.Film(b""))
pt.Sphere((0, 0, 0), 1)
pt.Context().set_camera(pt.RenderSettings(4, 4))
pt.Context().accumulate("16")
pt.render(np.zeros((2, 3)), 1.0, sise=(4, 4))
reveal_type(pt.figure("a.xyz", floor=True))
pt.figure("a.xyz", flor=True)
pt.figure("a.xyz", floor="yes")
"""


class Types(unittest.TestCase):
    def test_types(self):
        with tempfile.TemporaryDirectory() as folder:
            pathlib.Path(folder, "uses.py").write_text(USES)
            done = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--no-error-summary", "--cache-dir", os.devnull,
                                   PACKAGE / "pt", PACKAGE / "examples" / "particles.py", "uses.py"], text=True,
                                  capture_output=True, cwd=folder, env={**os.environ, "MYPYPATH": str(PACKAGE)})
        said = [line for line in done.stdout.splitlines() if " note: \"" not in line]  # notes say where functions are defined
        self.assertEqual([line for line in said if not line.startswith("uses.py:")], [], done.stderr)
        for line, words in zip(said, ('"builtins.float"', '"pt._film.Film"', 'Missing positional argument "material"',
                                      'incompatible type "RenderSettings"; expected "Camera"',
                                      'incompatible type "str"; expected "int"', 'argument "sise"',
                                      '"pt.figures._figure.Figure"', 'argument "flor"',
                                      'incompatible type "str"; expected "bool"'), strict=True):
            self.assertIn(words, line)
