"""The smallest program in Python: a ball under a lamp, written to smallest.pfm. Nothing is compiled, and nothing but
Python and libpt.so.0.2 is needed.

    python3 smallest.py          PT_LIBRARY names the library where the system does not find it

The classes are the structs of pt.h, field by field; a field that is not set is 0, which means its default.

A child of fork must not use a Renderer of its parent, and its calls would never return. With multiprocessing, make
renderers in the workers, and start those by multiprocessing.get_context("spawn").
"""

import array
import ctypes
import os
import sys
from ctypes import POINTER, c_char, c_char_p, c_double, c_float, c_int32, c_uint8, c_uint32, c_uint64, c_void_p

WIDTH, HEIGHT = 128, 96


class pt_device_info(ctypes.Structure):
    _fields_ = [("kind", c_uint32), ("suitable", c_uint32), ("memory_bytes", c_uint64), ("uuid", c_uint8 * 16),
                ("name", c_char * 256), ("driver", c_char * 256), ("reason", c_char * 256)]


class pt_material(ctypes.Structure):
    _fields_ = [("diffuse", c_float * 3), ("specular", c_float * 3), ("emission", c_float * 3), ("glossiness", c_float)]


class pt_sphere(ctypes.Structure):
    _fields_ = [("center", c_double * 3), ("radius", c_double), ("motion", c_double * 3), ("material", c_uint32),
                ("reserved", c_uint32)]


class pt_plane(ctypes.Structure):
    _fields_ = [("normal", c_double * 3), ("offset", c_double), ("material", c_uint32), ("reserved", c_uint32)]


class Sized(ctypes.Structure):
    """A struct that begins with its size, as compiled (here: as written) by the caller."""

    def __init__(self, **fields):
        super().__init__(struct_size=ctypes.sizeof(self), **fields)


class pt_column(ctypes.Structure):
    """Of a NumPy array a: pt_column(a.ctypes.data, a.strides[0], PT_TYPE_FLOAT32)."""

    _fields_ = [("data", c_void_p), ("stride_bytes", c_uint32), ("type", c_uint32)]


PT_TYPE_FLOAT32, PT_TYPE_FLOAT64, PT_TYPE_UINT32, PT_TYPE_SRGB8 = 1, 2, 3, 4


class pt_sphere_array(Sized):
    _fields_ = [("struct_size", c_uint32), ("count", c_uint32), ("center", pt_column), ("radius", pt_column),
                ("motion", pt_column), ("material", pt_column), ("color", pt_column)]


pt_progress_fn = ctypes.CFUNCTYPE(c_int32, c_void_p, c_double)


class pt_scene(Sized):
    _fields_ = [("struct_size", c_uint32), ("material_count", c_uint32), ("sphere_count", c_uint32),
                ("plane_count", c_uint32), ("materials", POINTER(pt_material)), ("spheres", POINTER(pt_sphere)),
                ("planes", POINTER(pt_plane)), ("sphere_arrays", POINTER(pt_sphere_array)),
                ("sphere_array_count", c_uint32), ("reserved", c_uint32), ("progress", pt_progress_fn),
                ("progress_user", c_void_p)]


class pt_camera(Sized):
    _fields_ = [("struct_size", c_uint32), ("reserved", c_uint32), ("position", c_double * 3), ("target", c_double * 3),
                ("up", c_double * 3), ("vertical_fov", c_double), ("shutter_open", c_double),
                ("shutter_close", c_double)]


class pt_render(Sized):
    _fields_ = [("struct_size", c_uint32), ("width", c_uint32), ("height", c_uint32), ("max_path_length", c_uint32),
                ("seed", c_uint64), ("first_sample", c_uint32), ("estimator", c_uint32), ("sampler", c_uint32),
                ("reserved", c_uint32), ("first_row", c_uint32), ("row_count", c_uint32)]


class pt_accumulate_info(Sized):
    _fields_ = [("struct_size", c_uint32), ("sample_count", c_uint32), ("progress", pt_progress_fn),
                ("progress_user", c_void_p), ("target_error", c_double), ("sampling", c_uint32), ("reserved", c_uint32)]


class pt_image(Sized):
    _fields_ = [("struct_size", c_uint32), ("quantity", c_uint32), ("data", POINTER(c_float)), ("size_bytes", c_uint64),
                ("row_bytes", c_uint64), ("x", c_uint32), ("y", c_uint32), ("width", c_uint32), ("height", c_uint32),
                ("format", c_uint32), ("reserved", c_uint32)]


