"""Renders scene files with libpt from Python, which PT_LIBRARY names where the system does not find it."""

import ctypes
import math
import pathlib
import sys
from ctypes import POINTER, byref, c_double, c_uint32, c_uint64, c_void_p

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "lib/examples"))
import smallest  # noqa: E402

SAMPLERS = {"random": 1, "halton": 2, "halton-cp": 3, "sobol": 4}
ESTIMATORS = {"best": 0, "uniform": 1, "cosine": 2, "bsdf": 3, "light": 4, "mis": 5}


def colour(value):
    return (ctypes.c_float * 3)(*(value if isinstance(value, list) else [value] * 3))


def vector(values):
    return (c_double * 3)(*values)


class Stats(smallest.Sized):
    """pt_stats; what an older library does not know stays 0."""

    _fields_ = [("struct_size", c_uint32), ("sample_count", c_uint32), ("rejected_samples", c_uint64),
                ("device_bytes", c_uint64), ("submit_count", c_uint64), ("device_seconds", c_double),
                ("features", c_uint32), ("device_count", c_uint32), ("rmse", c_double), ("rmse_low", c_double),
                ("rmse_high", c_double), ("relative_rmse", c_double), ("relative_rmse_low", c_double),
                ("relative_rmse_high", c_double), ("uncertain", c_uint32), ("max_sample_count", c_uint32),
                ("mean_sample_count", c_double)]


class SceneRenderer(smallest.Renderer):
    """Of the JSON of a scene file, which has a camera."""

    def __init__(self, scene):
        super().__init__()
        self.set_json(scene)
        camera = scene["camera"]
        shutter_open, shutter_close = camera.get("shutter", [0, 1])
        self.set_camera(position=vector(camera["position"]), target=vector(camera["look_at"]),
                        up=vector(camera.get("up", [0, 1, 0])), vertical_fov=math.radians(camera["vertical_fov"]),
                        shutter_open=shutter_open, shutter_close=shutter_close)
        self.library.pt_get_stats.argtypes = [c_void_p, POINTER(Stats)]

    def set_json(self, scene):
        """Takes materials, spheres and planes of a scene file's JSON."""
        names = list(scene["materials"])
        self.set_scene(
            [smallest.pt_material(colour(m.get("diffuse", 0)), colour(m.get("specular", 0)),
                                  colour(m.get("emission", 0)), m.get("glossiness", 0))
             for m in scene["materials"].values()],
            [smallest.pt_sphere(vector(s["center"]), s["radius"], vector(s.get("motion", [0, 0, 0])),
                                names.index(s["material"])) for s in scene.get("spheres", [])],
            [smallest.pt_plane(vector(p["normal"]), p["offset"], names.index(p["material"]))
             for p in scene.get("planes", [])])

    def stats(self):
        stats = Stats()
        self._check(self.library.pt_get_stats(self.context, byref(stats)))
        return stats
