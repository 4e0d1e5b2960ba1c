"""Prints tables of denoised images: stated against true error, and the gain.

    python3 tests/render/denoise_calibration.py [--scenes NAME ...] [--sizes WIDTHxHEIGHT ...]

PT_LIBRARY names the library; needs NumPy and Open Image Denoise (pip install pyoidn, or LD_LIBRARY_PATH). Scenes: see
error_calibration.py. An image is made of two halves of the samples; its true error is the root mean over seeds of its
squared relative error. The square is the product of the differences to two images of other seeds, so that their noise
cancels in the mean.
"""

import argparse
import math
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from error_calibration import RELATIVE_BITS, Case, all_scenes, print_table  # noqa: E402
from scene_renderer import SceneRenderer  # noqa: E402 (which finds pt)
from pt import _structs as structs, denoise  # noqa: E402

COUNTS = [4, 16, 64, 256]
SEEDS = range(100, 108)
TRUTH_SEEDS, TRUTH_SAMPLES = (9, 10), 1024
MORE_TRUTH_SAMPLES = {"two-lamps": 32768}  # few meet the light at shadows' ends
ALBEDO, NORMAL = 5, 4  # PT_QUANTITY_*


def measure(name, scene, size):
    """Cases; and by sample count the mean squared errors of both halves together and of the denoised image."""
    width, height = map(int, size.split("x"))
    length = scene.get("render", {}).get("max_path_length", 6)
    with SceneRenderer(scene) as renderer:
        def pixels(quantity=0):
            image = np.empty((height, width, 3), np.float32)
            renderer.call("pt_readback", structs.pt_image(quantity=quantity, data=image.ctypes.data, size_bytes=image.nbytes))
            return image

        def images(seed, counts):
            renderer.set_render(width, height, max_path_length=length, seed=seed)
            for before, count in zip([0, *counts], counts):
                renderer.accumulate(count - before)
                yield pixels()

        truths = [next(images(seed, [MORE_TRUTH_SAMPLES.get(name, TRUTH_SAMPLES)])).astype(float) for seed in TRUTH_SEEDS]
        weights = 1 / (np.maximum(truths[0] * truths[1], 0) + 0.01)

        def square(image):
            return float((weights * (image - truths[0]) * (image - truths[1])).mean())

        guides = pixels(ALBEDO), pixels(NORMAL)
        found = {count: [] for count in COUNTS}
        for seed in SEEDS:
            halves = [list(images(each, [count // 2 for count in COUNTS])) for each in (seed, seed ^ 2**63)]
            for count, first, second in zip(COUNTS, *halves):
                image, error = denoise(first, second, *guides)
                found[count].append((square((first.astype(float) + second) / 2), square(image.astype(float)), error))
    cases, gains = [], {}
    for count, each in found.items():
        gains[count] = [float(np.mean(column)) for column in list(zip(*each))[:2]]
        true = math.sqrt(gains[count][1])
        cases += [Case(name, size, "mis", "sobol", count, error.relative_rmse / true, int(error.uncertain) & RELATIVE_BITS != 0,
                       error.relative_rmse_low <= true <= error.relative_rmse_high) for *_, error in each]
    return cases, gains


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scenes", metavar="NAME", nargs="+")
    parser.add_argument("--sizes", metavar="WIDTHxHEIGHT", nargs="+", default=["256x128"])
    options = parser.parse_args()
    cases = []
    print("| scene | size | samples | two halves | denoised | times better |\n|---|---|---|---|---|---|")
    for name, scene in all_scenes().items():
        if options.scenes and name not in options.scenes:
            continue
        for size in options.sizes:
            found, gains = measure(name, scene, size)
            cases += found
            for count, (halves, denoised) in gains.items():
                print(f"| {name} | {size} | {count} | {halves:.2e} | {denoised:.2e} | {halves / denoised:.2f} |", flush=True)
    print()
    print_table("samples", cases, [], lambda case: case.count)
    print_table("scene", cases, [], lambda case: case.scene)


if __name__ == "__main__":
    main()
