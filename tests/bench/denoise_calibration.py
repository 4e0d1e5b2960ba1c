"""Prints whether denoised images are worse than raw images, and how good their stated errors are.

    python3 tests/bench/denoise_calibration.py [--own] [--images FOLDER] ...

--own renders the scenes of cli/scenes and calibration_scenes.py. --hundred SEED renders scenes of random_scenes.py.
PT_LIBRARY and PT_PROGRAM name the library and the program. Needs Open Image Denoise (pip install pyoidn). --images
keeps images in the folder and uses them again. --render renders only.

Errors are differences from an image of many samples. A denoised image is worse if its error exceeds the raw image's
error by more than 2%. "light" is the difference between the means of both images, divided by the standard error of the
raw image.
"""

import argparse
import json
import math
import pathlib
import statistics
import sys
from dataclasses import dataclass

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / part) for part in ("lib/python", "tests/support", "tests/bench")]
import pt
from calibration_scenes import scenes
from random_scenes import hundred
from scene_file import FOLDER

COUNTS = [16, 64, 256]
TRUTH_SEED, SEED = 9, 100


@dataclass
class Case:
    name: str
    count: int
    relative: float  # relative to the raw image's error
    absolute: float
    gain: float  # mean square of the raw image's relative error, divided by the denoised image's
    light: float
    brighter: int  # number of values above all values of both halves in the 3x3 pixels around them
    stated: float  # stated error / true error
    holds: bool
    is_uncertain: bool


def scene_files(options):
    for path in [*(sorted(FOLDER.glob("*.json")) if options.own else []), *options.files]:
        yield path.stem, path, None
    made = [*(scenes().items() if options.own else []),
            *(pair for seed in options.hundred for pair in hundred(seed))]
    for name, scene in made:
        yield name, "scene.json", json.dumps(scene)


def rendered(context, path, text, options):
    read = pt.load(path, text=text)
    context.set_scene(read.scene)
    context.set_camera(read.camera)
    width, height = map(int, options.size.split("x"))

    def images(seed, counts):
        context.set_render(pt.RenderSettings(width, height, max_path_length=read.settings.max_path_length, seed=seed))
        for before, count in zip([0, *counts], counts):
            context.accumulate(count - before)
            yield context.readback()

    arrays = {"truth": next(images(TRUTH_SEED, [options.truth_samples]))}
    arrays |= {"albedo": context.readback(pt.Quantity.ALBEDO), "normal": context.readback(pt.Quantity.NORMAL)}
    for half, seed in enumerate((SEED, SEED ^ 2**63)):
        for count, image in zip(COUNTS, images(seed, [count // 2 for count in COUNTS])):
            arrays[f"half{half}-{count}"] = image
    return arrays


def largest_about(image):
    padded = np.pad(image, ((1, 1), (1, 1), (0, 0)), mode="edge")
    height, width = image.shape[:2]
    return np.max([padded[y:y + height, x:x + width] for y in range(3) for x in range(3)], axis=0)


def measured(name, count, arrays):
    first, second = (arrays[f"half{half}-{count}"] for half in range(2))
    truth = arrays["truth"].astype(float)
    raw = (first.astype(float) + second) / 2
    denoised, error = pt.denoise(first, second, arrays["albedo"], arrays["normal"])

    def square(image, weight):
        return max(float((weight * (image - truth) ** 2).mean()), 1e-30)

    relative, absolute = ([square(image, weight) for image in (raw, denoised)] for weight in (1 / (truth ** 2 + 0.01), 1))
    true = math.sqrt(relative[1])
    noise = math.sqrt(float(((first.astype(float) - second).sum(axis=2) ** 2).sum())) / 2 / raw.size
    shift = float(denoised.mean(dtype=float) - raw.mean())
    return Case(name, count, math.sqrt(relative[1] / relative[0]), math.sqrt(absolute[1] / absolute[0]),
                relative[0] / relative[1], shift / noise if noise else 0.0,
                int((denoised > largest_about(np.maximum(first, second)) * (1 + 1e-6)).sum()),
                error.relative_rmse / true, error.relative_rmse_low <= true <= error.relative_rmse_high,
                bool(int(error.uncertain) & (2 + 4 + 8)))


def share(cases, holds):
    return f"{100 * sum(map(holds, cases)) / len(cases):.1f}%" if cases else "-"


def print_table(title, cases, key):
    heads = [title, "images", "relative worse", "absolute worse", "worst", "gain", "light beyond 2", "worst light",
             "brighter", "uncertain", "known: bounds hold", "all: bounds hold", "known: below 0.9", "above 2"]
    print("| " + " | ".join(heads) + " |\n|" + "---|" * len(heads))
    for value in [*dict.fromkeys(map(key, cases)), "all"]:
        some = [case for case in cases if value in (key(case), "all")]
        known = [case for case in some if not case.is_uncertain]
        cells = [value, len(some), share(some, lambda case: case.relative > 1.02), share(some, lambda case: case.absolute > 1.02),
                 f"{max(max(case.relative, case.absolute) for case in some):.2f}",
                 f"{math.exp(statistics.fmean(math.log(case.gain) for case in some)):.2f}",
                 share(some, lambda case: abs(case.light) > 2), f"{max((case.light for case in some), key=abs):.1f}",
                 sum(case.brighter for case in some), share(some, lambda case: case.is_uncertain),
                 share(known, lambda case: case.holds), share(some, lambda case: case.holds),
                 share(known, lambda case: case.stated < 0.9), share(known, lambda case: case.stated > 2)]
        print("| " + " | ".join(map(str, cells)) + " |")
    print(flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--own", action="store_true")
    parser.add_argument("--hundred", metavar="SEED", type=int, nargs="*", default=[])
    parser.add_argument("--files", metavar="SCENE", type=pathlib.Path, nargs="*", default=[])
    parser.add_argument("--size", metavar="WIDTHxHEIGHT", default="64x32")
    parser.add_argument("--truth-samples", type=int, default=32768, help="default: 32768")
    parser.add_argument("--images", metavar="FOLDER", type=pathlib.Path)
    parser.add_argument("--render", action="store_true")
    parser.add_argument("--worst", type=int, default=0, help="images to name, by relative and by absolute error")
    options = parser.parse_args()
    context, cases = None, []
    for name, path, text in scene_files(options):
        kept = options.images and options.images / f"{name}.npz"
        if kept and kept.exists():
            arrays = dict(np.load(kept))
        else:
            context = context or pt.Context()
            arrays = rendered(context, path, text, options)
            if kept:
                kept.parent.mkdir(parents=True, exist_ok=True)
                np.savez_compressed(kept, **arrays)
            print(name, file=sys.stderr, flush=True)
        if not options.render:
            cases += [measured(name, count, arrays) for count in COUNTS]
    if options.render:
        return
    print_table("samples", cases, lambda case: case.count)
    for of in ("relative", "absolute"):
        for case in sorted(cases, key=lambda case: -getattr(case, of))[:options.worst]:
            print(of, case)


if __name__ == "__main__":
    main()
