"""Measures how often pt.compare calls equal light different, and which changes it finds.

    python3 tests/bench/same_light.py [--pairs N] [--scenes NAME ...] [--changes]

PT_LIBRARY names the library. Without --changes, compares N pairs of equal light for each scene and kind of pair. The
second image of a pair has another method or number of samples. All images have different seeds, and each image is in up to
four pairs. The scenes are the benchmark's and ten difficult ones: lamps below a pixel, caustics, mostly black. With
--changes, counts the benchmark's scenes that show a change of their brightest lamp, of a material or of a tile.
"""

import argparse
import copy
import pathlib
import sys
from types import SimpleNamespace

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "lib/python"), str(ROOT / "tests/support"), str(ROOT / "tests/render")]
from bench_scenes import NAMES, load_scene  # noqa: E402
from calibration_scenes import scenes as calibration_scenes  # noqa: E402
from scene_renderer import ESTIMATORS, SAMPLERS, SceneRenderer  # noqa: E402

import pt  # noqa: E402

DIFFICULT = ["stars-100", "stars-1000", "fairy-100", "street-60", "corner-ball", "caustic-small", "caustic-balls",
             "glints", "night", "hidden-sun"]
SIZE = WIDTH, HEIGHT = 48, 32
SAMPLES = 16
# Each kind of pair with the samples and the method of the second image.
KINDS = {"alike": {}, "light": {"estimator": "light"}, "bsdf": {"estimator": "bsdf"}, "random": {"sampler": "random"},
         "16 times": {"samples": 16 * SAMPLES}}
RATES = (0.1, 0.01, 1e-3, 1e-6)
USES = 4
CHANGES = (0.005, 0.01, 0.03)
LARGE, MANY = (96, 48), 256


class Images:
    """Images of one scene, each with its own seed."""

    def __init__(self, scene):
        self.renderer, self.length, self.seed = SceneRenderer(scene), scene["render"]["max_path_length"], 0

    def one(self, size=SIZE, samples=SAMPLES, estimator="best", sampler="sobol"):
        self.seed += 1
        self.renderer.set_render(*size, seed=self.seed, max_path_length=self.length, estimator=ESTIMATORS[estimator],
                                 sampler=SAMPLERS[sampler])
        self.renderer.accumulate(samples)
        radiance = np.array(self.renderer.image(), np.float32).reshape(size[1], size[0], 3)
        counts = SimpleNamespace(sample_count=samples, max_sample_count=samples)
        error = SimpleNamespace(uncertain=pt.Uncertain.UNMET if estimator == "bsdf" else pt.Uncertain(0))  # as for films
        return pt.Image(radiance, radiance, np.full((*radiance.shape[:2], 1), samples), error, counts)


def probabilities(images, fields, pairs):
    count = -(-pairs // USES)
    first, second = ([images.one(**each) for _ in range(count)] for each in ({}, fields))
    return [pt.compare(first[i % count], second[(i + i // count) % count]).probability for i in range(pairs)]


def false_alarms(names, pairs):
    print("scene                " + "".join(f"{kind:>12}" for kind in KINDS) + "   (least probability)")
    found = {kind: [] for kind in KINDS}
    for name in names:
        images, least = Images(scene_of(name)), []
        for kind, fields in KINDS.items():
            each = probabilities(images, fields, pairs)
            found[kind] += each
            least.append(f"{min(each):12.2g}")
        print(f"{name:<21}" + "".join(least), flush=True)
    for kind, each in [*found.items(), ("all", sum(found.values(), []))]:
        print(f"{kind}: {len(each)} pairs, called different at the rate " +
              ", ".join(f"{rate:g}: {sum(p <= rate for p in each)}" for rate in RATES))


def brighter(scene, key, share):
    """Returns the scene with another value of `key` in the material with the largest value."""
    changed = copy.deepcopy(scene)
    strongest = max(changed["materials"].values(), key=lambda each: np.sum(each.get(key, 0)))
    strongest[key] = (np.array(strongest[key]) * (1 - share)).tolist()
    return changed


def changes(names):
    """Counts the scenes in which each change is found."""
    found = {}
    for name in names:
        scene = scene_of(name)
        reference = Images(scene).one(LARGE, MANY)
        for share in CHANGES:
            changed = {"lamp": brighter(scene, "emission", share), "material": brighter(scene, "diffuse", share)}
            for kind, each in changed.items():
                images = Images(each)
                images.seed = 100
                found.setdefault((kind, share), []).append(pt.compare(images.one(LARGE, MANY), reference))
            images = Images(scene)
            images.seed = 100
            tile = images.one(LARGE, MANY).radiance
            tile[16:48, 32:64] *= 1 - share
            found.setdefault(("tile", share), []).append(pt.compare(tile, reference))
            if share == CHANGES[0]:
                print(f"{name:<21}{pt.compare(images.one(LARGE, MANY), reference)}", flush=True)
    for (kind, share), each in found.items():
        print(f"{kind} by {share:.1%}: found in {sum(c.light == pt.Light.DIFFERENT for c in each)} of {len(each)}")


def scene_of(name):
    return load_scene(name) if name in NAMES else calibration_scenes()[name]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--pairs", type=int, default=84)
    parser.add_argument("--scenes", nargs="+")
    parser.add_argument("--changes", action="store_true")
    given = parser.parse_args()
    if given.changes:
        changes(given.scenes or NAMES)
    else:
        false_alarms(given.scenes or NAMES + DIFFICULT, given.pairs)


if __name__ == "__main__":
    main()
