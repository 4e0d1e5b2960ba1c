"""Examples, programs and commands of pages run, and the package has types."""

import contextlib
import importlib.util
import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile
import tomllib
import unittest

import pt
from pt.figures._command import joined, parser
from pt.figures._options import Options

ROOT = pathlib.Path(__file__).resolve().parents[2]
PACKAGE = ROOT / "lib/python"
PARTICLES = PACKAGE / "examples/particles.py"
PYPROJECT = tomllib.loads((PACKAGE / "pyproject.toml").read_text())["project"]
SMALLER = (("floor=True)", "floor=True, size=(32, 24), samples=4)"), ("640, 480", "32, 24"), ("1000,", "16,"),
           ("accumulate(64)", "accumulate(4)"))

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


def programs_of(page):
    return re.findall(r"```python\n(.*?)```", page.read_text(encoding="utf-8"), re.DOTALL)


class Examples(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))

    def test_particles(self):
        done = subprocess.run([sys.executable, "-B", PARTICLES, "200", "32"], cwd=self.folder, text=True, capture_output=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("<pt.Image 32x24, 32 samples a pixel, error ", done.stdout)
        self.assertIn("<pt.Film of 32x24 pixels, 16 samples or more>", done.stdout)
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()),
                         ["lamp.png", "particles.png", "particles.ptfilm", "step-0.png", "step-1.png", "step-2.png"])
        self.assertEqual(pt.Film.load(self.folder / "particles.ptfilm").stats().sample_count, 16)

    def test_programs_in_pages(self):
        first, = programs_of(ROOT / "README.md")
        others = programs_of(PACKAGE / "README.md")
        self.assertEqual(len(others), 2)
        program = "\n".join([first, *others])
        for large, small in SMALLER:
            self.assertIn(large, program)
            program = program.replace(large, small)
        with contextlib.chdir(self.folder):
            names = {}
            exec(program, names)
        self.assertEqual([path.name for path in self.folder.iterdir()], ["particles.png"])
        self.assertEqual((names["image"].shape, names["pixels"].shape), ((24, 32, 3), (24, 32, 3)))
        self.assertTrue((names["image"].sample_count == 16).all())

    def test_figures_of_the_pages(self):
        text = "".join(page.read_text(encoding="utf-8") for page in (ROOT / "README.md", PACKAGE / "README.md"))
        commands = re.findall(r"^pt[ -]figure ([^#\n]*)", text, re.MULTILINE) + re.findall(r"`pt[ -]figure ([^`]*)`", text)
        self.assertGreater(len(commands), 5)
        for command in {command.strip() for command in commands} - {"--help"}:
            with self.subTest(command):
                given = vars(parser().parse_args(joined(shlex.split(command))))
                Options(**{name: value for name, value in given.items() if name in Options.__annotations__ and name != "progress"})

    def test_help_needs_no_optional_module(self):
        optional = {re.match(r"\w+", need)[0] for extra in PYPROJECT["optional-dependencies"].values() for need in extra}
        self.assertLessEqual({"aiohttp", "distributed", "matplotlib"}, optional)
        for name, place in PYPROJECT["scripts"].items():
            module, function = place.split(":")
            done = subprocess.run([sys.executable, "-B", "-c", f"""
import importlib, sys
sys.modules.update(dict.fromkeys({sorted(optional)}))
sys.argv = [{name!r}, "--help"]
importlib.import_module({module!r}).{function}()
"""], capture_output=True, text=True)
            self.assertEqual((done.returncode, done.stderr), (0, ""), name)
            self.assertIn(f"usage: {name} ", done.stdout)

    @unittest.skipUnless(importlib.util.find_spec("mypy"), "mypy is not installed")
    def test_types(self):
        (self.folder / "uses.py").write_text(USES)
        done = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--no-error-summary", "--cache-dir", os.devnull,
                               PACKAGE / "pt", PARTICLES, "uses.py"], text=True, capture_output=True, cwd=self.folder,
                              env={**os.environ, "MYPYPATH": str(PACKAGE)})
        said = [line for line in done.stdout.splitlines() if " note: \"" not in line]  # notes say where functions are defined
        self.assertEqual([line for line in said if not line.startswith("uses.py:")], [], done.stderr)
        for line, words in zip(said, ('"builtins.float"', '"pt._film.Film"', 'Missing positional argument "material"',
                                      'incompatible type "RenderSettings"; expected "Camera"',
                                      'incompatible type "str"; expected "int"', 'argument "sise"',
                                      '"pt.figures._figure.Figure"', 'argument "flor"',
                                      'incompatible type "str"; expected "bool"'), strict=True):
            self.assertIn(words, line)
