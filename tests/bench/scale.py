"""Measures the cost of clouds of 10 to a million spheres.

    DRJIT_LIBLLVM_PATH=libLLVM.so.19.1 python3 tests/bench/scale.py --library old=OLD/libpt.so \\
        --library pt=build/lib/libpt.so --mitsuba mitsuba/bin/python --counts 10,1e3,1e5

--clouds all draws clouds of eight kinds, and --seeds sets the number of each kind. --clouds lamps has lamps whose brightness
spans four powers of ten, with eight balls below each lamp. --clouds dark-lamps has balls in place of the lamps, so the
difference is the cost of choosing lamps. benchmark.py describes Mitsuba. Figures are medians.

scene           seconds of pt_set_scene, or of building Mitsuba's scene
bytes           device memory per sphere, from pt_stats.device_bytes with and without the cloud
first           seconds from the scene to a picture of one sample at the first path length, including compilation
M/s, M/CPU s    million samples per wall and per CPU second (not on a GPU)

--error-samples adds costs at equal error, at the first path length. The error is the relMSE (README.md) at this many
samples, or 4 times as many in Mitsuba. The reference is the first library's picture with 64 times as many samples. The
ratio is cost x relMSE, divided by the first library's. "off by" is the difference between the means of the picture and
the reference, relative and in standard errors. A second table has the geometric means of ratios over the clouds of a
kind, with the standard error and the largest ratio. Pictures with different means are left out.
"""

import argparse
import array
import itertools
import json
import math
import os
import resource
import statistics
import subprocess
import sys
import tempfile
import time

os.environ.update(MESA_SHADER_CACHE_DISABLE="true", __GL_SHADER_DISK_CACHE="0")

from clouds import CLOUDS, KINDS, SEED
from table import print_table

FOLDER = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(os.path.dirname(FOLDER), "support"))
from scene_renderer import SceneRenderer, color, structs, vector
from pt import DeviceKind

FLOAT32, UINT32 = 1, 3
MOST_SAMPLES = 1 << 14
MITSUBA_FACTOR = 4
REFERENCE_FACTOR, REFERENCE_SEED = 64, 1000
ALIKE = 0.01  # pictures whose means differ by more are not compared


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--library", action="append", required=True, metavar="NAME=FILE")
    parser.add_argument("--mitsuba", metavar="PYTHON", help="interpreter that can import Mitsuba (default: without it)")
    parser.add_argument("--mitsuba-counts", type=float, default=1e5, metavar="N", help="up to N spheres (default: 1e5)")
    parser.add_argument("--variant", default="llvm_ad_rgb", help="of Mitsuba (default: llvm_ad_rgb)")
    parser.add_argument("--clouds", default="spheres", metavar="KIND,...", help=f"all, or some of {', '.join(CLOUDS)}")
    parser.add_argument("--seeds", type=int, default=1, metavar="N", help="clouds of a kind and count (default: 1)")
    parser.add_argument("--counts", default="10,30,100,1e3,1e4,1e5,1e6", metavar="N,...", help="of spheres")
    parser.add_argument("--path-lengths", default="3,6", metavar="L,...")
    parser.add_argument("--size", default="256x128", metavar="WxH", help="default: 256x128")
    parser.add_argument("--seconds", type=float, default=0.5, help="wall time of a measurement (default: 0.5)")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--error-samples", type=int, metavar="S", help="compare errors too, at S samples")
    parser.add_argument("--error-counts", type=float, default=1e5, metavar="N", help="up to N spheres (default: 1e5)")
    parser.add_argument("--json", metavar="FILE", help="write all figures")
    options = parser.parse_args()
    options.clouds = list(KINDS) if options.clouds == "all" else options.clouds.split(",")
    if unknown := set(options.clouds) - set(CLOUDS):
        parser.error(f"--clouds: there is no {min(unknown)}")
    if options.mitsuba and set(options.clouds) - set(KINDS):
        parser.error("--mitsuba: takes no clouds of lamps")
    options.counts = [int(float(count)) for count in options.counts.split(",")]
    options.lengths = [int(length) for length in options.path_lengths.split(",")]
    options.width, options.height = map(int, options.size.split("x"))
    return options


def cpu_seconds():
    usage = resource.getrusage(resource.RUSAGE_SELF)
    return usage.ru_utime + usage.ru_stime


