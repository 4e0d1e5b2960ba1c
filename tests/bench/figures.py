"""From a file of atoms to a picture: pt figure beside Mitsuba 3, Tachyon and OVITO, on the same data.

    python3 -m venv mitsuba && mitsuba/bin/pip install mitsuba==3.9.1 numpy
    python3 -m venv ovito && ovito/bin/pip install ovito numpy
    apt-get install tachyon
    DRJIT_LIBLLVM_PATH=libLLVM.so.19.1 python3 tests/bench/figures.py --mitsuba mitsuba/bin/python \\
        --ovito ovito/bin/python --counts 10000 100000 1000000 --folder pictures

The data are droplets (figure_data.py) in LAMMPS dumps. All programs have the camera that pt figure chooses; Mitsuba has
its light too, the others what their users have: a directional light, and ambient occlusion. pt and Mitsuba take 256
samples a pixel of paths of as many vertices; Tachyon 16 places in a pixel with 16 rays of ambient occlusion each; OVITO
its defaults, which are 12 of both in its own Tachyon, and a denoiser in OSPRay. A program is left out without its
option, and where it is not on the path.

Measured is the whole command, from the file to the PNG: CPU seconds of all its threads, wall seconds, and its peak
memory, which of several processes of one command is that of the largest. Medians over rounds, each of all programs in
turn. Noise, by --noise: of pt and Mitsuba the root of the mean square between two seeds over the root of 2;
of the others, whose random numbers are always the same, that to a picture with 16 times the samples; in steps of 8
bits, over the pixels that are not white in both. What a program leaves out of the light is no noise.
"""

import argparse
import json
import os
import shutil
import statistics
import subprocess
import sys
import time

from figure_data import RADIUS, view_of_scene, write_dump
from table import print_table

HERE = os.path.dirname(os.path.abspath(__file__))
MITSUBA_MOST = 100000  # balls
LOOK = ("--radius", str(RADIUS), "--box", "none")


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--pt", default="build/bin/pt", help="the program (default: build/bin/pt)")
    parser.add_argument("--mitsuba", metavar="PYTHON", help="that has Mitsuba and NumPy")
    parser.add_argument("--ovito", metavar="PYTHON", help="that has OVITO and NumPy")
    parser.add_argument("--tachyon", metavar="PYTHON", default=sys.executable, help="that has NumPy")
    parser.add_argument("--counts", type=int, nargs="+", default=[10000, 100000, 1000000], help="of atoms")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--samples", type=int, default=256, help="a pixel, of pt and Mitsuba")
    parser.add_argument("--size", default="800x600", metavar="WxH")
    parser.add_argument("--programs", nargs="+", metavar="NAME", help="these alone")
    parser.add_argument("--noise", action="store_true", help="measure it, at the first count")
    parser.add_argument("--folder", default="figures", help="for data and pictures")
    parser.add_argument("--json", metavar="FILE", help="write all figures")
    return parser.parse_args()


class Program:
    """How to call it: for a picture, and for one that tells its noise."""

    def __init__(self, name, command, other, is_seeded, most=None):
        self.name, self.command, self.other, self.is_seeded, self.most = name, command, other, is_seeded, most

    def renders(self, count):
        return self.most is None or count <= self.most


