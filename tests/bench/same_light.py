"""Measures how often pt.compare calls equal light different, which changes it finds, and how many samples this takes.

Without --changes and --samples it tests N pairs of images of equal light for each scene and kind of pair. --changes counts the scenes that
show a change of their brightest lamp, a material, a tile, or a kernel's density. --samples doubles the samples of two images until they
show a change of a given size.
"""

import argparse
import copy
import pathlib
import shutil
import sys
import tempfile
from dataclasses import replace

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / folder) for folder in ("lib/python", "tests/support", "tests/bench")]
import pt
import random_scenes
from bench_scenes import NAMES, load_scene
from calibration_scenes import scenes as calibration_scenes
from stated_error import read

DIFFICULT = ["stars-100", "stars-1000", "fairy-100", "street-60", "corner-ball", "caustic-small", "caustic-balls",
             "glints", "night", "hidden-sun"]
SIZE = 48, 32
SAMPLES = 16
# Maps each kind of pair to samples and method of the second image.
KINDS = {"alike": {}, "light": {"estimator": pt.Estimator.LIGHT}, "bsdf": {"estimator": pt.Estimator.BSDF},
         "random": {"sampler": pt.Sampler.RANDOM}, "16 times": {"samples": 16 * SAMPLES}}
RATES = (0.1, 0.01, 1e-3, 1e-6)
CHANGES = (0.005, 0.01, 0.03)
LARGE, MANY = (96, 48), 256
# Maps each change to file, text, and replacement.
FAULTS = {"density of lamps by 3%": ("lamp.glsl", "surface_of_lamp(choice.lamp)), density)",
                                     "surface_of_lamp(choice.lamp)), 1.03 * density)"),
          "density of directions by 3%": ("phong.glsl", "0.5 / PI : density)", "0.5 / PI : 1.03 * density)"),
          "weight of spots": ("path.glsl", "towards.density * float(BRANCH_COUNT)", "towards.density"),
          "a lost branch": ("path.glsl", "while (branch < BRANCH_COUNT)", "while (branch + 1u < BRANCH_COUNT)")}
NEEDED, MOST, WIDE = (0.01, 0.003, 0.001), 1 << 13, (256, 128)


class Images:
    def __init__(self, scene, seed=0, **context):
        whole = read(scene)
        self.context, self.settings, self.seed = pt.Context(**context), whole.settings, seed
        self.context.set_scene(whole.scene)
        self.context.set_camera(whole.camera)

    def begin(self, size, estimator=pt.Estimator.BEST, sampler=pt.Sampler.BEST):
        self.seed += 1
        self.context.set_render(replace(self.settings, width=size[0], height=size[1], seed=self.seed,
                                        estimator=estimator, sampler=sampler))

    def one(self, size=SIZE, samples=SAMPLES, **method):
        self.begin(size, **method)
        self.context.accumulate(samples)
        return self.context.image()


def probabilities(images, fields, pairs):
    return [pt.compare(images.one(), images.one(**fields)).probability for _ in range(pairs)]


def false_alarms(scenes, pairs):
    print("scene                " + "".join(f"{kind:>12}" for kind in KINDS) + "   (least probability)")
    found = {kind: [] for kind in KINDS}
    for name, scene in scenes.items():
        images, least = Images(scene), []
        for kind, fields in KINDS.items():
            each = probabilities(images, fields, pairs)
            found[kind] += each
            least.append(f"{min(each):12.2g}")
        print(f"{name:<21}" + "".join(least), flush=True)
    for kind, each in [*found.items(), ("all", sum(found.values(), []))]:
        print(f"{kind}: {len(each)} pairs, called different at the rate " +
              ", ".join(f"{rate:g}: {sum(p <= rate for p in each)}" for rate in RATES))


def darker(scene, key, share):
    changed = copy.deepcopy(scene)
    strongest = max(changed["materials"].values(), key=lambda each: np.sum(each.get(key, 0)))
    strongest[key] = (np.array(strongest[key]) * (1 - share)).tolist()
    return changed


def faulty_kernels(folder, fault):
    name, text, fault_text = fault
    kernels = pathlib.Path(shutil.copytree(ROOT / "shaders", pathlib.Path(folder, "kernels")))
    code = (kernels / name).read_text(encoding="utf-8")
    if code.count(text) != 1:
        raise ValueError(f"{name} does not contain {text} once")
    (kernels / name).write_text(code.replace(text, fault_text), encoding="utf-8")
    return kernels


def changes(scenes):
    found = {}
    for name, scene in scenes.items():
        reference = Images(scene).one(LARGE, MANY)
        other = Images(scene, 100).one(LARGE, MANY)
        print(f"{name:<21}{pt.compare(other, reference)}", flush=True)

        def look(change, image):
            found.setdefault(change, []).append(pt.compare(image, reference).light == pt.Light.DIFFERENT)

        for share in CHANGES:
            look(f"lamp by {share:.1%}", Images(darker(scene, "emission", share), 100).one(LARGE, MANY))
            look(f"material by {share:.1%}", Images(darker(scene, "diffuse", share), 100).one(LARGE, MANY))
            tile = other.radiance.copy()
            tile[16:48, 32:64] *= 1 - share
            look(f"tile by {share:.1%}", tile)
        for change, fault in FAULTS.items():
            with tempfile.TemporaryDirectory() as folder:
                look(change, Images(scene, 100, shader_dir=faulty_kernels(folder, fault)).one(LARGE, MANY))
    for change, each in found.items():
        print(f"{change}: found in {sum(each)} of {len(each)}")


def samples_needed(scenes):
    width, height = WIDE
    print(f"{width}x{height}; a change of  " + "".join(f"{share:>9.1%}" for share in NEEDED))
    for name, scene in scenes.items():
        pair = [Images(scene, seed) for seed in (0, 1)]
        for images in pair:
            images.begin(WIDE)
        needed, samples, taken = [], SAMPLES, 0
        while len(needed) < len(NEEDED) and samples <= MOST:
            for images in pair:
                images.context.accumulate(samples - taken)
            smallest = pt.compare(*(images.context.image() for images in pair)).smallest_change
            needed += [samples for share in NEEDED[len(needed):] if smallest <= share]
            samples, taken = 2 * samples, samples
        needed += [f"> {MOST}"] * (len(NEEDED) - len(needed))
        print(f"{name:<22}" + "".join(f"{each:>9}" for each in needed), flush=True)


def scenes_of(names):
    own = calibration_scenes()
    return {name: load_scene(name) if name in NAMES else own[name] for name in names}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--pairs", type=int, default=84)
    parser.add_argument("--scenes", nargs="+")
    parser.add_argument("--random", type=int, metavar="SEED")
    parser.add_argument("--changes", action="store_true")
    parser.add_argument("--samples", action="store_true")
    given = parser.parse_args()
    if given.changes:
        changes(scenes_of(given.scenes or NAMES))
    elif given.samples:
        samples_needed(scenes_of(given.scenes or ["coursework", "closed-room", "caustic"]))
    elif given.random is not None:
        false_alarms(dict(random_scenes.hundred(given.random)), given.pairs)
    else:
        false_alarms(scenes_of(given.scenes or NAMES + DIFFICULT), given.pairs)


if __name__ == "__main__":
    main()
