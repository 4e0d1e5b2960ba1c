"""Tests of lamp_scale.py: its clouds, and that it runs with a list and a tree of lamps. No times are judged. Arguments:
those of unittest; PT_LIBRARY names the library."""

import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

from lamp_cloud import HIGH, LOW, POWER, LampCloud

FOLDER = pathlib.Path(__file__).resolve().parent
LIBRARY = os.environ["PT_LIBRARY"]


class Clouds(unittest.TestCase):
    def materials(self, cloud):
        return list(cloud.surroundings()["materials"].values())

    def test_send_the_same_light_whatever_their_count(self):
        for count, shining in ((1, True), (10, True), (10000, True), (10000, False)):
            cloud = LampCloud(count, shining)
            emissions = [self.materials(cloud)[index].get("emission", 0) for index in cloud.materials]
            self.assertEqual(sum(emission > 0 for emission in emissions), count if shining else 1)
            light = math.fsum(emission * (radius / 0.3) ** 2 for emission, radius in zip(emissions, cloud.radii))
            self.assertAlmostEqual(light / POWER, 1, places=5)

    def test_dark_ones_have_the_same_places(self):
        lit, dark = LampCloud(100), LampCloud(100, shining=False)
        self.assertEqual((lit.centers, lit.radii), (dark.centers, dark.radii))
        for axis in range(3):
            column = lit.centers[axis::3]
            self.assertEqual(len(column), 100)
            self.assertTrue(LOW[axis] <= min(column) and max(column) <= HIGH[axis])

    def test_brightness_spans_four_powers_of_ten(self):
        cloud = LampCloud(1000)
        self.assertAlmostEqual(math.log10(cloud.emissions[-1] / cloud.emissions[0]), 4)


class Program(unittest.TestCase):
    def test_it_runs(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "lamps.json"
            done = subprocess.run([sys.executable, "-B", FOLDER / "lamp_scale.py", "--library", f"one={LIBRARY}",
                                   "--lamps", "1,1e3", "--size", "32x16", "--rounds", "2", "--seconds", "0.001",
                                   "--json", path], text=True, capture_output=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            costs = json.loads(path.read_text(encoding="utf-8"))["costs"]
        self.assertEqual([(cost["lamps"], cost["program"]) for cost in costs], [(1, "one"), (1000, "one")])
        self.assertTrue(all(min(cost["rates"] + cost["dark_rates"]) > 0 for cost in costs), costs)
        self.assertIn("| 1,000 ", done.stdout)


if __name__ == "__main__":
    unittest.main()
