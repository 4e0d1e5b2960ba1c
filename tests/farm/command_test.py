import contextlib
import io
import json
import os
import re
import signal
import subprocess
import sys
import tempfile
import unittest

import numpy as np
import pt

try:
    import distributed
except ImportError:
    print("skipped: Dask's distributed is not installed")
    sys.exit(77)
from pictures import SCENE_FILE
from pt import farm
from pt.farm import _command

PT = os.environ["PT_PROGRAM"]
SCENE = {**SCENE_FILE, "film": {"width": 96, "height": 60}, "animation": {"camera.position": [[0, [0, 1, 5]], [2, [1, 1, 5]]]}}
ENDLESS = 10**8


class Command(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.cluster = cls.enterClassContext(distributed.LocalCluster(
            n_workers=1, threads_per_worker=1, dashboard_address=None, host="127.0.0.1", silence_logs=50))

    def setUp(self):
        self.enterContext(contextlib.chdir(self.enterContext(tempfile.TemporaryDirectory())))
        with open("scene.json", "w") as file:
            json.dump(SCENE, file)

    def refused(self, *words):
        said, words = io.StringIO(), ["pt-farm", "render", "scene.json", *words]
        before, sys.argv = sys.argv, words
        try:
            with contextlib.redirect_stderr(said), self.assertRaises(SystemExit) as ended:
                sys.exit(_command.main())
        finally:
            sys.argv = before
        return ended.exception.code, said.getvalue()

    def farm(self, *words, code=0):
        """Uses one worker for all tests of this class, because Dask takes seconds to start."""
        found, said = self.refused(*words, "--scheduler", self.cluster.scheduler_address)
        self.assertEqual(found, code, said)
        return said

    def pt(self, *words, code=0):
        self.assertEqual(subprocess.run([PT, *words, "-q"]).returncode, code)

    def same(self, one, other):
        self.pt("compare", one, other, "--max-mse", "0")

    def test_what_is_refused(self):
        for words, code, said in (
                (["-o", "x.bmp"], 2, r"x\.bmp': must end in .exr, .png"),
                (["-o", "none/x.png"], 6, r"none/x\.png: its folder none"),
                ([], 2, "-o or --film is missing"),
                (["-o", "a.png", "-o", "./a.png"], 2, "named twice"),
                (["-o", "a.png", "--crop", "0,0,8,8"], 2, "unrecognized arguments: --crop 0,0,8,8"),
                (["-o", "a.png", "--size", "9"], 2, "argument --size: must be two whole numbers like 1920x1080, is '9'"),
                (["-o", "a.png", "--error", "0"], 2, "argument --error: must be a number above 0 like 0.005 or 0.5%, is '0'"),
                (["-o", "a.png", "--set", "spheres[0].center=none.npy"], 6, "cannot read none.npy"),
                (["-o", "a.png", "--frames", "2-1"], 2, "--frames 2-1: must be two whole numbers"),
                (["-o", "a.png", "--checkpoint-every", "0"], 2, "number of 0.01 or more, is '0'"),
                (["-o", "a.png", "--local-workers", "0"], 2, "whole number of 1 or more, is '0'"),
                (["-o", "a.png", "--part-seconds", "nan"], 2, "number of 0.1 or more, is 'nan'"),
                (["-o", "a.png", "--resume"], 2, "--resume: needs --checkpoint"),
                (["-o", "a.png", "--tls", "a", "b", "c"], 2, "--tls: needs --scheduler"),
                (["-o", "a.png", "--checkpoint", "scene.json"], 2, "scene.json: exists"),
                (["-o", "a.png", "--frames", "0-1", "--checkpoint", "k"], 2, "--checkpoint: cannot be used with --frames"),
                (["-o", "a.png", "--spp", "0"], 2, '^pt-farm: --spp: must be .*, is 0'),
                (["-o", "a.png", "--scheduler", "nowhere"], 4, "--scheduler nowhere: ")):
            with self.subTest(words):
                found, text = self.refused(*words)
                self.assertEqual(found, code)
                self.assertRegex(text, said)
        self.assertEqual(os.listdir(), ["scene.json"])

    def test_pictures_and_film(self):
        np.save("c.npy", np.array([[0, 1, 0], [1, 1, 0]], np.float32))
        words = ["--layers", "standard-error", "--spp", "40", "--set", 'spheres[1].center="c.npy"', "--set",
                 "film.exposure=-1", "--tonemap", "agx", "--gamma", "2", "--white", "1,0.5,0.8"]
        self.farm("-o", "a.exr", "-o", "a.png", "--film", "a.ptfilm", *words, "-q")
        self.pt("render", "scene.json", "-o", "b.exr", "-o", "b.png", *words)
        for one, other in (("a.exr", "b.exr"), ("a.png", "b.png")):
            self.same(one, other)
        self.pt("compare", "--layer", "standard_error", "a.exr", "b.exr", "--max-mse", "0")
        self.pt("merge", "a.ptfilm", "-o", "c.exr", "--layers", "standard-error")
        self.same("a.exr", "c.exr")

    def test_what_workers_refuse(self):
        said = self.farm("-o", "a.exr", "--set", "spheres[1].radius=-1", "-q", code=2)
        self.assertRegex(said, r"pt-farm: spheres\[1\].radius=-1: spheres\[1\].radius = -1: must be > 0")

    def test_target_errors(self):
        words = ["--spp", "20", "--error", "0.01%"]
        said = self.farm("-o", "a.exr", *words, code=7)
        self.pt("render", "scene.json", "-o", "b.exr", *words, code=7)
        self.same("a.exr", "b.exr")
        self.assertRegex(said, r"spp, error \d.*, 1 workers")

    def test_frames_go_on(self):
        words = ["--frames", "0-1", "--spp", "8"]
        self.farm("-o", "f-##.exr", *words)
        self.pt("render", "scene.json", "-o", "g-##.exr", *words)
        time = os.stat("f-00.exr").st_mtime_ns
        os.remove("f-01.exr")
        self.farm("-o", "f-##.exr", *words, "--skip-existing")
        for frame in "00", "01":
            self.same(f"f-{frame}.exr", f"g-{frame}.exr")
        self.assertEqual(os.stat("f-00.exr").st_mtime_ns, time)

    def test_interrupted_and_going_on(self):
        words = ["--checkpoint", "k.ptfilm", "--local-workers", "2", "--part-seconds", "0.1"]
        with open("scene.json") as file:
            program = subprocess.Popen([sys.executable, "-m", "pt.farm._command", "render", "-", "-o", "a.exr", "--spp",
                                        str(ENDLESS), *words],
                                       stdin=file, stderr=subprocess.PIPE, text=True, start_new_session=True)
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
        self.assertEqual(said, "pt-farm: --checkpoint k.ptfilm: exists; continue from it by --resume\n")
        samples = max(tile.samples[-1].stop for tile in pt.Film.load("k.ptfilm").tiles) + 3
        said = self.farm("-o", "b.exr", "--seed", "7", "--spp", str(samples), "--resume", *words[:2], code=2)
        self.assertIn("the checkpoint belongs to another picture: its seed differs", said)
        self.farm("-o", "b.exr", "--spp", str(samples), "--resume", *words[:2])
        self.pt("render", "scene.json", "-o", "c.exr", "--spp", str(samples))
        self.same("b.exr", "c.exr")

    def test_options_reach_the_farm(self):
        class Reached(Exception):
            pass

        def render(client, job, samples, *, target_error, sampling, options, progress):
            seen.append((options, samples, target_error))
            raise Reached

        seen, _command.render = [], render
        _command.cluster, cluster = lambda _: contextlib.nullcontext(), _command.cluster
        try:
            with self.assertRaises(Reached):
                self.refused("-o", "a.exr", "--checkpoint", "k", "--checkpoint-every", "7", "--patience", "3", "--wait", "4",
                             "--part-seconds", "2", "--mixed", "--spp", "9", "--error", "2%")
        finally:
            _command.render, _command.cluster = farm.render, cluster
        self.assertEqual(seen, [(farm.Options(2.0, 3.0, checkpoint="k", checkpoint_every=7.0, wait_for_workers=4.0,
                                              mixed=True), 9, 0.02)])
