import copy
import json
import math
import os

import jsonschema
import pt
from command_line import SCENES, CommandLineTest, npy
from manual_test import EITHER, SECTIONS, beyond, names_in, range_of, scene_with, section_rows
from scene_file import read_scene

SCENE = {
    "camera": {"position": [0, 1, 6], "look_at": [0, 1, 0], "up": [0, 1, 0], "vertical_fov": 35, "shutter": [0, 0.5]},
    "film": {"width": 4, "height": 2, "exposure": "auto", "tonemap": "neutral", "gamma": 2.2, "white": [1, 0.9, 0.8]},
    "render": {"max_path_length": 2, "spp": 1, "seed": 7, "sampler": "sobol", "estimator": "mis"},
    "materials": {"a": {"diffuse": 0.5, "specular": [0.1, 0.2, 0.3], "glossiness": 10, "emission": [3, 2, 1]}},
    "spheres": [{"center": [0, 1, 0], "radius": 0.5, "material": "a", "motion": [1, 0, 0],
                 "color": [0.5, 1, 0]}],
    "planes": [{"normal": [0, 1, 0], "offset": 1, "material": "a"}],
    "animation": {"camera.position": [[0, [0, 1, 6]], [10, [1, 1, 6]]], "materials.a.glossiness": [[0, 10], [5, 20]]}}

OTHERS = (None, "zzzz", -1, 0, 0.5, 65, 1e-19, 5e9, 2e18, [], [0, 0, 0], [1, 2, -3], {"zzzz": 1})
OTHERS_IN_ARRAYS = ("a", -1, 0, 2e18, [])

# Schemas cannot compare values with each other.
BEYOND_SCHEMAS = ("unknown material", "must be later than the previous key frame", "as many numbers as the previous",
                  "the name must be a key of")


def places(value, path=()):
    members = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, member in members:
        yield (*path, key)
        yield from places(member, (*path, key))


def changed(place, change):
    scene = copy.deepcopy(SCENE)
    parent = scene
    for key in place[:-1]:
        parent = parent[key]
    change(parent, place[-1])
    return scene


def changes():
    for place in places(SCENE):
        def put(other):
            return lambda parent, key: parent.__setitem__(key, other)

        for other in OTHERS if isinstance(place[-1], str) else OTHERS_IN_ARRAYS:
            yield changed(place, put(other))
        yield changed(place, lambda parent, key: parent.__delitem__(key))
        if isinstance(place[-1], str):
            yield changed(place, lambda parent, key: parent.__setitem__(key + "x", parent.pop(key)))


