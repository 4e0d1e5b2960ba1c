"""Tests scale.py without judging times. PT_LIBRARY names the library."""

import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

from clouds import COLORS, EXTENT, KINDS, LAYERS, MATERIALS, POWER, DenseCloud, LampCloud, SparseCloud, SphereCloud
from mitsuba_scene import obstacle
from scale import difference_of_means, mean_ratios, relative_error

FOLDER = pathlib.Path(__file__).resolve().parent
LIBRARY = os.environ["PT_LIBRARY"]


class Reckoning(unittest.TestCase):
    def test_errors_are_relative_to_the_reference(self):
        self.assertAlmostEqual(relative_error([1, 2, 0.1], [1, 1, 0]), (0 + 1 / 1.01 + 1) / 3)

    def test_means_differ_by_a_share_and_by_standard_errors(self):
        share, deviations = difference_of_means([2, 2, 2, 4, 4, 4], [2, 2, 2, 2, 2, 2])
        self.assertAlmostEqual(share, 0.5)
        self.assertAlmostEqual(deviations, 2 ** 0.5)


    def test_ratios_of_pictures_with_the_same_light_have_a_geometric_mean(self):
        errors = [{"cloud": "a", "program": "x", "ratio": ratio, "off_by": (off, 0)}
                  for ratio, off in ((0.5, 0), (2, 0.001), (9, 0.2))]
        (mean, error, largest, count), of_all = mean_ratios(errors).values()
        self.assertEqual((mean, largest, count), (1, 2, 2))
        self.assertAlmostEqual(math.log(error), math.log(2))
        self.assertEqual(of_all[:1], (1,))


class Clouds(unittest.TestCase):
    def test_columns_hold_spheres_that_stay_away_from_camera_and_lamp(self):
        cloud = SphereCloud(100)
        scene = cloud.surroundings()
        self.assertEqual((len(cloud.centers), len(cloud.radii), len(cloud.materials)), (300, 100, 100))
        self.assertEqual({list(MATERIALS)[i] for i in cloud.materials}, set(COLORS))
        for i, radius in enumerate(cloud.radii):
            center = cloud.centers[3 * i:3 * i + 3]
            self.assertLessEqual(abs(center[0]), EXTENT[0] / 2)
            self.assertLess(center[2] + radius, scene["camera"]["position"][2])

    def test_clouds_of_all_counts_fill_as_much(self):
        few, many = (sum(radius ** 3 for radius in SphereCloud(count).radii) for count in (200, 20000))
        self.assertAlmostEqual(many / few, 1, delta=0.15)

    def test_seeds_give_other_clouds_of_the_same_kind(self):
        for kind, cloud in KINDS.items():
            one, same, other = cloud(200, 5), cloud(200, 5), cloud(200, 6)
            self.assertEqual(one.centers, same.centers, kind)
            self.assertNotEqual(one.centers, other.centers, kind)
            for each in one, other:
                scene = each.surroundings()
                self.assertIsNone(obstacle(scene), kind)
                for sphere in scene["spheres"][:1]:
                    self.assertGreater(math.dist(sphere["center"], scene["camera"]["position"]), sphere["radius"], kind)

    def test_kinds_differ_as_their_names_say(self):
        for cloud, factor in ((DenseCloud, 0.8 / 0.45), (SparseCloud, 0.15 / 0.45)):
            self.assertAlmostEqual(sum(cloud(100).radii) / sum(SphereCloud(100).radii), factor, places=5)
        self.assertEqual(len(set(KINDS["layered"](100).centers[1::3])), LAYERS)
        spheres, planes = ({kind: len(cloud(9).surroundings()[what]) for kind, cloud in KINDS.items()}
                           for what in ("spheres", "planes"))
        self.assertEqual((spheres["spheres"], spheres["near-ball"], spheres["many-lamps"], spheres["open"]), (1, 2, 24, 2))
        self.assertEqual((planes["spheres"], planes["closed"], planes["open"]), (1, 6, 0))

    def test_lamps_send_the_same_light_whatever_their_count(self):
        for count, shining in ((1, True), (10, True), (10000, True), (10000, False)):
            cloud = LampCloud(count, shining=shining)
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

    def test_it_draws_clouds_of_kinds(self):
        report, printed = self.run_scale("--library", f"other={LIBRARY}", "--clouds", "sparse,open", "--seeds", "2",
                                         "--counts", "30", "--error-samples", "8")
        self.assertEqual([error["cloud"] for error in report["errors"][::4]], ["sparse", "open"])
        self.assertRegex(printed, r"\| all +\| other +\| ")

    def test_it_runs_with_lamps(self):
        for cloud in "lamps", "dark-lamps":
            report, _ = self.run_scale("--clouds", cloud, "--counts", "1,1e3")
            self.assertTrue(all(min(cost["rates"]["3"]) > 0 for cost in report["costs"]), report["costs"])


if __name__ == "__main__":
    unittest.main()
