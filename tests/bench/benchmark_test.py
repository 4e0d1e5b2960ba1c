"""PT_LIBRARY names the library."""

import contextlib
import io
import json
import pathlib
import random
import subprocess
import sys
import tempfile
import unittest

from bench_scenes import CHECKS, NAMES, REFERENCES, SIZE, digest, load_scene, read_reference_table
from benchmark_figures import print_report, scene_figures
from block_means import block_means, compare, whole_means
from cost_of_error import cost_of_error
from mitsuba_scene import obstacle

FOLDER = pathlib.Path(__file__).resolve().parent
SCENE = "large-lamp"


def cells(*points):
    return [{"spp": spp, "processor_seconds": cost, "seconds": 2 * cost, "rel_mse": error}
            for spp, cost, error in points]


class Reckoning(unittest.TestCase):
    def cost(self, error, *points):
        cost, within = cost_of_error({spp: (spp, value) for spp, value in points}, error)
        return round(cost, 6), within

    def test_the_cost_of_an_error_lies_between_those_measured(self):
        line = (1, 1e-2), (100, 1e-4)
        self.assertEqual(self.cost(1e-3, *line), (10, True))
        self.assertEqual(self.cost(1e-4, *line), (100, True))
        self.assertEqual(self.cost(1e-5, *line), (1000, False))
        self.assertEqual(self.cost(1e-1, *line), (0.1, False))

    def test_an_error_that_rises_again_was_not_reached(self):
        self.assertEqual(self.cost(1e-2, (1, 1), (2, 1e-3), (4, 1), (16, 1e-4)), (8, True))

    def test_what_is_ahead_of_the_default_is_printed_first(self):
        one = {"default": cells((16, 1, 4e-2), (64, 4, 1e-2), (256, 16, 2.5e-3)),
               "random": cells((16, 1, 8e-2), (64, 4, 2e-2), (256, 16, 5e-3)),
               "light": cells((16, 1, 2e-2), (64, 4, 5e-3), (256, 16, 1.25e-3))}
        figures = scene_figures([one, one], "processor_seconds")
        ratios = {option: [(round(each["ratio"], 6), each["within"], each["rounds_behind"]) for each in of["ratios"]]
                  for option, of in figures["options"].items() if option != "default"}
        self.assertEqual(ratios, {"random": [(2, True, 0), (2, False, 0)], "light": [(0.5, True, 2), (0.5, True, 2)]})
        self.assertEqual([(target["spp"], target["cost"], target["seconds"]) for target in figures["targets"]],
                         [(64, 4, 8), (256, 16, 32)])
        report = {"mitsuba": None, "rounds": 2, "unit": "CPU seconds",
                  "scenes": {"a": {**figures, "own_error": 1e-4, "obstacle": "no such thing",
                                   "device": {"name": "a device"}}}}
        with contextlib.redirect_stdout(io.StringIO()) as output:
            print_report(report)
        lines = output.getvalue().splitlines()
        self.assertEqual(lines[:4], [
            "What is ahead of the default:",
            "- a: light takes 0.50 / 0.50 of what the default takes (it is ahead in 2 and 2 of 2 rounds)",
            "- a: the reference's own error is 8.0% of the smallest measured", "- a: not by Mitsuba: no such thing"])
        self.assertIn("| 2.00 / ~2.00 |", lines[-1])


class References(unittest.TestCase):
    def test_blocks_tell_images_that_differ(self):
        source = random.Random(1)
        images = [[[source.gauss(mean, 0.1) for _ in range(32 * 16 * 3)] for _ in range(16)] for mean in (1, 1, 1.01)]
        runs, same, other = ([block_means(image, 32, 16) for image in of] for of in images)
        self.assertEqual(len(runs[0]), 2 * 3)
        self.assertAlmostEqual(whole_means(runs[0])[1], sum(images[0][0][1::3]) / (32 * 16))
        self.assertLess(compare(runs, same)["largest_z"], 4)
        self.assertGreater(compare(runs, other)["largest_z"], 6)

    def test_each_scene_has_one_that_was_checked(self):
        table = read_reference_table()
        self.assertEqual(sorted(table), sorted(NAMES))
        self.assertEqual(sorted(path.stem for path in REFERENCES.glob("*.exr")), sorted(NAMES))
        for name, facts in table.items():
            self.assertEqual((facts["width"], facts["height"]), SIZE)
            self.assertEqual(facts["scene"], digest(load_scene(name)), f"{name} has changed since")
            self.assertEqual(facts["check"]["estimator"], CHECKS[name])
            self.assertLess(facts["check"]["largest_z"], 6)
            self.assertEqual("obstacle" in facts["mitsuba"], bool(obstacle(load_scene(name))))


class RealDevice(unittest.TestCase):
    def run_script(self, name, *arguments):
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run([sys.executable, "-B", FOLDER / name, *(each.replace("FOLDER", folder)
                                                                         for each in arguments)],
                                  text=True, capture_output=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            return {path.name: path.read_bytes() for path in pathlib.Path(folder).iterdir()}, done.stdout

    def test_the_benchmark_runs(self):
        files, output = self.run_script("benchmark.py", "--scenes", SCENE, "--samples", "2", "32",
                                        "--rounds", "1", "--json", "FOLDER/b.json")
        scene = json.loads(files["b.json"])["scenes"][SCENE]
        self.assertEqual(list(scene["options"]), ["default", "random", "halton", "halton-cp", "uniform", "cosine",
                                                  "bsdf", "light"])
        errors = {option: [point["rel_mse"] for point in of["points"]] for option, of in scene["options"].items()}
        for option, (few, many) in errors.items():
            self.assertLess(many, few, option)
        self.assertLess(errors["default"][1], 0.003)
        self.assertLess(errors["default"][1], errors["uniform"][1] / 10)
        self.assertIn(f"| {SCENE} ", output)

    def test_references_are_rendered(self):
        files, _ = self.run_script("references.py", "render", "FOLDER", "--scenes", SCENE, "--samples", "1",
                                   "--check-samples", "1")
        self.assertEqual(sorted(files), [f"{SCENE}.json", f"{SCENE}.pfm"])
        self.assertEqual(len(files[f"{SCENE}.pfm"]), len("PF\n128 64\n-1.0\n") + 4 * 3 * 128 * 64)
        made = json.loads(files[f"{SCENE}.json"])
        self.assertTrue(0 < made["facts"]["own_error"] < 0.03, made["facts"])
        self.assertLess(compare(made["block_means"]["check"], made["block_means"]["reference"])["largest_z"], 6)


if __name__ == "__main__":
    unittest.main()
