"""Prints the tables in shaders/README.md of the error that is stated of an image: of stated / true error the share below
0.9, the share above 2 and the median, where the error is known; and of how many cases it is called uncertain.

    PT_LIBRARY=build/lib/libpt.so python3 tests/render/error_calibration.py [SCENE.json ...]   # default: all of cli/scenes

The true error is the root of the mean, over 16 seeds, of the squared relative error against an image of many samples of
another seed. The stated ones are those of the first six seeds. On a GPU it takes minutes.
"""

import math
import pathlib
import statistics
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from scene_file import FOLDER, read_scene  # noqa: E402
from scene_renderer import ESTIMATORS, SAMPLERS, SceneRenderer  # noqa: E402

WIDTH, HEIGHT = 96, 48
COUNTS = [16, 24, 64, 100, 256, 1024]
TRUTH_SAMPLES = 1 << 17
TRUTH_SEEDS, STATED_SEEDS = 16, 6
METHODS = [("mis", "random"), ("mis", "halton"), ("mis", "halton-cp"), ("mis", "sobol"), ("light", "sobol"),
           ("bsdf", "sobol"), ("cosine", "halton"), ("uniform", "random")]
RELATIVE_BITS = 2 + 4 + 8  # of PT_UNCERTAIN_*, those of relative_rmse


def relative_square(image, truth):
    return math.fsum((x - t) ** 2 / (t * t + 0.01) for x, t in zip(image, truth)) / len(truth)


def cases_of(path):
    """(scene, estimator, sampler, count, stated / true, uncertain, bounds that hold)"""
    scene = read_scene(path)
    length = scene.get("render", {}).get("max_path_length", 6)
    with SceneRenderer(scene) as renderer:
        renderer.set_render(WIDTH, HEIGHT, max_path_length=length, seed=99)
        renderer.accumulate(TRUTH_SAMPLES)
        truth = list(renderer.image())
        for estimator, sampler in METHODS:
            squares = {count: [] for count in COUNTS}
            stated = {count: [] for count in COUNTS}
            for seed in range(100, 100 + TRUTH_SEEDS):
                renderer.set_render(WIDTH, HEIGHT, max_path_length=length, seed=seed, sampler=SAMPLERS[sampler],
                                    estimator=ESTIMATORS[estimator])
                done = 0
                for count in COUNTS:
                    renderer.accumulate(count - done)
                    done = count
                    squares[count].append(relative_square(renderer.image(), truth))
                    if len(stated[count]) < STATED_SEEDS:
                        stated[count].append(renderer.stats())
            for count in COUNTS:
                error = math.sqrt(statistics.fmean(squares[count]))
                for stats in stated[count]:
                    holds = stats.relative_rmse_low <= error <= stats.relative_rmse_high
                    yield (path.stem, estimator, sampler, count, stats.relative_rmse / error,
                           stats.uncertain & RELATIVE_BITS != 0, holds)


def share(cases, is_one):
    return f"{100 * sum(map(is_one, cases)) / len(cases):.1f}%" if cases else ""


def print_rows(title, cases, key):
    print(f"| {title} | cases | uncertain | below 0.9 | above 2 | median | bounds hold | uncertain: below 0.9 | above 2 |")
    print("|---|---|---|---|---|---|---|---|---|")
    for name in [*dict.fromkeys(map(key, cases)), "all"]:
        rows = [case for case in cases if name in (key(case), "all")]
        known = [case for case in rows if not case[5]]
        uncertain = [case for case in rows if case[5]]
        cells = [str(name), str(len(rows)), share(rows, lambda case: case[5])]
        cells += [share(known, lambda case: case[4] < 0.9), share(known, lambda case: case[4] > 2)]
        cells += [f"{statistics.median(case[4] for case in known):.2f}" if known else ""]
        cells += [share(known, lambda case: case[6])]
        cells += [share(uncertain, lambda case: case[4] < 0.9), share(uncertain, lambda case: case[4] > 2)]
        print("| " + " | ".join(cells) + " |")
    print(flush=True)


def main():
    paths = [pathlib.Path(path) for path in sys.argv[1:]] or sorted(FOLDER.glob("*.json"))
    cases = []
    for path in paths:
        cases += cases_of(path)
        print(path.stem, file=sys.stderr, flush=True)
    print_rows("estimator, sampler", cases, lambda case: f"`{case[1]}`, `{case[2]}`")
    print_rows("samples", cases, lambda case: case[3])
    print_rows("scene, `mis`", [case for case in cases if case[1] == "mis"], lambda case: case[0])
    print_rows("scene, found by chance or `light`", [case for case in cases if case[1] != "mis"], lambda case: case[0])


if __name__ == "__main__":
    main()
