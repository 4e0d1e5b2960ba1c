"""Tests the radiance of shaders/MATERIALS.md's material, and all estimators against uniform directions, which need no density."""

import pathlib
import shutil
import subprocess
import tempfile
import unittest

import numpy as np
import pt

SHADERS = pathlib.Path(__file__).resolve().parents[2] / "shaders"
WHITE, GLOSSY = pt.Material(diffuse=(0.7, 0.6, 0.5)), pt.Material(diffuse=0.3, specular=0.4, glossiness=4)
LAMP, SKY = pt.Material(diffuse=0.2, emission=(4, 3, 2)), pt.Material(emission=(0.5, 0.7, 1))
ROOM = [pt.Plane(normal, 4, material) for normal, material in (
    ((1, 0, 0), WHITE), ((-1, 0, 0), GLOSSY), ((0, 1, 0), WHITE), ((0, -1, 0), LAMP), ((0, 0, 1), WHITE), ((0, 0, -1), WHITE))]
FLOOR = [pt.Plane((0, 1, 0), 2, WHITE)]
BALLS = [pt.Sphere((-1, -1, 0), 1, GLOSSY), pt.Sphere((1.2, 1, -1), 1.5, LAMP), pt.Sphere((-2, 1, -2), 1, WHITE)]
CLOUD = [pt.Sphere(center, 0.25, material) for center, material in zip(np.random.default_rng(3).uniform(-2, 2, (200, 3)), 50 * [WHITE, WHITE,
         GLOSSY, WHITE])]
DOME = [pt.Sphere((0, 0, 0), 100, SKY)]
SCENES = {"a closed room": pt.Scene(BALLS, ROOM), "a sky alone": pt.Scene(BALLS[2:] + DOME, FLOOR),
          "a tree": pt.Scene(CLOUD + BALLS[1:2] + DOME, FLOOR)}
CAMERA = pt.Camera((0.3, 0.2, 3.8), (0, 0, 0), vertical_fov=1.2)
SAMPLES = 512
STANDARD_ERRORS = 5.4  # exceeded once in ten million


class Minnaert(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()), "shaders")
        shutil.copytree(SHADERS, self.folder)
        page = (SHADERS / "MATERIALS.md").read_text(encoding="utf-8")
        subprocess.run(["patch", "-s", "--fuzz=0", "-p2", "-d", self.folder], input=page.split("```diff\n")[1].split("```")[0], text=True,
                       check=True)
        self.context = self.enterContext(pt.Context(shader_dir=self.folder))

    def light(self, scene, estimator):
        """Returns the means of the picture's halves, and their standard errors."""
        settings = pt.RenderSettings(32, 32, max_path_length=3, estimator=estimator, sampler=pt.Sampler.RANDOM)
        image = self.context.render(scene, CAMERA, settings, SAMPLES)
        self.assertEqual(image.stats.rejected_samples, 0)
        means, errors = (each.reshape(2, -1) for each in (image.radiance, image.standard_error))
        return means.mean(axis=1), np.sqrt((errors**2).sum(axis=1)) / means.shape[1]

    def difference(self, scene, estimator, expected):
        """Returns the largest difference in units of the bound, and the bound relative to the light."""
        (mean, error), (right, error_of_right) = self.light(scene, estimator), expected
        bound = STANDARD_ERRORS * np.sqrt(3) * np.hypot(error, error_of_right)  # errors of a pixel's colors may be correlated
        return (abs(mean - right) / bound).max(), (bound / right).max()

    def test_estimators_agree_on_every_kind_of_scene(self):
        for name, scene in SCENES.items():
            expected = self.light(scene, pt.Estimator.UNIFORM)
            for estimator in (pt.Estimator.COSINE, pt.Estimator.BSDF, pt.Estimator.LIGHT, pt.Estimator.MIS):
                with self.subTest(scene=name, estimator=estimator.name):
                    difference, share = self.difference(scene, estimator, expected)
                    self.assertLessEqual(difference, 1)
                    self.assertLess(share, 0.05)

    def test_a_floor_under_a_white_sky_has_the_radiance_of_the_page(self):
        """The albedo 1/2 gives the radiance 1/2 from above, and 1/4 at 60 degrees."""
        floor = pt.Scene([pt.Sphere((0, 0, 0), 1000, pt.Material(emission=1))], [pt.Plane((0, 1, 0), 0, pt.Material(diffuse=0.5))])
        for position, radiance in ((0, 1, 0), 0.5), ((0, 1, 3**0.5), 0.25):
            camera = pt.Camera(position, (0, 0, 0), (1, 0, 0), vertical_extent=1)
            for estimator, samples in (pt.Estimator.BEST, 1), (pt.Estimator.UNIFORM, 16384):
                image = self.context.render(floor, camera, pt.RenderSettings(3, 2, max_path_length=2, estimator=estimator), samples)
                rounding = 1e-6 * radiance
                noise = STANDARD_ERRORS * image.standard_error if samples > 1 else 0
                self.assertTrue((abs(image.radiance - radiance) <= rounding + noise).all(), image.radiance)

    def test_a_wrong_density_stands_out(self):
        path = self.folder / "phong.glsl"
        text = path.read_text()
        self.assertEqual(text.count("(1.5 / PI)"), 1)
        expected = self.light(SCENES["a sky alone"], pt.Estimator.UNIFORM)
        path.write_text(text.replace("(1.5 / PI)", "(1.35 / PI)"))
        self.context.reload_shaders()
        self.assertGreater(self.difference(SCENES["a sky alone"], pt.Estimator.BSDF, expected)[0], 1)
