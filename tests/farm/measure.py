"""What the farm costs, measured on this machine with the coursework scene. Figures are in lib/python/FARM.md.

    PYTHONPATH=lib/python PT_LIBRARY=build/lib/libpt.so python3 tests/farm/measure.py WHAT --pt build/bin/pt

costs      seconds and bytes of a part, on a worker and on the coordinator, by tiles (--json FILE for simulate.py)
memory     of the coordinator, over about a thousand parts of 1920x1080
overhead   processor seconds of two workers, coordinator and scheduler, and of one process for the same samples
error      seconds to a target error, of two workers and of one process
scheduler  bytes that a scheduler in a process of its own takes and sends"""

import argparse
import json
import math
import os
import pathlib
import re
import resource
import subprocess
import sys
import tempfile
import time

import numpy as np
import pt
from distributed import Client, LocalCluster
from pt import farm
from pt.farm import _task
from pt.farm._job import packed
from pt.farm._part import Part, is_film_of
from pt.farm._sum import Sum

CODECS = _task.codecs()
WARM, ORANGE = pt.Material(emission=(135, 135, 75)), pt.Material(emission=(120, 45, 15))
BLUE = pt.Material(diffuse=(0.2, 0.5, 0.8), specular=0.8, glossiness=40)
PALE = pt.Material(diffuse=(0.9, 0.8, 0.8), specular=1.0, glossiness=10)
BACK = pt.Material(diffuse=(0.9, 0.6, 0.3), specular=0.02, glossiness=3000)
SIDE = pt.Material(diffuse=0.2, specular=0.1, glossiness=100)
SCENE = pt.Scene(  # cli/scenes/coursework.json
    [pt.Sphere((7, -2, -12), 2, WARM), pt.Sphere((-8, 4, -13), 1, ORANGE), pt.Sphere((-2, -2, -12), 3, BLUE),
     pt.Sphere((3, -3.5, -14), 1, PALE)],
    [pt.Plane((0, 1, 0), 4.5, pt.Material(diffuse=0.8)), pt.Plane((0, 0, 1), 18.5, BACK), pt.Plane((1, 0, 0), 10, SIDE),
     pt.Plane((-1, 0, 0), 10, SIDE)])
CAMERA = pt.Camera((0, 0, 1), (0, 0, 0), vertical_fov=2 * math.atan(0.5))


def job(size):
    width, height = map(int, size.split("x"))
    return farm.Job(SCENE, CAMERA, pt.RenderSettings(width, height, max_path_length=2))


def cluster(count=2):
    os.environ["LP_NUM_THREADS"] = "1"
    try:
        return LocalCluster(n_workers=count, threads_per_worker=1, dashboard_address=None, host="127.0.0.1")
    finally:
        del os.environ["LP_NUM_THREADS"]


def context_of(what):
    context = pt.Context()
    context.set_scene(what.scene)
    context.set_camera(what.camera)
    context.set_render(what.settings)
    context.prepare()
    return context


def processor_seconds(process):
    words = pathlib.Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
    return (int(words[11]) + int(words[12])) / os.sysconf("SC_CLK_TCK")


