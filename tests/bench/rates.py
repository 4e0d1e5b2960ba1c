"""Measures how fast pt takes samples, how fast it starts, what memory it needs, and what each part of a scene costs.

    python3 tests/bench/rates.py --pt build/bin/pt --json rates.json

Runs the program on scenes of cli/scenes and on variants of the coursework scene that this script makes. Every round
runs all cases in turn, so that a disturbed machine is so for all alike; figures are medians over the rounds.

samples/s       from the difference of two runs with different sample counts, so that start-up falls out; per wall
                second (of sampling) and per CPU second (of all threads; left out on a GPU, where it means nothing)
paths/s         the same, where a path is a branch: beyond path length 2 the first vertex of a sample is left by 4 paths
first, cold     seconds to create the context and take the first sample with an empty folder for compiled kernels
first, warm     the same when the kernel has been compiled by an earlier process
start to PNG    wall seconds of the whole process for 16 samples, warm
peak            memory of that process (resident, the system's ru_maxrss)
cost            CPU seconds a sample (wall seconds on a GPU) of a variant over those of the coursework scene
"""

import argparse
import copy
import json
import os
import statistics
import subprocess
import sys
import tempfile
import time

from devices import runs_on_cpu
from table import print_table

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(ROOT, "tests/support"))
from scene_file import read_scene  # noqa: E402

SCENES = ("coursework", "coursework-diffuse", "coursework-motion", "many-lamps")
PATH_LENGTHS = (2, 6)
FEW = 16  # samples of the shorter run, and of the run to a PNG
MOST = 1 << 20


def branch_count(path_length):
    return 4 if path_length > 2 else 1


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--pt", default="build/bin/pt", help="the program (default: build/bin/pt)")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--device", help="as for pt render")
    parser.add_argument("--size", default="256x128", metavar="WxH", help="default: 256x128")
    parser.add_argument("--seconds", type=float, default=0.5, help="wall time of a longer run (default: 0.5)")
    parser.add_argument("--json", metavar="FILE", help="write all figures and those of each round")
    return parser.parse_args()


def variants():
    """What the coursework scene may lack: name -> scene."""
    full = read_scene(os.path.join(ROOT, "cli/scenes/coursework.json"))
    no_gloss, one_lamp, half = (copy.deepcopy(full) for _ in range(3))
    for material in no_gloss["materials"].values():
        material.pop("specular", None)
    lamps = [s for s in full["spheres"] if "emission" in full["materials"][s["material"]]]
    balls = [s for s in full["spheres"] if s not in lamps]
    one_lamp["spheres"] = lamps[:1] + balls
    half["spheres"] = lamps[:1] + balls[:1]
    half["planes"] = full["planes"][:2]
    return {"without gloss": no_gloss, "with one lamp": one_lamp, "half the objects": half}


class Program:
    """Runs pt in an environment whose caches of compiled kernels are in a folder of this script's."""

    def __init__(self, options, folder):
        self.options, self.folder = options, folder

    def environment(self, cache):
        os.makedirs(cache, exist_ok=True)
        return {**os.environ, "XDG_CACHE_HOME": cache, "__GL_SHADER_DISK_CACHE_PATH": cache}

    def render(self, case, sample_count, cache="cache"):
        """Figures of one process."""
        stats = os.path.join(self.folder, "stats.json")
        command = [self.options.pt, "render", case["path"], "--size", self.options.size, "--spp", str(sample_count),
                   "--max-path-length", str(case["path_length"]), "--sampler", case["sampler"],
                   "-o", os.path.join(self.folder, "image.png"), "--stats", stats, "--quiet"]
        command += ["--device", self.options.device] if self.options.device else []
        start = time.perf_counter()
        process = subprocess.Popen(command, env=self.environment(os.path.join(self.folder, cache)))
        _, status, usage = os.wait4(process.pid, 0)
        wall = time.perf_counter() - start
        if status != 0:
            raise SystemExit(f"{' '.join(command)}: ended with status {status}")
        with open(stats, encoding="utf-8") as file:
            facts = json.load(file)
        return {"wall": wall, "cpu": usage.ru_utime + usage.ru_stime, "peak_bytes": usage.ru_maxrss * 1024,
                "sampling": facts["seconds"]["accumulate"],
                "first": facts["seconds"]["create"] + facts["seconds"]["accumulate"], "facts": facts}


