"""Parts as plain files, by the commands of lib/python/FARM.md, verbatim except for the scene's size: their sum is the
picture of one process. Arguments: the program pt, and FARM.md. GNU parallel is tried where it is installed."""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

PT, MANUAL = (os.path.abspath(path) for path in (sys.argv.pop(1), sys.argv.pop(1)))
SCENE = pathlib.Path(__file__).resolve().parents[2] / "cli/scenes/coursework-diffuse.json"


def command(start):
    """The line of the manual that starts so, with what belongs to it."""
    lines = pathlib.Path(MANUAL).read_text().replace("\\\n", " ").splitlines()
    line, = (line for line in lines if line.startswith(start))
    return line.replace("scene.json", f"{SCENE} --size 16x8")


class Files(unittest.TestCase):
    def parts(self, line):
        """Runs a line of the manual in a folder of its own, and then the one that adds what it wrote."""
        with tempfile.TemporaryDirectory() as folder:
            def run(words):
                environment = {**os.environ, "PATH": os.path.dirname(PT) + os.pathsep + os.environ["PATH"]}
                done = subprocess.run(["sh", "-c", words], cwd=folder, env=environment, stdout=subprocess.PIPE,
                                      stderr=subprocess.STDOUT, text=True)
                self.assertEqual(done.returncode, 0, f"{words}\n{done.stdout}")
            run(line)
            self.assertEqual(len(os.listdir(folder)), 16)
            run(command("pt merge").replace("picture.png", "sum.exr"))
            run(f"pt render {SCENE} --size 16x8 --spp 1024 -o one.exr -q")
            run("pt compare sum.exr one.exr --max-mse 0")
            os.remove(os.path.join(folder, "part-64.ptfilm"))
            with self.assertRaises(AssertionError):  # exit code 7: samples are missing
                run(command("pt merge"))

    def test_xargs(self):
        self.parts(command("seq "))

    @unittest.skipUnless(shutil.which("parallel"), "GNU parallel is not installed")
    def test_parallel(self):
        self.parts(command("parallel "))


if __name__ == "__main__":
    unittest.main()
