import dataclasses
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

import numpy as np
import pt

SCENES = pathlib.Path(__file__).resolve().parents[2] / "cli/scenes"
os.environ.setdefault("LP_NATIVE_VECTOR_WIDTH", "256")  # equal films need equal vector widths

SIZE = {"film.width": 16, "film.height": 8}
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

    def program(self, *words, code=0):
        done = subprocess.run([os.environ["PT_PROGRAM"], *words, "-q"], capture_output=True, cwd=self.folder)
        self.assertEqual(done.returncode, code, done.stderr)

    def film_of(self, path):
        loaded = pt.load(path, overrides=SIZE)
        with pt.Context() as context:
            context.set_scene(loaded.scene)
            context.set_camera(loaded.camera)
            context.set_render(loaded.settings)
            context.accumulate(2)
            context.film().save(self.folder / "a.ptfilm")
        return loaded

    def test_films_are_the_program_s(self):
        scenes = ({**ALL_KINDS, "spheres": SPHERES}, {**PARALLEL, "spheres": COLORED, "capsules": CAPSULES},
                  {**ALL_KINDS, "spheres": [*SPHERES, *COLUMNS], "capsules": CAPSULES[:1]})
        for path in (SCENES / "first.json", *map(self.written, scenes)):
            loaded = self.film_of(path)
            self.program("render", path, "--size", "16x8", "--first-sample", "2", "--spp", "2", "--film", "b.ptfilm")
            self.program("merge", "a.ptfilm", "b.ptfilm", "--film", "sum.ptfilm")
            self.program("render", path, "--size", "16x8", "--spp", "4", "--film", "one.ptfilm")
            self.assertEqual((self.folder / "sum.ptfilm").read_bytes(), (self.folder / "one.ptfilm").read_bytes())
        self.assertEqual([file.name for file in loaded.files], ["c.npy", "r.npy", "k.npy", "r.npy", "c.npy"])
        self.film_of(self.written({**scenes[-1], "planes": []}))
        self.program("merge", "a.ptfilm", "b.ptfilm", "--film", "sum.ptfilm", code=2)

    def test_arrays_are_the_file_s_memory(self):
        array = pt.load(self.written({**ALL_KINDS, "spheres": COLUMNS})).scene.sphere_arrays[0]
        self.assertEqual(array.copied, ())
        np.testing.assert_array_equal(array.center, np.load(self.folder / "c.npy"))
        np.testing.assert_array_equal(array.color, np.load(self.folder / "k.npy"))
        with self.assertRaises(ValueError):
            array.center[0] = 0

    def test_refusals_name_the_place(self):
        with self.assertRaisesRegex(pt.InvalidArgumentError, "^--spp: must be a whole number from 1 to .*, is 0$"):
            pt.load("s.json", text="{}", overrides=[pt.Override("render.spp=0", "--spp")])
        with self.assertRaisesRegex(pt.InvalidSceneError, "^s.json: has no animation"):
            pt.load("s.json", text="{}", frame=1)
        with self.assertRaisesRegex(pt.FileError, "cannot read .*absent.json: No such file or directory"):
            pt.load(self.folder / "absent.json")
        with self.assertRaisesRegex(pt.FileError, r"spheres\[0\].center: cannot read "):
            pt.load(self.written({**ALL_KINDS, "spheres": [{**COLUMNS[0], "center": "absent.npy"}]}))

    def test_errors_of_libpt_get_lines_and_overrides(self):
        text = '{"materials": {"a": {}},\n"spheres": [{"center": [0, 0, 0],\n"radius": -1, "material": "a"}]}'
        for overrides, kind, words in (({}, pt.InvalidSceneError, "s.json:3: spheres[0].radius = -1: must be > 0"),
                                       ({"spheres[0].radius": -2}, pt.InvalidArgumentError, "spheres[0].radius = -2: must be > 0")):
            loaded = pt.load("s.json", text=text, overrides=overrides)
            with pt.Context() as context, self.assertRaises(pt.InvalidSceneError) as refused:
                context.set_scene(loaded.scene)
            explained = loaded.explained(refused.exception)
            self.assertIs(type(explained), kind)
            self.assertEqual(str(explained), words)

    def test_a_frame_has_its_values_and_seed(self):
        text = json.dumps({**ALL_KINDS, "animation": {"camera.position": [[0, [0, 1, 6]], [2, [2, 1, 6]]]}})
        loaded = pt.load("s.json", text=text, frame=1, overrides={"camera.shutter": [0, 0], "render.seed": 5})
        self.assertEqual((loaded.camera.position, loaded.settings.seed), ((1.0, 1.0, 6.0), 6))

    def test_how_a_picture_is_shown(self):
        keys = pt.scene_schema()["properties"]["film"]["properties"]
        self.assertEqual({*keys} - {"width", "height"}, {each.name for each in dataclasses.fields(pt.Display)})
        shown = {"exposure": -1.5, "tonemap": "agx", "gamma": 2.5, "white": [1, 2, 0.5]}
        loaded = pt.load("s.json", text=json.dumps({"film": shown, "render": {"spp": 9}}))
        self.assertEqual(loaded.display.fields(), {"exposure": -1.5, "curve": pt.Curve.AGX, "gamma": 2.5, "white": (1, 2, 0.5)})
        self.assertEqual((loaded.samples, json.loads(json.dumps(vars(loaded.display)))), (9, shown))
        for name in keys["tonemap"]["enum"]:
            self.assertEqual(pt.load("s.json", text=f'{{"film": {{"tonemap": "{name}"}}}}').display.tonemap, name)
        loaded = pt.load("s.json", text="{}")
        self.assertEqual((loaded.samples, loaded.display), (None, pt.Display()))
