"""Prints the error that is stated of other samples than the first (shaders/README.md has some rows): least, median and
largest over six seeds of stated / true error, where the truth is an image of 32768 samples of another seed.

    PT_LIBRARY=build/lib/libpt.so python3 tests/render/range_calibration.py MAX_PATH_LENGTH
"""

import ctypes
import math
import pathlib
import statistics
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from relative_error import relative_square  # noqa: E402
from scene_file import FOLDER, read_scene  # noqa: E402
from scene_renderer import SAMPLERS, SceneRenderer  # noqa: E402

WIDTH, HEIGHT = 96, 48
RANDOM, SOBOL = SAMPLERS["random"], SAMPLERS["sobol"]
ROWS = [[(0, 100)], [(100, 100)], [(0, 500)], [(1000, 500)], [(1016, 484)], [(1023, 477)], [(0, 256)], [(4096, 256)],
        [(4088, 264)], [(0, 128)], [(0, 64), (512, 64)], [(0, 64), (700, 64)], [(0, 64), (2**20, 64)], [(0, 192)],
        [(0, 64), (512, 64), (1024, 64)]]


class Renderer(SceneRenderer):
    """Of the coursework scene."""

    def __init__(self, max_path_length):
        super().__init__(read_scene(FOLDER / "coursework.json"))
        self.max_path_length = max_path_length

    def take(self, first, count, **fields):
        self.set_render(WIDTH, HEIGHT, max_path_length=self.max_path_length, first_sample=first, **fields)
        if count > 0:
            self.accumulate(count)

    def film(self):
        size = ctypes.c_uint64()
        self.call("pt_save_film", None, size)
        data = ctypes.create_string_buffer(size.value)
        self.call("pt_save_film", data, size)
        return data.raw

    def take_ranges(self, ranges, **fields):
        films = []
        for first, count in ranges:
            self.take(first, count, **fields)
            films.append(self.film())
        self.take(0, 0, **fields)
        for film in films:
            self.call("pt_add_film", film, len(film))

    def stated_error(self):
        return self.error_estimate().relative_rmse

    def true_error(self, truth):
        return math.sqrt(relative_square(self.image(), truth))


def main():
    with Renderer(int(sys.argv[1])) as renderer:
        renderer.take(0, 32768, seed=99, sampler=SOBOL)
        truth = renderer.image()
        print("| samples | `random` | `sobol` |\n|---|---|---|")
        for ranges in ROWS:
            cells = [", ".join(f"{first}+{count}" for first, count in ranges)]
            for sampler in (RANDOM, SOBOL):
                ratios = []
                for seed in range(11, 17):
                    renderer.take_ranges(ranges, seed=seed, sampler=sampler)
                    ratios.append(renderer.stated_error() / renderer.true_error(truth))
                cells.append(f"{min(ratios):.2f}, {statistics.median(ratios):.2f}, {max(ratios):.2f}")
            print("| " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    main()
