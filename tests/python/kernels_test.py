"""Traces of kernels, and the kernel with the material of shaders/MATERIALS.md."""

import dataclasses
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

import numpy as np
import pt
from pt.view._trace import Projection, Tracer, message_of

ROOT = pathlib.Path(__file__).resolve().parents[2]
WHITE, GLOSSY = pt.Material(diffuse=(0.7, 0.6, 0.5)), pt.Material(diffuse=0.3, specular=0.4, glossiness=20)
LAMP = pt.Material(diffuse=0.2, emission=(4, 3, 2))
WALLS = [pt.Plane(normal, 4, material) for normal, material in (
    ((1, 0, 0), WHITE), ((-1, 0, 0), GLOSSY), ((0, 1, 0), WHITE), ((0, -1, 0), LAMP), ((0, 0, 1), WHITE), ((0, 0, -1), GLOSSY))]
BALLS = [pt.Sphere((0, -2, 0), 1.5, GLOSSY), pt.Sphere((2, 2, -1), 1, LAMP), pt.Sphere((-2, 0, -2), 1, WHITE)]
ROOM = pt.Scene(BALLS, WALLS)
CAMERA = pt.Camera((0.3, 0.2, 3.5), (0, 0, 0), vertical_fov=1.2)
SETTINGS = pt.RenderSettings(48, 32, max_path_length=4)
NEAR = 1e-4  # rounding of float32 over distances of 12, at grazing angles
PIXELS = ((5, 7, 0), (24, 16, 3), (40, 25, 1), (30, 9, 70))


def surface_of(position, scene):
    found = [(abs(np.linalg.norm(position - ball.center) - ball.radius), (position - ball.center) / ball.radius, ball.material)
             for ball in scene.spheres]
    found += [(abs(np.dot(plane.normal, position) + plane.offset), np.array(plane.normal, float), plane.material)
              for plane in scene.planes]
    return min(found, key=lambda each: each[0])


def reflectance(material, normal, arriving, leaving):
    mirror = arriving - 2 * np.dot(arriving, normal) * normal
    n = material.glossiness
    return (np.multiply(material.diffuse, 1 / np.pi) +
            np.multiply(material.specular, (n + 2) / (2 * np.pi) * max(np.dot(mirror, leaving), 0) ** n))


def unit(vector):
    return vector / np.linalg.norm(vector)


