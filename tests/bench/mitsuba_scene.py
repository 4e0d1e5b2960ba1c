"""Translates scene files for Mitsuba 3."""

import math
import resource
import time

SAMPLERS = ("multijitter", "independent")
HALF_SIZE = 300  # half size of the rectangles that replace planes
SMALLEST_LAMP = 1e-6  # (radius / distance)^2; Mitsuba makes smaller lamps too bright


def obstacle(scene):
    if any(any(sphere.get("motion", [])) for sphere in scene["spheres"]):
        return "its spheres do not move"
    if any("emission" in scene["materials"][plane["material"]] for plane in scene.get("planes", [])):
        return "a rectangle gives off less than a plane that emits"
    position = scene["camera"]["position"]
    if any(holds(sphere, position) and sphere["radius"] > HALF_SIZE / 2 for sphere in scene["spheres"]):
        return "a rectangle ends before a plane does in so large a ball"
    lamps = [sphere for sphere in scene["spheres"] if "emission" in scene["materials"][sphere["material"]]]
    if any((lamp["radius"] / math.dist(lamp["center"], position)) ** 2 < SMALLEST_LAMP for lamp in lamps):
        return "it makes so small a lamp too bright, by the rounding of its solid angle"
    return None


def holds(sphere, position):
    return math.dist(sphere["center"], position) < sphere["radius"]


def rgb(value):
    return {"type": "rgb", "value": value if isinstance(value, list) else [value] * 3}


def bsdf(material):
    diffuse, specular = rgb(material.get("diffuse", 0)), rgb(material.get("specular", 0))
    if "specular" not in material:
        return {"type": "diffuse", "reflectance": diffuse}
    return {"type": "pt_phong", "diffuse": diffuse, "specular": specular, "glossiness": material.get("glossiness", 0)}


def emitter(material):
    if "emission" not in material:
        return {}
    return {"emitter": {"type": "area", "radiance": rgb(material["emission"])}}


class MitsubaScene:
    def __init__(self, variant, scene, size=None, lengths=None):
        import mitsuba
        mitsuba.set_variant(variant)
        import drjit
        import numpy
        import phong_bsdf
        phong_bsdf.register()
        self.mi, self.dr, self.np = mitsuba, drjit, numpy
        self.on_gpu = variant.startswith("cuda")
        self.size = size or (scene["film"]["width"], scene["film"]["height"])
        self.scene = mitsuba.load_dict(self.describe(scene))
        self.sensors = {sampler: mitsuba.load_dict(self.sensor(scene["camera"], sampler)) for sampler in SAMPLERS}
        self.integrators = {length: mitsuba.load_dict({"type": "path", "max_depth": length, "rr_depth": 1000})
                            for length in lengths or [scene["render"]["max_path_length"]]}

    def describe(self, scene):
        """Mitsuba's surfaces have one side, so balls around the camera are inverted and planes face the camera."""
        position, shapes = scene["camera"]["position"], {}
        for i, sphere in enumerate(scene["spheres"]):
            material = scene["materials"][sphere["material"]]
            shapes[f"sphere{i}"] = {"type": "sphere", "center": sphere["center"], "radius": sphere["radius"],
                                    "flip_normals": holds(sphere, position), "bsdf": bsdf(material),
                                    **emitter(material)}
        for i, plane in enumerate(scene.get("planes", [])):
            shapes[f"plane{i}"] = {"type": "rectangle", "to_world": self.frame(plane, position),
                                   "bsdf": bsdf(scene["materials"][plane["material"]])}
        return {"type": "scene", **shapes}

    def frame(self, plane, position):
        length = math.hypot(*plane["normal"])
        normal, offset = [n / length for n in plane["normal"]], plane["offset"] / length
        if sum(n * x for n, x in zip(normal, position)) + offset < 0:
            normal, offset = [-n for n in normal], -offset
        center = [-offset * n for n in normal]
        up = [0, 0, 1] if abs(normal[2]) < 0.9 else [0, 1, 0]
        transform = self.mi.ScalarTransform4f
        return transform().look_at(origin=center, target=[c + n for c, n in zip(center, normal)],
                                   up=up) @ transform().scale(HALF_SIZE)

    def sensor(self, camera, sampler):
        return {"type": "perspective", "fov_axis": "y", "fov": camera["vertical_fov"],
                "to_world": self.mi.ScalarTransform4f().look_at(origin=camera["position"], target=camera["look_at"],
                                                                 up=camera.get("up", [0, 1, 0])),
                "sampler": {"type": sampler},
                "film": {"type": "hdrfilm", "width": self.size[0], "height": self.size[1], "pixel_format": "rgb",
                         "component_format": "float32", "rfilter": {"type": "box"}}}

    def render(self, length, sampler, spp, seed):
        start, before = time.perf_counter(), resource.getrusage(resource.RUSAGE_SELF)
        image = self.np.array(self.mi.render(self.scene, sensor=self.sensors[sampler],
                                             integrator=self.integrators[length], seed=seed, spp=spp))
        after = resource.getrusage(resource.RUSAGE_SELF)
        return (time.perf_counter() - start,
                after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, image)

    def read(self, path):
        return self.np.array(self.mi.Bitmap(str(path)))[:, :, :3]
