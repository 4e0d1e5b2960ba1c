"""Notices when walks through trees have become slower: compares builds of libpt, or kernels, in clouds of spheres.

    python3 tests/bench/walks.py --library old=OLD/libpt.so --library new=build/lib/libpt.so
    python3 tests/bench/walks.py --library old=build/lib/libpt.so --library new=build/lib/libpt.so --shaders new=DIR

Each round builds the kernels anew, because builds of the same code differ in speed, and renders short pictures in turn.
A round's ratio is new / old of the least CPU seconds, because other processes only add time. Rounds go on
until the mean's standard error is small. Ends with 1 if the mean exceeds the limit, and with 2 if the machine is too
noisy for an answer.
"""

import argparse
import math
import os
import statistics
import sys
import time

os.environ["MESA_SHADER_CACHE_DISABLE"] = "true"
os.environ.setdefault("LP_NATIVE_VECTOR_WIDTH", "256")

from clouds import SphereCloud
from scene_renderer import SceneRenderer
from table import print_table

LIMIT = 1.025  # half of the loss to notice
STANDARD_ERROR = 0.008  # a third of LIMIT - 1
FEWEST_ROUNDS = 4
SECONDS = 0.02  # of a picture
SLOWER, UNCLEAR = 1, 2


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--library", action="append", required=True, metavar="NAME=FILE", help="old, then new")
    parser.add_argument("--shaders", action="append", default=[], metavar="NAME=DIR", help="kernels of a library")
    parser.add_argument("--counts", default="113,1e3,1e4", metavar="N,...", help="of spheres (default: 113,1e3,1e4)")
    parser.add_argument("--path-length", type=int, default=3, metavar="L")
    parser.add_argument("--rounds", type=int, default=24, help="at most (default: 24)")
    parser.add_argument("--pictures", type=int, default=12, help="of a round (default: 12)")
    options = parser.parse_args()
    if len(options.library) != 2:
        parser.error("--library: must be given twice")
    return options


class Walks:
    def __init__(self, library, shaders, scene, options):
        name, os.environ["PT_LIBRARY"] = library.split("=", 1)
        folder = {"shader_dir": shaders[name].encode()} if name in shaders else {}
        self.renderer = SceneRenderer(scene, **folder)
        self.length = options.path_length
        self.seconds_of(1)

    def seconds_of(self, samples):
        self.renderer.set_render(64, 64, max_path_length=self.length)
        start = time.process_time()
        self.renderer.accumulate(samples)
        return time.process_time() - start

    def close(self):
        self.renderer.__exit__()


def ratio_of_round(number, scene, options, shaders):
    """Rounds begin with old and new in turn, because the memory of the first may be the faster one."""
    both = {}
    try:
        for library in options.library if number % 2 else reversed(options.library):
            both[library] = Walks(library, shaders, scene, options)
        old, new = (both[library] for library in options.library)
        samples = max(1, round(4 * SECONDS / old.seconds_of(4)))
        least = {old: math.inf, new: math.inf}
        for picture in range(options.pictures):
            for each in (old, new) if (picture + number // 2) % 2 else (new, old):
                least[each] = min(least[each], each.seconds_of(samples))
    finally:
        for each in both.values():
            each.close()
    return least[new] / least[old]


def mean_ratio(ratios):
    logs = list(map(math.log, ratios))
    return math.exp(statistics.fmean(logs)), statistics.stdev(logs) / math.sqrt(len(logs))


def is_clear(ratios):
    return len(ratios) >= FEWEST_ROUNDS and mean_ratio(ratios)[1] <= STANDARD_ERROR


def verdict(ratios):
    return UNCLEAR if not is_clear(ratios) else SLOWER if mean_ratio(ratios)[0] > LIMIT else 0


def main():
    options = parse_arguments()
    shaders = dict(pair.split("=", 1) for pair in options.shaders)
    rows, verdicts = [["spheres", "new/old", "standard error", "rounds", ""]], []
    for count in (int(float(text)) for text in options.counts.split(",")):
        scene, ratios = SphereCloud(count).scene(), []
        while len(ratios) < options.rounds and not is_clear(ratios):
            ratios.append(ratio_of_round(len(ratios), scene, options, shaders))
            print(f"{count:,} spheres, round {len(ratios)}: {ratios[-1]:.3f}", file=sys.stderr, flush=True)
        verdicts.append(verdict(ratios))
        mean, error = mean_ratio(ratios)
        words = {0: "not slower", SLOWER: "slower", UNCLEAR: "too noisy"}[verdicts[-1]]
        rows.append([f"{count:,}", f"{mean:.3f}", f"{error:.1%}", str(len(ratios)), words])
    print_table(rows)
    sys.exit(SLOWER if SLOWER in verdicts else max(verdicts))


if __name__ == "__main__":
    main()
