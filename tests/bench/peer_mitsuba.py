"""Renders the coursework scene with Mitsuba 3 and with pt in turn, and compares their speeds and errors.

    python3 -m venv mitsuba && mitsuba/bin/pip install mitsuba openimageio
    PT_LIBRARY=build/lib/libpt.so DRJIT_LIBLLVM_PATH=libLLVM.so.19.1 mitsuba/bin/python \
        tests/bench/peer_mitsuba.py --json peer.json

Variant llvm_ad_rgb runs on the CPU and needs LLVM's shared library (Debian: libllvm19; with libllvm15 Mitsuba 3.9.1 ends
with "Cannot select: fminimum" on processors with AVX-512); cuda_ad_rgb runs on a GPU. The scene is the same
(mitsuba_scene.py), the path integrator has no roulette, and the means of both programs' images are checked against the
references, which Mitsuba made too.

A sample is one camera ray. A path is one way from the camera to its last vertex: a sample of Mitsuba's is one path; in
pt, beyond path length 2, the first vertex of a sample is left by 4. Both rates are given.

Measured in rounds, each of both programs, medians over them. The cost is in CPU seconds of all threads (on a GPU in wall
seconds) of rendering alone, without start-up, compilation and files, at several sample counts. relMSE is the mean over
pixels and channels of (x - r)^2 / (r^2 + 0.01) against the reference r. The cost of an error lies on the line between two
sample counts, both axes logarithmic; "~" marks those beyond the counts measured, found with the slope -1. pt is measured with
target errors too, which give pixels different numbers of samples; their ratio is to Mitsuba's first sampler.
"""

import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile

from cost_of_error import cost_of_error
from mitsuba_scene import MitsubaScene
from table import print_table

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(ROOT, "tests/support"))
from scene_file import read_scene  # noqa: E402

PATH_LENGTHS = {
    2: {"pt": [1, 4, 16, 64, 256], "targets": [0.2, 0.06, 0.05, 0.04, 0.03, 0.02, 0.015, 0.01],
        "mitsuba": [16, 64, 256, 1024], "errors": [1e-2, 1e-3, 1e-4]},
    6: {"pt": [4, 16, 64, 256], "targets": [0.3, 0.2, 0.14, 0.1, 0.07, 0.05, 0.035],
        "mitsuba": [16, 64, 256, 400, 1024], "errors": [5e-3, 1e-3]},
}
ERROR_AND_TIME = [sys.executable, "-B", os.path.join(ROOT, "tests/bench/error_and_time.py")]
PT_SAMPLERS = {"multijitter": "sobol", "independent": "random"}  # what stands beside which sampler of Mitsuba's
BRANCHES = {2: 1, 6: 4}  # paths of pt's from the first vertex of a sample


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--pt", default="build/bin/pt", help="the program (default: build/bin/pt)")
    parser.add_argument("--device", help="of pt (default: the best)")
    parser.add_argument("--variant", default="llvm_ad_rgb", help="of Mitsuba (default: llvm_ad_rgb)")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--lengths", type=int, nargs="+", choices=PATH_LENGTHS, default=list(PATH_LENGTHS))
    parser.add_argument("--samplers", nargs="+", choices=PT_SAMPLERS, default=list(PT_SAMPLERS), help="of Mitsuba")
    parser.add_argument("--json", metavar="FILE", help="write all figures")
    return parser.parse_args()


def run_pt(options, scene, reference, length, round_number, samplers, *aims):
    """One round of error_and_time.py, with numbers of samples or target errors: sampler -> point of each -> (cost, relMSE)."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "bench.json")
        command = [*ERROR_AND_TIME, scene, "--reference", reference, "--max-path-length", str(length),
                   "--samplers", ",".join(samplers), *aims,
                   "--rounds", "1", "--seed", str(1000 * round_number), "--json", path, "--quiet"]
        subprocess.run(command + (["--device", options.device] if options.device else []), check=True)
        with open(path, encoding="utf-8") as file:
            bench = json.load(file)
    unit = "seconds" if options.variant.startswith("cuda") else "processor_seconds"
    points = {sampler: {} for sampler in samplers}
    for cell in bench["cells"]:
        grows = 1 / cell["target_error"] if cell["target_error"] else cell["spp"]
        points[cell["sampler"]][grows] = (cell[unit], cell["rel_mse"])
    return points, bench["device"]["name"]


def pt_mean(options, scene, mitsuba, length):
    """The mean of an image of pt's, like those of Mitsuba."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "image.exr")
        command = [options.pt, "render", scene, "--max-path-length", str(length), "--spp", "256", "-o", path, "--quiet"]
        subprocess.run(command + (["--device", options.device] if options.device else []), check=True)
        return mitsuba.read(path).mean((0, 1))


def run_mitsuba(options, mitsuba, reference, length, seed):
    """One round, like run_pt, and the mean of the images with most samples."""
    points, means = {}, []
    for sampler in options.samplers:
        points[sampler] = {}
        for spp in PATH_LENGTHS[length]["mitsuba"]:
            seconds, processor_seconds, image = mitsuba.render(length, sampler, spp, seed)
            cost = seconds if mitsuba.on_gpu else processor_seconds
            points[sampler][spp] = (cost, float(((image - reference) ** 2 / (reference ** 2 + 0.01)).mean()))
        means.append(image.mean((0, 1)))
    return points, sum(means) / len(means)


def check_means(name, mean, reference):
    expected = reference.mean((0, 1))
    deviation = float(abs(mean / expected - 1).max())
    print(f"mean of {name}: {', '.join(f'{x:.4f}' for x in mean)}; of the reference: "
          f"{', '.join(f'{x:.4f}' for x in expected)}")
    if deviation > 0.005:
        raise SystemExit(f"{name} does not show the scene of the reference: the mean differs by {deviation:.2%}")


