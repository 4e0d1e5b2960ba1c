"""Prints how good stated errors and target errors of images are.

    PT_LIBRARY=build/lib/libpt.so PT_PROGRAM=build/bin/pt python3 tests/bench/stated_error.py SET ... [--jobs N]

A SET is `own` (cli/scenes and calibration_scenes.py), `random:SEED` (the hundred of random_scenes.py), or a folder of
scene files. Errors are relative root mean squares over pixels and channels, measured against an image of many samples.
The error of this image is at most a fifth of the measured one. --keep writes the estimator's input for some seeds as
NumPy's .npz.
"""

import argparse
import concurrent.futures
import dataclasses
import json
import math
import multiprocessing
import os
import pathlib
import sys
from dataclasses import dataclass, field

import numpy

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / folder) for folder in ("lib/python", "tests/support", "tests/bench")]
import pt
import random_scenes
from calibration_scenes import scenes as calibration_scenes
from relative_error import relative_square
from scene_file import FOLDER, read_scene

MOST_TRUTH = 1 << 17
REFERENCE_SHARE = 0.2  # limit for the reference's error, divided by the picture's error
FIRST_SEED, FIRST_TARGET_SEED = 100, 200
RELATIVE_BITS = pt.Uncertain.RELATIVE_RMSE | pt.Uncertain.UNSEEN | pt.Uncertain.UNMET


@dataclass
class Stated:
    scene: str
    size: str
    count: int
    seed: int
    stated: float
    low: float
    high: float
    uncertain: int
    own: float
    over_seeds: float = math.nan

    @property
    def certain(self):
        return not self.uncertain & RELATIVE_BITS


@dataclass
class Stopped:
    scene: str
    size: str
    target: float
    reached: bool
    own: float
    brightness: float  # mean, relative to the reference's mean
    samples: float


@dataclass
class Found:
    stated: list = field(default_factory=list)
    stopped: list = field(default_factory=list)
    left_out: int = 0
    kept: dict = field(default_factory=dict)


def sets_of(name):
    if name == "own":
        return {path.stem: read_scene(path) for path in sorted(FOLDER.glob("*.json"))} | calibration_scenes()
    if name.startswith("random:"):
        return dict(random_scenes.hundred(int(name.removeprefix("random:"))))
    return {path.stem: path for path in sorted(pathlib.Path(name).glob("*.json"))}


def read(scene):
    return pt.load(scene) if isinstance(scene, pathlib.Path) else pt.load("scene.json", text=json.dumps(scene))


def short(values):
    """Rounds floats >= 0 to 16 bits, 8 of them for the exponent. The relative error is at most 2^-9."""
    return ((numpy.asarray(values, numpy.float32).view(numpy.uint32) + (1 << 14)) >> 15).astype(numpy.uint16)


