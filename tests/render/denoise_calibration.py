"""Prints tables of denoised images: the stated error against the true one, and what is gained.

    python3 tests/render/denoise_calibration.py [--scenes NAME ...] [--sizes WIDTHxHEIGHT ...]

PT_LIBRARY names the library; it takes NumPy and Open Image Denoise (pip install pyoidn, or LD_LIBRARY_PATH). Scenes are
those of error_calibration.py. An image is made of two of half of the samples; its true error is the root of the mean, over
the seeds, of the squared relative error against an image of many samples of another seed. On a GPU it takes minutes.
"""

import argparse
import math
import pathlib
import statistics
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from error_calibration import RELATIVE_BITS, Calibration, Case, all_scenes, print_table  # noqa: E402
from pt import _structs as structs, denoise  # noqa: E402

COUNTS = [4, 16, 64, 256]
SEEDS = 6
ALBEDO, NORMAL = 5, 4  # PT_QUANTITY_*


def pixels(calibration, quantity=0):
    width, height = map(int, calibration.size.split("x"))
    image = np.empty((height, width, 3), np.float32)
    calibration.renderer.call("pt_readback", structs.pt_image(quantity=quantity, data=image.ctypes.data,
                                                              size_bytes=image.nbytes))
    return image


def rendered(calibration, seed, count):
    calibration.start(seed)
    calibration.renderer.accumulate(count)
    return pixels(calibration)


def measure(name, scene, size):
    """Cases, and by number of samples the mean squares of the errors of one image of all samples, of the mean of two of
    half of them, and of the denoised one."""
    calibration = Calibration(name, scene, size)
    with calibration.renderer:
        truth = np.array(calibration.truth, np.float32).reshape(pixels(calibration).shape).astype(float)

        def square(image):
            return float(((image - truth) ** 2 / (truth ** 2 + 0.01)).mean())

        guides = pixels(calibration, ALBEDO), pixels(calibration, NORMAL)
        cases, gains = [], {}
        for count in COUNTS:
            squares, stated = [], []
            for seed in range(100, 100 + SEEDS):
                first, second = (rendered(calibration, each, count // 2) for each in (seed, seed + 2**63))
                image, error = denoise(first, second, *guides)
                squares.append((square(rendered(calibration, seed, count)), square((first.astype(float) + second) / 2),
                                square(image)))
                stated.append(error)
            gains[count] = tuple(map(statistics.fmean, zip(*squares)))
            true = math.sqrt(gains[count][2])
            cases += [Case(name, size, "mis", "sobol", count, each.relative_rmse / true,
                           int(each.uncertain) & RELATIVE_BITS != 0,
                           each.relative_rmse_low <= true <= each.relative_rmse_high) for each in stated]
    return cases, gains


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scenes", metavar="NAME", nargs="+")
    parser.add_argument("--sizes", metavar="WIDTHxHEIGHT", nargs="+", default=["256x128"])
    options = parser.parse_args()
    cases = []
    print("| scene | size | samples | raw | two halves | denoised | times better |\n|---|---|---|---|---|---|---|")
    for name, scene in all_scenes().items():
        if options.scenes and name not in options.scenes:
            continue
        for size in options.sizes:
            found, gains = measure(name, scene, size)
            cases += found
            for count, (raw, halves, denoised) in gains.items():
                print(f"| {name} | {size} | {count} | {raw:.2e} | {halves:.2e} | {denoised:.2e} | {raw / denoised:.2f} |",
                      flush=True)
    print()
    print_table("size", cases, [], lambda case: case.size)
    print_table("samples", cases, [], lambda case: case.count)
    print_table("scene", cases, [], lambda case: case.scene)


if __name__ == "__main__":
    main()
