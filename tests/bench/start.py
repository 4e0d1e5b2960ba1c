"""Takes the time of a short run of pt apart: from its start to the picture, as its user waits for it.

    python3 tests/bench/start.py --pt new=build/bin/pt
    python3 tests/bench/start.py --pt old=OLD/bin/pt --pt new=build/bin/pt --size 1920x1080 --arguments "--device 0"

Several programs are measured in turn, so that a disturbed machine is so for all alike. Milliseconds, medians over the
rounds; the first run of each, which may have to compile kernels, is told apart.

create    pt_create: the Vulkan instance and device, for the most part the driver's work
samples   kernels, samples and reading back
picture   tone mapping, encoding and writing
process   loading the program before, and taking down the device and the process after
"""

import argparse
import json
import os
import shlex
import statistics
import subprocess
import tempfile
import time

from table import print_table

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--pt", action="append", required=True, metavar="NAME=FILE")
    parser.add_argument("--scene", default=os.path.join(ROOT, "cli/scenes/coursework.json"))
    parser.add_argument("--size", default="1024x512", metavar="WxH")
    parser.add_argument("--spp", default="64", metavar="N")
    parser.add_argument("--arguments", default="", help="more of pt render's")
    parser.add_argument("--rounds", type=int, default=15)
    return parser.parse_args()


def run(program, arguments, folder):
    """The parts of one run in milliseconds, by name."""
    stats = os.path.join(folder, "stats.json")
    command = [program, "render", arguments.scene, "-o", os.path.join(folder, "picture.png"), "--size", arguments.size,
               "--spp", arguments.spp, "--quiet", "--stats", stats, *shlex.split(arguments.arguments)]
    begin = time.perf_counter()
    subprocess.run(command, check=True)
    wall = time.perf_counter() - begin
    with open(stats, encoding="utf-8") as file:
        seconds = json.load(file)["seconds"]
    parts = {"create": seconds["create"], "samples": seconds["accumulate"],
             "picture": seconds["total"] - seconds["create"] - seconds["accumulate"],
             "process": wall - seconds["total"], "all": wall}
    return {name: 1e3 * part for name, part in parts.items()}


def main():
    arguments = parse_arguments()
    programs = dict(program.split("=", 1) for program in arguments.pt)
    runs = {name: [] for name in programs}
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(1 + arguments.rounds):
            for name, program in programs.items():
                runs[name].append(run(program, arguments, folder))
    parts = list(next(iter(runs.values()))[0])
    rows = [["ms", *parts]]
    for name, found in runs.items():
        rows.append([name + ", first", *(f"{found[0][part]:.0f}" for part in parts)])
        rows.append([name, *(f"{statistics.median(one[part] for one in found[1:]):.0f}" for part in parts)])
    print_table(rows)


if __name__ == "__main__":
    main()