def costs():
    """In processor seconds, with one thread, as others may use the machine meanwhile."""
    what = job("1920x1080")
    os.environ["LP_NUM_THREADS"] = "1"
    _task.introduce(packed(what), CODECS)
    name, shape = _task._ready.name, (135, 240)
    rows = []
    for tiles in (16, 64, 256, 1024, 4096, 32400):
        first = (32400 - tiles) // 2
        chosen = np.arange(first, first + tiles, dtype=np.uint32)
        samples = max(65536 // tiles, 2)
        _task.render_part(name, Part(0, 2, chosen), CODECS)  # what is built on first use
        begun = time.process_time()
        outcome = _task.render_part(name, Part(0, samples, chosen), CODECS)
        seconds = time.process_time() - begun
        begun = time.process_time()
        _task.render_part(name, Part(samples, samples + 1, chosen), CODECS)
        least = time.process_time() - begun  # nearly nothing to render: what a part costs its worker besides
        begun = time.process_time()
        data = _task.unpack(outcome.data)
        film = pt.Film(data)
        assert is_film_of(film, Part(0, samples, chosen), shape)
        opened = time.process_time() - begun
        rows.append({"tiles": tiles, "samples": samples, "speed": tiles * samples / seconds, "least_seconds": least,
                     "bytes": len(outcome.data), "raw_bytes": len(data), "open_seconds": opened})
        print(f"{tiles} tiles x {samples}: {seconds:.3f} s, {rows[-1]['speed']:.0f} samples of tiles a second; of one "
              f"sample {least:.3f} s; {len(outcome.data) / tiles:.0f} bytes a tile packed, "
              f"{len(data) / tiles:.0f} raw; "
              f"unpack and open {opened * 1e3:.2f} ms")
    # Adding: a picture's worth of parts, in the batches of the coordinator.
    for tiles in (64, 4096):
        parts = []
        for first in range(0, 32400, tiles):
            part = Part(0, 9, np.arange(first, min(first + tiles, 32400), dtype=np.uint32))
            parts.append(_task.unpack(_task.render_part(name, part, CODECS).data))
        whole = Sum(None, 1920, 1080)
        add_all(whole, parts)
        begun = time.process_time()
        second = [_task.unpack(_task.render_part(name, Part(9, 18, np.arange(
            first, min(first + tiles, 32400), dtype=np.uint32)), CODECS).data) for first in range(0, 32400, tiles)]
        begun = time.process_time()
        add_all(whole, second)
        seconds = time.process_time() - begun
        rows.append({"add_tiles": tiles, "add_seconds_of_tile": seconds / 32400})
        print(f"adding all tiles by {tiles}: {seconds:.3f} s, {seconds / 32400 * 1e6:.1f} us a tile")
    return rows


def add_all(whole, parts):
    for data in parts:
        whole.add(pt.Film(data), len(data), frozenset())
        if whole._bytes >= whole._most_bytes:
            whole.merge()
    whole.merge()


def memory():
    """Of a rendering that writes checkpoints, beside what the interpreter has taken before."""
    what = job("1920x1080")
    with cluster() as here, Client(here) as client, tempfile.TemporaryDirectory() as folder:
        before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        options = farm.Options(part_seconds=0.02, checkpoint=pathlib.Path(folder, "kept"), checkpoint_every=5.0)
        result = farm.render(client, what, 20, options=options)
        after = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    film = result.film.size
    print(f"{result.progress.parts} parts, {result.progress.part_bytes / 1e6:.0f} MB: {before / 1e3:.0f} MB before, "
          f"at the most {after / 1e3:.0f} MB; a film is {film / 1e6:.0f} MB, so "
          f"{(after - before) * 1024 / film:.2f} films")


def overhead():
    what = job("640x480")
    one = context_of(what)
    one.accumulate(16)
    with cluster() as here, Client(here) as client:
        farm.render(client, what, 16)
        workers = [each.process.pid for each in here.workers.values()]
        for _ in range(ARGUMENTS.repeats):
            one.set_render(what.settings)
            start, begun = processor_seconds(os.getpid()), time.monotonic()
            one.accumulate(ARGUMENTS.samples)
            single, single_wall = processor_seconds(os.getpid()) - start, time.monotonic() - begun
            everyone = [os.getpid(), *workers]
            start, begun = [processor_seconds(each) for each in everyone], time.monotonic()
            result = farm.render(client, what, ARGUMENTS.samples)
            wall = time.monotonic() - begun
            each = [processor_seconds(process) - first for process, first in zip(everyone, start)]
            assert result.film == one.film()
            print(f"one process {single:.1f} s of processors in {single_wall:.1f} s; farm {sum(each):.1f} s "
                  f"(coordinator and scheduler {each[0]:.1f}) in {wall:.1f} s: {sum(each) / single - 1:+.1%}, wall "
                  f"{wall / single_wall - 1:+.1%}; {result.progress.parts} parts, "
                  f"{result.progress.part_bytes / 1e6:.0f} MB", flush=True)


def error():
    what = job(ARGUMENTS.size)
    one = context_of(what)
    with cluster() as here, Client(here) as client:
        farm.render(client, what, 16)
        workers = [each.process.pid for each in here.workers.values()]
        for _ in range(ARGUMENTS.repeats):
            one.set_render(what.settings)
            start, begun = processor_seconds(os.getpid()), time.monotonic()
            one.accumulate(65536, target_error=ARGUMENTS.target)
            single, single_wall = processor_seconds(os.getpid()) - start, time.monotonic() - begun
            everyone = [os.getpid(), *workers]
            start, begun = [processor_seconds(each) for each in everyone], time.monotonic()
            result = farm.render(client, what, 65536, target_error=ARGUMENTS.target)
            wall = time.monotonic() - begun
            each = [processor_seconds(process) - first for process, first in zip(everyone, start)]
            assert result.film == one.film()
            print(f"to {ARGUMENTS.target:.1%}: one process {single_wall:.1f} s ({single:.1f} s of processors), farm "
                  f"{wall:.1f} s ({sum(each[1:]):.1f} s of workers, {each[0]:.1f} of coordinator and scheduler), "
                  f"{result.progress.parts} parts, {one.stats().mean_sample_count:.0f} spp", flush=True)


def scheduler():
    """By what the kernel counts of its connections."""
    what = job("640x480")
    program = subprocess.Popen([sys.executable, "-m", "distributed.cli.dask_scheduler", "--host", "127.0.0.1", "--port",
                                "18786", "--no-dashboard"], stderr=subprocess.DEVNULL)
    environment = {**os.environ, "LP_NUM_THREADS": "1"}
    command = [sys.executable, "-m", "distributed.cli.dask_worker", "tcp://127.0.0.1:18786", "--nthreads", "1",
               "--no-nanny", "--no-dashboard"]
    workers = [subprocess.Popen(command, env=environment, stderr=subprocess.DEVNULL) for _ in (0, 1)]
    try:
        with Client("tcp://127.0.0.1:18786") as client:
            client.wait_for_workers(2)
            before = bytes_of_port(18786)
            result = farm.render(client, what, ARGUMENTS.samples, options=farm.Options(part_seconds=0.5))
            taken, sent = (after - first for after, first in zip(bytes_of_port(18786), before))
        progress = result.progress
        print(f"{progress.parts} parts of {progress.part_bytes / 1e6:.1f} MB in {progress.seconds:.0f} s: the "
              f"scheduler took {taken / 1e3:.0f} kB and sent {sent / 1e3:.0f} kB, "
              f"{(taken + sent) / progress.parts / 1e3:.1f} kB a part; the job is {len(packed(what)) / 1e3:.1f} kB")
    finally:
        for each in (*workers, program):
            each.terminate()


def bytes_of_port(port):
    text = subprocess.run(["ss", "-tinH", f"sport = :{port}"], stdout=subprocess.PIPE, text=True).stdout
    return [sum(map(int, re.findall(rf"{name}:(\d+)", text))) for name in ("bytes_received", "bytes_sent")]


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=("costs", "memory", "overhead", "error", "scheduler"))
    parser.add_argument("--json")
    parser.add_argument("--samples", type=int, default=512)
    parser.add_argument("--target", type=float, default=0.01)
    parser.add_argument("--size", default="640x480")
    parser.add_argument("--repeats", type=int, default=3)
    ARGUMENTS = parser.parse_args()
    rows = globals()[ARGUMENTS.what]()
    if ARGUMENTS.json:
        pathlib.Path(ARGUMENTS.json).write_text(json.dumps(rows, indent=1) + "\n")
