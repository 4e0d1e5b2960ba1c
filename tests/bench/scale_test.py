"""Tests scale.py without judging times. PT_LIBRARY names the library."""

import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

from lamp_cloud import POWER, LampCloud
from scale import difference_of_means, relative_error
from sphere_cloud import COLORS, EXTENT, MATERIALS, SphereCloud, surroundings

FOLDER = pathlib.Path(__file__).resolve().parent
LIBRARY = os.environ["PT_LIBRARY"]


class Reckoning(unittest.TestCase):
    def test_errors_are_relative_to_the_reference(self):
        self.assertAlmostEqual(relative_error([1, 2, 0.1], [1, 1, 0]), (0 + 1 / 1.01 + 1) / 3)

    def test_means_differ_by_a_share_and_by_standard_errors(self):
        share, deviations = difference_of_means([2, 2, 2, 4, 4, 4], [2, 2, 2, 2, 2, 2])
        self.assertAlmostEqual(share, 0.5)
        self.assertAlmostEqual(deviations, 2 ** 0.5)


class Clouds(unittest.TestCase):
    def test_columns_hold_spheres_that_stay_away_from_camera_and_lamp(self):
        cloud, scene = SphereCloud(100), surroundings()
        self.assertEqual((len(cloud.centers), len(cloud.radii), len(cloud.materials)), (300, 100, 100))
        self.assertEqual({list(MATERIALS)[i] for i in cloud.materials}, set(COLORS))
        for i, radius in enumerate(cloud.radii):
            center = cloud.centers[3 * i:3 * i + 3]
            self.assertLessEqual(abs(center[0]), EXTENT[0] / 2)
            self.assertLess(center[2] + radius, scene["camera"]["position"][2])

    def test_clouds_of_all_counts_fill_as_much(self):
        few, many = (sum(radius ** 3 for radius in SphereCloud(count).radii) for count in (200, 20000))
        self.assertAlmostEqual(many / few, 1, delta=0.15)


    def test_lamps_send_the_same_light_whatever_their_count(self):
        for count, shining in ((1, True), (10, True), (10000, True), (10000, False)):
            cloud = LampCloud(count, shining)
            materials = list(cloud.surroundings()["materials"].values())
            emissions = [materials[index].get("emission", 0) for index in cloud.materials]
            self.assertEqual(sum(emission > 0 for emission in emissions), count if shining else 1)
            light = math.fsum(emission * (radius / 0.3) ** 2 for emission, radius in zip(emissions, cloud.radii))
            self.assertAlmostEqual(light / POWER, 1, places=5)


class RealDevice(unittest.TestCase):
    def run_scale(self, *arguments):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "scale.json"
            done = subprocess.run([sys.executable, "-B", FOLDER / "scale.py", "--library", f"one={LIBRARY}", "--size",
                                   "32x16", "--rounds", "2", "--seconds", "0.001", "--path-lengths", "3", "--json", path,
                                   *arguments], text=True, capture_output=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            return json.loads(path.read_text(encoding="utf-8")), done.stdout

    def test_it_runs(self):
        report, printed = self.run_scale("--library", f"other={LIBRARY}", "--counts", "10,2e3", "--error-samples", "2")
        self.assertEqual([(cost["count"], cost["program"]) for cost in report["costs"]],
                         [(10, "one"), (10, "other"), (2000, "one"), (2000, "other")])
        self.assertTrue(all(20 <= cost["bytes"] <= 400 for cost in report["costs"][2:]), report["costs"])
        self.assertTrue(all(min(cost["rates"]["3"]) > 0 for cost in report["costs"]), report["costs"])
        for error, same in zip(report["errors"][::2], report["errors"][1::2]):
            self.assertEqual(error["rel_mse"], same["rel_mse"])
            self.assertTrue(0 < error["rel_mse"] < 0.2, error)
            self.assertLess(abs(error["off_by"][1]), 6)
        self.assertIn("| 2,000 ", printed)

    def test_it_runs_with_lamps(self):
        for cloud in "lamps", "dark-lamps":
            report, _ = self.run_scale("--cloud", cloud, "--counts", "1,1e3")
            self.assertTrue(all(min(cost["rates"]["3"]) > 0 for cost in report["costs"]), report["costs"])


if __name__ == "__main__":
    unittest.main()