class Traces(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.tracer = Tracer(None, None)
        cls.addClassCleanup(cls.tracer.close)
        cls.context = cls.enterClassContext(pt.Context())

    def film(self, context, scene, settings, sample):
        settings = dataclasses.replace(settings, first_sample=sample)
        return context.render(scene, CAMERA, settings, 1).radiance

    def check_path(self, trace, branches):
        light, last = np.zeros(3), {0: (np.array(CAMERA.position),)}
        for vertex in trace.vertices:
            distance, normal, material = surface_of(vertex.position, ROOM)
            self.assertLess(distance, NEAR)
            before, *surface = last[vertex.number - 1]
            leaving, expected = unit(vertex.position - before), 1
            if surface:
                normal_before, material_before, arriving, throughput = surface
                expected = throughput * reflectance(material_before, normal_before, arriving, leaving) * max(
                    np.dot(normal_before, leaving), 0) * 2 * np.pi / (branches if vertex.number == 2 else 1)
            np.testing.assert_allclose(vertex.throughput, expected, rtol=2e-3, atol=1e-5)
            last[vertex.number] = vertex.position, normal if np.dot(normal, leaving) < 0 else -normal, material, leaving, vertex.throughput
            light += vertex.throughput * np.array(material.emission)
        np.testing.assert_allclose(trace.radiance, light, rtol=1e-6, atol=1e-7)

    def test_a_path_is_the_sample_s(self):
        settings = dataclasses.replace(SETTINGS, estimator=pt.Estimator.UNIFORM, sampler=pt.Sampler.RANDOM)
        lit = 0
        for x, y, sample in PIXELS:
            trace = self.tracer.trace(ROOM, CAMERA, settings, x, y, sample)
            branches = sum(vertex.number == 2 for vertex in trace.vertices)
            self.assertEqual(len(trace.vertices), 1 + 3 * branches)
            self.check_path(trace, branches)
            np.testing.assert_array_equal(trace.radiance, self.film(self.context, ROOM, settings, sample)[y, x])
            lit += trace.radiance.any()
        self.assertGreater(lit, 1)

    def test_radiance_is_the_film_s(self):
        random = np.random.default_rng(7)
        many = pt.Scene([pt.Sphere(center, 0.2, GLOSSY) for center in random.uniform(-2, 2, (300, 3))] + BALLS[1:2], WALLS)
        for scene, fields in ((ROOM, {}), (ROOM, {"sampler": pt.Sampler.HALTON_CP, "estimator": pt.Estimator.LIGHT}), (many, {})):
            settings = dataclasses.replace(SETTINGS, **fields)
            for x, y, sample in PIXELS[:2]:
                trace = self.tracer.trace(scene, CAMERA, settings, x, y, sample)
                np.testing.assert_array_equal(trace.radiance, self.film(self.context, scene, settings, sample)[y, x])
                self.assertTrue(trace.vertices and max(surface_of(vertex.position, scene)[0] for vertex in trace.vertices) < NEAR)

    def test_the_first_vertex_is_in_its_pixel(self):
        for camera in (CAMERA, dataclasses.replace(CAMERA, projection="orthographic", vertical_fov=None, vertical_extent=3.0),
                       pt.Camera((0, 0, 3e4), (0, -2, 0), vertical_fov=1e-4)):
            scene = ROOM if camera.position[2] < 4 else pt.Scene(BALLS, [])
            for x, y in ((24, 16), (20, 20)):
                trace = self.tracer.trace(scene, camera, SETTINGS, x, y, 1)
                first = trace.vertices[0]
                across, down = message_of(trace, camera, SETTINGS)["vertices"][0]["place"]
                self.assertEqual((int(across * 48), int(down * 32)), (x, y))
                if camera.vertical_fov:
                    rounding = 2**-22 * np.linalg.norm(camera.position)  # relative to the first surface's distance
                    self.assertLess(surface_of(first.position, scene)[0], NEAR + rounding)

    def test_lines_end_before_the_camera_s_plane(self):
        projection = Projection(pt.Camera((0, 0, 0), (0, 0, -1), vertical_fov=np.pi / 2), pt.RenderSettings(20, 10))
        np.testing.assert_allclose(projection.line(np.array([0, 0, -2.0]), np.array([2, 0, -2.0])), [0.5, 0.5, 0.75, 0.5])
        self.assertIsNone(projection.line(np.array([0, 0, 1.0]), np.array([1.0, 0, 2.0])))
        line = projection.line(np.array([0, 1, -1.0]), np.array([0, 1, 1.0]))
        np.testing.assert_allclose(line[:3], [0.5, 0, 0.5], atol=1e-12)
        self.assertLess(line[3], -100)

    def test_what_cannot_be_traced_is_refused(self):
        with self.assertRaisesRegex(ValueError, "is no pixel"):
            self.tracer.trace(ROOM, CAMERA, SETTINGS, 48, 0, 0)
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name, "kernels")
            shutil.copytree(ROOT / "shaders", folder)
            kernel = folder / "pathtrace.comp"
            kernel.write_text(kernel.read_text().replace("traced_sample(radiance * held.film_scale)", "radiance * held.film_scale"))
            tracer = Tracer(None, folder)
            self.addCleanup(tracer.close)
            with self.assertRaisesRegex(ValueError, "traced_sample"):
                tracer.trace(ROOM, CAMERA, SETTINGS, 1, 1, 0)
            (folder / "trace.glsl").unlink()
            with self.assertRaisesRegex(ValueError, "trace.glsl is missing"):
                tracer.trace(ROOM, CAMERA, SETTINGS, 1, 1, 0)

    def test_an_edited_kernel_shows_its_own_path(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name, "course")
            subprocess.run([os.environ["PT_PROGRAM"], "course", folder], check=True)
            tracer = Tracer(None, folder)
            self.addCleanup(tracer.close)
            settings = dataclasses.replace(SETTINGS, estimator=pt.Estimator.UNIFORM, sampler=pt.Sampler.RANDOM)
            trace = tracer.trace(ROOM, CAMERA, settings, 5, 7, 0)
            self.assertEqual([vertex.number for vertex in trace.vertices], [1])
            for difference in ("1-emission", "2-directions", "3-throughput"):
                subprocess.run(["patch", "-s", "-p1", "-d", folder, "-i", ROOT / f"shaders/coursework/{difference}.diff"], check=True)
            context = self.enterContext(pt.Context(shader_dir=folder))
            for x, y, sample in PIXELS:
                trace = tracer.trace(ROOM, CAMERA, settings, x, y, sample)
                self.assertEqual([vertex.number for vertex in trace.vertices], [1, 2, 3, 4])
                self.check_path(trace, 1)
                for before, vertex in zip(trace.vertices, trace.vertices[1:]):
                    height, turn = 1 - 2 * vertex.numbers[0], 2 * np.pi * vertex.numbers[1]
                    side = np.sqrt(1 - height**2)
                    direction = (side * np.cos(turn), side * np.sin(turn), height)  # or the opposite one, above the surface
                    self.assertAlmostEqual(abs(np.dot(unit(vertex.position - before.position), direction)), 1, 6)
                np.testing.assert_array_equal(trace.radiance, self.film(context, ROOM, settings, sample)[y, x])
            kernel = folder / "pathtrace.comp"
            kernel.write_text(kernel.read_text().replace("(2.0 * PI);", "(4.0 * PI);", 1))
            with self.assertRaises(AssertionError):
                self.check_path(tracer.trace(ROOM, CAMERA, settings, 5, 7, 0), 1)


CLOUD = [pt.Sphere(center, 0.25, material) for center, material in zip(np.random.default_rng(3).uniform(-2, 2, (200, 3)), 50 * [WHITE, WHITE,
         GLOSSY, WHITE])]
DOME, FLOOR = pt.Sphere((0, 0, 0), 100, pt.Material(emission=(0.5, 0.7, 1))), [pt.Plane((0, 1, 0), 2, WHITE)]
SCENES = {"a closed room": ROOM, "a sky alone": pt.Scene([BALLS[2], DOME], FLOOR), "a tree": pt.Scene([*CLOUD, BALLS[1], DOME], FLOOR)}
STANDARD_ERRORS = 5.4  # exceeded once in ten million


class Minnaert(unittest.TestCase):
    """The material of shaders/MATERIALS.md has its radiance. Estimators agree with uniform directions, which need no density."""

    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()), "shaders")
        shutil.copytree(ROOT / "shaders", self.folder)
        page = (ROOT / "shaders/MATERIALS.md").read_text(encoding="utf-8")
        subprocess.run(["patch", "-s", "--fuzz=0", "-p2", "-d", self.folder], input=page.split("```diff\n")[1].split("```")[0], text=True,
                       check=True)
        self.context = self.enterContext(pt.Context(shader_dir=self.folder))

    def light(self, scene, estimator):
        """Returns the means of the picture's halves, and their standard errors."""
        settings = pt.RenderSettings(32, 32, max_path_length=3, estimator=estimator, sampler=pt.Sampler.RANDOM)
        image = self.context.render(scene, CAMERA, settings, 512)
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