class Library:
    def __init__(self, name, path, cloud, options):
        os.environ["PT_LIBRARY"] = path
        self.name, self.options = name, options
        scene = cloud.surroundings()
        self.renderer = SceneRenderer(scene)
        device = self.renderer.device()
        self.device, self.on_cpu = device.name.decode(), device.kind == DeviceKind.CPU
        self.render(options.lengths[0], 1)
        before = self.renderer.stats().device_bytes
        self.scene_seconds = self.set_scene(scene, cloud)
        start = time.perf_counter()
        self.render(options.lengths[0], 1)
        self.first_seconds = self.scene_seconds + time.perf_counter() - start
        self.bytes = (self.renderer.stats().device_bytes - before) / cloud.count

    def set_scene(self, scene, cloud):
        names = list(scene["materials"])
        materials = [structs.pt_material(diffuse=color(m.get("diffuse", 0)), emission=color(m.get("emission", 0)))
                     for m in scene["materials"].values()]
        lamps = [structs.pt_sphere(vector(s["center"]), s["radius"], material=names.index(s["material"]))
                 for s in scene["spheres"]]
        planes = [structs.pt_plane(vector(p["normal"]), p["offset"], names.index(p["material"]))
                  for p in scene["planes"]]

        def column(values, components, kind):
            return structs.pt_column(values.buffer_info()[0], components * values.itemsize, kind)

        spheres = structs.pt_sphere_array(count=cloud.count, center=column(cloud.centers, 3, FLOAT32),
                                          radius=column(cloud.radii, 1, FLOAT32),
                                          material=column(cloud.materials, 1, UINT32))
        start = time.perf_counter()
        self.renderer.set_scene(materials, lamps, planes, [spheres])
        return time.perf_counter() - start

    def render(self, length, samples, seed=0):
        self.renderer.set_render(self.options.width, self.options.height, max_path_length=length, seed=seed)
        start, before = time.perf_counter(), cpu_seconds()
        self.renderer.accumulate(samples)
        after, end = cpu_seconds(), time.perf_counter()
        return end - start, after - before, self.renderer.image()

    def close(self):
        self.renderer.__exit__()


