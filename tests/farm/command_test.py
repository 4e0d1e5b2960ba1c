"""pt-farm: what it writes, exit codes, messages, frames, signals, checkpoints and the viewer. Argument: the program pt,
whose pictures its own must equal. Skipped where distributed is not installed."""

import contextlib
import io
import json
import os
import re
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import threading
import unittest

import numpy as np
import pt

try:
    import distributed  # noqa: F401
except ImportError:
    print("skipped: Dask's distributed is not installed")
    sys.exit(77)
from pt.farm import _command

PT = os.environ["PT_PROGRAM"] = os.path.abspath(sys.argv.pop(1))
SCENE = {"camera": {"position": [0, 1, 5], "look_at": [0, 0.8, 0]}, "film": {"width": 96, "height": 60},
         "materials": {"lamp": {"emission": [10, 9, 7]}, "grey": {"diffuse": 0.6}},
         "spheres": [{"center": [-2, 4, 2], "radius": 1, "material": "lamp"},
                     {"center": [0, 1, 0], "radius": 1, "material": "grey"}],
         "planes": [{"normal": [0, 1, 0], "offset": 0, "material": "grey"}],
         "animation": {"camera.position": [[0, [0, 1, 5]], [2, [1, 1, 5]]]}}
ENDLESS = 10**8


class Viewer(threading.Thread):
    """Takes what is sent, connection by connection."""

    def __init__(self):
        super().__init__(daemon=True)
        self.server = socket.create_server(("127.0.0.1", 0))
        self.address = "127.0.0.1:%d" % self.server.getsockname()[1]
        self.sent = []
        self.start()

    def run(self):
        while True:
            connection, _ = self.server.accept()
            with connection, connection.makefile("rb") as stream:
                self.sent.append(stream.read())

    def last(self):
        """Name and pixels of the image that was sent last."""
        data = self.sent[-1]
        length, kind = struct.unpack_from("<IB", data)
        assert kind == 4, kind
        update = data[length:]
        assert struct.unpack_from("<IB", update) == (len(update), 6)
        name = update[6:update.index(b"\0", 6)]
        place = 6 + len(name) + 1 + 4 + len(b"R\0G\0B\0")
        x, y, width, height = struct.unpack_from("<4i", update, place)
        assert (x, y) == (0, 0)
        pixels = np.frombuffer(update, "<f4", offset=place + 16 + 48).reshape(height, width, 3)
        return name.decode(), pixels


