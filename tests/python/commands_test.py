import pathlib
import re
import shlex
import subprocess
import sys
import tomllib
import unittest

from pt.figures._command import joined, parser
from pt.figures._options import Options

ROOT = pathlib.Path(__file__).resolve().parents[2]
PYPROJECT = tomllib.loads((ROOT / "lib/python/pyproject.toml").read_text())["project"]


def figure_commands(text):
    lines = re.findall(r"^pt[ -]figure ([^#\n]*)", text, re.MULTILINE) + re.findall(r"`pt[ -]figure ([^`]*)`", text)
    return [words for line in lines if (words := shlex.split(line)) != ["--help"]]


class Commands(unittest.TestCase):
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

    def test_the_figures_of_the_pages(self):
        found = 0
        for page in ("README.md", "lib/python/README.md"):
            for words in figure_commands((ROOT / page).read_text()):
                with self.subTest(" ".join(words)):
                    given = parser().parse_args(joined(words))
                    Options(**{name: value for name, value in vars(given).items() if name in Options.__annotations__
                               and name != "progress"})
                    found += 1
        self.assertGreater(found, 5)
