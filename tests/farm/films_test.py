import dataclasses
import os
import signal
import subprocess
import sys
import tempfile
import time
import unittest
import zlib
from unittest import mock

import numpy as np
import pt

try:
    import distributed
    from distributed import Client, LocalCluster, SpecCluster
    import xxhash  # pt.farm needs it for mixed devices
except ImportError:
    print("skipped: Dask's distributed, or xxhash, is not installed")
    sys.exit(77)
from pt import farm
from pt.farm import _coordinator, _task
from pt.farm._crew import LOOK_SECONDS, MOST_FAILURES
from pt.farm._part import Part
from pt.farm._sum import Sum, write_film
from pictures import CAMERA, GLOSSY, SCENE, ready, settings

SHAPE = {"width": 136, "height": 100}
SETTINGS = settings(**SHAPE)
JOB = farm.Job(SCENE, CAMERA, SETTINGS)
SAMPLES, ERROR = 256, 0.006
QUICK = farm.Options(part_seconds=0.1, patience=0.5)

MODELS = "model a, driver 1", "model b, driver 1"
RENAMED = """\
from pt.farm import _identity, _task
pack = _task.pack

def dask_setup(worker):
    _task.pack = lambda film, codecs: pack(_identity.with_models(film, frozenset({{"{}"}})), codecs)
"""

render_part = _task.render_part


def slow(name, part, codecs):
    time.sleep(0.08)
    return _task.render_part(name, part, codecs)


def waiting(path):
    def task(name, part, codecs):
        worker = distributed.get_worker().name
        if worker == "failing":
            return _task.Outcome(error="this disk is full", may_help_elsewhere=True)
        open(f"{path}.{worker}", "w").close()
        while not os.path.exists(path):
            time.sleep(0.01)
        return _task.render_part(name, part, codecs)
    return task


class Unreadable:
    def __reduce__(self):
        return int, ("no number",)