def make_cases(folder):
    cases = []
    for name in SCENES:
        path = os.path.join(ROOT, "cli/scenes", name + ".json")
        cases += [{"scene": name, "path": path, "path_length": length, "sampler": sampler}
                  for length in PATH_LENGTHS for sampler in ("best", "random")]
    for name, scene in variants().items():
        path = os.path.join(folder, name.replace(" ", "-") + ".json")
        with open(path, "w", encoding="utf-8") as file:
            json.dump(scene, file)
        cases += [{"scene": name, "path": path, "path_length": length, "sampler": "best"} for length in PATH_LENGTHS]
    return cases


def choose_sample_count(program, case):
    """As many as take the wished time, found with runs of growing length."""
    few = program.render(case, FEW)["sampling"]
    many = 4 * FEW
    while True:
        seconds = program.render(case, many)["sampling"] - few
        if seconds > program.options.seconds / 4 or many == MOST:
            break
        many = min(4 * many, MOST)
    wished = FEW + (many - FEW) * program.options.seconds / max(seconds, 1e-3)
    return int(min(max(wished, 2 * FEW), MOST))


def measure_round(program, case, number):
    few, many = program.render(case, FEW), program.render(case, case["sample_count"])
    cold = program.render(case, 1, cache=f"cold-{number}-{case['index']}")
    warm = program.render(case, 1)
    samples = (case["sample_count"] - FEW) * few["facts"]["width"] * few["facts"]["height"]
    return {"wall_seconds_per_sample": (many["sampling"] - few["sampling"]) / samples,
            "cpu_seconds_per_sample": (many["cpu"] - few["cpu"]) / samples,
            "first_cold": cold["first"], "first_warm": warm["first"], "start_to_png": few["wall"],
            "peak_bytes": few["peak_bytes"]}


def summarise(case, on_cpu):
    figures = {key: statistics.median(one[key] for one in case["rounds"]) for key in case["rounds"][0]}
    case["median"] = figures
    case["samples_per_wall_second"] = 1 / figures["wall_seconds_per_sample"]
    case["samples_per_cpu_second"] = 1 / figures["cpu_seconds_per_sample"] if on_cpu else None
    best = case["samples_per_cpu_second" if on_cpu else "samples_per_wall_second"]
    case["branches"] = branch_count(case["path_length"])
    case["paths_per_second"] = case["branches"] * best


def add_costs(cases, on_cpu):
    key = "cpu_seconds_per_sample" if on_cpu else "wall_seconds_per_sample"
    whole = {(case["path_length"], case["sampler"]): case for case in cases if case["scene"] == "coursework"}
    for case in cases:
        of_whole = whole[case["path_length"], case["sampler"]]
        ratios = [one[key] / other[key] for one, other in zip(case["rounds"], of_whole["rounds"])]
        case["cost"] = statistics.median(ratios)


def print_cases(cases):
    rows = [["scene", "length", "sampler", "M samples/CPU s", "M samples/s", "M paths", "first, cold", "first, warm",
             "start to PNG", "peak MiB", "cost"]]
    for case in cases:
        per_cpu, figures = case["samples_per_cpu_second"], case["median"]
        rows.append([case["scene"], str(case["path_length"]), case["sampler"],
                     "-" if per_cpu is None else f"{per_cpu / 1e6:.3g}", f"{case['samples_per_wall_second'] / 1e6:.3g}",
                     f"{case['paths_per_second'] / 1e6:.3g}", f"{figures['first_cold']:.3f}",
                     f"{figures['first_warm']:.3f}", f"{figures['start_to_png']:.3f}",
                     f"{figures['peak_bytes'] / 2**20:.0f}", f"{case['cost']:.2f}"])
    print_table(rows)


def main():
    options = parse_arguments()
    with tempfile.TemporaryDirectory() as folder:
        program, cases = Program(options, folder), make_cases(folder)
        device = program.render(cases[0], 1)["facts"]["device"]
        on_cpu = runs_on_cpu(options.pt, device)
        for index, case in enumerate(cases):
            case.update(index=index, sample_count=choose_sample_count(program, case), rounds=[])
        for number in range(options.rounds):
            for case in cases:
                case["rounds"].append(measure_round(program, case, number))
    for case in cases:
        summarise(case, on_cpu)
        case["path"] = os.path.basename(case["path"])
    add_costs(cases, on_cpu)
    print(f"{device['name']}, {options.size}, medians of {options.rounds} rounds")
    print_cases(cases)
    if options.json:
        with open(options.json, "w", encoding="utf-8") as file:
            report = {"device": device, "size": options.size, "rounds": options.rounds, "cases": cases}
            json.dump(report, file, indent=2)
            file.write("\n")


if __name__ == "__main__":
    main()
