"""Renders the benchmark's scenes with pt's default, with all other samplers and estimators, and with Mitsuba. Prints a
table, and draws error against time (benchmark.png, with matplotlib).

--mitsuba names a Python with Mitsuba:

    python3 -m venv mitsuba && mitsuba/bin/pip install mitsuba

Mitsuba's variant llvm_ad_rgb (CPU) needs LLVM's shared library, and DRJIT_LIBLLVM_PATH names it. The variant
cuda_ad_rgb runs on a GPU.

cost     median CPU seconds of sampling (GPU: wall seconds)
error    mean relMSE (README.md) against references (references.py)
target   an error of the default at one of its two largest sample counts
ratio    an option's cost at the target, divided by the default's cost, interpolated in logarithms; "~" marks
         extrapolation with the slope -1
"""

import argparse
import json
import os
import pathlib
import subprocess
import sys
import tempfile

from bench_scenes import NAMES, REFERENCES, SIZE, load_scene, read_reference_table, sample_counts, scene_path
from benchmark_figures import DEFAULT, ESTIMATORS, SAMPLERS, print_report, scene_figures
from mitsuba_scene import obstacle

ERROR_AND_TIME = [sys.executable, "-B", str(pathlib.Path(__file__).with_name("error_and_time.py"))]
MITSUBA_FACTOR = 4


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--mitsuba", metavar="PYTHON", help="interpreter that can import Mitsuba (default: without it)")
    parser.add_argument("--variant", default="llvm_ad_rgb", help="of Mitsuba (default: llvm_ad_rgb)")
    parser.add_argument("--device", help="of pt (default: the best)")
    parser.add_argument("--scenes", nargs="+", choices=NAMES, default=NAMES)
    parser.add_argument("--samples", type=int, nargs="+", help="per pixel, at least two numbers (default: the scene's)")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--references", type=pathlib.Path, default=REFERENCES)
    parser.add_argument("--json", metavar="FILE", type=pathlib.Path, default="benchmark.json",
                        help="all figures; the plot has its name with .png (default: benchmark.json)")
    options = parser.parse_args()
    if options.samples and len(set(options.samples)) < 2:
        parser.error("--samples: two different numbers at least")
    return options


def bench(command, folder):
    path = os.path.join(folder, "bench.json")
    subprocess.run([*command, "--json", path], check=True)
    with open(path, encoding="utf-8") as file:
        return json.load(file)


def run_pt(options, name, counts, number, folder):
    cells = {}
    for samplers, estimators in ((SAMPLERS, DEFAULT[1:]), (DEFAULT[:1], ESTIMATORS)):
        command = [*ERROR_AND_TIME, str(scene_path(name)), "--reference", str(options.references / f"{name}.exr"),
                   "--size", "{}x{}".format(*SIZE), "--samplers", ",".join(samplers), "--estimators",
                   ",".join(estimators), "--spp", counts, "--rounds", "1", "--seed", str(10 * number), "--quiet"]
        result = bench(command + (["--device", options.device] if options.device else []), folder)
        for cell in result["cells"]:
            pair = (cell["sampler"], cell["estimator"])
            option = "default" if pair == DEFAULT else pair[0] if pair[1] == DEFAULT[1] else pair[1]
            cells.setdefault(option, []).append(cell)
    return cells, result["device"]


def run_mitsuba(options, name, counts, number, folder):
    worker = os.path.join(os.path.dirname(os.path.abspath(__file__)), "mitsuba_bench.py")
    command = [options.mitsuba, "-B", worker, str(scene_path(name)), "--reference",
               str(options.references / f"{name}.exr"), "--spp", counts, "--seed", str(number + 1),
               "--variant", options.variant]
    return bench(command, folder)


def measure_round(options, name, number, report):
    counts = options.samples or sample_counts(name)
    scene = report["scenes"].setdefault(name, {"rounds": []})
    with tempfile.TemporaryDirectory() as folder:
        cells, scene["device"] = run_pt(options, name, ",".join(map(str, counts)), number, folder)
        scene["obstacle"] = obstacle(load_scene(name)) if options.mitsuba else None
        if options.mitsuba and not scene["obstacle"]:
            more = [*counts, MITSUBA_FACTOR * max(counts)]
            result = run_mitsuba(options, name, ",".join(map(str, more)), number, folder)
            cells["Mitsuba"], report["mitsuba"] = result["cells"], result["mitsuba"]
    scene["rounds"].append(cells)


def draw(report, path):
    try:
        from benchmark_plot import plot
    except ImportError as error:
        print(f"no plot: {error}", file=sys.stderr)
    else:
        plot(report).savefig(path, dpi=110)
        print(f"wrote {path}")


def main():
    options = parse_arguments()
    references = read_reference_table(options.references)
    report = {"rounds": options.rounds, "mitsuba": None, "scenes": {}}
    for number in range(options.rounds):
        for name in options.scenes:
            print(f"round {number + 1} of {options.rounds}: {name}", file=sys.stderr, flush=True)
            measure_round(options, name, number, report)
    on_cpu = all(scene["device"]["is_cpu"] for scene in report["scenes"].values())
    report["unit"] = "CPU seconds" if on_cpu else "seconds"
    for name, scene in report["scenes"].items():
        scene.update(scene_figures(scene["rounds"], "processor_seconds" if on_cpu else "seconds"),
                     own_error=references[name]["own_error"])
    print_report(report)
    options.json.write_text(json.dumps(report, indent=1) + "\n", encoding="utf-8")
    draw(report, options.json.with_suffix(".png"))


if __name__ == "__main__":
    main()
