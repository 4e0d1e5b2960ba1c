import contextlib
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import pt

ROOT = pathlib.Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / "lib/python/examples"
SMALLER = (("floor=True)", "floor=True, size=(32, 24), samples=4)"), ("640, 480", "32, 24"), ("1000,", "16,"),
           ("accumulate(64)", "accumulate(4)"))


def programs_of(page):
    return re.findall(r"```python\n(.*?)```", page.read_text(encoding="utf-8"), re.DOTALL)


class Examples(unittest.TestCase):
    def test_particles(self):
        self.assertEqual([path.name for path in EXAMPLES.iterdir()], ["particles.py"])
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run([sys.executable, "-B", EXAMPLES / "particles.py", "200", "32"], cwd=folder, text=True,
                                  capture_output=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("<pt.Image 32x24, 32 samples a pixel, error ", done.stdout)
            self.assertIn("<pt.Film of 32x24 pixels, 16 samples or more>", done.stdout)
            self.assertEqual(sorted(path.name for path in pathlib.Path(folder).iterdir()),
                             ["lamp.png", "particles.png", "particles.ptfilm", "step-0.png", "step-1.png",
                             "step-2.png"])
            self.assertEqual(pt.Film.load(pathlib.Path(folder, "particles.ptfilm")).stats().sample_count, 16)

    def test_programs_in_pages(self):
        first, = programs_of(ROOT / "README.md")
        others = programs_of(ROOT / "lib/python/README.md")
        self.assertEqual(len(others), 2)
        program = "\n".join([first, *others])
        for large, small in SMALLER:
            self.assertIn(large, program)
            program = program.replace(large, small)
        with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
            names = {}
            exec(program, names)
            self.assertEqual([path.name for path in pathlib.Path(folder).iterdir()], ["particles.png"])
        self.assertEqual(names["image"].shape, (24, 32, 3))
        self.assertEqual(names["pixels"].shape, (24, 32, 3))
        self.assertTrue((names["image"].sample_count == 16).all())
