"""Tests scenes that the program reads for the package."""

import json
import os
import pathlib
import tempfile
import unittest

import numpy as np
import pt

SCENES = pathlib.Path(__file__).resolve().parents[2] / "cli/scenes"
os.environ.setdefault("LP_NATIVE_VECTOR_WIDTH", "256")  # equal films need equal widths

from pt._program import Program  # noqa: E402

ALL_KINDS = {
    "camera": {"position": [0.1, 1, 6], "look_at": [0, 1, 0], "up": [0.1, 1, 0], "vertical_fov": 33, "aperture": 0.2, "focus": 5.5,
               "shutter": [0.25, 0.75]},
    "render": {"max_path_length": 3, "seed": 2**63, "sampler": "halton-cp", "estimator": "light"},
    "materials": {"lamp": {"emission": [4, 3, 2], "hidden_from_camera": True}, "grey": {"diffuse": 0.1},
                  "red": {"diffuse": [0.6, 0.1, 0.1], "specular": 0.3, "glossiness": 33.3}},
    "planes": [{"normal": [0, 2, 0], "offset": 0.1, "material": "grey"}],
}
PARALLEL = {**ALL_KINDS, "camera": {"position": [0.1, 1, 6], "look_at": [0, 1, 0], "projection": "orthographic",
                                    "vertical_extent": 3}}
SPHERES = [{"center": [2, 4, 2], "radius": 1, "material": "lamp"},
           {"center": [0, 1, 0], "radius": 1, "material": "red", "motion": [0.1, 0, 0]}]
COLORED = [*SPHERES, {"center": [-1, 1, 1], "radius": 0.3, "material": "red", "color": [0.1, 0.9, 0.3]}]
CAPSULES = [{"center": [1, 0, 1], "end": [1, 1, 1], "radius": 0.2, "material": "red", "color": 0.5, "opacity": 0.7},
            {"center": [-1, 0, 1], "end": [-1, 2, 1], "radius": 0.1, "material": "grey"}]
COLUMNS = [{"center": "c.npy", "radius": "r.npy", "color": "k.npy", "material": "red", "opacity": "r.npy"},
           {"center": "c.npy", "radius": 0.05, "motion": [0, 0.2, 0], "material": "grey"}]


class Reading(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        random = np.random.default_rng(1)
        np.save(self.folder / "c.npy", random.uniform(-1, 1, (7, 3)) + (0, 1, 0))
        np.save(self.folder / "r.npy", random.uniform(0.05, 0.3, 7).astype(np.float32))
        np.save(self.folder / "k.npy", random.integers(0, 256, (7, 3), np.uint8))

    def written(self, scene):
        path = self.folder / "scene.json"
        path.write_text(json.dumps(scene))
        return path

    def films(self, path):
        program = Program([str(path), "--size", "16x8"])
        self.addCleanup(program.close)
        read = program.scene()
        with pt.Context() as context:
            context.set_scene(read.scene)
            context.set_camera(read.camera)
            context.set_render(read.settings)
            context.accumulate(2)
            return read, context.film(), pt.Film(program.film(0, 2, [0, 1]))

    def test_films_are_the_program_s(self):
        scenes = ({**ALL_KINDS, "spheres": SPHERES}, {**PARALLEL, "spheres": COLORED, "capsules": CAPSULES},
                  {**ALL_KINDS, "spheres": [*SPHERES, *COLUMNS], "capsules": CAPSULES[:1]})
        for path in (SCENES / "first.json", *map(self.written, scenes)):
            read, mine, its = self.films(path)
            self.assertEqual(mine, its)
        self.assertEqual([pathlib.Path(file).name for file in read.files], ["c.npy", "r.npy", "k.npy", "r.npy", "c.npy"])
        other = {**scenes[-1], "planes": []}
        self.assertNotEqual(self.films(self.written(other))[1], its)

    def test_refusals_are_the_program_s(self):
        with self.assertRaisesRegex(pt.InvalidSceneError, r"scene.json:1: spheres\[0\]: \"radius\" is missing"):
            Program([str(self.written({"spheres": [{"center": [0, 0, 0]}]}))])
        with self.assertRaises(OSError):
            Program([str(self.folder / "absent.json")])
