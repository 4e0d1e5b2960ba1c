import json
import os
import pathlib

from command_line import PT, SCENES, CommandLineTest
from scene_file import read_scene

# These scenes' materials reflect more light than they receive, like in the original coursework.
WARNED_OF = ["coursework-motion.json", "coursework.json"]
FILES = sorted(name for name in os.listdir(SCENES) if name.endswith(".json"))


class Scenes(CommandLineTest):
    def test_each_says_what_it_is_for_and_sets_what_a_picture_needs(self):
        for name in FILES:
            with self.subTest(scene=name):
                path = os.path.join(SCENES, name)
                self.assertRegex(pathlib.Path(path).read_text(encoding="utf-8"), r"\A{\n  // [A-Z\d].*\.\n  \"camera\"")
                scene = read_scene(path)
                for section, key in (("camera", "vertical_fov"), ("film", "width"), ("film", "height"),
                                     ("render", "max_path_length")):
                    self.assertIn(key, scene[section])


class RealDevice(CommandLineTest):
    program = PT

    def test_each_renders(self):
        self.assertIn("thousand-spheres.json", FILES)
        for name in FILES:
            with self.subTest(scene=name):
                self.expect(0, "render", os.path.join(SCENES, name), "--size", "16x8", "--spp", "1", "-o", "a.png",
                            "--stats", "s.json")
                stats = json.loads(self.read("s.json"))
                self.assertEqual((stats["spp"], stats["rejected_samples"]), (1, 0))
                self.assertEqual(len(stats["warnings"]), int(name in WARNED_OF), stats["warnings"])
