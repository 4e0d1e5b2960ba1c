"""pt.farm: whatever happens to workers and coordinator, the film has the bytes of one process.

Each case compares whole films with those of a Context of this process. Skipped where distributed is not installed."""

import os
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import pt

try:
    import distributed
    from distributed import Client, LocalCluster
except ImportError:
    print("skipped: Dask's distributed is not installed")
    sys.exit(77)
from pt import farm
from pt.farm import _task
from pt.farm._part import Part, missing_parts

LAMP = pt.Material(emission=(4, 3, 2))
BALL = pt.Material(diffuse=(0.4, 0.1, 0.1), specular=0.4, glossiness=100)
SCENE = pt.Scene([pt.Sphere((0, 1, 0), 1, BALL), pt.Sphere((2, 4, 2), 1, LAMP)],
                 [pt.Plane((0, 1, 0), 0, pt.Material(diffuse=0.8))])
CAMERA = pt.Camera(position=(0, 1.5, 5), target=(0, 1, 0))
SETTINGS = pt.RenderSettings(136, 100)  # tiles that are cut at both edges
JOB = farm.Job(SCENE, CAMERA, SETTINGS)
SAMPLES, ERROR = 400, 0.006
QUICK = farm.Options(part_seconds=0.1, patience=0.5)

render_part = _task.render_part


def slow(name, part, codecs):
    time.sleep(0.15)
    return _task.render_part(name, part, codecs)  # of the worker's process, where nothing takes its place


def failing(name, part, codecs):
    """Fails on one worker, always."""
    if distributed.get_worker().name == 0:
        return _task.Outcome(error="this disk is full", may_help_elsewhere=True)
    return slow(name, part, codecs)


def whole(samples, target_error=0.0):
    with pt.Context() as context:
        context.set_scene(SCENE)
        context.set_camera(CAMERA)
        context.set_render(SETTINGS)
        context.accumulate(samples, target_error=target_error)
        return context.film()


class Farm(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.whole = whole(SAMPLES)

    def farm(self, samples=SAMPLES, workers=2, task=slow, **arguments):
        arguments.setdefault("options", QUICK)
        _task.render_part = task
        try:
            with LocalCluster(n_workers=workers, threads_per_worker=1, dashboard_address=None, host="127.0.0.1",
                              silence_logs=50) as self.cluster, Client(self.cluster) as client:
                return farm.render(client, JOB, samples, **arguments)
        finally:
            _task.render_part = render_part

    def after_parts(self, count, action):
        """A progress function that acts once."""
        acted = []

        def progress(seen, film):
            if seen.parts >= count and not acted:
                acted.append(True)
                action()
        return progress

    def process_of(self, name):
        return self.cluster.workers[name].pid if hasattr(self.cluster.workers[name], "pid") else \
            self.cluster.workers[name].process.pid

    def test_one_is_killed(self):
        found = self.farm(progress=self.after_parts(2, lambda: os.kill(self.process_of(1), signal.SIGKILL)))
        self.assertGreaterEqual(found.progress.lost, 1)
        self.assertEqual(found.film, self.whole)

    def test_one_is_stopped(self):
        stopped = []

        def stop():
            stopped.append(self.process_of(1))
            os.kill(stopped[0], signal.SIGSTOP)
            threading.Timer(4.0, os.kill, (stopped[0], signal.SIGCONT)).start()  # its part comes back, or the end does
        found = self.farm(progress=self.after_parts(2, stop))
        self.assertGreater(found.progress.issued, found.progress.parts)
        self.assertEqual(found.film, self.whole)

    def test_one_always_fails(self):
        found = self.farm(task=failing)
        self.assertGreaterEqual(found.progress.failed, 1)
        self.assertIn("this disk is full", found.progress.messages)
        self.assertEqual(found.film, self.whole)

    def test_target_error(self):
        one = whole(4096, ERROR)
        self.assertGreater(len(one.tiles), 1)  # or nothing is told
        found = self.farm(4096, target_error=ERROR, task=render_part)
        self.assertEqual(found.progress.ended_by, "error")
        self.assertEqual(found.film, one)

    def test_the_coordinator_is_killed(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "kept.ptfilm")
            program = subprocess.Popen([sys.executable, __file__, "coordinator", path])
            while not os.path.exists(path):
                self.assertIsNone(program.poll())
                time.sleep(0.05)
            program.send_signal(signal.SIGKILL)
            program.wait()
            kept = pt.Film.load(path)
            self.assertNotEqual(kept, self.whole)
            options = farm.Options(part_seconds=0.1, patience=0.5, checkpoint=path)
            found = self.farm(options=options, task=render_part)
            self.assertEqual(found.film, self.whole)
            self.assertEqual(pt.Film.load(path), self.whole)

    def test_broken_scenes_are_told_once(self):
        broken = farm.Job(pt.Scene([pt.Sphere((0, 1, 0), -1, BALL)]), CAMERA, SETTINGS)
        with LocalCluster(n_workers=1, threads_per_worker=1, dashboard_address=None, host="127.0.0.1",
                          silence_logs=50) as cluster, Client(cluster) as client:
            with self.assertRaisesRegex(farm.FarmError, r"spheres\[0\].radius = -1: must be > 0"):
                farm.render(client, broken, 1, options=QUICK)


class Parts(unittest.TestCase):
    """Without workers: what is missing, and how it is cut."""

    def test_what_is_missing(self):
        import numpy as np
        goals = np.full((13, 17), 24, np.uint32)
        one = missing_parts(None, 8, goals)
        self.assertEqual([(part.first, part.end, len(part.tiles)) for part in one], [(8, 32, 221)])
        with pt.Context() as context:
            context.set_scene(SCENE)
            context.set_camera(CAMERA)
            context.set_render(pt.RenderSettings(136, 100, first_sample=10))
            counts = np.zeros((13, 17), np.uint32)
            counts[12, 3:] = 5  # the last row, of 4 pixels, and not its first tiles
            context.accumulate_tiles(counts)
            film = context.film()
        left = missing_parts(film, 8, goals)
        self.assertEqual(sum(part.work for part in left), 221 * 24 - 14 * 5)
        self.assertEqual([(part.first, part.end, len(part.tiles)) for part in left],
                         [(8, 10, 14), (8, 32, 207), (15, 32, 14)])

    def test_cuts(self):
        import numpy as np
        part = Part(0, 100, np.arange(50, dtype=np.uint32))
        for work, least in ((1, 1), (700, 1), (700, 40), (99, 50), (10**9, 1)):
            pieces, rest = [], [part]
            while rest:
                piece, others = rest.pop().split(work, least)
                self.assertLessEqual(piece.work, max(work, least))
                pieces.append(piece)
                rest += others
            taken = np.zeros((50, 100), int)
            for piece in pieces:
                taken[piece.tiles, piece.first:piece.end] += 1
            self.assertTrue((taken == 1).all())


def coordinator(path):
    """Until it is killed: a checkpoint at every batch."""
    _task.render_part = slow
    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None, host="127.0.0.1", silence_logs=50,
                      ) as cluster, Client(cluster) as client:
        farm.render(client, JOB, SAMPLES, options=farm.Options(part_seconds=0.1, checkpoint=path, checkpoint_every=0.0))
        time.sleep(600)


if __name__ == "__main__":
    if sys.argv[1:2] == ["coordinator"]:
        coordinator(sys.argv[2])
    else:
        unittest.main()
