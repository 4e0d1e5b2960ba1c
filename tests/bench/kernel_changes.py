"""What a change of the scene or the camera costs: CPU time of the frame that brings it, and the kernels built for it.

    python3 tests/bench/kernel_changes.py build/lib/libpt.so [OTHER_LIBRARY ...]

Each library runs in a process of its own, in turn with the others for --rounds rounds, on the coursework scene and with
a cache of compiled kernels that is empty, or with --warm full. Medians of CPU milliseconds of a frame of one sample:

first         the first frame of a context; prepared: that frame after pt_prepare, where the library has it
lamp          one of the two lamps off, and on again, and so on: the first time, then the mean of the others
sphere        a third ball, and without it again
ball          the camera into a ball and out again
camera        the first frame after a camera's movement, the second, and one after the camera stood for --stop seconds

With --kept a folder has what pt_create_info.store_kernels was given, which a second process loads: on a GPU `first` is
then the time with kernels kept.
"""

import argparse
import copy
import ctypes
import json
import os
import pathlib
import re
import resource
import statistics
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/support"))
from scene_file import read_scene  # noqa: E402
from scene_renderer import SceneRenderer, structs, vector  # noqa: E402

WIDTH, HEIGHT = 256, 128


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("libraries", nargs="+")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--warm", action="store_true", help="with the caches of an earlier process")
    parser.add_argument("--path-length", type=int, default=2)
    parser.add_argument("--stop", type=float, default=1.5, help="seconds for which the camera stands")
    parser.add_argument("--no-scene-kernels", action="store_true", help="PT_CREATE_NO_SCENE_KERNELS")
    parser.add_argument("--kept", metavar="DIR", help="keep kernels here from process to process")
    parser.add_argument("--child", help=argparse.SUPPRESS)
    return parser.parse_args()


def cpu_seconds():
    usage = resource.getrusage(resource.RUSAGE_SELF)
    return usage.ru_utime + usage.ru_stime


class Viewer:
    """A context that renders frames of one sample, and counts the kernels that are built."""

    def __init__(self, options, scene):
        os.environ["PT_LIBRARY"] = options.child
        self.kernels = []

        def log(_, level, line):
            match = re.match(rb"built a kernel for (this scene|all scenes)", line)
            if match:
                self.kernels.append("own" if match.group(1) == b"this scene" else "any")

        def load(_, key, data, size):
            path = pathlib.Path(options.kept, key.decode())
            kept = path.read_bytes() if path.exists() else b""
            if 0 < len(kept) <= size:
                ctypes.memmove(data, kept, len(kept))
            return len(kept)

        def store(_, key, data, size):
            pathlib.Path(options.kept).mkdir(parents=True, exist_ok=True)
            pathlib.Path(options.kept, key.decode()).write_bytes(ctypes.string_at(data, size))

        fields = {"log": structs.pt_log_fn(log), "flags": 2 if options.no_scene_kernels else 0}
        if options.kept:
            fields.update(load_kernels=structs.pt_load_kernels_fn(load),
                          store_kernels=structs.pt_store_kernels_fn(store))
        self.callbacks = fields  # are called as long as the context lives
        self.renderer = SceneRenderer(scene, **fields)
        self.renderer.set_render(WIDTH, HEIGHT, max_path_length=options.path_length)

    def set_scene(self, scene):
        self.renderer.set_json(scene)

    def look(self, position, target=(0, 0, 0)):
        self.renderer.set_camera(position=vector(position), target=vector(target), vertical_fov=0.927)

    def measured(self, run):
        """CPU milliseconds, wall milliseconds and the kinds of kernels built."""
        self.kernels.clear()
        cpu, wall = cpu_seconds(), time.perf_counter()
        run()
        return {"cpu": 1e3 * (cpu_seconds() - cpu), "wall": 1e3 * (time.perf_counter() - wall),
                "kernels": list(self.kernels)}

    def frame(self):
        return self.measured(lambda: self.renderer.accumulate(1))

    def prepare(self):
        return self.measured(lambda: self.renderer.call("pt_prepare"))