class Mitsuba:
    name, bytes, on_cpu = "Mitsuba", None, True

    def __init__(self, kind, count, seed, options):
        self.options = options
        self.on_cpu = not options.variant.startswith("cuda")
        self.process = subprocess.Popen(
            [options.mitsuba, "-B", os.path.join(FOLDER, "mitsuba_cloud.py"), "--variant", options.variant, "--size",
             options.size, "--path-lengths", options.path_lengths],
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        answer = self.ask(kind=kind, count=count, seed=seed)
        self.scene_seconds, self.device = answer["seconds"], "Mitsuba " + answer["version"]
        self.first_seconds = self.scene_seconds + self.render(options.lengths[0], 1)[0]

    def ask(self, **asked):
        self.process.stdin.write(json.dumps(asked) + "\n")
        self.process.stdin.flush()
        line = self.process.stdout.readline()
        if not line:
            raise SystemExit(f"Mitsuba ended with status {self.process.wait()}")
        return json.loads(line)

    def render(self, length, samples, seed=0):
        with tempfile.NamedTemporaryFile() as file:
            answer = self.ask(length=length, samples=samples, seed=seed, image=file.name)
            image = array.array("f", file.read())
        return answer["seconds"], answer["cpu_seconds"], image

    def close(self):
        self.process.stdin.close()
        self.process.wait()


def choose_samples(program, length, options):
    """Returns a power of four, because Mitsuba's sampler rounds up to powers of four. Also compiles the kernel."""
    samples = 4
    program.render(length, samples)
    while samples < MOST_SAMPLES and program.render(length, samples)[0] < options.seconds / 4:
        samples *= 4
    return samples


def measure_rates(programs, options):
    rates, samples_of_picture = {}, options.width * options.height
    for length in options.lengths:
        samples = [choose_samples(program, length, options) for program in programs]
        times = [[] for _ in programs]
        for number in range(options.rounds):
            for program, count, of_program in zip(programs, samples, times):
                of_program.append(program.render(length, count, number)[:2])
        for program, count, of_program in zip(programs, samples, times):
            rates[program.name, length] = [count * samples_of_picture / statistics.median(column)
                                           for column in zip(*of_program)]
    return rates


def relative_error(image, reference):
    return math.fsum((x - r) ** 2 / (r * r + 0.01) for x, r in zip(image, reference)) / len(reference)


def difference_of_means(image, reference):
    pixels = [sum(image[i:i + 3]) - sum(reference[i:i + 3]) for i in range(0, len(image), 3)]
    mean = statistics.fmean(pixels)
    error = statistics.pstdev(pixels, mean) / math.sqrt(len(pixels))
    return mean / (3 * statistics.fmean(reference)), mean / error if error else 0.0


def measure_errors(programs, options):
    """Maps each program to samples, cost, relMSE, ratio of cost x relMSE, and difference of means."""
    length, figures = options.lengths[0], {}
    count = REFERENCE_FACTOR * options.error_samples
    reference = programs[0].render(length, count, REFERENCE_SEED)[2]
    rounds = {program.name: [] for program in programs}
    for number in range(options.rounds):
        for program in programs:
            samples = options.error_samples * (MITSUBA_FACTOR if isinstance(program, Mitsuba) else 1)
            rounds[program.name].append((samples, *program.render(length, samples, number + 1)))
    for name, of_program in rounds.items():
        mean = [statistics.fmean(values) for values in zip(*(image for *_, image in of_program))]
        figures[name] = {"samples": of_program[0][0],
                         "cost": statistics.median(one[2 if programs[0].on_cpu else 1] for one in of_program),
                         "rel_mse": statistics.fmean(relative_error(one[3], reference) for one in of_program),
                         "off_by": difference_of_means(mean, reference)}
    of_first = figures[programs[0].name]
    for of_program in figures.values():
        of_program["ratio"] = of_program["cost"] * of_program["rel_mse"] / (of_first["cost"] * of_first["rel_mse"])
    return figures


def measure_cloud(kind, count, seed, options, report):
    cloud = CLOUDS[kind](count, seed)
    programs = [Library(*library.split("=", 1), cloud, options) for library in options.library]
    report["devices"] = list(dict.fromkeys(program.device for program in programs))
    try:
        if options.mitsuba and count <= options.mitsuba_counts:
            programs.append(Mitsuba(kind, count, seed, options))
        rates = measure_rates(programs, options)
        for program in programs:
            report["costs"].append({
                "cloud": kind, "count": count, "program": program.name, "scene": program.scene_seconds, "bytes": program.bytes,
                "first": program.first_seconds, "on_cpu": program.on_cpu,
                "rates": {length: rates[program.name, length] for length in options.lengths}})
        if options.error_samples and count <= options.error_counts:
            report["errors"] += [{"cloud": kind, "count": count, "program": name, **figures}
                                 for name, figures in measure_errors(programs, options).items()]
    finally:
        for program in programs:
            program.close()


def print_costs(costs, options):
    heading = ["cloud", "spheres", "", "scene", "bytes", "first"]
    for length in options.lengths:
        heading += [f"L {length}: M/s", f"L {length}: M/CPU s"]
    rows = [heading]
    for cost in costs:
        row = [cost["cloud"], f"{cost['count']:,}", cost["program"], f"{cost['scene']:.2g}",
               "-" if cost["bytes"] is None else f"{cost['bytes']:.0f}", f"{cost['first']:.2f}"]
        for wall, cpu in cost["rates"].values():
            row += [f"{wall / 1e6:.3g}", f"{cpu / 1e6:.3g}" if cost["on_cpu"] else "-"]
        rows.append(row)
    print_table(rows)


def print_errors(errors, options):
    rows = [["cloud", "spheres", "", "samples", "cost, s", "relMSE", "cost x relMSE", "off by"]]
    for error in errors:
        off, deviations = error["off_by"]
        rows.append([error["cloud"], f"{error['count']:,}", error["program"], str(error["samples"]), f"{error['cost']:.2f}",
                     f"{error['rel_mse']:.2g}", f"{error['ratio']:.2f}" if abs(off) < ALIKE else "-",
                     f"{off:+.2%} ({deviations:+.1f})"])
    print(f"\nat path length {options.lengths[0]}\n")
    print_table(rows)


def mean_ratios(errors):
    """Maps kinds and programs to the geometric mean, its standard error as a factor, the largest ratio, and the count."""
    ratios = {}
    for error in errors:
        if abs(error["off_by"][0]) < ALIKE:
            ratios.setdefault((error["cloud"], error["program"]), []).append(math.log(error["ratio"]))
            ratios.setdefault(("all", error["program"]), []).append(math.log(error["ratio"]))
    return {key: (math.exp(statistics.fmean(logs)), math.exp(statistics.stdev(logs) / math.sqrt(len(logs))),
                  math.exp(max(logs)), len(logs)) for key, logs in ratios.items() if len(logs) > 1}


def print_means(errors, first):
    rows = [["cloud", "", "mean ratio", "standard error", "largest", "clouds"]]
    for (kind, name), (mean, error, largest, count) in mean_ratios(errors).items():
        if name != first:
            rows.append([kind, name, f"{mean:.3f}", f"{error - 1:.1%}", f"{largest:.2f}", str(count)])
    if len(rows) > 1:
        print()
        print_table(rows)


def main():
    options = parse_arguments()
    report = {"size": options.size, "rounds": options.rounds, "costs": [], "errors": []}
    for kind, count, seed in itertools.product(options.clouds, options.counts, range(SEED, SEED + options.seeds)):
        print(f"{count:,} {kind}, seed {seed}", file=sys.stderr, flush=True)
        measure_cloud(kind, count, seed, options, report)
    print(f"{', '.join(report['devices'])}, {options.size}, medians of {options.rounds} rounds\n")
    print_costs(report["costs"], options)
    if report["errors"]:
        print_errors(report["errors"], options)
        print_means(report["errors"], options.library[0].split("=")[0])
    if options.json:
        with open(options.json, "w", encoding="utf-8") as file:
            json.dump(report, file, indent=1)
            file.write("\n")


if __name__ == "__main__":
    main()
