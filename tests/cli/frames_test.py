import json
import os
import signal

from command_line import PT, CommandLineTest, read_png

SCENE = {"camera": {"position": [0, 0, 4], "look_at": [0, 0, 0], "shutter": [0, 0.5]},
         "film": {"width": 16, "height": 8, "exposure": 0}, "render": {"max_path_length": 1, "spp": 16, "seed": 5},
         "materials": {"a": {"emission": 0.5}},
         "spheres": [{"center": [0, 0, 0], "radius": 1, "material": "a"}]}
ANIMATION = {"spheres[0].center": [[0, [-2, 0, 0]], [4, [2, 0, 0]]], "materials.a.emission": [[0, 0.2], [4, 0.6]],
             "camera.position": [[2, [0, 0, 4]], [4, [0, 1, 4]]]}


class FramesTest(CommandLineTest):
    def setUp(self):
        super().setUp()
        self.write("s.json", json.dumps({**SCENE, "animation": ANIMATION}))

    def pixels(self, name):
        return read_png(self.path(name))


class Frames(FramesTest):
    def test_each_frame_has_its_files(self):
        self.expect(0, "render", "s.json", "--frames", "9-11", "-o", "f-###.png", "--film", "#.ptfilm", "--stats", "#.json")
        self.assertEqual(self.files(), sorted(f"{name}" for frame in (9, 10, 11) for name in (
            f"f-{frame:03}.png", f"{frame}.ptfilm", f"{frame}.json")) + ["s.json"])
        self.assertEqual([json.loads(self.read(f"{frame}.json"))["seed"] for frame in (9, 10, 11)], [14, 15, 16])
        self.assertEqual(self.output.count("wrote f-"), 3)

    def test_what_is_there_is_left_out_on_request(self):
        arguments = ("render", "s.json", "--frames", "0-3", "-o", "#.png", "--stats", "#.json", "-q")
        self.expect(0, *arguments)
        os.remove(self.path("1.png"))
        os.remove(self.path("2.json"))
        self.write("3.png", "kept")
        self.write("0.png", "kept")
        self.expect(0, *arguments, "--skip-existing")
        self.assertEqual((self.read("0.png"), self.read("3.png")), ("kept", "kept"))
        self.assertEqual((self.pixels("1.png")[:2], json.loads(self.read("2.json"))["seed"]), ((16, 8), 7))
        self.expect(0, *arguments, "--skip-existing", FAKE_PT_FAIL="create:-5")
        self.expect(4, *arguments, error="none", FAKE_PT_FAIL="create:-5", FAKE_PT_MESSAGE="none")

    def test_the_time_is_that_of_each_frame(self):
        self.expect(0, "render", "s.json", "--frames", "0-1", "-o", "#.png", "--stats", "#.json", "--spp", "1000000",
                    "--time", "0.2", FAKE_PT_SAMPLE_MS=20)
        self.assertEqual([json.loads(self.read(f"{frame}.json"))["ended_by"] for frame in (0, 1)], ["time", "time"])

    def test_a_stop_leaves_whole_frames(self):
        submission = 2 * 16 * 4 + 5
        self.expect(130, "render", "s.json", "--frames", "4-9", "-o", "#.png", "-q",
                    error="pt: stopped by SIGINT in frame 6", FAKE_PT_SIGNAL=f"{int(signal.SIGINT)}:{submission}")
        self.assertEqual(self.files(), ["4.png", "5.png", "s.json"])

    def test_what_is_refused(self):
        self.expect_refusals("render", (
                (2, ("s.json", "-o", "a.png", "--frames", "0"), "-o a.png: with --frames the name needs # signs"),
                (2, ("s.json", "-o", "#.png", "-o", "-", "--format", "png", "--frames", "0"), "-o -: with --frames"),
                (2, ("s.json", "-o", "#.png", "--stats", "s", "--frames", "0"), "--stats s: with --frames"),
                (2, ("s.json", "-o", "#.png", "--frames", "3-1"), "--frames: must be two whole numbers like 0-23"),
                (2, ("s.json", "-o", "#.png", "--frames", "0", "--watch"), "--watch: cannot be used with --frames"),
                (2, ("s.json", "--film", "f.ptfilm", "--frames", "0"), "--film f.ptfilm: with --frames the name needs"),
                (2, ("s.json", "-o", "#.png", "--checkpoint", "#.ptfilm", "--frames", "0"), "--checkpoint: cannot be used with --frames"),
                (2, ("s.json", "-o", "#.png", "--preview-every", "9", "--frames", "0"), "--preview-every: cannot be used with --frames"),
                (2, ("s.json", "-o", "#.png", "--frames", "0", "--set", "spheres[5].radius=1"), "--set spheres[5].")))

    def test_the_target_error_of_one_frame_is_missed(self):
        arguments = ("render", "s.json", "--frames", "0-1", "-o", "#.png", "--spp", "16", "--error")
        self.assertEqual(self.run_pt(*arguments, "5%"), 7)
        self.assertEqual(self.files(), ["0.png", "1.png", "s.json"])
        self.expect(0, *arguments, "7%")


class RealDevice(FramesTest):
    program = PT

    def test_a_frame_is_the_picture_of_its_scene(self):
        self.expect(0, "render", "s.json", "--frames", "1-5", "-o", "#.png", "-q")
        pictures = {frame: self.pixels(f"{frame}.png") for frame in (1, 3, 4, 5)}
        self.assertEqual(len({str(picture) for picture in pictures.values()}), 4)
        for frame, picture in pictures.items():
            at, middle = min(frame, 4), min(frame + 0.25, 4)
            scene = {**SCENE, "materials": {"a": {"emission": 0.2 + 0.1 * middle}},
                     "spheres": [{**SCENE["spheres"][0], "center": [at - 2, 0, 0], "motion": [float(frame < 4), 0, 0]}],
                     "camera": {**SCENE["camera"], "position": [0, max(0, middle - 2) / 2, 4]},
                     "render": {**SCENE["render"], "seed": 5 + frame}}
            self.write("one.json", json.dumps(scene))
            self.expect(0, "render", "one.json", "-o", "one.png", "-q")
            self.assertEqual(self.pixels("one.png"), picture, frame)

    def test_options_count_more_than_the_animation(self):
        self.expect(0, "render", "s.json", "--frames", "1", "-o", "a#.png", "-q", "--set", "materials.a.emission=0")
        self.assertEqual({value for row in self.pixels("a1.png")[2] for value in row}, {0})
