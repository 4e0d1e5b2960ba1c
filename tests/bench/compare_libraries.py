"""Compares the costs of equal errors between builds of libpt in the scenes of cli/scenes.

    python3 tests/bench/compare_libraries.py --library old=OLD/libpt.so --library new=build/lib/libpt.so

Renders pictures of 8, 32 and 128 samples with several seeds, in turn. The cost is the median CPU seconds of a picture.
The error is the variance over seeds, divided by r^2 + 0.01 with the mean r of all pictures.

time, error     relative to the first library, at 32 samples
gain            CPU seconds of the first library at 32 samples, divided by this library's for the same error
z               difference of the means of all pictures of 128 samples, in standard errors
"""

import argparse
import json
import math
import os
import resource
import statistics
import subprocess
import sys

from bench_scenes import load_scene
from cost_of_error import cost_of_error
from table import print_table

COUNTS, AT, FEW_SURFACES = (8, 32, 128), 32, 12


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--library", action="append", required=True, metavar="NAME=FILE")
    parser.add_argument("--scenes", default="closed-room,coursework,dim-room,mirror-wall,open-sky,tiny-lamp",
                        metavar="NAME,...")
    parser.add_argument("--path-lengths", default="3,6", metavar="L,...")
    parser.add_argument("--size", default="64x32", metavar="WxH")
    parser.add_argument("--seeds", type=int, default=8)
    parser.add_argument("--one", metavar="NAME,L", help=argparse.SUPPRESS)
    return parser.parse_args()


def cpu_seconds():
    usage = resource.getrusage(resource.RUSAGE_SELF)
    return usage.ru_utime + usage.ru_stime


def render(renderer, options, length, samples, seed):
    width, height = map(int, options.size.split("x"))
    renderer.set_render(width, height, max_path_length=length, seed=seed)
    start = cpu_seconds()
    renderer.accumulate(samples)
    return cpu_seconds() - start, renderer.image()


def figures_of(pictures, pooled):
    variances = (statistics.variance(values) for values in zip(*(image for _, image in pictures)))
    errors = [variance / (r * r + 0.01) for variance, r in zip(variances, pooled)]
    return statistics.median(cost for cost, _ in pictures), statistics.fmean(errors)


def measure(name, length, options):
    scene = load_scene(name)
    if len(scene["spheres"]) + len(scene.get("planes", [])) <= FEW_SURFACES:
        os.environ.setdefault("LP_NATIVE_VECTOR_WIDTH", "512")
    os.environ["MESA_SHADER_CACHE_DISABLE"] = "true"
    from scene_renderer import SceneRenderer

    libraries = {}
    for library in options.library:
        label, os.environ["PT_LIBRARY"] = library.split("=", 1)
        libraries[label] = SceneRenderer(scene)
    for renderer in libraries.values():
        for _ in range(3):
            render(renderer, options, length, COUNTS[0], 0)
    pictures = {(label, count): [] for label in libraries for count in COUNTS}
    for count in COUNTS:
        for seed in range(options.seeds):
            for label, renderer in libraries.items():
                pictures[label, count].append(render(renderer, options, length, count, 1000 * count + seed))
    most = [image for (_, count), of_label in pictures.items() if count == COUNTS[-1] for _, image in of_label]
    pooled = [statistics.fmean(values) for values in zip(*most)]
    result = {}
    for label in libraries:
        means = [statistics.fmean(image) for _, image in pictures[label, COUNTS[-1]]]
        result[label] = {"figures": [figures_of(pictures[label, count], pooled) for count in COUNTS],
                         "mean": statistics.fmean(means),
                         "error_of_mean": statistics.stdev(means) / math.sqrt(len(means))}
    return result


def row_of(name, length, label, of_first, of_label):
    at = COUNTS.index(AT)
    first_cost, first_error = of_first["figures"][at]
    cost, error = of_label["figures"][at]
    gain = first_cost / cost_of_error(dict(zip(COUNTS, of_label["figures"])), first_error)[0]
    spread = math.hypot(of_first["error_of_mean"], of_label["error_of_mean"])
    deviation = (of_label["mean"] - of_first["mean"]) / spread if spread else 0.0
    return [name, str(length), label, f"{cost / first_cost:.2f}", f"{error / first_error:.2f}", f"{gain:.2f}",
            f"{deviation:+.1f}"]


def main():
    options = parse_arguments()
    if options.one:
        name, length = options.one.split(",")
        print(json.dumps(measure(name, int(length), options)))
        return
    rows = [["scene", "L", "", "time", "error", "gain", "z"]]
    for name in options.scenes.split(","):
        for length in options.path_lengths.split(","):
            output = subprocess.run([sys.executable, "-B", __file__, *sys.argv[1:], "--one", f"{name},{length}"],
                                    check=True, stdout=subprocess.PIPE, text=True).stdout
            result = json.loads(output)
            first = next(iter(result.values()))
            rows += [row_of(name, length, label, first, figures) for label, figures in list(result.items())[1:]]
    print_table(rows)


if __name__ == "__main__":
    main()
