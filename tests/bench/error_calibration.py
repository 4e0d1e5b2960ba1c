"""Prints the tables of shaders/README.md that compare stated errors of images with true errors.

    python3 tests/bench/error_calibration.py [--before OLD.so] ...

PT_LIBRARY names the library. Scenes come from cli/scenes and calibration_scenes.py. The true error is the root mean
squared relative error over 24 seeds (96 for at most 8192 pixels). It is measured against an image of many samples with
another seed. Stated errors come from the first six seeds.
"""

import argparse
import concurrent.futures
import math
import multiprocessing
import os
import pathlib
import statistics
import sys
from dataclasses import dataclass

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from calibration_scenes import scenes  # noqa: E402
from relative_error import relative_square  # noqa: E402
from scene_file import FOLDER, read_scene  # noqa: E402
from scene_renderer import ESTIMATORS, SAMPLERS, SceneRenderer  # noqa: E402

SIZES = ["64x32", "128x64", "256x128", "512x256"]
COUNTS = [16, 64, 256, 1024]
TRUTH_WORK = 1 << 28  # pixels times samples
LEAST_TRUTH, MOST_TRUTH = 1 << 15, 1 << 17  # samples
MANY_SEEDS, FEW_SEEDS, STATED_SEEDS = 96, 24, 6
SMALL_PICTURE = 1 << 13
MOST_SAMPLES = 4096
RELATIVE_BITS = 2 + 4 + 8


@dataclass
class Case:
    scene: str
    size: str
    estimator: str
    sampler: str
    count: int
    ratio: float  # stated / true
    uncertain: bool
    holds: bool


