"""Prints the bias of pictures with a target error, and the standard error of this bias, in percent of the mean.

    PT_LIBRARY=build/lib/libpt.so python3 tests/bench/adaptive_bias.py SCENE TARGET [SEEDS]   # caustic 0.1 96

SCENE is one of cli/scenes or calibration_scenes.py. Each picture is compared with a picture of the same seed that has
many more samples and is not adaptive.
"""

import math
import pathlib
import statistics
import sys

sys.path[:0] = [str(pathlib.Path(__file__).resolve().parents[1] / folder) for folder in ("bench", "support")]
from calibration_scenes import scenes
from scene_file import FOLDER, read_scene
from scene_renderer import SceneRenderer

WIDTH, HEIGHT = 96, 48
EVEN_SAMPLES = 2048


def main():
    name, target, seeds = sys.argv[1], float(sys.argv[2]), int(sys.argv[3]) if len(sys.argv) > 3 else 96
    path = FOLDER / f"{name}.json"
    scene = read_scene(path) if path.exists() else scenes()[name]
    differences, means, samples = [], [], []
    with SceneRenderer(scene) as renderer:
        for seed in range(300, 300 + seeds):
            found = []
            for most, error in ((EVEN_SAMPLES, target), (EVEN_SAMPLES, 0.0)):
                renderer.set_render(WIDTH, HEIGHT, max_path_length=scene["render"]["max_path_length"], seed=seed)
                renderer.accumulate(most, error)
                found.append(math.fsum(renderer.image()))
                samples.append(renderer.stats().mean_sample_count)
            differences.append(found[0] - found[1])
            means.append(found[1])
    scale = 100 / statistics.fmean(means)
    print(f"{name} {target}: bias {scale * statistics.fmean(differences):+.3f}% "
          f"+- {scale * statistics.stdev(differences) / math.sqrt(seeds):.3f}, "
          f"{statistics.fmean(samples[::2]):.1f} samples")


if __name__ == "__main__":
    main()
