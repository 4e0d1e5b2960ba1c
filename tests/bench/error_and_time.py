"""Measures error and time of samplers and estimators.

    PT_LIBRARY=build/lib/libpt.so python3 tests/bench/error_and_time.py cli/scenes/coursework.json --size 64x32 \\
        --samplers random,sobol --spp 4,16 --rounds 1 --json bench.json

Each round has another seed.

seconds, cpu s  median wall and CPU seconds of sampling alone
mse, rel_mse    mean of (x - r)^2 and of (x - r)^2 / (r^2 + 0.01) against the reference r, over the rounds
slope           slope of log MSE against log N since the previous count; independent samples have -1
"""

import argparse
import itertools
import json
import math
import os
import pathlib
import statistics
import time

import numpy as np
from bench_scenes import read_scene
from scene_renderer import ESTIMATORS, SAMPLERS, SceneRenderer
from table import print_table
from pt import DeviceKind

REFERENCE_FACTOR = 64  # squared errors fall as 1 / N, so the reference's error is an eighth of the smallest error
NOISE_MARGIN = 3


def names(known):
    def read(text):
        chosen = list(dict.fromkeys(text.split(",")))
        for name in chosen:
            if name not in known:
                raise argparse.ArgumentTypeError(f'"{name}" is none of {", ".join(known)}')
        return chosen
    return read


def counts(text):
    chosen = sorted(set(map(int, text.split(","))))
    if chosen[0] < 1:
        raise argparse.ArgumentTypeError(f"{chosen[0]}: must be at least 1")
    return chosen


def size(text):
    width, height = map(int, text.split("x"))
    return width, height