class Pictures:
    def __init__(self, context, scene, settings, size, options):
        self.context, self.name, self.size, self.options = context, scene, size, options
        self.settings = settings
        pixels = math.prod(map(int, size.split("x")))
        count = min((1 << options.truth) // pixels, MOST_TRUTH)
        first, second = (self.take(seed, count) for seed in (98, 99))
        self.truth = (first.astype(numpy.float64) + second) / 2
        self.reference_error = math.sqrt(relative_square(first, self.truth))

    def start(self, seed):
        width, height = map(int, self.size.split("x"))
        self.context.set_render(dataclasses.replace(self.settings, width=width, height=height, seed=seed))

    def take(self, seed, count):
        self.start(seed)
        self.context.accumulate(count)
        return self.context.readback()

    def measure(self, found):
        for seed in range(FIRST_SEED, FIRST_SEED + self.options.seeds):
            self.measure_stated(seed, found)
        for target in self.options.targets:
            for seed in range(FIRST_TARGET_SEED, FIRST_TARGET_SEED + self.options.target_seeds):
                self.measure_stopped(target, seed, found)
        if self.name_kept():
            found.kept[f"{self.name}|{self.size}|truth"] = self.truth.astype(numpy.float32)

    def name_kept(self):
        return self.options.keep and self.size in self.options.keep_sizes

    def measure_stated(self, seed, found):
        self.start(seed)
        done = 0
        for count in self.options.counts:
            self.context.accumulate(count - done)
            done = count
            image = self.context.readback()
            own = math.sqrt(relative_square(image, self.truth))
            error = self.context.error_estimate()
            if self.name_kept() and seed < FIRST_SEED + self.options.keep_seeds:
                error_image = self.context.readback(pt.Quantity.STANDARD_ERROR)
                key = f"{self.name}|{self.size}|{count}|{seed}"
                found.kept[key + "|mean"], found.kept[key + "|error"] = short(image), short(error_image)
            if self.reference_error > REFERENCE_SHARE * own:
                found.left_out += 1
                continue
            found.stated.append(Stated(self.name, self.size, count, seed, error.relative_rmse, error.relative_rmse_low,
                                       error.relative_rmse_high, int(error.uncertain), own))

    def measure_stopped(self, target, seed, found):
        self.start(seed)
        result = self.context.accumulate(self.options.most, target_error=target)
        image = self.context.readback()
        found.stopped.append(Stopped(self.name, self.size, target, result == pt.Result.TARGET_REACHED,
                                     math.sqrt(relative_square(image, self.truth)),
                                     float(image.mean(dtype=numpy.float64) / max(self.truth.mean(), 1e-300)),
                                     self.context.stats().mean_sample_count))


def add_rms_over_seeds(cases):
    groups = {}
    for case in cases:
        groups.setdefault((case.scene, case.size, case.count), []).append(case)
    for group in groups.values():
        rms = math.sqrt(sum(case.own ** 2 for case in group) / len(group))
        for case in group:
            case.over_seeds = rms


def measure_scene(name, scene, options):
    found = Found()
    try:
        whole = read(scene)
        with pt.Context() as context:
            context.set_scene(whole.scene)
            context.set_camera(whole.camera)
            for size in options.sizes:
                Pictures(context, name, whole.settings, size, options).measure(found)
    except pt.Error as error:
        print(f"{name}: {error}", file=sys.stderr, flush=True)
    add_rms_over_seeds(found.stated)
    print(name, file=sys.stderr, flush=True)
    return found


def share(values):
    values = list(values)
    return f"{100 * sum(values) / len(values):.1f}%" if values else ""


def stated_row(cases):
    certain = [case for case in cases if case.certain]
    return [str(len(cases)), share(not case.certain for case in cases),
            share(case.stated < 0.9 * case.own for case in certain),
            share(case.stated < 0.7 * case.own for case in certain),
            share(case.stated > 2 * case.own for case in certain),
            share(case.low <= case.own <= case.high for case in certain),
            share(case.stated < 0.9 * case.over_seeds for case in certain),
            share(case.low <= case.over_seeds <= case.high for case in certain),
            share(case.stated < 0.9 * case.own for case in cases),
            share(case.stated > 2 * case.own for case in cases)]


def stopped_row(runs):
    reached = [run for run in runs if run.reached]
    brightness = [run.brightness for run in reached]
    return [str(len(runs)), share(run.reached for run in runs), share(run.own > run.target for run in reached),
            share(run.own > 2 * run.target for run in reached),
            f"{100 * (numpy.mean(brightness) - 1):+.2f}%" if brightness else "",
            f"{numpy.exp(numpy.mean(numpy.log([run.samples for run in reached]))):.0f}" if reached else ""]


STATED_HEADS = ["pictures", "uncertain", "certain: < .9 own", "< .7", "> 2", "bounds hold own", "< .9 rms",
                "bounds hold rms", "all: < .9 own", "> 2"]
STOPPED_HEADS = ["runs", "reached", "above target", "above twice", "brightness", "samples"]


def print_table(title, heads, row_of, cases, key):
    print(f"| {title} | " + " | ".join(heads) + " |\n|" + "---|" * (len(heads) + 1))
    for name in [*sorted(set(map(key, cases)), key=str), "all"]:
        print(f"| {name} | " + " | ".join(row_of([case for case in cases if name in (key(case), "all")])) + " |")
    print(flush=True)


def print_tables(found, by_scene):
    for key in ("size", "count", "scene") if by_scene else ("size", "count"):
        print_table(key, STATED_HEADS, stated_row, found.stated, lambda case: getattr(case, key))
    print(f"Left out, since the reference is too coarse: {found.left_out}\n")
    for key in ("target", "scene") if by_scene else ("target",):
        print_table(key, STOPPED_HEADS, stopped_row, found.stopped, lambda case: getattr(case, key))


def measure(name, options):
    scenes = sets_of(name)
    whole = Found()
    with concurrent.futures.ProcessPoolExecutor(options.jobs, multiprocessing.get_context("spawn")) as pool:
        for found in pool.map(measure_scene, scenes, scenes.values(), [options] * len(scenes)):
            whole.stated += found.stated
            whole.stopped += found.stopped
            whole.left_out += found.left_out
            whole.kept |= found.kept
    return whole


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sets", metavar="SET", nargs="+")
    parser.add_argument("--sizes", metavar="WIDTHxHEIGHT", nargs="+", default=["64x32", "128x64"])
    parser.add_argument("--counts", type=int, nargs="+", default=[16, 64, 256])
    parser.add_argument("--seeds", type=int, default=24)
    parser.add_argument("--targets", type=float, nargs="*", default=[0.1, 0.03])
    parser.add_argument("--target-seeds", type=int, default=6)
    parser.add_argument("--most", type=int, default=4096, help="samples on the way to a target")
    parser.add_argument("--truth", type=int, default=27, help="log2 of pixels times samples, of each of two images")
    parser.add_argument("--jobs", type=int, default=1, help="scenes at once (default: 1)")
    parser.add_argument("--by-scene", action="store_true")
    parser.add_argument("--keep", type=pathlib.Path, metavar="FOLDER")
    parser.add_argument("--keep-seeds", type=int, default=2)
    parser.add_argument("--keep-sizes", nargs="+", default=["64x32"])
    options = parser.parse_args()
    for name in options.sets:
        found = measure(name, options)
        print(f"## {name}\n")
        print_tables(found, options.by_scene)
        if options.keep:
            options.keep.mkdir(parents=True, exist_ok=True)
            cases = {kind: numpy.array([[str(value) for value in vars(case).values()] for case in getattr(found, kind)])
                     for kind in ("stated", "stopped")}
            stem = name.replace(":", "-").replace("/", "-").strip("-")
            numpy.savez_compressed(options.keep / f"{stem}.npz", **found.kept, **cases)


if __name__ == "__main__":
    main()