class Calibration:
    def __init__(self, name, scene, size):
        self.name = name
        self.size = size
        self.length = scene.get("render", {}).get("max_path_length", 6)
        self.renderer = SceneRenderer(scene)
        self.start(99)
        pixels = self.renderer.value_count // 3
        self.renderer.accumulate(min(max(TRUTH_WORK // pixels, LEAST_TRUTH), MOST_TRUTH))
        self.truth = self.renderer.image()

    def start(self, seed, **fields):
        width, height = map(int, self.size.split("x"))
        self.renderer.set_render(width, height, max_path_length=self.length, seed=seed, **fields)

    def square(self):
        return relative_square(self.renderer.image(), self.truth)

    def cases(self, estimator, sampler):
        squares = {count: [] for count in COUNTS}
        stated = {count: [] for count in COUNTS}
        is_small = self.renderer.value_count // 3 <= SMALL_PICTURE
        for seed in range(100, 100 + (MANY_SEEDS if is_small else FEW_SEEDS)):
            self.start(seed, sampler=SAMPLERS[sampler], estimator=ESTIMATORS[estimator])
            done = 0
            for count in COUNTS:
                self.renderer.accumulate(count - done)
                done = count
                squares[count].append(self.square())
                if len(stated[count]) < STATED_SEEDS:
                    stated[count].append(self.renderer.error_estimate())
        for count in COUNTS:
            error = math.sqrt(statistics.fmean(squares[count]))
            for each in stated[count]:
                yield Case(self.name, self.size, estimator, sampler, count, each.relative_rmse / error,
                           each.uncertain & RELATIVE_BITS != 0,
                           each.relative_rmse_low <= error <= each.relative_rmse_high)

    def stopped(self, target):
        """Yields error / target for images that should reach the target, or None for images that do not reach it."""
        for seed in range(200, 200 + STATED_SEEDS):
            self.start(seed)
            result = self.renderer.accumulate(MOST_SAMPLES, target)
            yield math.sqrt(self.square()) / target if result == 2 else None  # PT_TARGET_REACHED


def all_scenes():
    return {path.stem: read_scene(path) for path in sorted(FOLDER.glob("*.json"))} | scenes()


def measure_scene(name, scene, options):
    cases, stopped = [], {target: [] for target in options.targets}
    for size in options.sizes:
        calibration = Calibration(name, scene, size)
        with calibration.renderer:
            for method in options.methods:
                cases += calibration.cases(*method.split("/"))
            for target in options.targets:
                stopped[target] += calibration.stopped(target)
    print(name, file=sys.stderr, flush=True)
    return cases, stopped


def measure(options, library):
    if library:
        os.environ["PT_LIBRARY"] = library
    chosen = {name: scene for name, scene in all_scenes().items() if not options.scenes or name in options.scenes}
    with concurrent.futures.ProcessPoolExecutor(options.jobs, multiprocessing.get_context("spawn")) as pool:
        parts = list(pool.map(measure_scene, chosen, chosen.values(), [options] * len(chosen)))
    return ([case for cases, _ in parts for case in cases],
            {target: [ratio for _, stopped in parts for ratio in stopped[target]] for target in options.targets})


def share(cases, holds):
    return f"{100 * sum(map(holds, cases)) / len(cases):.1f}%" if cases else ""


def flattered(case):
    return case.ratio < 0.9


def overstated(case):
    return case.ratio > 2


def absurd(case):
    return case.ratio > 10


def row(cases, before):
    known = [case for case in cases if not case.uncertain]
    uncertain = [case for case in cases if case.uncertain]
    cells = [share(cases, lambda case: case.uncertain), share(known, flattered), share(known, overstated),
             f"{statistics.median(case.ratio for case in known):.2f}" if known else "",
             share(known, lambda case: case.holds), share(uncertain, flattered), share(uncertain, overstated),
             share(cases, flattered), share(cases, overstated), share(cases, absurd)]
    old = [share(before, lambda case: case.uncertain), share(before, flattered), share(before, overstated),
           share(before, absurd)]
    return cells + (old if before else [])


def print_table(title, cases, before, key):
    heads = [title, "uncertain", "known: below 0.9", "above 2", "median", "bounds hold", "uncertain: below 0.9",
             "above 2", "all: below 0.9", "above 2", "above 10"]
    heads += ["before: uncertain", "below 0.9", "above 2", "above 10"] if before else []
    print("| " + " | ".join(heads) + " |\n|" + "---|" * len(heads))
    for name in [*dict.fromkeys(map(key, cases)), "all"]:
        chosen = [[case for case in some if name in (key(case), "all")] for some in (cases, before)]
        print("| " + " | ".join([str(name)] + row(*chosen)) + " |")
    print(flush=True)


def print_stopped(stopped):
    print("| target | reached | error above the target | above 1.25 times |\n|---|---|---|---|")
    for target, ratios in stopped.items():
        reached = [ratio for ratio in ratios if ratio is not None]
        print(f"| {target:.0%} | {len(reached)} of {len(ratios)} | {share(reached, lambda r: r > 1)} | "
              f"{share(reached, lambda r: r > 1.25)} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--before", metavar="LIBRARY")
    parser.add_argument("--methods", metavar="ESTIMATOR/SAMPLER", nargs="+", default=["mis/sobol"])
    parser.add_argument("--scenes", metavar="NAME", nargs="+")
    parser.add_argument("--sizes", metavar="WIDTHxHEIGHT", nargs="+", default=SIZES)
    parser.add_argument("--jobs", type=int, default=1, help="scenes at once")
    parser.add_argument("--targets", type=float, nargs="*", default=[0.1, 0.03])
    options = parser.parse_args()
    cases, stopped = measure(options, None)
    before = measure(options, options.before)[0] if options.before else []
    print_table("estimator, sampler", cases, before, lambda case: f"`{case.estimator}`, `{case.sampler}`")
    print_table("size", cases, before, lambda case: case.size)
    print_table("samples", cases, before, lambda case: case.count)
    print_table("scene", cases, before, lambda case: case.scene)
    print_stopped(stopped)


if __name__ == "__main__":
    main()
