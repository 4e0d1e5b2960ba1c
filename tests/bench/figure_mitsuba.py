"""Makes a picture of a dump with Mitsuba 3, by the camera and the light of a view that figures.py wrote.

    figure_mitsuba.py DATA VIEW OUT WIDTH HEIGHT SAMPLES SEED SHAPE
"""

import json
import sys

import mitsuba
import numpy
from figure_data import COLORS, RADIUS, linear, read_dump


def balls(shape, places, color):
    """One shape for all of a color, or each ball by itself."""
    bsdf = {"type": "diffuse", "reflectance": {"type": "rgb", "value": linear(color)}}
    if shape == "ellipsoids":
        turns = numpy.tile(numpy.array([0, 0, 0, 1], "f4"), (len(places), 1))
        return [{"type": "ellipsoids", "extent": 1.0, "centers": mitsuba.TensorXf(places.astype("f4")),
                 "scales": mitsuba.TensorXf(numpy.full((len(places), 3), RADIUS, "f4")),
                 "quaternions": mitsuba.TensorXf(turns), "bsdf": bsdf}]
    made = mitsuba.load_dict(bsdf)
    return [{"type": "sphere", "center": place.tolist(), "radius": RADIUS, "bsdf": made} for place in places]


def main():
    data, view_path, out, width, height, samples, seed, shape = sys.argv[1:]
    mitsuba.set_variant("llvm_ad_rgb")
    with open(view_path, encoding="utf-8") as file:
        view = json.load(file)
    types, places = read_dump(data)
    shapes = [ball for kind, color in enumerate(COLORS, 1) for ball in balls(shape, places[types == kind], color)]
    camera, lamp = view["camera"], view["lamp"]
    scene = mitsuba.load_dict({
        "type": "scene",
        "integrator": {"type": "path", "max_depth": view["max_path_length"], "rr_depth": 1000, "hide_emitters": True},
        "sky": {"type": "constant", "radiance": {"type": "rgb", "value": view["sky"]["emission"]}},
        "lamp": {"type": "sphere", "center": lamp["center"], "radius": lamp["radius"],
                 "emitter": {"type": "area", "radiance": {"type": "rgb", "value": lamp["emission"]}}},
        "sensor": {"type": "perspective", "fov_axis": "y", "fov": camera["vertical_fov"],
                   "to_world": mitsuba.ScalarTransform4f().look_at(origin=camera["position"], target=camera["look_at"],
                                                                   up=camera["up"]),
                   "sampler": {"type": "multijitter"},
                   "film": {"type": "hdrfilm", "width": int(width), "height": int(height), "pixel_format": "rgba",
                            "component_format": "float32", "rfilter": {"type": "box"}}},
        **{f"ball{i}": shape for i, shape in enumerate(shapes)}})
    image = numpy.array(mitsuba.render(scene, spp=int(samples), seed=int(seed)))
    on_white = image[:, :, :3] + (1 - image[:, :, 3:])
    mitsuba.util.write_bitmap(out, on_white, write_async=False)


if __name__ == "__main__":
    main()
