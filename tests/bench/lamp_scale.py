"""Measures what many lamps cost: clouds of 1 to 10,000 of them, whose brightness spans four powers of ten, over a floor
with eight balls.

    python3 tests/bench/lamp_scale.py --library pt=build/lib/libpt.so
    python3 tests/bench/lamp_scale.py --library old=OLD/libpt.so --library pt=build/lib/libpt.so --lamps 10,1e4

The libraries are measured in turn, as scale.py does; figures are medians over the rounds.

first           seconds from the scene to its first picture of one sample in memory, with its kernels compiled then
M/s, M/CPU s    millions of samples a second, and a second of all threads' time, left out on a GPU
dark            the same where all lamps but one are dark balls of the same places and sizes: what the rays cost. The
                difference is what the choice among lamps costs
"""

import argparse
import json
import sys

from lamp_cloud import LampCloud
from scale import Library, measure_rates
from table import print_table


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--library", action="append", required=True, metavar="NAME=FILE")
    parser.add_argument("--lamps", default="1,10,100,1e3,1e4", metavar="N,...")
    parser.add_argument("--path-length", type=int, default=3, metavar="L")
    parser.add_argument("--size", default="256x128", metavar="WxH", help="default: 256x128")
    parser.add_argument("--seconds", type=float, default=0.5, help="wall time of a measurement (default: 0.5)")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--json", metavar="FILE", help="write all figures")
    options = parser.parse_args()
    options.counts = [int(float(count)) for count in options.lamps.split(",")]
    options.lengths = [options.path_length]
    options.width, options.height = map(int, options.size.split("x"))
    return options


def measure(cloud, options):
    """Name of a library -> its figures."""
    programs = [Library(*library.split("=", 1), cloud, options) for library in options.library]
    try:
        rates = measure_rates(programs, options)
        return {program.name: {"device": program.device, "on_cpu": program.on_cpu, "first": program.first_seconds,
                               "rates": rates[program.name, options.path_length]} for program in programs}
    finally:
        for program in programs:
            program.close()


def measure_count(count, options):
    """Figures of each library, with those of the dark cloud in them."""
    lit, dark = (measure(LampCloud(count, shining), options) for shining in (True, False))
    return [{"lamps": count, "program": name, **figures, "dark_rates": dark[name]["rates"]}
            for name, figures in lit.items()]


def print_rates(costs):
    rows = [["lamps", "", "first", "M/s", "M/CPU s", "dark: M/s", "dark: M/CPU s"]]
    for cost in costs:
        row = [f"{cost['lamps']:,}", cost["program"], f"{cost['first']:.2f}"]
        for wall, cpu in (cost["rates"], cost["dark_rates"]):
            row += [f"{wall / 1e6:.3g}", f"{cpu / 1e6:.3g}" if cost["on_cpu"] else "-"]
        rows.append(row)
    print_table(rows)


def main():
    options = parse_arguments()
    costs = []
    for count in options.counts:
        print(f"{count:,} lamps", file=sys.stderr, flush=True)
        costs += measure_count(count, options)
    devices = dict.fromkeys(cost["device"] for cost in costs)
    print(f"{', '.join(devices)}, {options.size}, path length {options.path_length}, "
          f"medians of {options.rounds} rounds\n")
    print_rates(costs)
    if options.json:
        with open(options.json, "w", encoding="utf-8") as file:
            json.dump({"size": options.size, "path_length": options.path_length, "costs": costs}, file, indent=1)
            file.write("\n")


if __name__ == "__main__":
    main()
