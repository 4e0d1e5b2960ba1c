import json
import os
import signal

from command_line import npy, read_png
from watching import WatchTest, scene_text


class Scenes(WatchTest):
    def setUp(self):
        super().setUp()
        self.write("s.json", scene_text(3))

    def width(self):
        return read_png(self.path("a.png"))[0]

    def test_each_way_to_save(self):
        pt = self.watch()
        pt.line_with("wrote a.png: 3x2")
        pt.line_with("watching s.json; Ctrl-C ends")
        self.write("s.json", scene_text(4))
        pt.line_with("pt: changed: s.json")
        pt.line_with("wrote a.png: 4x2")
        self.assertEqual(self.width(), 4)
        self.save("s.json", scene_text(5))
        pt.line_with("wrote a.png: 5x2")
        self.save("s.json", scene_text(6))
        pt.line_with("wrote a.png: 6x2")
        self.write("other.json", scene_text(9))
        os.utime(self.path("s.json"))
        self.save("s.json", scene_text(6))
        self.save("s.json", scene_text(7))
        pt.line_with("wrote a.png: 7x2")
        self.assertEqual(self.width(), 7)
        self.assertEqual(pt.end(), 0)
        self.assertEqual(pt.count("wrote"), 5, pt.seen)

    def test_columns_of_files(self):
        scene = json.loads(scene_text(3))
        scene["spheres"] = [{"center": "data/a.npy", "radius": 1, "material": "light"}]
        os.mkdir(self.path("data"))
        self.write("data/a.npy", npy("<f4", (1, 3), [0, 0, 0]))
        self.write("s.json", json.dumps(scene))
        pt = self.watch()
        pt.line_with("watching s.json and its columns; Ctrl-C ends")
        self.save("data/a.npy", npy("<f4", (2, 3), [0, 0, 0, 1, 0, 0]))
        pt.line_with("pt: changed: data/a.npy")
        pt.line_with("wrote a.png")
        self.save("data/a.npy", npy("<f4", (2, 3), [0, 0, 0]))
        pt.line_with("pt: s.json: spheres[0].center: data/a.npy: ends after 1 of 2 rows")
        self.save("data/a.npy", npy("<f4", (1, 3), [0, 0, 0]))
        pt.line_with("wrote a.png")
        self.save("s.json", scene_text(4))
        pt.line_with("wrote a.png: 4x2")
        self.assertEqual(pt.end(), 0)

    def test_a_wrong_scene_is_told_once_and_waited_out(self):
        self.write("s.json", "[")
        pt = self.watch("--piece-rows", "1", "--stats", "stats.json")
        pt.line_with("pt: s.json:1: must contain an object")
        pt.line_with("watching")
        self.assertEqual(self.files(), ["s.json"])
        self.save("s.json", scene_text(3))
        pt.line_with("wrote a.png: 3x2")
        picture = self.contents("a.png")
        self.save("s.json", "{")
        pt.line_with("pt: s.json:1:2: syntax error")
        self.save("s.json", scene_text(-1))
        pt.line_with("width")
        os.remove(self.path("s.json"))
        pt.line_with("pt: cannot read s.json: No such file or directory")
        self.assertEqual(self.contents("a.png"), picture)
        self.save("s.json", scene_text(4))
        pt.line_with("wrote a.png: 4x2")
        self.assertEqual(pt.end(signal.SIGTERM), 0)
        self.assertEqual(json.loads(self.read("stats.json"))["width"], 4)
        self.assertEqual(pt.count("syntax error"), 1)
        self.assertEqual(pt.count("cannot read"), 1)

    def test_a_folder_may_be_replaced(self):
        os.mkdir(self.path("folder"))
        self.write("folder/s.json", scene_text(3))
        os.remove(self.path("s.json"))
        os.symlink("folder/s.json", self.path("s.json"))
        pt = self.watch()
        pt.line_with("watching")
        os.rename(self.path("folder"), self.path("aside"))
        pt.line_with("cannot read s.json")
        os.mkdir(self.path("folder"))
        self.write("folder/s.json", scene_text(4))
        pt.line_with("wrote a.png: 4x2")
        self.write("folder/s.json", scene_text(5))
        pt.line_with("wrote a.png: 5x2")
        self.assertEqual(pt.end(), 0)

    def test_what_no_edit_can_mend_ends_it(self):
        for code, arguments, environment in ((6, ["-o", "none/b.png"], {}), (2, ["-o", "b.tiff"], {}),
                                             (4, [], {"FAKE_PT_FAIL": "create:-5", "FAKE_PT_MESSAGE": "none"}),
                                             (5, [], {"FAKE_PT_FAIL": "accumulate:-8", "FAKE_PT_MESSAGE": "lost"})):
            with self.subTest(code=code):
                self.expect(code, "render", "s.json", "--watch", "-o", "a.png", *arguments, **environment)
        os.remove(self.path("s.json"))
        self.expect(6, "render", "s.json", "--watch", "-o", "a.png", error="cannot read s.json")
        os.mkfifo(self.path("s.json"))
        self.expect(2, "render", "s.json", "--watch", "-o", "a.png", error="not a regular file")
        self.expect(2, "render", "-", "--watch", "-o", "a.png", error="--watch needs a file")

    def test_a_change_stops_the_rendering(self):
        pt = self.watch("--progress", "json", "--spp", "1000000", FAKE_PT_SAMPLE_MS=200)  # takes two days
        pt.line_with('"fraction"')
        self.write("s.json", "{")
        pt.line_with("syntax error")
        self.assertNotIn("a.png", self.files())
        self.write("s.json", scene_text(4))
        pt.line_with('"fraction"')
        self.assertEqual(pt.end(), 130)
        self.assertEqual(pt.count("pt: stopped by SIGINT"), 1)
        self.assertEqual(pt.count("wrote"), int("a.png" in self.files()))