def load_library():
    """libpt with the parameter types that are used here: without them ctypes cuts pointers to 32 bits."""
    library = ctypes.CDLL(os.environ.get("PT_LIBRARY", "libpt.so.0.2"))
    library.pt_result_name.argtypes = [c_int32]
    library.pt_result_name.restype = c_char_p
    library.pt_last_error.argtypes = [c_void_p]
    library.pt_last_error.restype = c_char_p
    library.pt_create.argtypes = [c_void_p, POINTER(c_void_p)]
    library.pt_destroy.argtypes = [c_void_p]
    library.pt_destroy.restype = None
    library.pt_get_context_device.argtypes = [c_void_p, POINTER(pt_device_info)]
    library.pt_set_scene.argtypes = [c_void_p, POINTER(pt_scene)]
    library.pt_set_camera.argtypes = [c_void_p, POINTER(pt_camera)]
    library.pt_set_render.argtypes = [c_void_p, POINTER(pt_render)]
    library.pt_accumulate.argtypes = [c_void_p, POINTER(pt_accumulate_info)]
    library.pt_readback.argtypes = [c_void_p, POINTER(pt_image)]
    return library


class Renderer:
    """A pt_context whose calls raise RuntimeError where the library reports a failure. The interpreter's lock is
    released during calls, so that other threads go on; one renderer is used by one thread at a time."""

    def __init__(self):
        self.library = load_library()
        self.context = c_void_p()
        self._check(self.library.pt_create(None, self.context))

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.library.pt_destroy(self.context)
        self.context = c_void_p()

    def _check(self, result):
        if result < 0:
            name = self.library.pt_result_name(result).decode()
            raise RuntimeError(f"{name}: {self.library.pt_last_error(self.context).decode()}")

    def device_name(self):
        device = pt_device_info()
        self._check(self.library.pt_get_context_device(self.context, device))
        return device.name.decode()

    def set_scene(self, materials, spheres=(), planes=(), sphere_arrays=()):
        self._check(self.library.pt_set_scene(self.context, pt_scene(
            material_count=len(materials), materials=(pt_material * len(materials))(*materials),
            sphere_count=len(spheres), spheres=(pt_sphere * len(spheres))(*spheres),
            plane_count=len(planes), planes=(pt_plane * len(planes))(*planes),
            sphere_array_count=len(sphere_arrays),
            sphere_arrays=(pt_sphere_array * len(sphere_arrays))(*sphere_arrays) if sphere_arrays else None)))

    def set_camera(self, **fields):
        self._check(self.library.pt_set_camera(self.context, pt_camera(**fields)))

    def set_render(self, width, height, **fields):
        self._check(self.library.pt_set_render(self.context, pt_render(width=width, height=height, **fields)))
        self.value_count = width * (fields.get("row_count") or height - fields.get("first_row", 0)) * 3

    def accumulate(self, sample_count, progress=None):
        """Adds samples, and calls progress with the share that is done after every submission: a twentieth of a second.
        What is raised meanwhile, by progress or by a signal such as Ctrl-C, stops the call and is raised here. True
        returned by progress stops it too; then fewer samples were added."""
        raised = []

        def report(_, fraction):
            return int(bool(raised or (progress and progress(fraction))))

        def keep(unraisable):  # ctypes lets no exception pass through the library, but hands it to this hook
            if unraisable.object is report:
                raised.append(unraisable.exc_value)
            else:
                hook(unraisable)

        hook, sys.unraisablehook = sys.unraisablehook, keep
        try:
            result = self.library.pt_accumulate(self.context, pt_accumulate_info(
                sample_count=sample_count, progress=pt_progress_fn(report)))
        finally:
            sys.unraisablehook = hook
        if raised:
            raise raised[0]
        self._check(result)

    def image(self):
        """R, G, B of each pixel, row by row from the top; numpy.frombuffer(image, "f4") views it without a copy."""
        pixels = array.array("f", bytes(4 * self.value_count))
        data = (c_float * self.value_count).from_buffer(pixels)
        self._check(self.library.pt_readback(self.context, pt_image(data=data, size_bytes=ctypes.sizeof(data))))
        return pixels


def show_progress(fraction):
    print(f"\r{fraction:4.0%}", end="", file=sys.stderr, flush=True)


def main():
    white = pt_material(diffuse=(0.8, 0.8, 0.8))
    red = pt_material(diffuse=(0.4, 0.1, 0.1), specular=(0.4, 0.4, 0.4), glossiness=100)
    lamp = pt_material(emission=(40, 40, 36))
    with Renderer() as renderer:
        renderer.set_scene([white, red, lamp],
                           [pt_sphere(center=(0, 1, 0), radius=1, material=1),
                            pt_sphere(center=(2, 4, 2), radius=1, material=2)],
                           [pt_plane(normal=(0, 1, 0), material=0)])
        renderer.set_camera(position=(0, 1.5, 5), target=(0, 1, 0))
        renderer.set_render(WIDTH, HEIGHT)
        renderer.accumulate(64, show_progress)
        pixels = renderer.image()
        print("\rrendered on", renderer.device_name())
    with open("smallest.pfm", "wb") as file:
        file.write(b"PF\n%d %d\n-1.0\n" % (WIDTH, HEIGHT))
        for row in reversed(range(HEIGHT)):  # PFM wants the bottom row first
            file.write(pixels[row * WIDTH * 3:(row + 1) * WIDTH * 3].tobytes())


if __name__ == "__main__":
    main()
