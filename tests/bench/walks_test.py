"""PT_LIBRARY names the library."""

import os
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile
import unittest

from walks import SLOWER, UNCLEAR, is_clear, verdict

FOLDER = pathlib.Path(__file__).resolve().parent
LIBRARY = os.environ["PT_LIBRARY"]
TRIP, SLOWER_TRIP = "        ++trips;\n", "        ++trips;\n        walk.done = walk.done || sqrt(sqrt(float(trips))) < 0.5;\n"


def rounds(factor, scatter, seed):
    source, ratios = random.Random(seed), []
    while len(ratios) < 24 and not is_clear(ratios):
        ratios.append(factor * source.lognormvariate(0, scatter))
    return ratios


class Verdict(unittest.TestCase):
    def test_a_loss_of_5_percent_is_noticed_and_equal_builds_pass(self):
        for factor, expected in ((1.05, SLOWER), (1, 0), (0.9, 0)):
            wrong = sum(verdict(rounds(factor, 0.02, seed)) != expected for seed in range(200))
            self.assertLessEqual(wrong, 6, factor)

    def test_noise_gives_no_answer(self):
        self.assertEqual({verdict(rounds(factor, 0.2, seed)) for factor in (1, 1.05) for seed in range(20)}, {UNCLEAR})


class RealDevice(unittest.TestCase):
    def run_walks(self, *arguments):
        done = subprocess.run([sys.executable, "-B", FOLDER / "walks.py", "--library", f"old={LIBRARY}", "--library",
                               f"new={LIBRARY}", "--counts", "1e3", *arguments], text=True, capture_output=True)
        self.assertIn("| 1,000 ", done.stdout, done.stderr)
        return done.returncode

    def test_equal_builds(self):
        self.assertNotEqual(self.run_walks(), SLOWER)

    def test_a_planted_loss(self):
        with tempfile.TemporaryDirectory() as folder:
            shutil.copytree(FOLDER.parents[1] / "shaders", folder, dirs_exist_ok=True)
            walk = pathlib.Path(folder, "tree_walk.glsl")
            text = walk.read_text(encoding="utf-8")
            self.assertEqual(text.count(TRIP), 1)
            walk.write_text(text.replace(TRIP, SLOWER_TRIP), encoding="utf-8")
            self.assertNotEqual(self.run_walks("--shaders", f"new={folder}"), 0)


if __name__ == "__main__":
    unittest.main()
