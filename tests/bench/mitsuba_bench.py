"""Does the same as error_and_time.py with Mitsuba. benchmark.py describes Mitsuba."""

import argparse
import json

from bench_scenes import read_scene
from mitsuba_scene import SAMPLERS, MitsubaScene


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene")
    parser.add_argument("--reference", required=True, help="image (.exr), whose size is that of the picture")
    parser.add_argument("--spp", required=True, help="numbers of samples, separated by commas")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--sampler", choices=SAMPLERS, default="multijitter")
    parser.add_argument("--variant", default="llvm_ad_rgb")
    parser.add_argument("--json", required=True, metavar="FILE")
    parser.add_argument("--images", metavar="FOLDER", help="for the images, as SPP.npy")
    return parser.parse_args()


def reference_size(path, variant):
    import mitsuba
    mitsuba.set_variant(variant)
    return tuple(mitsuba.Bitmap(path).size())


def main():
    options = parse_arguments()
    scene = read_scene(options.scene)
    mitsuba = MitsubaScene(options.variant, scene, reference_size(options.reference, options.variant))
    reference, length, cells = mitsuba.read(options.reference), scene["render"]["max_path_length"], []
    for spp in map(int, options.spp.split(",")):
        mitsuba.render(length, options.sampler, spp, options.seed)
        seconds, processor_seconds, image = mitsuba.render(length, options.sampler, spp, options.seed)
        if options.images:
            mitsuba.np.save(f"{options.images}/{spp}.npy", image)
        error = float(((image - reference) ** 2 / (reference ** 2 + 0.01)).mean())
        cells.append({"sampler": options.sampler, "spp": spp, "seconds": seconds,
                      "processor_seconds": processor_seconds, "rel_mse": error})
    with open(options.json, "w", encoding="utf-8") as file:
        json.dump({"mitsuba": mitsuba.mi.__version__, "variant": options.variant, "cells": cells}, file)


if __name__ == "__main__":
    main()
