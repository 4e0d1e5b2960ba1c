"""The commands of lib/python/FARM.md must give the picture of a single process."""

import importlib.util
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

PT = os.environ["PT_PROGRAM"]
ROOT = pathlib.Path(__file__).resolve().parents[2]
SCENE = ROOT / "cli/scenes/coursework-diffuse.json"


def commands(start):
    lines = (ROOT / "lib/python/FARM.md").read_text().replace("\\\n", " ").splitlines()
    return [line.replace("scene.json", f"{SCENE} --size 16x8") for line in lines if line.startswith(start)]


def command(start):
    line, = commands(start)
    return line


class Files(unittest.TestCase):
    def setUp(self):
        self.folder = self.enterContext(tempfile.TemporaryDirectory())

    def run_line(self, words, **more):
        path = os.path.dirname(PT) + os.pathsep + os.environ["PATH"]
        done = subprocess.run(["sh", "-c", words], cwd=self.folder, env={**os.environ, "PATH": path, **more},
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.assertEqual(done.returncode, 0, f"{words}\n{done.stdout}")

    def parts(self, line):
        """Renders 4 of the 16 parts."""
        self.run_line(line.replace("64 960", "64 192"))
        self.assertEqual(len(os.listdir(self.folder)), 4)
        merge = command("pt merge").replace("--spp 1024", "--spp 256")
        self.run_line(merge.replace("picture.png", "sum.exr"))
        self.run_line(f"pt render {SCENE} --size 16x8 --spp 256 -o one.exr -q")
        self.run_line("pt compare sum.exr one.exr --max-mse 0")
        os.remove(os.path.join(self.folder, "part-64.ptfilm"))
        with self.assertRaises(AssertionError):  # Samples are missing.
            self.run_line(merge)

    def test_xargs(self):
        self.parts(command("seq "))

    @unittest.skipUnless(shutil.which("parallel"), "GNU parallel is not installed")
    def test_parallel(self):
        self.parts(command("parallel "))

    @unittest.skipUnless(importlib.util.find_spec("distributed"), "Dask's distributed is not installed")
    def test_denoised(self):
        os.symlink(os.environ["OPEN_IMAGE_DENOISE"], os.path.join(self.folder, "libOpenImageDenoise.so.2"))
        lines = [*commands("pt-farm render scene.json --spp 32"), command("pt render scene.json --spp 1 "),
                 command("pt denoise").replace("picture.png", "parts.exr"),
                 f"pt render {SCENE} --size 16x8 --spp 64 --denoise -o one.exr", "pt compare parts.exr one.exr --max-mse 0"]
        self.assertEqual(len(lines), 6)
        for line in lines:
            self.run_line(line.replace("pt-farm", f"{sys.executable} -m pt.farm._command"), LD_LIBRARY_PATH=self.folder)
