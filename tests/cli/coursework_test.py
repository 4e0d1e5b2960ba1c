"""Tests the steps of shaders/COURSEWORK.md. Each diff must apply, and its picture must agree with other renderers."""

import os
import shutil
import subprocess

import numpy
import pt

from command_line import PT, SCENES, CommandLineTest, read_exr_channels

ROOT = os.path.join(SCENES, "..", "..")
REFERENCES = os.path.join(ROOT, "tests", "reference")
STEPS = (("1-light", "coursework", 1, "coursework_L1"), ("2-directions", "coursework-diffuse", 2, "coursework-diffuse_L2"),
         ("3-paths", "coursework-diffuse", 6, "coursework-diffuse_L6"), ("4-gloss", "coursework", 6, "coursework_L6"),
         ("5-points", "coursework", 6, "coursework_L6"), ("6-lamps", "coursework", 6, "coursework_L6"),
         ("7-motion", "coursework-motion", 2, None))
MOST_CHANGE = 0.15  # of all light; every step changes more


def pixels_of(path):
    channels = read_exr_channels(path)
    image = numpy.stack([numpy.array(channels[name]) for name in "RGB"], axis=2)
    side = len(image) // 64
    return image.reshape(64, side, 128, side, 3).mean(axis=(1, 3))


class Coursework(CommandLineTest):
    program = PT

    def render(self, scene, length, *more):
        self.expect(0, "render", os.path.join(SCENES, f"{scene}.json"), "--size", "128x64", "--max-path-length", str(length), "-q", "-o",
                    "a.exr", *more)
        return pixels_of(self.path("a.exr"))

    def test_steps(self):
        shutil.copytree(os.path.join(ROOT, "shaders"), self.path("kernels"))
        course = os.path.join(ROOT, "shaders", "coursework")
        shutil.copy(os.path.join(course, "start.comp"), self.path("kernels/pathtrace.comp"))
        images = {}
        for step, scene, length, reference in STEPS:
            subprocess.run(["patch", "-s", "--fuzz=0", "-p1", "-d", self.path("kernels"), "-i", os.path.join(course, f"{step}.diff")],
                           check=True)
            images[step] = self.render(scene, length, "--spp", "64", "--shader-dir", "kernels")
            converged = (pixels_of(os.path.join(REFERENCES, f"{reference}.exr")) if reference
                         else self.render(scene, length, "--spp", "256"))
            with self.subTest(step=step):
                comparison = pt.compare(images[step], converged)
                self.assertNotEqual(comparison.light, pt.Light.DIFFERENT, comparison)
                self.assertLess(comparison.smallest_change, MOST_CHANGE)
            if step == "4-gloss":
                done = subprocess.run([PT, "selftest", "--directions", "--shader-dir", self.path("kernels")], capture_output=True,
                                      text=True)
                verdicts = [line.split()[0] for line in done.stdout.splitlines()
                            if "hemisphere, uniform" in line or "by cosine: cosine" in line]
                self.assertEqual(verdicts, ["pass"] * 7)
        shorter = pixels_of(os.path.join(REFERENCES, "coursework-diffuse_L2.exr"))
        self.assertEqual(pt.compare(images["3-paths"], shorter).light, pt.Light.DIFFERENT)
