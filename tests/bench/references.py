"""Makes the benchmark's references, in two steps.

    PT_LIBRARY=build/lib/libpt.so python3 tests/bench/references.py render made      # where a GPU is
    DRJIT_LIBLLVM_PATH=libLLVM.so.19.1 mitsuba/bin/python tests/bench/references.py check made

`render` writes NAME.pfm and NAME.json. NAME.pfm is the reference, the mean of 16 images of different seeds by `mis` and
`sobol`. NAME.json has the relMSE of the reference, and block means of 64 images by another estimator with random numbers.

`check` needs Mitsuba (benchmark.py). In each channel of blocks of 16x16 pixels, the reference and the other estimator may
differ by 6 standard errors. Mitsuba's mean of 16 images may differ by 6 standard errors or half a percent. If all agree,
`check` writes NAME.exr and references.json into tests/reference/bench, or --output.
"""

import argparse
import array
import json
import math
import pathlib
import statistics
import sys

from bench_scenes import CHECKS, NAMES, REFERENCES, SIZE, digest, load_scene
from block_means import block_means, compare, mean_and_error, whole_means

SEEDS = range(9001, 9017)
CHECK_SEEDS = range(9101, 9165)
MITSUBA_SEEDS = range(9201, 9217)
MOST_Z = 6
MOST_DEVIATION = 0.005  # Mitsuba rounds solid angles of small lamps
WIDTH, HEIGHT = SIZE


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("step", choices=("render", "check"))
    parser.add_argument("folder", type=pathlib.Path, help="what render writes and check reads")
    parser.add_argument("--scenes", nargs="+", choices=NAMES, default=NAMES)
    parser.add_argument("--samples", type=int, default=16384, help="a pixel, of each of 16 images (default: 16384)")
    parser.add_argument("--check-samples", type=int, default=4096, help="of each of 64 images (default: 4096)")
    parser.add_argument("--mitsuba-samples", type=int, default=256, help="of each of 16 images (default: 256)")
    parser.add_argument("--variant", default="llvm_ad_rgb", help="of Mitsuba (default: llvm_ad_rgb)")
    parser.add_argument("--output", type=pathlib.Path, default=REFERENCES)
    return parser.parse_args()


def own_error(images, mean):
    count = len(images)
    squares = [math.fsum((image[i] - m) ** 2 for image in images) / (m * m + 0.01) for i, m in enumerate(mean)]
    return math.fsum(squares) / len(squares) / (count * (count - 1))


def write_pfm(path, pixels):
    if sys.byteorder != "little":
        pixels = array.array("f", pixels)
        pixels.byteswap()
    with open(path, "wb") as file:
        file.write(b"PF\n%d %d\n-1.0\n" % SIZE)
        for row in reversed(range(HEIGHT)):
            file.write(pixels[row * WIDTH * 3:(row + 1) * WIDTH * 3].tobytes())


def render(options, name):
    from scene_renderer import ESTIMATORS, SAMPLERS, SceneRenderer
    scene = load_scene(name)
    with SceneRenderer(scene) as renderer:
        def take(seed, sampler, estimator, samples):
            renderer.set_render(WIDTH, HEIGHT, max_path_length=scene["render"]["max_path_length"], seed=seed,
                                sampler=SAMPLERS[sampler], estimator=ESTIMATORS[estimator])
            renderer.accumulate(samples)
            return renderer.image()

        images = [take(seed, "sobol", "mis", options.samples) for seed in SEEDS]
        mean = array.array("f", (statistics.fmean(values) for values in zip(*images)))
        checks = [block_means(take(seed, "random", CHECKS[name], options.check_samples), *SIZE) for seed in CHECK_SEEDS]
        facts = {"scene": digest(scene), "device": renderer.device().name.decode(), "width": WIDTH, "height": HEIGHT,
                 "images": len(images), "samples": options.samples, "own_error": own_error(images, mean)}
    write_pfm(options.folder / f"{name}.pfm", mean)
    means = {"reference": [block_means(image, *SIZE) for image in images], "check": checks}
    (options.folder / f"{name}.json").write_text(json.dumps(
        {"facts": facts, "check_samples": options.check_samples, "block_means": means}), encoding="utf-8")
    print(f"{name}: own relMSE {facts['own_error']:.2e}", flush=True)


def mitsuba_means(options, scene):
    from mitsuba_scene import MitsubaScene
    mitsuba = MitsubaScene(options.variant, scene, SIZE)
    length = scene["render"]["max_path_length"]
    return [mitsuba.render(length, "multijitter", options.mitsuba_samples, seed)[2].mean((0, 1)).tolist()
            for seed in MITSUBA_SEEDS]


def compare_with_mitsuba(options, scene, reference_blocks):
    expected = [whole_means(blocks) for blocks in reference_blocks]
    means = mitsuba_means(options, scene)
    deviation = max(abs(mean / wanted - 1) for (mean, _), (wanted, _) in zip(mean_and_error(means),
                                                                             mean_and_error(expected)))
    return {**compare(means, expected), "deviation": deviation}


def write_exr(options, name, facts):
    import mitsuba
    bitmap = mitsuba.Bitmap(str(options.folder / f"{name}.pfm"))
    bitmap.metadata()["comments"] = (f"{facts['images']} images of {facts['samples']} samples per pixel by pt, mis, "
                                     f"sobol; own relMSE {facts['own_error']:.3g}")
    bitmap.write(str(options.output / f"{name}.exr"))


def check(options, name):
    import mitsuba
    from mitsuba_scene import obstacle
    mitsuba.set_variant(options.variant)
    made = json.loads((options.folder / f"{name}.json").read_text(encoding="utf-8"))
    facts, means, scene = made["facts"], made["block_means"], load_scene(name)
    facts["check"] = {"estimator": CHECKS[name], "images": len(means["check"]), "samples": made["check_samples"],
                      **compare(means["check"], means["reference"])}
    if obstacle(scene):
        facts["mitsuba"] = {"obstacle": obstacle(scene)}
    else:
        facts["mitsuba"] = {"version": mitsuba.__version__, "images": len(MITSUBA_SEEDS),
                            "samples": options.mitsuba_samples,
                            **compare_with_mitsuba(options, scene, means["reference"])}
    for other in "check", "mitsuba":
        told = facts[other]
        print(f"{name}: {other}: " + (told.get("obstacle") or f"largest z {told['largest_z']:.2f}, standard error "
                                      f"{told['median_standard_error']:.2%}"), flush=True)
        if told.get("largest_z", 0) > MOST_Z and told.get("deviation", 1) > MOST_DEVIATION:
            raise SystemExit(f"{name}: the reference and {told.get('estimator', other)} do not agree")
    write_exr(options, name, facts)
    return facts


def main():
    options = parse_arguments()
    if options.step == "render":
        options.folder.mkdir(parents=True, exist_ok=True)
        for name in options.scenes:
            render(options, name)
        return
    options.output.mkdir(parents=True, exist_ok=True)
    path = options.output / "references.json"
    table = json.loads(path.read_text(encoding="utf-8")) if path.exists() else {}
    for name in options.scenes:
        table[name] = check(options, name)
        path.write_text(json.dumps(table, indent=2) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
