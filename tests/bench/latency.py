"""Measures the duration of libpt's calls in milliseconds, for the coursework scene.

    python3 tests/bench/latency.py --library old=OLD/libpt.so --library new=build/lib/libpt.so --sizes 1024x512

Figures are medians. The camera moves before each new picture.

64 samples      pt_accumulate on a film with samples
readback        pt_readback of the radiance into memory that was written before
map             pt_map_image, and a read of the last pixel
camera + 1      pt_set_camera and pt_accumulate of one sample
picture of N    pt_set_camera, pt_accumulate of N samples, and pt_readback
to ERROR        pt_set_camera and pt_accumulate with a target error; the number of samples; the time of as many samples
                without a target
"""

import argparse
import ctypes
import math
import os
import statistics
import sys
import time

from bench_scenes import load_scene
from scene_renderer import SceneRenderer, structs, vector
from table import print_table


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--library", action="append", required=True, metavar="NAME=FILE")
    parser.add_argument("--sizes", default="64x32,256x128,1024x512,1920x1080", metavar="WxH,...")
    parser.add_argument("--path-lengths", default="2,6", metavar="K,...")
    parser.add_argument("--errors", default="0.05,0.02,0.01", metavar="E,...", help="none: empty")
    parser.add_argument("--samples", default="16", metavar="N,...", help="of pictures")
    parser.add_argument("--rounds", type=int, default=15)
    return parser.parse_args()


class Measured:
    def __init__(self, name, path, scene):
        os.environ["PT_LIBRARY"] = path
        self.name = name
        self.times = {}
        self.renderer = SceneRenderer(scene)
        self.moves = 0
        self.camera = scene["camera"]

    def set_render(self, width, height, path_length):
        self.renderer.set_render(width, height, max_path_length=path_length)
        self.image = (ctypes.c_float * (width * height * 3))()
        ctypes.memset(self.image, 1, ctypes.sizeof(self.image))

    def move_camera(self):
        self.moves += 1
        position = list(self.camera["position"])
        position[0] += 1e-3 * (self.moves % 7)
        self.renderer.set_camera(position=vector(position), target=vector(self.camera["look_at"]),
                                 up=vector(self.camera.get("up", [0, 1, 0])),
                                 vertical_fov=math.radians(self.camera["vertical_fov"]))

    def accumulate(self, samples, target_error=0.0):
        self.renderer.accumulate(samples, target_error)

    def readback(self):
        self.renderer.readback(self.image)

    def map(self):
        pixels, size = ctypes.c_void_p(), ctypes.c_uint64()
        self.renderer.call("pt_map_image", ctypes.byref(structs.pt_image()), ctypes.byref(pixels), ctypes.byref(size))
        return ctypes.c_float.from_address(pixels.value + size.value - 4).value

    def measure(self, case, *calls):
        begin = time.perf_counter()
        for call in calls:
            call()
        self.times.setdefault(case, []).append(1e3 * (time.perf_counter() - begin))


def measure_size(contexts, arguments, path_length):
    for _ in range(arguments.rounds):
        for context in contexts:
            context.measure("64 samples", lambda: context.accumulate(64))
            context.measure("readback", context.readback)
            context.measure("map", context.map)
            context.measure("camera + 1", context.move_camera, lambda: context.accumulate(1))
            for count in arguments.samples.split(","):
                context.measure(f"picture of {count}", context.move_camera, lambda: context.accumulate(int(count)),
                                context.readback)


def measure_errors(contexts, arguments):
    for error in filter(None, arguments.errors.split(",")):
        for _ in range(min(arguments.rounds, 3)):
            for context in contexts:
                context.accumulate(256)
                context.measure(f"to {error}", context.move_camera, lambda: context.accumulate(1 << 16, float(error)))
                samples = context.renderer.stats().sample_count
                context.times[f"to {error}, samples"] = [samples]
                context.accumulate(256)
                context.measure(f"to {error}, known", context.move_camera, lambda: context.accumulate(samples))


def main():
    arguments = parse_arguments()
    scene = load_scene("coursework")
    contexts = [Measured(*library.split("=", 1), scene) for library in arguments.library]
    for path_length in map(int, arguments.path_lengths.split(",")):
        for size in arguments.sizes.split(","):
            width, height = map(int, size.split("x"))
            for context in contexts:
                context.times.clear()
                context.set_render(width, height, path_length)
                for _ in range(3):
                    context.accumulate(256)
                    context.readback()
            measure_size(contexts, arguments, path_length)
            measure_errors(contexts, arguments)
            print(f"\n{size}, path length {path_length}\n")
            print_table([["ms"] + [context.name for context in contexts]] +
                        [[case] + [f"{statistics.median(context.times[case]):.3f}" for context in contexts]
                         for case in contexts[0].times])
            sys.stdout.flush()


if __name__ == "__main__":
    main()