def parse_arguments(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene")
    parser.add_argument("--size", type=size, metavar="WxH", help="default: the scene's, else 512x512")
    parser.add_argument("--max-path-length", type=int, metavar="L", help="default: the scene's, else 6")
    parser.add_argument("--samplers", type=names(SAMPLERS), default=list(SAMPLERS), metavar="NAME,...")
    parser.add_argument("--estimators", type=names(ESTIMATORS), default=["best"], metavar="NAME,...")
    parser.add_argument("--spp", type=counts, default=[16, 64, 256, 1024], metavar="N,...")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--device", help="on which to render (default: the best)")
    references = parser.add_mutually_exclusive_group()
    references.add_argument("--reference", metavar="EXR", help="image to compare with (default: rendered first)")
    references.add_argument("--reference-spp", type=int, metavar="N", help="of one that is rendered (default: 64 times --spp)")
    parser.add_argument("--json", metavar="FILE", help="write the table and all conditions")
    parser.add_argument("--quiet", action="store_true", help="print no table")
    return parser.parse_args(arguments)


def read_exr(path):
    import OpenImageIO
    image = OpenImageIO.ImageBuf(path)
    if image.has_error:
        raise SystemExit(f"{path}: {image.geterror()}")
    return image.get_pixels(OpenImageIO.FLOAT)[..., :3].astype(np.float64)


def image_error(image, reference):
    square = (image - reference) ** 2
    return float(square.mean()), float((square / (reference ** 2 + 0.01)).mean())


class Bench:
    def __init__(self, options):
        # Sets the program's vector width. Mesa's cache is off, because it ignores vector widths.
        if "avx512vl" in pathlib.Path("/proc/cpuinfo").read_text(encoding="ascii", errors="replace"):
            os.environ.setdefault("LP_NATIVE_VECTOR_WIDTH", "512")
        os.environ.setdefault("MESA_SHADER_CACHE_DISABLE", "true")
        scene = read_scene(options.scene)
        film, render = scene.get("film", {}), scene.get("render", {})
        self.options = options
        self.size = options.size or (film.get("width", 512), film.get("height", 512))
        self.length = options.max_path_length or render.get("max_path_length", 6)
        device = {"device": options.device.encode()} if options.device else {}
        self.renderer = SceneRenderer(scene, **device)

    def set_render(self, sampler, estimator, seed):
        self.renderer.set_render(*self.size, max_path_length=self.length, seed=seed, sampler=sampler, estimator=estimator)

    def image(self):
        return np.array(self.renderer.image(), np.float64).reshape(*self.size[::-1], 3)

    def reference(self):
        if self.options.reference:
            image = read_exr(self.options.reference)
            if image.shape[1::-1] != tuple(self.size):
                raise SystemExit(f"--reference {self.options.reference}: is {image.shape[1]}x{image.shape[0]}, the picture "
                                 f"is {self.size[0]}x{self.size[1]}")
            return image, {"path": self.options.reference}
        samples = self.options.reference_spp or REFERENCE_FACTOR * self.options.spp[-1]
        half = samples // 2
        self.set_render(0, 0, self.options.seed)
        self.renderer.accumulate(half)
        first = self.image()
        self.renderer.accumulate(samples - half)
        whole = self.image()
        mse, rel_mse = (error * half / (samples - half) for error in image_error(first, whole))
        return whole, {"spp": samples, "seed": self.options.seed, "mse": mse, "rel_mse": rel_mse}

    def measure(self, sampler, estimator, samples, seed, reference):
        for warm_up in True, False:  # The second set_render drops the samples of the warm-up.
            self.set_render(SAMPLERS[sampler], ESTIMATORS[estimator], seed)
            if warm_up:
                self.renderer.call("pt_prepare")
                self.renderer.accumulate(1)
        start, cpu_start = time.perf_counter(), time.process_time()
        self.renderer.accumulate(samples)
        seconds, cpu_seconds = time.perf_counter() - start, time.process_time() - cpu_start
        return seconds, cpu_seconds, *image_error(self.image(), reference)


def cells_of(runs, near):
    cells, before = [], None
    for (sampler, estimator, samples), of_rounds in runs.items():
        columns = list(zip(*of_rounds))
        seconds, cpu_seconds = map(statistics.median, columns[:2])
        mse, rel_mse = map(statistics.fmean, columns[2:])
        follows = before and before[:2] == (sampler, estimator) and mse > 0 and before[3] > 0 and samples > before[2]
        cells.append({
            "sampler": sampler, "estimator": estimator, "spp": samples, "rounds": len(of_rounds),
            "seconds": seconds, "processor_seconds": cpu_seconds, "mse": mse, "rel_mse": rel_mse,
            "slope": math.log(mse / before[3]) / math.log(samples / before[2]) if follows else None,
            "near_reference_noise": mse < NOISE_MARGIN * near[0] or rel_mse < NOISE_MARGIN * near[1]})
        before = sampler, estimator, samples, mse
    return cells


def print_cells(cells):
    print_table([["sampler", "estimator", "spp", "seconds", "cpu s", "MSE", "relMSE", "slope"]] + [
        [cell["sampler"], cell["estimator"], str(cell["spp"]), f"{cell['seconds']:.4f}",
         f"{cell['processor_seconds']:.4f}", f"{cell['mse']:.4g}",
         f"{cell['rel_mse']:.4g}" + ("*" if cell["near_reference_noise"] else ""),
         "" if cell["slope"] is None else f"{cell['slope']:.2f}"] for cell in cells])
    if any(cell["near_reference_noise"] for cell in cells):
        print(f"* within {NOISE_MARGIN} times the reference's own error")


def main():
    options = parse_arguments()
    bench = Bench(options)
    reference, told = bench.reference()
    runs = {}
    for number, *cell in itertools.product(range(options.rounds), options.samplers, options.estimators, options.spp):
        run = bench.measure(*cell, options.seed + 1 + number, reference)
        runs.setdefault(tuple(cell), []).append(run)
    cells = cells_of(runs, (told.get("mse", 0.0), told.get("rel_mse", 0.0)))
    device = bench.renderer.device()
    if not options.quiet:
        print_cells(cells)
    if options.json:
        report = {"scene": options.scene, "width": bench.size[0], "height": bench.size[1], "max_path_length": bench.length,
                  "seed": options.seed, "reference": told, "cells": cells,
                  "device": {"name": device.name.decode(), "driver": device.driver.decode(),
                             "is_cpu": device.kind == DeviceKind.CPU}}
        pathlib.Path(options.json).write_text(json.dumps(report, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