def faulty(name, part, codecs):
    """Damages every other film among a worker's first films. Workers start at different places in FAULTS, so that a few parts show all
    faults."""
    worker = distributed.get_worker()
    worker.films = getattr(worker, "films", 0) + 1
    time.sleep(0.03)
    film = _task.render_part(name, part, frozenset())
    fault, is_good = divmod(worker.films - 1, 2)
    if is_good or fault >= len(FAULTS):
        return film
    return list(FAULTS.values())[(fault + int(worker.name) * (len(FAULTS) // 2)) % len(FAULTS)](name, part, film)


def raising(name, part, film):
    raise LookupError("a mistake of this task")


def changed(name, part, film):
    data = zlib.decompress(film.data)
    return dataclasses.replace(film, data=zlib.compress(data[:-9] + bytes([data[-9] ^ 1]) + data[-8:]))


def of_another_picture(name, part, film):
    with pt.Context() as context:
        ready(context, seed=1, first_sample=part.first, **SHAPE)
        counts = np.zeros((13, 17), np.uint32)
        counts.ravel()[part.tiles] = part.end - part.first
        context.accumulate_tiles(counts)
        return dataclasses.replace(film, data=zlib.compress(context.film().to_bytes()))


def with_values(**values):
    return lambda name, part, film: dataclasses.replace(film, **values)


FAULTS = {  # Maps messages to faults.
    "LookupError: a mistake of this task": raising,
    "a part's bytes are damaged": lambda name, part, film: dataclasses.replace(film, data=film.data[:len(film.data) // 2]),
    "its checksum does not match": changed,
    "other samples than requested": lambda name, part, film: _task.render_part(
        name, Part(part.first, part.end + 1, part.tiles), frozenset()),
    "it belongs to another picture": of_another_picture,
    "seconds = nan": with_values(seconds=float("nan")),
    "seconds = -1.0": with_values(seconds=-1.0),
    "seconds = 1e[+]300": with_values(seconds=1e300),
    "seconds of type str": with_values(seconds="1"),
    "data of type NoneType": with_values(data=None),
    "result = 77": with_values(error="x", result=77),
    "a value of type dict": lambda name, part, film: {"data": film.data},
    "ValueError: invalid literal": lambda name, part, film: Unreadable()}


def local_cluster(workers):
    return LocalCluster(n_workers=workers, threads_per_worker=1, dashboard_address=None, host="127.0.0.1",
                        silence_logs=50)


def own_cluster(workers):
    return SpecCluster(workers, {"cls": distributed.Scheduler, "options": {"dashboard": False, "host": "127.0.0.1"}},
                       silence_logs=50)


def whole(samples, target_error=0.0):
    with ready(pt.Context(), **SHAPE) as context:
        context.accumulate(samples, target_error=target_error)
        return context.film()


class Farm(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.whole = whole(SAMPLES)
        cls.shared = cls.enterClassContext(local_cluster(2))

    def farm(self, samples=SAMPLES, cluster=None, task=slow, job=JOB, **arguments):
        arguments.setdefault("options", QUICK)
        _task.render_part = task
        self.cluster = cluster or self.shared
        try:
            with Client(self.cluster) as client:
                return farm.render(client, job, samples, **arguments)
        finally:
            _task.render_part = render_part

    def process_of(self, name):
        return self.cluster.workers[name].pid if hasattr(self.cluster.workers[name], "pid") else \
            self.cluster.workers[name].process.pid

    def harm(self, stopped, killed):
        """Stops and kills workers that have parts, after another one has failed. A stopped worker continues when other
        workers have its parts."""
        go = os.path.join(self.enterContext(tempfile.TemporaryDirectory()), "go")
        held = []

        def progress(seen, film):
            have_parts = all(os.path.exists(f"{go}.{worker}") for worker in (stopped, killed))
            if have_parts and seen.failed >= MOST_FAILURES and not os.path.exists(go):
                held.append(self.process_of(stopped))
                os.kill(held[0], signal.SIGSTOP)
                address = self.cluster.workers[killed].worker_address
                os.kill(self.process_of(killed), signal.SIGKILL)
                while address in self.cluster.scheduler.workers:  # The worker's parts must count as lost, not as late.
                    time.sleep(0.01)
                time.sleep(LOOK_SECONDS)
                open(go, "w").close()
            if seen.repeated and held:
                os.kill(held.pop(), signal.SIGCONT)
        return {"progress": progress, "task": waiting(go)}

    def test_of_four_one_fails_one_is_killed_and_one_stopped(self):
        nanny = {"cls": distributed.Nanny, "options": {"nthreads": 1}}
        with own_cluster({name: nanny for name in ("failing", "killed", "stopped", "healthy")}) as cluster:
            found = self.farm(cluster=cluster, **self.harm("stopped", "killed"))
        self.assertGreaterEqual(found.progress.failed, 1)
        self.assertGreaterEqual(found.progress.repeated, 1)
        self.assertGreaterEqual(found.progress.lost, 1)
        self.assertIn("is refused: this disk is full", "\n".join(found.progress.messages))
        self.assertEqual(found.film, self.whole)

    def test_faulty_outcomes(self):
        options = dataclasses.replace(QUICK, part_seconds=0.004, most_tries=50)
        with mock.patch.object(_coordinator, "least_seconds", lambda workers, adding_seconds: 0.05):
            found = self.farm(2 * SAMPLES, task=faulty, options=options)
        told = "\n".join(found.progress.messages)
        for reason in FAULTS:
            self.assertRegex(told, rf"worker tcp://[\d.:]+: .*{reason}")
        self.assertEqual(found.film, whole(2 * SAMPLES))

    def test_mixed_devices(self):
        nannies = {model: {"cls": distributed.Nanny, "options": {"nthreads": 1, "preload": [RENAMED.format(model)]}}
                   for model in MODELS}
        with own_cluster(nannies) as cluster, Client(cluster) as client:
            alone = farm.render(client, JOB, 2**20, options=QUICK, progress=lambda seen, film: film and seen.messages)
            with tempfile.TemporaryDirectory() as folder:
                path = os.path.join(folder, "kept.ptfilm")
                options = dataclasses.replace(QUICK, checkpoint=path)
                begun = farm.render(client, JOB, 2**20, options=dataclasses.replace(options, mixed=True),
                                    progress=lambda seen, film: film and " and " in film.info.device)
                samples = max(tile.samples[-1].stop for tile in begun.film.tiles)
                with self.assertRaisesRegex(farm.FarmError, "refused: .* and the others .* and .*mixed"):
                    farm.render(client, JOB, samples, options=options)
                mixed = farm.render(client, JOB, samples, options=dataclasses.replace(options, mixed=True))
        self.assertEqual(len(alone.devices), 1)
        self.assertRegex(alone.progress.messages[0], r"is refused: it has model .*, and the others model .*mixed")
        self.assertEqual(list(mixed.devices), list(MODELS))
        with self.assertRaises(pt.IncompatibleError):
            mixed.film + alone.film
        self.assertTrue((mixed.film.readback(pt.Quantity.SAMPLE_COUNT) == samples).all())
        self.assertTrue((mixed.film.readback() == whole(samples).readback()).all())

    def test_target_error(self):
        one = whole(4096, ERROR)
        self.assertGreater(len(one.tiles), 1)  # With one tile, nothing would be compared.
        options = dataclasses.replace(QUICK, patience=60.0)
        found = self.farm(4096, target_error=ERROR, task=render_part, options=options)
        self.assertEqual(found.progress.ended_by, "error")
        self.assertEqual(found.film, one)
        self.assert_accounts(found.progress)

    def test_the_coordinator_is_killed(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "kept.ptfilm")
            program = subprocess.Popen([sys.executable, __file__, "coordinator", self.shared.scheduler_address, path])
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
            seen = []
            self.farm(options=options, progress=lambda now, film: seen.append((now.samples, now.samples_wanted)))
            self.assertEqual(set(seen), {(SAMPLES, SAMPLES)})

    def test_goes_on_from_tiles_that_are_ahead(self):
        with tempfile.TemporaryDirectory() as folder, ready(pt.Context(), **SHAPE) as context:
            path = os.path.join(folder, "kept.ptfilm")
            counts = np.zeros((13, 17), np.uint32)
            counts[4:6, 3:9] = 100
            context.accumulate_tiles(counts)
            context.film().save(path)
            found = self.farm(options=dataclasses.replace(QUICK, checkpoint=path))
            more = self.farm(16, target_error=9.0, options=dataclasses.replace(QUICK, checkpoint=path))
        self.assertEqual(found.film, self.whole)
        self.assertEqual(found.progress.forgotten, 0)
        self.assertEqual((more.progress.samples, more.progress.samples_wanted), (SAMPLES, SAMPLES))

    def test_the_scheduler_dies(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "kept.ptfilm")
            options = dataclasses.replace(QUICK, checkpoint=path)
            program = subprocess.Popen([sys.executable, __file__, "scheduler"], stdout=subprocess.PIPE, text=True)
            address = program.stdout.readline().strip()
            with Client(address) as client, self.assertRaisesRegex(farm.FarmError, "the scheduler is lost"):
                farm.render(client, JOB, 2**20, options=options,
                            progress=lambda seen, film: seen.parts and program.kill())
            program.communicate()
            samples = max(tile.samples[-1].stop for tile in pt.Film.load(path).tiles)
            self.assertEqual(self.farm(samples, options=options, task=render_part).film, whole(samples))

    def test_a_full_disk(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "kept.ptfilm")

            def full(film, place):
                if len(calls) < 3:
                    calls.append(place)
                    raise OSError(28, "No space left on device")
                write_film(film, place)
            calls, _coordinator.write_film = [], full
            try:
                options = dataclasses.replace(QUICK, checkpoint=path, checkpoint_every=0.0)
                found = self.farm(task=render_part, options=options)
            finally:
                _coordinator.write_film = write_film
            self.assertEqual(len(calls), 3)
            told, = found.progress.messages
            self.assertRegex(told, "the checkpoint could not be written.*No space left")
            self.assertEqual(pt.Film.load(path), self.whole)

    def assert_accounts(self, seen):
        self.assertEqual(seen.forgotten, 0, seen.messages)
        self.assertEqual((seen.repeated, seen.dropped, seen.lost, seen.failed), (0, 0, 0, 0))
        self.assertEqual(seen.issued, seen.parts)

    def test_accounts_of_parts(self):
        options, wanted = dataclasses.replace(QUICK, patience=60.0), set()
        found = self.farm(task=render_part, options=options, progress=lambda now, film: wanted.add(now.samples_wanted))
        self.assertEqual(wanted, {SAMPLES})
        self.assertGreater(found.progress.parts, 4)
        self.assert_accounts(found.progress)
        dropped = []

        def forgetful(self, part, size, models):
            if not dropped:
                dropped.append(sum(tile.width * tile.height * len(*tile.samples) for tile in part.tiles))
            else:
                add(self, part, size, models)
        add, Sum.add = Sum.add, forgetful
        try:
            found = self.farm(task=render_part, options=options)
        finally:
            Sum.add = add
        self.assertLessEqual(dropped[0], 64 * found.progress.forgotten)
        self.assertGreater(found.progress.forgotten, 0)
        told, = found.progress.messages
        self.assertEqual(told, f"the coordinator has lost {found.progress.forgotten} samples of tiles, which are taken "
                         "again")
        self.assertEqual(found.film, self.whole)

    def test_broken_scenes_are_told_once(self):
        broken = farm.Job(pt.Scene([pt.Sphere((0, 1, 0), -1, GLOSSY)]), CAMERA, SETTINGS)
        with self.assertRaisesRegex(farm.FarmError, r"spheres\[0\].radius = -1: must be > 0"):
            self.farm(1, job=broken)


def coordinator(address, path):
    _task.render_part = slow
    with Client(address) as client:
        farm.render(client, JOB, SAMPLES, options=farm.Options(part_seconds=0.1, checkpoint=path, checkpoint_every=0.0))
        time.sleep(600)


if __name__ == "__main__":
    if sys.argv[1:2] == ["coordinator"]:
        coordinator(*sys.argv[2:])
    elif sys.argv[1:2] == ["scheduler"]:
        with local_cluster(1) as local:
            print(local.scheduler_address, flush=True)
            time.sleep(600)
    else:
        unittest.main()
