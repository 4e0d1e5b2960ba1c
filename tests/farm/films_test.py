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
from pt.farm._part import Part, has_only
from pt.farm._sum import Sum, write_film
from pictures import CAMERA, SCENE, ready, settings

SHAPE = {"width": 136, "height": 100}
SETTINGS = settings(**SHAPE)
JOB = farm.Job(SCENE, CAMERA, SETTINGS)
SAMPLES, ERROR = 128, 0.006
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


LOCAL = {"threads_per_worker": 1, "dashboard_address": None, "host": "127.0.0.1", "silence_logs": 50}


def own_cluster(workers):
    return SpecCluster(workers, {"cls": distributed.Scheduler, "options": {"dashboard": False, "host": "127.0.0.1"}},
                       silence_logs=50)


class Farm(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.context = cls.enterClassContext(pt.Context())
        cls.whole = cls.film_of(SAMPLES)
        cls.shared = cls.enterClassContext(LocalCluster(n_workers=2, **LOCAL))

    @classmethod
    def film_of(cls, samples, target_error=0.0):
        ready(cls.context, **SHAPE).accumulate(samples, target_error=target_error)
        return cls.context.film()

    def setUp(self):
        self.path = os.path.join(self.enterContext(tempfile.TemporaryDirectory()), "kept.ptfilm")
        self.keeping = dataclasses.replace(QUICK, checkpoint=self.path)

    def farm(self, samples=SAMPLES, cluster=None, task=slow, **arguments):
        arguments.setdefault("options", QUICK)
        with mock.patch.object(_task, "render_part", task), Client(cluster or self.shared) as client:
            return farm.render(client, JOB, samples, **arguments)

    def test_of_four_one_fails_one_is_killed_and_one_stopped(self):
        """Two are harmed when they have parts and another has failed. The stopped one continues when others have its parts."""
        path = self.path
        held = []

        def waiting(name, part, codecs):
            worker = distributed.get_worker().name
            if worker == "failing":
                return _task.Outcome(error="this disk is full", may_help_elsewhere=True)
            open(f"{path}.{worker}", "w").close()
            while not os.path.exists(path):
                time.sleep(0.01)
            return _task.render_part(name, part, codecs)

        def progress(seen, film):
            have_parts = all(os.path.exists(f"{path}.{worker}") for worker in ("stopped", "killed"))
            if have_parts and seen.failed >= MOST_FAILURES and not os.path.exists(path):
                held.append(cluster.workers["stopped"].pid)
                os.kill(held[0], signal.SIGSTOP)
                address = cluster.workers["killed"].worker_address
                os.kill(cluster.workers["killed"].pid, signal.SIGKILL)
                while address in cluster.scheduler.workers:  # The worker's parts must count as lost, not as late.
                    time.sleep(0.01)
                time.sleep(LOOK_SECONDS)
                open(path, "w").close()
            if seen.repeated and held:
                os.kill(held.pop(), signal.SIGCONT)

        nanny = {"cls": distributed.Nanny, "options": {"nthreads": 1}}
        with own_cluster({name: nanny for name in ("failing", "killed", "stopped", "healthy")}) as cluster:
            found = self.farm(cluster=cluster, task=waiting, progress=progress)
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
        self.assertEqual(found.film, self.film_of(2 * SAMPLES))

    def test_mixed_devices(self):
        nannies = {model: {"cls": distributed.Nanny, "options": {"nthreads": 1, "preload": [RENAMED.format(model)]}}
                   for model in MODELS}
        with own_cluster(nannies) as cluster, Client(cluster) as client:
            alone = farm.render(client, JOB, 2**20, options=QUICK, progress=lambda seen, film: film and seen.messages)
            options = dataclasses.replace(self.keeping, mixed=True)
            begun = farm.render(client, JOB, 2**20, options=options,
                                progress=lambda seen, film: film and " and " in film.info.device)
            samples = max(tile.samples[-1].stop for tile in begun.film.tiles)
            with self.assertRaisesRegex(farm.FarmError, "refused: .* and the others .* and .*mixed"):
                farm.render(client, JOB, samples, options=self.keeping)
            mixed = farm.render(client, JOB, samples, options=options)
        self.assertEqual(len(alone.devices), 1)
        self.assertRegex(alone.progress.messages[0], r"is refused: it has model .*, and the others model .*mixed")
        self.assertEqual(list(mixed.devices), list(MODELS))
        with self.assertRaises(pt.IncompatibleError):
            mixed.film + alone.film
        self.assertTrue((mixed.film.readback(pt.Quantity.SAMPLE_COUNT) == samples).all())
        self.assertTrue((mixed.film.readback() == self.film_of(samples).readback()).all())

    def test_target_error(self):
        one = self.film_of(4096, ERROR)
        self.assertGreater(len(one.tiles), 1)  # With one tile, nothing would be compared.
        options = dataclasses.replace(QUICK, patience=60.0)
        found = self.farm(4096, target_error=ERROR, task=render_part, options=options)
        self.assertEqual(found.progress.ended_by, "error")
        self.assertEqual(found.film, one)
        seen = found.progress
        self.assertEqual((seen.forgotten, seen.repeated, seen.dropped, seen.lost, seen.failed), (0,) * 5, seen.messages)
        self.assertEqual(seen.issued, seen.parts)
        self.assertGreater(seen.parts, 4)

    def test_the_coordinator_is_killed(self):
        program = subprocess.Popen([sys.executable, __file__, "coordinator", self.shared.scheduler_address, self.path])
        while not os.path.exists(self.path):
            self.assertIsNone(program.poll())
            time.sleep(0.05)
        program.send_signal(signal.SIGKILL)
        program.wait()
        self.assertNotEqual(pt.Film.load(self.path), self.whole)
        found = self.farm(options=self.keeping, task=render_part)
        self.assertEqual(found.film, self.whole)
        self.assertEqual(pt.Film.load(self.path), self.whole)
        seen = []
        self.farm(options=self.keeping, progress=lambda now, film: seen.append((now.samples, now.samples_wanted)))
        self.assertEqual(set(seen), {(SAMPLES, SAMPLES)})

    def test_samples_of_a_film_begin_with_the_first(self):
        cells = [((range(5, 13),), np.arange(2, dtype=np.uint32))]
        for first, expected in (4, False), (5, True):
            self.assertEqual(has_only(cells, first, np.full(2, 8, np.uint32)), expected)

    def test_tiles_that_are_ahead_and_a_full_disk(self):
        calls = []

        def full(film, place):
            if len(calls) < 3:
                calls.append(place)
                raise OSError(28, "No space left on device")
            write_film(film, place)

        counts = np.zeros((13, 17), np.uint32)
        counts[4:6, 3:9] = 100
        ready(self.context, **SHAPE).accumulate_tiles(counts)
        self.context.film().save(self.path)
        with mock.patch.object(_coordinator, "write_film", full):
            found = self.farm(options=dataclasses.replace(self.keeping, checkpoint_every=0.0))
        self.assertEqual(len(calls), 3)
        told, = found.progress.messages
        self.assertRegex(told, "the checkpoint could not be written.*No space left")
        self.assertEqual(found.film, self.whole)
        self.assertEqual(pt.Film.load(self.path), self.whole)
        self.assertEqual(found.progress.forgotten, 0)
        more = self.farm(16, target_error=9.0, options=self.keeping)
        self.assertEqual((more.progress.samples, more.progress.samples_wanted), (SAMPLES, SAMPLES))

    def test_the_scheduler_dies(self):
        program = subprocess.Popen([sys.executable, __file__, "scheduler"], stdout=subprocess.PIPE, text=True)
        address = program.stdout.readline().strip()
        with Client(address) as client, self.assertRaisesRegex(farm.FarmError, "the scheduler is lost"):
            farm.render(client, JOB, 2**20, options=self.keeping,
                        progress=lambda seen, film: seen.parts and program.kill())
        program.communicate()
        samples = max(tile.samples[-1].stop for tile in pt.Film.load(self.path).tiles)
        self.assertEqual(self.farm(samples, options=self.keeping, task=render_part).film, self.film_of(samples))

    def test_a_lost_part_is_taken_again(self):
        dropped = []

        def forgetful(self, part, size, models):
            if not dropped:
                dropped.append(sum(tile.width * tile.height * len(*tile.samples) for tile in part.tiles))
            else:
                add(self, part, size, models)

        add = Sum.add
        with mock.patch.object(Sum, "add", forgetful):
            found = self.farm(task=render_part, options=dataclasses.replace(QUICK, patience=60.0))
        self.assertLessEqual(dropped[0], 64 * found.progress.forgotten)
        self.assertGreater(found.progress.forgotten, 0)
        self.assertEqual(found.progress.messages, [f"the coordinator has lost {found.progress.forgotten} samples of tiles, "
                                                   "which are taken again"])
        self.assertEqual(found.film, self.whole)


def coordinator(address, path):
    _task.render_part = slow
    with Client(address) as client:
        farm.render(client, JOB, SAMPLES, options=farm.Options(part_seconds=0.1, checkpoint=path, checkpoint_every=0.0))
        time.sleep(600)


if __name__ == "__main__":
    if sys.argv[1:2] == ["coordinator"]:
        coordinator(*sys.argv[2:])
    elif sys.argv[1:2] == ["scheduler"]:
        with LocalCluster(n_workers=1, processes=False, protocol="tcp://", **LOCAL) as local:
            print(local.scheduler_address, flush=True)
            time.sleep(600)
    else:
        unittest.main()
