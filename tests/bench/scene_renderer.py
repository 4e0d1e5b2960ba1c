"""Renders scenes by the C functions, because the package loads only one libpt and benchmarks compare several."""

import array
import ctypes
import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "lib/python"))
from pt import _structs as structs
from pt._library import checked, library_path, load_library

SAMPLERS = {"random": 1, "halton": 2, "halton-cp": 3, "sobol": 4}
ESTIMATORS = {"best": 0, "uniform": 1, "cosine": 2, "bsdf": 3, "light": 4, "mis": 5}


def color(value):
    return (ctypes.c_float * 3)(*(value if isinstance(value, list) else [value] * 3))


def vector(values):
    return (ctypes.c_double * 3)(*values)


class Renderer:
    def __init__(self, **create_info):
        self.library = load_library(library_path())
        self.context = ctypes.c_void_p()
        checked(self.library, self.library.pt_create(structs.pt_create_info(**create_info), self.context))

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.library.pt_destroy(self.context)
        self.context = ctypes.c_void_p()

    def call(self, function, *arguments):
        return checked(self.library, getattr(self.library, function)(self.context, *arguments), self.context)

    def device(self):
        device = structs.pt_device_info()
        self.call("pt_get_context_device", device)
        return device

    def set_scene(self, materials, spheres=(), planes=(), sphere_arrays=()):
        self.call("pt_set_scene", structs.pt_scene(
            material_count=len(materials), materials=(structs.pt_material * len(materials))(*materials),
            sphere_count=len(spheres), spheres=(structs.pt_sphere * len(spheres))(*spheres),
            plane_count=len(planes), planes=(structs.pt_plane * len(planes))(*planes),
            sphere_array_count=len(sphere_arrays),
            sphere_arrays=(structs.pt_sphere_array * len(sphere_arrays))(*sphere_arrays) if sphere_arrays else None))

    def set_camera(self, **fields):
        self.call("pt_set_camera", structs.pt_camera(**fields))

    def set_render(self, width, height, **fields):
        self.call("pt_set_render", structs.pt_render(width=width, height=height, **fields))
        self.value_count = width * (fields.get("row_count") or height - fields.get("first_row", 0)) * 3

    def accumulate(self, sample_count, target_error=0.0):
        return self.call("pt_accumulate",
                         structs.pt_accumulate_info(sample_count=sample_count, stopping=structs.pt_stopping(target_error=target_error)))

    def readback(self, values):
        self.call("pt_readback", structs.pt_image(data=ctypes.addressof(values), size_bytes=ctypes.sizeof(values)))

    def image(self):
        pixels = array.array("f", bytes(4 * self.value_count))
        self.readback((ctypes.c_float * self.value_count).from_buffer(pixels))
        return pixels

    def stats(self):
        stats = structs.pt_stats()
        self.call("pt_get_stats", stats)
        return stats


class SceneRenderer(Renderer):
    def __init__(self, scene, **create_info):
        super().__init__(**create_info)
        self.set_json(scene)
        camera = scene["camera"]
        shutter_open, shutter_close = camera.get("shutter", [0, 1])
        self.set_camera(position=vector(camera["position"]), target=vector(camera["look_at"]),
                        up=vector(camera.get("up", [0, 1, 0])), vertical_fov=math.radians(camera["vertical_fov"]),
                        shutter_open=shutter_open, shutter_close=shutter_close)

    def set_json(self, scene):
        names = list(scene["materials"])
        self.set_scene(
            [structs.pt_material(color(m.get("diffuse", 0)), color(m.get("specular", 0)),
                                 color(m.get("emission", 0)), m.get("glossiness", 0))
             for m in scene["materials"].values()],
            [structs.pt_sphere(vector(s["center"]), s["radius"], vector(s.get("motion", [0, 0, 0])),
                               names.index(s["material"])) for s in scene.get("spheres", [])],
            [structs.pt_plane(vector(p["normal"]), p["offset"], names.index(p["material"]))
             for p in scene.get("planes", [])])