def medians(rounds):
    """Rounds of sampler -> spp -> (cost, relMSE) -> the same with medians."""
    return {sampler: {spp: tuple(statistics.median(one[sampler][spp][i] for one in rounds) for i in (0, 1))
                      for spp in rounds[0][sampler]} for sampler in rounds[0]}


def rate(points, pixel_count):
    """Samples a second, from the difference of the largest and the smallest count: constant costs fall out."""
    low, high = min(points), max(points)
    return (high - low) * pixel_count / (points[high][0] - points[low][0])


def summary(points, length, pixel_count, branches):
    """What the table and the JSON say of one program and sampler."""
    samples = rate(points, pixel_count)
    return {"samples_per_second": samples, "paths_per_second": branches * samples,
            "points": [{"spp": spp, "seconds": points[spp][0], "rel_mse": points[spp][1]} for spp in sorted(points)],
            "cost_of_error": {f"{error:g}": cost_of_error(points, error) for error in PATH_LENGTHS[length]["errors"]}}


def measure(options, mitsuba, scene_path, scene, length):
    reference_path = os.path.join(ROOT, f"tests/reference/coursework_L{length}.exr")
    reference = mitsuba.read(reference_path)
    run_mitsuba(options, mitsuba, reference, length, 1)  # compiles
    samplers = [PT_SAMPLERS[sampler] for sampler in options.samplers]
    lists = {key: ",".join(map(str, PATH_LENGTHS[length][key])) for key in ("pt", "targets")}
    pt_rounds, mitsuba_rounds, target_rounds, means = [], [], [], []
    for number in range(options.rounds):
        points, device = run_pt(options, scene_path, reference_path, length, number, samplers, "--spp", lists["pt"])
        pt_rounds.append(points)
        points, _ = run_pt(options, scene_path, reference_path, length, number, ["sobol"], "--errors", lists["targets"])
        target_rounds.append(points)
        points, mean = run_mitsuba(options, mitsuba, reference, length, 2 + number)
        mitsuba_rounds.append(points)
        means.append(mean)
    check_means("Mitsuba", sum(means) / len(means), reference)
    check_means("pt", pt_mean(options, scene_path, mitsuba, length), reference)
    pixel_count = scene["film"]["width"] * scene["film"]["height"]
    ours = {sampler: summary(points, length, pixel_count, BRANCHES[length])
            for sampler, points in medians(pt_rounds).items()}
    theirs = {sampler: summary(points, length, pixel_count, 1) for sampler, points in medians(mitsuba_rounds).items()}
    targets = medians(target_rounds)["sobol"]
    return {"device": device, "pt": ours, "mitsuba": theirs,
            "targets": {f"{error:g}": cost_of_error(targets, error) for error in PATH_LENGTHS[length]["errors"]},
            "ratios": {sampler: ratios(ours[PT_SAMPLERS[sampler]], theirs[sampler]) for sampler in theirs}}


def ratios(ours, theirs):
    """How many times as fast pt is."""
    return {**{rate: ours[rate] / theirs[rate] for rate in ("samples_per_second", "paths_per_second")},
            "cost_of_error": {error: theirs["cost_of_error"][error][0] / ours["cost_of_error"][error][0]
                              for error in ours["cost_of_error"]}}


def cost_texts(costs):
    return [("" if within else "~") + f"{cost:.3g}" for cost, within in costs.values()]


def row(program, sampler, figures):
    costs = cost_texts(figures["cost_of_error"])
    errors = " ".join(f"{point['spp']}: {point['rel_mse']:.2g}" for point in figures["points"])
    return [program, sampler, f"{figures['samples_per_second'] / 1e6:.3g}", f"{figures['paths_per_second'] / 1e6:.3g}",
            *costs, errors]


def ratio_row(ratio):
    return ["ratio", "", *(f"{value:.3g}" for value in (ratio["samples_per_second"], ratio["paths_per_second"],
                                                       *ratio["cost_of_error"].values())), ""]


def print_result(length, result):
    rows = [["program", "sampler", "M samples/s", "M paths/s",
             *(f"s to {error:g}" for error in PATH_LENGTHS[length]["errors"]), "relMSE at samples per pixel"]]
    for sampler, theirs in result["mitsuba"].items():
        ours = result["pt"][PT_SAMPLERS[sampler]]
        rows += [row("pt", PT_SAMPLERS[sampler], ours), row("Mitsuba", sampler, theirs),
                 ratio_row(result["ratios"][sampler])]
    theirs = next(iter(result["mitsuba"].values()))["cost_of_error"]
    rows += [["pt, target errors", "sobol", "", "", *cost_texts(result["targets"]), ""],
             ["ratio", "", "", "", *(f"{theirs[error][0] / cost:.3g}" for error, (cost, _) in result["targets"].items()), ""]]
    print(f"\nPath length {length}, pt on {result['device']}")
    print_table(rows)


def main():
    options = parse_arguments()
    scene_path = os.path.join(ROOT, "cli/scenes/coursework.json")
    scene = read_scene(scene_path)
    mitsuba = MitsubaScene(options.variant, scene, lengths=PATH_LENGTHS)
    report = {"mitsuba": mitsuba.mi.__version__, "variant": options.variant, "rounds": options.rounds,
              "unit": "wall seconds" if mitsuba.on_gpu else "CPU seconds", "lengths": {}}
    for length in options.lengths:
        report["lengths"][length] = measure(options, mitsuba, scene_path, scene, length)
        print_result(length, report["lengths"][length])
    if options.json:
        with open(options.json, "w", encoding="utf-8") as file:
            json.dump(report, file, indent=2)
            file.write("\n")


if __name__ == "__main__":
    main()
