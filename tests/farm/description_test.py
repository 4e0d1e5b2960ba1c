"""A scene by `pt render --describe` is the scene itself: its film has the bytes of the program's. Skipped where
distributed, without which pt.farm is not, or zstd, by which the program packs films, is not installed.

Arguments: PT."""

import json
import os
import pickle
import shutil
import subprocess
import sys
import tempfile
import unittest

import pt

try:
    from pt.farm._job import job_of
except ImportError:
    print("skipped: Dask's distributed is not installed")
    sys.exit(77)
if not shutil.which("zstd"):
    print("skipped: zstd is not installed")
    sys.exit(77)

PROGRAM = sys.argv.pop(1)
DATA = """3
Properties=species:S:1:pos:R:3:radius:R:1
H 0 0 0 0.5
O 1.5 0 0 0.7
N 0 1.5 1 0.6
"""
CAMERA = {"position": [0, 0, 5], "look_at": [0, 0, 0]}
MATERIALS = {"white": {"diffuse": 1}, "sky": {"emission": 1}}
SKY = {"center": [0, 0, 0], "radius": 100, "material": "sky"}
BALL = {"center": [1, 0, 0], "radius": 1, "material": "white", "motion": [0.1, 0, 0]}
SCENES = {
    "plain": {"camera": CAMERA, "materials": MATERIALS, "spheres": [SKY, BALL]},
    "coloured": {"camera": CAMERA, "materials": MATERIALS, "spheres": [SKY, {**BALL, "color": [0.2, 0.5, 1]}]},
    "figure": {"figure": {}, "particles": [{"file": "a.xyz"}]},
    "all": {"camera": CAMERA, "materials": MATERIALS, "spheres": [SKY, {**BALL, "color": 0.5}, BALL],
            "planes": [{"normal": [0, 1, 0], "offset": 3, "material": "white"}],
            "particles": [{"file": "a.xyz", "material": "white", "color": {"column": "y"}},
                          {"file": "a.xyz", "material": "white", "radius": 0.1, "color": [1, 0.5, 0]}]}}


class Description(unittest.TestCase):
    def program(self, *arguments):
        command = [PROGRAM, "render", "s.json", "--size", "20x16", "--spp", "4", "-q", *arguments]
        return subprocess.run(command, cwd=self.folder, check=True, capture_output=True).stdout

    def films(self, scene):
        """Of the program, and of what it says of the scene."""
        with tempfile.TemporaryDirectory() as self.folder:
            for name, text in ("a.xyz", DATA), ("s.json", json.dumps(scene)):
                with open(os.path.join(self.folder, name), "w", encoding="utf-8") as file:
                    file.write(text)
            self.program("--film", "a.ptfilm")
            description = json.loads(self.program("--describe", "-"))
            unpack = ["zstd", "-dcq", os.path.join(self.folder, "a.ptfilm")]
            wanted = subprocess.run(unpack, check=True, capture_output=True).stdout
        job = pickle.loads(pickle.dumps(job_of(description, None)))  # as it goes to workers
        os.environ.update(job.environment)
        with pt.Context() as context:
            context.set_scene(job.scene)
            context.set_camera(job.camera)
            context.set_render(job.settings)
            context.accumulate(description["samples"])
            with tempfile.TemporaryDirectory() as folder:
                path = os.path.join(folder, "b.ptfilm")
                context.film().save(path)
                with open(path, "rb") as file:
                    return wanted, file.read()

    def test_films_are_equal(self):
        films = {name: self.films(scene) for name, scene in SCENES.items()}
        for name, (wanted, found) in films.items():
            self.assertEqual(wanted, found, name)
        self.assertEqual(len({wanted for wanted, _ in films.values()}), len(films))  # each scene its own


if __name__ == "__main__":
    unittest.main()