def without_a_lamp(scene):
    changed = copy.deepcopy(scene)
    changed["materials"]["orange lamp"] = {"diffuse": 0.5}
    return changed


def with_a_ball(scene):
    changed = copy.deepcopy(scene)
    changed["spheres"].append({"center": [0, 1, -13], "radius": 1, "material": "pale ball"})
    return changed


def there_and_back(viewer, change, back, times=3):
    frames = []
    for _ in range(times):
        for go in (change, back):
            go()
            frames.append(viewer.frame())
    return frames


def child(options):
    scene = read_scene(ROOT / "cli/scenes/coursework.json")
    results = {}

    def ready():
        viewer = Viewer(options, scene)
        viewer.look((0, 0, 1))
        return viewer

    viewer = ready()
    results["first"] = [viewer.frame()]
    results["lamp"] = there_and_back(viewer, lambda: viewer.set_scene(without_a_lamp(scene)),
                                     lambda: viewer.set_scene(scene))
    viewer = ready()
    viewer.frame()
    results["sphere"] = there_and_back(viewer, lambda: viewer.set_scene(with_a_ball(scene)),
                                       lambda: viewer.set_scene(scene))
    viewer = ready()
    viewer.frame()
    results["ball"] = there_and_back(viewer, lambda: viewer.look((-2, -2, -11), (-2, -2, -12)),
                                     lambda: viewer.look((0, 0, 1)))
    viewer = ready()
    viewer.frame()
    frames = []
    for i in range(3):
        for step in range(4):
            viewer.look((0.1 * step + i, 0, 1))
            frames.append(viewer.frame())
        stopped = time.perf_counter()
        still = {"cpu": 0, "wall": 0, "kernels": []}
        while time.perf_counter() - stopped < options.stop:
            frame = viewer.frame()
            still["kernels"] += frame["kernels"]
            still["cpu"] = max(still["cpu"], frame["cpu"])
        frames.append(still)
    results["camera"] = frames
    viewer = ready()
    if hasattr(viewer.renderer.library, "pt_prepare"):
        results["prepare"] = [viewer.prepare()]
        results["prepared"] = [viewer.frame()]
    print(json.dumps(results))


def run_child(options, library, cache):
    arguments = [sys.executable, __file__, library, "--child", library, "--path-length", str(options.path_length),
                 "--stop", str(options.stop)]
    arguments += ["--no-scene-kernels"] if options.no_scene_kernels else []
    arguments += ["--kept", options.kept] if options.kept else []
    environment = {**os.environ, "MESA_SHADER_CACHE_DIR": cache, "__GL_SHADER_DISK_CACHE_PATH": cache}
    output = subprocess.run(arguments, env=environment, check=True, capture_output=True, text=True).stdout
    return json.loads(output)


def main():
    options = parse_arguments()
    if options.child:
        child(options)
        return
    rounds = {library: [] for library in options.libraries}
    with tempfile.TemporaryDirectory() as folder:
        for number in range(options.rounds + (1 if options.warm else 0)):
            for index, library in enumerate(options.libraries):
                cache = os.path.join(folder, f"{index}-{0 if options.warm else number}")
                os.makedirs(cache, exist_ok=True)
                result = run_child(options, os.path.abspath(library), cache)
                if number > 0 or not options.warm:
                    rounds[library].append(result)
    for library, results in rounds.items():
        print(library)
        for name, frames in results[0].items():
            medians = [statistics.median(result[name][i]["cpu"] for result in results) for i in range(len(frames))]
            texts = [f"{cpu:.0f}" + (f" ({'+'.join(frame['kernels'])})" if frame["kernels"] else "")
                     for cpu, frame in zip(medians, frames)]
            print(f"  {name:8} {'  '.join(texts)}   sum {sum(medians):.0f}")


main()