class Command(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(folder.name)
        with open("scene.json", "w") as file:
            json.dump(SCENE, file)

    def refused(self, *words):
        """The exit code of a command that ends before any worker starts, and what it says."""
        said, words = io.StringIO(), ["pt-farm", "render", "scene.json", *words]
        before, sys.argv = sys.argv, words
        try:
            with contextlib.redirect_stderr(said), self.assertRaises(SystemExit) as ended:
                sys.exit(_command.main())
        finally:
            sys.argv = before
        return ended.exception.code, said.getvalue()

    def farm(self, *words, code=0):
        done = subprocess.run([sys.executable, "-m", "pt.farm._command", "render", "scene.json", *words],
                              stderr=subprocess.PIPE, text=True)
        self.assertEqual(done.returncode, code, done.stderr)
        return done.stderr

    def pt(self, *words, code=0):
        self.assertEqual(subprocess.run([PT, *words, "-q"]).returncode, code)

    def same(self, one, other):
        self.pt("compare", one, other, "--max-mse", "0")

    def test_what_is_refused(self):
        for words, code, said in (
                (["-o", "x.bmp"], 2, r"x\.bmp: must end in .exr or .png"),
                (["-o", "none/x.png"], 6, r"none/x\.png: its folder none"),
                ([], 2, "-o or --film is missing"),
                (["-o", "a.png", "-o", "./a.png"], 2, "named twice"),
                (["-o", "a.png", "--crop", "0,0,8,8"], 2, "--crop: a farm has no such option"),
                (["-o", "a.png", "--local-workers", "0"], 2, "whole number of 1 or more, is '0'"),
                (["-o", "a.png", "--part-seconds", "nan"], 2, "number of 0.1 or more, is 'nan'"),
                (["-o", "a.png", "--resume"], 2, "--resume: needs --checkpoint"),
                (["-o", "a.png", "--tls", "a", "b", "c"], 2, "--tls: needs --scheduler"),
                (["-o", "a.png", "--checkpoint", "scene.json"], 2, "scene.json: is there already"),
                (["-o", "a.png", "--frames", "0-1", "--checkpoint", "k"], 2, "--frames have none"),
                (["-o", "a.png", "--spp", "0"], 2, "^$"),  # pt says it, on the real stderr
                (["-o", "a.png", "--scheduler", "nowhere"], 4, "--scheduler nowhere: ")):
            with self.subTest(words):
                found, text = self.refused(*words)
                self.assertEqual(found, code)
                self.assertRegex(text, said)
        self.assertEqual(os.listdir(), ["scene.json"])

    def test_pictures_film_and_viewer(self):
        viewer = Viewer()
        self.farm("-o", "a.exr", "-o", "a.png", "--film", "a.ptfilm", "--standard-error", "e.exr", "--spp", "40",
                  "--tev", viewer.address, "--local-workers", "1", "-q")
        self.pt("render", "scene.json", "-o", "b.exr", "-o", "b.png", "--standard-error", "f.exr", "--spp", "40")
        for one, other in (("a.exr", "b.exr"), ("a.png", "b.png"), ("e.exr", "f.exr")):
            self.same(one, other)
        self.pt("merge", "a.ptfilm", "-o", "c.exr")
        self.same("a.exr", "c.exr")
        name, pixels = viewer.last()
        self.assertEqual(name, "scene.json")
        self.assertEqual(pixels.shape, (60, 96, 3))
        self.assertTrue((pt.Film.load("a.ptfilm").readback() == pixels).all())

    def test_target_errors(self):
        said = self.farm("-o", "a.exr", "--spp", "20", "--error", "0.01%", "--local-workers", "1", code=7)
        self.assertRegex(said, r"spp, error \d.*, 1 workers")
        self.pt("render", "scene.json", "-o", "b.exr", "--spp", "20", "--error", "0.01%", code=7)
        self.same("a.exr", "b.exr")

    def test_frames_go_on(self):
        words = ["-o", "f-##.exr", "--frames", "0-2", "--spp", "8", "--local-workers", "1", "-q"]
        self.farm(*words)
        self.pt("render", "scene.json", "-o", "g-##.exr", "--frames", "0-2", "--spp", "8")
        for frame in range(3):
            self.same(f"f-0{frame}.exr", f"g-0{frame}.exr")
        times = [os.stat(f"f-0{frame}.exr").st_mtime_ns for frame in range(3)]
        os.remove("f-01.exr")
        self.farm(*words, "--skip-existing")
        self.same("f-01.exr", "g-01.exr")
        self.assertEqual([os.stat(f"f-0{frame}.exr").st_mtime_ns for frame in (0, 2)], [times[0], times[2]])

    def test_interrupted_and_going_on(self):
        """By Ctrl-C, which the workers see too."""
        words = ["--checkpoint", "k.ptfilm", "--local-workers", "2", "--part-seconds", "0.1"]
        program = subprocess.Popen([sys.executable, "-m", "pt.farm._command", "render", "scene.json", "-o", "a.exr",
                                    "--spp", str(ENDLESS), *words],
                                   stderr=subprocess.PIPE, text=True, start_new_session=True)
        text = ""
        while not re.search(r"[1-9]\d* parts", text):
            letter = program.stderr.read(1)
            self.assertTrue(letter, text)
            text += letter
        os.killpg(program.pid, signal.SIGINT)
        program.communicate()
        self.assertEqual(program.returncode, 130)
        self.pt("merge", "k.ptfilm", "-o", "k.exr")
        self.same("a.exr", "k.exr")
        code, said = self.refused("-o", "b.exr", "--spp", "9", *words)
        self.assertEqual(code, 2)
        self.assertEqual(said, "pt-farm: --checkpoint k.ptfilm: is there already; go on from it by --resume\n")
        samples = max(tile.samples[-1].stop for tile in pt.Film.load("k.ptfilm").tiles) + 3
        said = self.farm("-o", "b.exr", "--seed", "7", "--spp", str(samples), "--resume", *words, code=2)
        self.assertIn("the checkpoint is of another picture: its seed differs", said)
        self.farm("-o", "b.exr", "--spp", str(samples), "--resume", *words)
        self.pt("render", "scene.json", "-o", "c.exr", "--spp", str(samples))
        self.same("b.exr", "c.exr")


if __name__ == "__main__":
    unittest.main()
