"""Renders clouds of spheres with Mitsuba for scale.py. Reads lines of JSON, and prints the seconds of each on a line.

    {"kind": K, "count": N, "seed": I}                  builds the scene
    {"length": L, "samples": S, "seed": I, "image": F}  renders; writes floats to F, if given
"""

import argparse
import json
import os
import sys
import time

from clouds import COLORS, KINDS, MATERIALS
from mitsuba_scene import SAMPLERS, MitsubaScene, bsdf


class MitsubaCloud(MitsubaScene):
    """Spheres of one color are one shape of ellipsoids, because Mitsuba renders many separate spheres slowly."""

    def __init__(self, variant, cloud, size, lengths):
        self.cloud = cloud
        super().__init__(variant, cloud.surroundings(), size, lengths)

    def describe(self, scene):
        np, mi, shapes = self.np, self.mi, {}
        centers = np.frombuffer(self.cloud.centers, "f4").reshape(-1, 3)
        radii, materials = np.frombuffer(self.cloud.radii, "f4"), np.frombuffer(self.cloud.materials, "u4")
        for name in COLORS:
            chosen = materials == list(MATERIALS).index(name)
            if not chosen.any():
                continue
            turns = np.tile(np.array([0, 0, 0, 1], "f4"), (int(chosen.sum()), 1))
            shapes[f"cloud-{name}"] = {
                "type": "ellipsoids", "extent": 1.0, "centers": mi.TensorXf(centers[chosen]),
                "scales": mi.TensorXf(np.repeat(radii[chosen, None], 3, axis=1)), "quaternions": mi.TensorXf(turns),
                "bsdf": bsdf(scene["materials"][name])}
        return {**super().describe(scene), **shapes}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--variant", default="llvm_ad_rgb")
    parser.add_argument("--size", required=True, metavar="WxH")
    parser.add_argument("--path-lengths", required=True, metavar="L,...")
    options = parser.parse_args()
    size, lengths = tuple(map(int, options.size.split("x"))), list(map(int, options.path_lengths.split(",")))
    answers, scene = os.fdopen(os.dup(1), "w"), None
    os.dup2(2, 1)  # keeps Mitsuba's output out of the answers
    for line in sys.stdin:
        asked = json.loads(line)
        if "count" in asked:
            cloud, start = KINDS[asked["kind"]](asked["count"], asked["seed"]), time.perf_counter()
            scene = MitsubaCloud(options.variant, cloud, size, lengths)
            answer = {"seconds": time.perf_counter() - start, "version": scene.mi.__version__}
        else:
            seconds, cpu_seconds, image = scene.render(asked["length"], SAMPLERS[0], asked["samples"], asked["seed"])
            if asked.get("image"):
                image.astype("f4").tofile(asked["image"])
            answer = {"seconds": seconds, "cpu_seconds": cpu_seconds}
        print(json.dumps(answer), file=answers, flush=True)


if __name__ == "__main__":
    main()
