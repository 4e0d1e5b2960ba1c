import contextlib
import importlib.util
import io
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest
import unittest.mock

import numpy as np
import pt
from pt.figures._command import EPILOG, main, numbered, parser

if importlib.util.find_spec("matplotlib") is None:
    print("matplotlib is not installed")
    sys.exit(77)

PROGRAM = os.environ.get("PT_PROGRAM")
SMALL = ("--size", "48x32", "--spp", "2", "--color", "#4060c0")
WATER = """3
Lattice="4 0 0 0 4 0 0 0 4" Properties=species:S:1:pos:R:3:speed:R:1
O 1.00 1.00 1.00 0.4
H 1.76 1.59 1.00 2.1
H 0.24 1.59 1.00 1.8
"""


class Command(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.enterContext(contextlib.chdir(self.folder))
        (self.folder / "water.xyz").write_text(2 * WATER)
        np.save(self.folder / "points.npy", np.random.default_rng(2).normal(size=(4, 30, 3)).astype(np.float32))

    def run_figure(self, *arguments, code=0, **options):
        done = subprocess.run([sys.executable, "-B", "-m", "pt.figures._command", *arguments], cwd=self.folder,
                              capture_output=True, **options)
        self.assertEqual(done.returncode, code, done.stderr.decode())
        return done

    def call_figure(self, *arguments, code=0):
        """Calls the command in this process, because Python starts slowly."""
        said = io.StringIO()
        with (unittest.mock.patch("sys.argv", ["pt-figure", *arguments]), contextlib.redirect_stderr(said),
              contextlib.redirect_stdout(io.StringIO()), self.assertRaises(SystemExit) as ended):
            main()
        self.assertEqual(ended.exception.code, code, said.getvalue())
        return said.getvalue()

    def names(self, pattern):
        return sorted(path.name for path in self.folder.glob(pattern))

    def test_it_is_the_function(self):
        self.run_figure("water.xyz", *SMALL, "-o", "a.png", "-o", "a.exr", "-o", "b.PNG", "-q", "--png-bits", "16")
        figure = pt.figure(self.folder / "water.xyz", color="#4060c0", size=(48, 32), samples=2)
        self.assertEqual((self.folder / "a.png").read_bytes(), figure.encode("png", bits=16))
        self.assertEqual((self.folder / "a.exr").read_bytes(), figure.encode("exr"))
        done = self.run_figure("water.xyz", *SMALL, "-o", "-", "--format", "png", "--progress", "json")
        self.assertEqual(done.stdout, figure.encode("png"))
        self.assertIn(b"2 samples a pixel", done.stderr)
        shares = [json.loads(line)["fraction"] for line in done.stderr.decode().splitlines() if line.startswith("{")]
        self.assertEqual((shares[-1], shares), (1.0, sorted(shares)))
        given = self.run_figure("-", *SMALL, "-o", "-", "--format", "png", "-q", input=2 * WATER.encode())
        self.assertEqual(given.stdout, figure.encode("png"))

    def test_series(self):
        self.call_figure("points.npy", *SMALL, "--frames", "1-3", "-o", "f-##.png")
        self.call_figure("water.xyz", *SMALL, "--turntable", "3", "-o", "t#.png")
        self.assertEqual(self.names("*.png"), ["f-01.png", "f-02.png", "f-03.png", "t0.png", "t1.png", "t2.png"])
        self.assertEqual(len({(self.folder / name).read_bytes() for name in self.names("*.png")}), 6)
        self.assertEqual(numbered("a#b##.png", 7), "a#b07.png")
        self.assertIn("-i f-%03d.png", EPILOG)

    def test_a_film(self):
        with unittest.mock.patch.dict(sys.modules, {"imageio_ffmpeg": None}):
            said = self.call_figure("points.npy", *SMALL, "--frames", "0-2", "-o", "f.mp4", code=2)
        self.assertIn("needs the module imageio_ffmpeg: pip install imageio", said.replace("imageio_ffmpeg, or", "imageio"))
        image = importlib.import_module("PIL.Image")
        self.call_figure("points.npy", *SMALL, "--frames", "0-2", "-o", "f.gif", "-o", "f#.png")
        film = self.enterContext(image.open(self.folder / "f.gif"))
        self.assertEqual((film.n_frames, film.size), (3, (48, 32)))
        film.seek(2)
        apart = np.asarray(film.convert("RGB"), int) - np.asarray(image.open(self.folder / "f2.png").convert("RGB"), int)
        self.assertLess(np.abs(apart).mean(), 4)  # a palette of 256 colors

    def test_a_camera_of_a_file(self):
        self.call_figure("water.xyz", *SMALL, "--view", "right", "-o", "a.png", "--write-scene", "s.json")
        self.call_figure("water.xyz", *SMALL, "--camera", "s.json", "-o", "b.png")
        scene = json.loads((self.folder / "s.json").read_text())
        scene["camera"]["vertical_fov"] *= 0.5
        (self.folder / "s.json").write_text(json.dumps(scene["camera"]))
        self.call_figure("water.xyz", *SMALL, "--camera", "s.json", "-o", "c.png")
        same, other = ((self.folder / name).read_bytes() == (self.folder / "a.png").read_bytes() for name in ("b.png", "c.png"))
        self.assertEqual((same, other), (True, False))

    def test_a_written_scene_renders_to_the_same_radiance(self):
        for arguments in (("water.xyz", "--model", "sticks"),
                          ("points.npy", "--vectors", "y,z,x", "--bonds", "0.5", "--floor", "--style", "glossy"),
                          ("points.npy", "--projection", "orthographic", "--radius", "0.2", "--color", "x", "--up", "-x",
                           "--style", "ambient-occlusion")):
            self.call_figure(*arguments, "--size", "48x32", "--spp", "4", "--write-scene", "s.json", "-o", "a.exr", "-q")
            scene = json.loads((self.folder / "s.json").read_text())
            columns = {name: np.load(self.folder / value) for name, value in scene["spheres"][-1].items()
                       if str(value).endswith(".npy")}
            self.assertEqual(columns["center"].shape[1:], (3,))
            if PROGRAM:
                subprocess.run([PROGRAM, "render", self.folder / "s.json", "-o", self.folder / "b.exr", "-q"], check=True)
                subprocess.run([PROGRAM, "compare", self.folder / "a.exr", self.folder / "b.exr", "--max-mse", "0"], check=True,
                               stdout=subprocess.DEVNULL)
        self.call_figure("water.xyz", "--style", "matte", "--write-scene", "only.json", "--legend", "l.svg", code=0)
        self.assertEqual(self.names("*.svg") + self.names("only*"), [
            "l.svg", "only-capsules-1-center.npy", "only-capsules-1-end.npy", "only-center.npy", "only-color.npy",
            "only-radius.npy", "only.json"])

    def test_a_note_of_a_series_is_told_once(self):
        points = np.random.default_rng(4).normal(size=(3, 30, 3))
        points[1:, 0] = 900
        points[2, 0] *= 2
        np.save(self.folder / "far.npy", points)
        said = self.call_figure("far.npy", *SMALL, "--radius", "0.1", "--frames", "0-2", "-o", "f#.png")
        self.assertEqual(said.count("1 of 30 balls is not drawn"), 1)

    def test_an_error_that_is_not_reached_is_told_by_the_code(self):
        self.call_figure("water.xyz", *SMALL, "--error", "0.001%", "-o", "a.png", code=7)
        self.call_figure("water.xyz", *SMALL[:2], "--error", "30%", "-o", "b.png")
        self.assertEqual(self.names("*.png"), ["a.png", "b.png"])

    def test_what_is_refused(self):
        (self.folder / "bad.xyz").write_text("2\n\nO 0 0\n")
        (self.folder / "data.png").write_text(WATER)
        for code, words, arguments in (
                (2, "there is nothing to write", ("water.xyz",)),
                (2, "must end in .exr, .png, .jpg, .jpeg, .pdf or .svg", ("water.xyz", "-o", "a.bmp")),
                (2, "a.gif: only with --frames or --turntable", ("water.xyz", "-o", "a.gif")),
                (2, "camera = 'water.xyz': must be a scene file, or its part camera", ("water.xyz", "-o", "a.png", "--camera", "water.xyz")),
                (2, "repeat = .0, 1, 1.: must be at least 1", ("water.xyz", "-o", "a.png", "--repeat", "0,1,1")),
                (3, "repeat: points.npy has no cell", ("points.npy", "-o", "a.png", "--repeat", "2,1,1")),
                (6, "its folder nowhere does not exist", ("water.xyz", "-o", "nowhere/a.png")),
                (2, "named twice, nor be water.xyz", ("water.xyz", "-o", "a.png", "-o", "./a.png")),
                (2, "nor be data.png", ("data.png", "-o", "./data.png")),
                (2, "-o -: needs --format", ("water.xyz", "-o", "-")),
                (2, "JPEG has no alpha", ("water.xyz", "-o", "a.jpg", "--background", "transparent")),
                (2, "a series needs # signs", ("water.xyz", "-o", "a.png", "--turntable", "4")),
                (2, "not with --frames", ("water.xyz", "-o", "a#.png", "--turntable", "4", "--frames", "0-1")),
                (2, "must be LO,HI", ("water.xyz", "-o", "a.png", "--color-range", "3")),
                (2, "standard input cannot be read twice", ("-", "-o", "a#.png", "--frames", "0-1")),
                (2, "spp.: must be N|samples = 0: must be at least 1", ("water.xyz", "-o", "a.png", "--spp", "0")),
                (3, "bad.xyz", ("bad.xyz", "-o", "a.png")),
                (4, "no device|'nothing'", ("water.xyz", "-o", "a.png", "--device", "nothing")),
                (6, "none.xyz: does not exist", ("none.xyz", "-o", "a.png"))):
            with self.subTest(words=words):
                said = self.call_figure(*arguments, code=code)
                self.assertRegex(said, words)
        self.assertEqual(self.names("a*"), [])

    def test_every_option_is_in_the_manual(self):
        manual = (pathlib.Path(pt.__file__).parents[1] / "README.md").read_text()
        for action in parser()._actions:
            for name in action.option_strings:
                if name not in ("-h", "--help", "-q", "-o"):
                    self.assertIn(f"`{name}`", manual)