class Schema(CommandLineTest):
    def setUp(self):
        super().setUp()
        self.context = self.enterContext(pt.Context())
        self.expect(0, "schema")
        self.schema = json.loads(self.output)
        self.validator = jsonschema.Draft7Validator(self.schema)

    def test_it_is_a_schema(self):
        jsonschema.Draft7Validator.check_schema(self.schema)
        self.assertEqual(self.schema["$schema"], "http://json-schema.org/draft-07/schema#")

    def test_scenes_are_valid(self):
        names = [name for name in os.listdir(SCENES) if name.endswith(".json")]
        self.assertGreater(len(names), 10)
        for scene in (*(read_scene(os.path.join(SCENES, name)) for name in names), SCENE, {}):
            self.validator.validate(scene)

    def test_its_keys_words_and_defaults_are_those_of_the_manual(self):
        def plain(text):
            return (text[:1].lower() + text[1:]).replace("`", "").replace('"', "")

        self.assertEqual(sorted(self.schema["properties"]), sorted([*SECTIONS, "animation"]))
        for section in SECTIONS:
            schema = self.schema["properties"][section]
            element = schema.get("items") or schema["additionalProperties"] or schema
            element = element.get("anyOf", [element])[0]
            self.assertEqual(list(element["properties"]), [row[0].strip("`") for row in section_rows(section)])
            for key, words, domain, initial, _ in section_rows(section):
                name = key.strip("`")
                told = element["properties"][name].get("description", "")
                default = "" if name in element.get("required", ()) or not initial else f"; default: {initial}"
                self.assertEqual(plain(told), plain(words + default), name)
                if "enum" in element["properties"][name]:
                    self.assertEqual(names_in(domain), element["properties"][name]["enum"])

    def refusal(self, scene, is_valid):
        """Returns what refuses the scene, and the message. is_valid: the schema accepts the scene, so the library need not check it."""
        self.write("s.json", json.dumps(scene))
        refused = "reader"
        try:
            found = pt.load(self.path("s.json"))
            if is_valid:
                return None, ""
            refused = "library"
            self.context.set_scene(found.scene)
            self.context.set_camera(found.camera)
            self.context.set_render(found.settings)
        except (pt.Error, ValueError) as error:
            return refused, str(error)
        return None, ""

    def test_examples_and_ranges_are_those_of_the_manual(self):
        found = 0
        for section in SECTIONS:
            examples = {names_in(row[0])[0]: json.loads(row[4].strip("`")) for row in section_rows(section)}
            for left_out in EITHER.get(section, ([],)):
                some = {key: value for key, value in examples.items() if key not in left_out}
                self.assertEqual(self.refusal(json.loads(scene_with(section, some)), False), (None, ""))
            rows = {names_in(row[0])[0]: row[2] for row in section_rows(section)}
            limits = {key: (0.0, 1e18) if "color" in text else range_of(text) for key, text in rows.items()}
            limits = {key: ends for key, ends in limits.items() if ends}
            found += len(limits)
            for key, ends in limits.items():
                for numbers, is_valid in (ends, True), (beyond(*ends), False):
                    for number in numbers:
                        value = [number] * 3 if rows[key].startswith("each") else number
                        scene = json.loads(scene_with(section, {key: value}))
                        refused, message = self.refusal(scene, False)
                        self.assertEqual((self.validator.is_valid(scene), refused is None), (is_valid, is_valid), scene)
                        self.assertIn("" if is_valid else key, message)
        self.assertEqual(found, 10)

    def test_it_refuses_what_the_program_refuses_of_columns(self):
        for name, shape in ("a.npy", (1, 3)), ("r.npy", (1,)):
            self.write(name, npy("<f8", shape, [0.5] * math.prod(shape)))
        counts = {True: 0, False: 0}
        for key, values in (("center", ("a.npy", "", 1)), ("radius", ("r.npy", 0.5, 0, -1, "", [1])),
                            ("motion", ("a.npy", [1, 2, 3], [1, 2], 1, "")), ("file", ("a.npy",)),
                            ("color", ("a.npy", [1, 0, 0], 0.5, 2, [1, 0], "", {})), ("material", ("r", 1, None))):
            for value in values:
                spheres = {"center": "a.npy", "radius": "r.npy", "material": "r", key: value}
                scene = {"materials": {"r": {}}, "spheres": [spheres]}
                is_valid = self.validator.is_valid(scene)
                self.assertEqual(self.refusal(scene, is_valid)[0] is None, is_valid, spheres)
                counts[is_valid] += 1
        self.assertGreater(min(counts.values()), 7, counts)

    def test_it_refuses_what_the_program_refuses(self):
        counts = {"valid": 0, "reader": 0, "library": 0, "beyond": 0}
        for scene in changes():
            spheres = scene.get("spheres")
            if isinstance(spheres, list) and any(isinstance(each, dict) and isinstance(each.get("center"), str)
                                                 for each in spheres):
                continue
            is_valid = self.validator.is_valid(scene)
            refused, message = self.refusal(scene, is_valid)
            if is_valid and refused:
                self.assertTrue(any(rule in message for rule in BEYOND_SCHEMAS), (scene, message))
                refused = "beyond"
            elif not is_valid:
                self.assertIsNotNone(refused, scene)
            counts[refused or "valid"] += 1
        for kind, least in (("valid", 50), ("reader", 200), ("library", 30), ("beyond", 2)):
            self.assertGreater(counts[kind], least, counts)