def programs(options):
    width, height = options.size.split("x")
    samples = str(options.samples)

    def script(python, name, *settings):
        return lambda data, view, out: [python, os.path.join(HERE, name), data, view, out, width, height, *settings]

    def pt_figure(seed):
        return lambda data, view, out: [options.pt, "figure", data, "-o", out, *LOOK, "--size", options.size,
                                        "--spp", samples, "--seed", seed, "--quiet"]

    found = [Program("pt figure", pt_figure("0"), pt_figure("1"), True)]
    if options.mitsuba:
        for shape in ("ellipsoids", "spheres"):
            both = [script(options.mitsuba, "figure_mitsuba.py", samples, seed, shape) for seed in ("0", "1")]
            found.append(Program(f"Mitsuba, {shape}", *both, True, MITSUBA_MOST))
    if shutil.which("tachyon"):
        found.append(Program("Tachyon", script(options.tachyon, "figure_tachyon.py", "16", "16"),
                             script(options.tachyon, "figure_tachyon.py", "64", "64"), False))
    if options.ovito:
        own = ("figure_ovito.py", "TachyonRenderer")
        more = ("antialiasing_samples=48", "ambient_occlusion_samples=48")
        found.append(Program("OVITO, Tachyon", script(options.ovito, *own), script(options.ovito, *own, *more), False))
        own = ("figure_ovito.py", "OSPRayRenderer")
        found.append(Program("OVITO, OSPRay", script(options.ovito, *own),
                             script(options.ovito, *own, "refinement_iterations=64"), False))
    return [program for program in found if not options.programs or program.name in options.programs]


def run(command):
    """CPU seconds, wall seconds and peak MiB of a command and what it called."""
    start = time.perf_counter()
    process = subprocess.Popen(["/usr/bin/time", "-f", "%U %S %M", *command], stderr=subprocess.PIPE, text=True)
    errors = process.communicate()[1]
    if process.returncode != 0:
        raise SystemExit(f"{' '.join(command)}\n{errors}")
    user, system, kibibytes = map(float, errors.splitlines()[-1].split())
    return user + system, time.perf_counter() - start, kibibytes / 1024


def noise(program, data, view, out):
    """Of the picture in out, in steps of 8 bits; needs NumPy and imageio."""
    import imageio.v3
    import numpy
    other = out.replace(".png", "-other.png")
    run(program.other(data, view, other))
    pictures = [imageio.v3.imread(path)[:, :, :3].astype(float) for path in (out, other)]
    seen = (pictures[0].min(axis=2) < 250) & (pictures[1].min(axis=2) < 250)
    square = ((pictures[0] - pictures[1])[seen] ** 2).mean()
    return float(numpy.sqrt(square / 2 if program.is_seeded else square))


def main():
    options = parse_arguments()
    os.makedirs(options.folder, exist_ok=True)
    rows = [["atoms", "program", "CPU s", "wall s", "MiB", "noise"]]
    report = []
    for count in options.counts:
        data, view, scene = (os.path.join(options.folder, f"{count}.{kind}") for kind in ("dump", "view.json", "json"))
        write_dump(data, count)
        subprocess.run([options.pt, "figure", data, "--write-scene", scene, *LOOK, "--size", options.size,
                        "--spp", "1", "--quiet"], check=True)
        with open(view, "w", encoding="utf-8") as file:
            json.dump(view_of_scene(scene), file)
        os.remove(scene)
        chosen = [program for program in programs(options) if program.renders(count)]
        runs = {program.name: [] for program in chosen}
        for _ in range(options.rounds):
            for program in chosen:
                out = os.path.join(options.folder, f"{count} {program.name}.png".replace(", ", "-").replace(" ", "-"))
                runs[program.name].append(run(program.command(data, view, out)))
                print(count, program.name, *(f"{value:.1f}" for value in runs[program.name][-1]), file=sys.stderr)
        for program in chosen:
            out = os.path.join(options.folder, f"{count} {program.name}.png".replace(", ", "-").replace(" ", "-"))
            told = noise(program, data, view, out) if options.noise and count == options.counts[0] else None
            cpu, wall, memory = (statistics.median(column) for column in zip(*runs[program.name]))
            report.append({"atoms": count, "program": program.name, "cpu_seconds": cpu, "seconds": wall,
                           "mebibytes": memory, "noise": told, "runs": runs[program.name]})
            rows.append([f"{count:,}", program.name, f"{cpu:.1f}", f"{wall:.1f}", f"{memory:.0f}",
                         "" if told is None else f"{told:.2f}"])
    print_table(rows)
    if options.json:
        with open(options.json, "w", encoding="utf-8") as file:
            json.dump({"size": options.size, "samples": options.samples, "results": report}, file, indent=2)
            file.write("\n")


if __name__ == "__main__":
    main()
