"""Measures error and CPU seconds of raw, filtered and combined images of pt, and of Mitsuba's images with the same filter.

benchmark.py describes scenes, references, Mitsuba and relMSE. Needs Open Image Denoise (pip install pyoidn) and
matplotlib. Albedo and normals come from pt, for Mitsuba's images too. The cost is the median CPU seconds of sampling
and filtering.
"""

import argparse
import json
import pathlib
import subprocess
import sys
import tempfile
import time

import numpy as np
import pyoidn
from bench_scenes import NAMES, REFERENCES, SIZE, load_scene, scene_path
from benchmark import draw
from benchmark_figures import points_of
from error_and_time import SceneRenderer, image_error, read_exr
from mitsuba_scene import obstacle
from table import print_table

from pt import _structs as structs, denoise

COUNTS = [4, 16, 64, 256]
ALBEDO, NORMAL = 5, 4
COLUMNS = {"default": "raw", "filtered": "filtered", "combined": "combined", "Mitsuba, filtered": "Mitsuba, filtered"}


def timed(function, *arguments, **more):
    start = time.process_time()
    result = function(*arguments, **more)
    return result, time.process_time() - start


def filtered(image, guides):
    return pyoidn.denoise(image, albedo=guides[0], normal=guides[1], hdr=True, clean_aux=True)


def pixels(renderer, quantity=0):
    image = np.empty((*SIZE[::-1], 3), np.float32)
    renderer.call("pt_readback", structs.pt_image(quantity=quantity, data=image.ctypes.data, size_bytes=image.nbytes))
    return image


def pt_round(name, seed, add):
    scene = load_scene(name)
    with SceneRenderer(scene) as renderer:
        def sample(count, seed):
            renderer.set_render(*SIZE, max_path_length=scene["render"]["max_path_length"], seed=seed)
            _, seconds = timed(renderer.accumulate, count)
            return pixels(renderer), seconds

        for _ in range(2):
            image, _ = sample(1, seed)
            renderer.call("pt_prepare")
        guides = pixels(renderer, ALBEDO), pixels(renderer, NORMAL)
        filtered(image, guides)
        for count in COUNTS:
            image, seconds = sample(count, seed)
            add("default", count, seconds, image)
            image, more = timed(filtered, image, guides)
            add("filtered", count, seconds + more, image)
            (first, before), (second, seconds) = sample(count // 2, seed), sample(count // 2, seed ^ 2**63)
            (image, _), more = timed(denoise, first, second, *guides)
            add("combined", count, before + seconds + more, image)
    return guides


def mitsuba_round(options, name, seed, guides, add):
    worker = pathlib.Path(__file__).with_name("mitsuba_bench.py")
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder, "bench.json")
        subprocess.run([options.mitsuba, "-B", worker, scene_path(name), "--reference", REFERENCES / f"{name}.exr", "--spp",
                        ",".join(map(str, COUNTS)), "--seed", str(seed), "--variant", options.variant, "--json", path,
                        "--images", folder], check=True)
        for cell in json.loads(path.read_text(encoding="utf-8"))["cells"]:
            image = np.load(pathlib.Path(folder, f"{cell['spp']}.npy")).astype(np.float32)
            image, more = timed(filtered, image, guides)
            add("Mitsuba, filtered", cell["spp"], cell["processor_seconds"] + more, image)


def measure(options, name):
    reference, cells = read_exr(str(REFERENCES / f"{name}.exr")), {}

    def add(option, count, seconds, image):
        cells.setdefault(option, []).append({"spp": count, "cost": seconds, "rel_mse": image_error(image, reference)[1]})

    for number in range(options.rounds):
        guides = pt_round(name, 10 * number + 1, add)
        if options.mitsuba and not obstacle(load_scene(name)):
            mitsuba_round(options, name, number + 1, guides, add)
    return {"options": {option: {"points": [{"spp": count, "cost": cost, "rel_mse": error}
                                            for count, (cost, error) in points_of(of_option, "cost").items()]}
                        for option, of_option in cells.items()}}


def print_scenes(scenes):
    rows = [["scene", "samples", *COLUMNS.values()]]
    for name, scene in scenes.items():
        for i in 1, 2:
            points = {option: of["points"][i] for option, of in scene["options"].items()}
            rows.append([name, str(COUNTS[i]), *(f"{points[option]['rel_mse']:.2g} in {points[option]['cost']:.2g} s"
                                                 if option in points else "-" for option in COLUMNS)])
    print_table(rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--mitsuba", metavar="PYTHON", help="interpreter that can import Mitsuba (default: without it)")
    parser.add_argument("--variant", default="llvm_ad_rgb", help="of Mitsuba (default: llvm_ad_rgb)")
    parser.add_argument("--scenes", nargs="+", choices=NAMES, default=NAMES)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--json", metavar="FILE", type=pathlib.Path, default="denoise.json",
                        help="all figures; the plot has its name with .png (default: denoise.json)")
    options = parser.parse_args()
    report = {"unit": "CPU seconds", "scenes": {}}
    for name in options.scenes:
        report["scenes"][name] = measure(options, name)
        print(name, file=sys.stderr, flush=True)
    print_scenes(report["scenes"])
    options.json.write_text(json.dumps(report, indent=1) + "\n", encoding="utf-8")
    draw(report, options.json.with_suffix(".png"))


if __name__ == "__main__":
    main()
