"""Measures how fast pt takes samples, and how fast it starts.

Figures are medians.

samples/s       from the difference of two sample counts, per wall second of sampling and per CPU second (not on a GPU)
first, cold     seconds to create the context and take the first sample, including the compilation of kernels
first, warm     seconds with kernels that an earlier process compiled
start to PNG    wall seconds of the whole process for 16 samples, warm
"""

import argparse
import json
import os
import statistics
import subprocess
import tempfile
import time

from bench_scenes import scene_path
from table import print_table

SCENES = ("coursework", "coursework-diffuse", "coursework-motion", "many-lamps")
PATH_LENGTHS = (2, 6)
FEW = 16
MOST = 1 << 20


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--pt", default="build/bin/pt", help="the program (default: build/bin/pt)")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--device", help="as for pt render")
    parser.add_argument("--size", default="256x128", metavar="WxH", help="default: 256x128")
    parser.add_argument("--seconds", type=float, default=0.5, help="wall time of a longer run (default: 0.5)")
    parser.add_argument("--json", metavar="FILE", help="write all figures and those of each round")
    return parser.parse_args()


class Program:
    def __init__(self, options, folder):
        self.options, self.folder = options, folder

    def environment(self, cache):
        os.makedirs(cache, exist_ok=True)
        return {**os.environ, "XDG_CACHE_HOME": cache, "__GL_SHADER_DISK_CACHE_PATH": cache}

    def render(self, case, sample_count, cache="cache"):
        stats = os.path.join(self.folder, "stats.json")
        command = [self.options.pt, "render", scene_path(case["scene"]), "--size", self.options.size, "--spp",
                   str(sample_count), "--max-path-length", str(case["path_length"]),
                   "-o", os.path.join(self.folder, "image.png"), "--stats", stats, "--quiet"]
        command += ["--device", self.options.device] if self.options.device else []
        start = time.perf_counter()
        process = subprocess.Popen(command, env=self.environment(os.path.join(self.folder, cache)))
        _, status, usage = os.wait4(process.pid, 0)
        wall = time.perf_counter() - start
        if status != 0:
            raise SystemExit(f"{' '.join(map(str, command))}: ended with status {status}")
        with open(stats, encoding="utf-8") as file:
            facts = json.load(file)
        return {"wall": wall, "cpu": usage.ru_utime + usage.ru_stime, "sampling": facts["seconds"]["accumulate"],
                "first": facts["seconds"]["create"] + facts["seconds"]["accumulate"], "facts": facts}


def choose_sample_count(program, case):
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
    return {"samples_per_wall_second": samples / (many["sampling"] - few["sampling"]),
            "samples_per_cpu_second": samples / (many["cpu"] - few["cpu"]),
            "first_cold": cold["first"], "first_warm": warm["first"], "start_to_png": few["wall"]}


def print_cases(cases, on_cpu):
    rows = [["scene", "length", "M samples/CPU s", "M samples/s", "first, cold", "first, warm", "start to PNG"]]
    for case in cases:
        figures = case["median"]
        rows.append([case["scene"], str(case["path_length"]),
                     f"{figures['samples_per_cpu_second'] / 1e6:.3g}" if on_cpu else "-",
                     f"{figures['samples_per_wall_second'] / 1e6:.3g}",
                     *(f"{figures[key]:.3f}" for key in ("first_cold", "first_warm", "start_to_png"))])
    print_table(rows)


def main():
    options = parse_arguments()
    cases = [{"scene": name, "path_length": length} for name in SCENES for length in PATH_LENGTHS]
    with tempfile.TemporaryDirectory() as folder:
        program = Program(options, folder)
        device = program.render(cases[0], 1)["facts"]["device"]
        for index, case in enumerate(cases):
            case.update(index=index, sample_count=choose_sample_count(program, case), rounds=[])
        for number in range(options.rounds):
            for case in cases:
                case["rounds"].append(measure_round(program, case, number))
    for case in cases:
        case["median"] = {key: statistics.median(one[key] for one in case["rounds"]) for key in case["rounds"][0]}
    print(f"{device['name']}, {options.size}, medians of {options.rounds} rounds")
    print_cases(cases, device["kind"] == "CPU")
    if options.json:
        with open(options.json, "w", encoding="utf-8") as file:
            report = {"device": device, "size": options.size, "rounds": options.rounds, "cases": cases}
            json.dump(report, file, indent=2)
            file.write("\n")


if __name__ == "__main__":
    main()
