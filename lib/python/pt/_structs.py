"""The structs of the headers in lib/include/pt, field by field, as lib/python/generate.py writes them; a field
that is not set is 0, which means its default."""

import ctypes
from ctypes import POINTER, c_char, c_char_p, c_double, c_float, c_int32, c_int64, c_uint8, c_uint32, c_uint64, c_void_p
from typing import Any

pt_progress_fn = ctypes.CFUNCTYPE(c_int32, c_void_p, c_double)
pt_log_fn = ctypes.CFUNCTYPE(None, c_void_p, c_int32, c_char_p)
pt_load_kernels_fn = ctypes.CFUNCTYPE(c_uint64, c_void_p, c_char_p, c_void_p, c_uint64)
pt_store_kernels_fn = ctypes.CFUNCTYPE(None, c_void_p, c_char_p, c_void_p, c_uint64)
pt_take_bytes_fn = ctypes.CFUNCTYPE(c_int32, c_void_p, c_void_p, c_uint64)


class Sized(ctypes.Structure):
    """A struct that begins with its size, as its caller (here: this file) has it."""

    def __init__(self, **fields: Any) -> None:
        super().__init__(struct_size=ctypes.sizeof(self), **fields)


class pt_material(ctypes.Structure):
    _fields_ = [("diffuse", c_float * 3), ("specular", c_float * 3), ("emission", c_float * 3), ("glossiness", c_float),
                ("flags", c_uint32)]


class pt_sphere(ctypes.Structure):
    _fields_ = [("center", c_double * 3), ("radius", c_double), ("motion", c_double * 3), ("material", c_uint32),
                ("reserved", c_uint32)]


class pt_column(ctypes.Structure):
    _fields_ = [("data", c_void_p), ("stride_bytes", c_uint32), ("type", c_uint32)]


class pt_sphere_array(Sized):
    _fields_ = [("struct_size", c_uint32), ("count", c_uint32), ("center", pt_column), ("radius", pt_column),
                ("motion", pt_column), ("material", pt_column), ("color", pt_column), ("end", pt_column),
                ("opacity", pt_column)]


class pt_plane(ctypes.Structure):
    _fields_ = [("normal", c_double * 3), ("offset", c_double), ("material", c_uint32), ("reserved", c_uint32)]


class pt_scene(Sized):
    _fields_ = [("struct_size", c_uint32), ("material_count", c_uint32), ("sphere_count", c_uint32),
                ("plane_count", c_uint32), ("materials", POINTER(pt_material)), ("spheres", POINTER(pt_sphere)),
                ("planes", POINTER(pt_plane)), ("sphere_arrays", POINTER(pt_sphere_array)),
                ("sphere_array_count", c_uint32), ("reserved", c_uint32), ("progress", pt_progress_fn),
                ("progress_user", c_void_p)]


class pt_camera(Sized):
    _fields_ = [("struct_size", c_uint32), ("projection", c_uint32), ("position", c_double * 3),
                ("target", c_double * 3), ("up", c_double * 3), ("vertical_fov", c_double), ("shutter_open", c_double),
                ("shutter_close", c_double), ("vertical_extent", c_double), ("aperture", c_double), ("focus", c_double)]


class pt_render(Sized):
    _fields_ = [("struct_size", c_uint32), ("width", c_uint32), ("height", c_uint32), ("max_path_length", c_uint32),
                ("seed", c_uint64), ("first_sample", c_uint32), ("estimator", c_uint32), ("sampler", c_uint32),
                ("reserved", c_uint32), ("first_row", c_uint32), ("row_count", c_uint32)]


class pt_accumulate_info(Sized):
    _fields_ = [("struct_size", c_uint32), ("sample_count", c_uint32), ("progress", pt_progress_fn),
                ("progress_user", c_void_p), ("target_error", c_double), ("sampling", c_uint32),
                ("sample_limit", c_uint32), ("tile_samples", POINTER(c_uint32)), ("tile_count", c_uint32),
                ("reserved2", c_uint32)]


class pt_image(Sized):
    _fields_ = [("struct_size", c_uint32), ("quantity", c_uint32), ("data", c_void_p), ("size_bytes", c_uint64),
                ("row_bytes", c_uint64), ("x", c_uint32), ("y", c_uint32), ("width", c_uint32), ("height", c_uint32),
                ("format", c_uint32), ("reserved", c_uint32)]


class pt_create_info(Sized):
    _fields_ = [("struct_size", c_uint32), ("flags", c_uint32), ("device", c_char_p), ("log", pt_log_fn),
                ("log_user", c_void_p), ("submit_milliseconds", c_uint32), ("reserved", c_uint32), ("vulkan", c_void_p),
                ("shader_dir", c_char_p), ("load_kernels", pt_load_kernels_fn), ("store_kernels", pt_store_kernels_fn),
                ("kernels_user", c_void_p)]


class pt_function_accuracy(ctypes.Structure):
    _fields_ = [("name", c_char * 40), ("worst_error", c_double), ("bound", c_double), ("worst_input", c_double)]


class pt_compared_image(ctypes.Structure):
    _fields_ = [("radiance", POINTER(c_float)), ("min_samples", c_uint32), ("max_samples", c_uint32),
                ("sampler", c_uint32), ("may_miss_light", c_uint32)]


class pt_compare_info(Sized):
    _fields_ = [("struct_size", c_uint32), ("width", c_uint32), ("height", c_uint32), ("look", c_uint32),
                ("first", pt_compared_image), ("second", pt_compared_image), ("rate", c_double),
                ("min_change", c_double)]


class pt_compared_region(ctypes.Structure):
    _fields_ = [("x", c_uint32), ("y", c_uint32), ("width", c_uint32), ("height", c_uint32), ("light", c_double * 3),
                ("difference", c_double * 3), ("deviation", c_double * 3), ("probability", c_double),
                ("smallest_change", c_double)]


class pt_comparison(Sized):
    _fields_ = [("struct_size", c_uint32), ("light", c_uint32), ("probability", c_double),
                ("smallest_change", c_double), ("smallest_tile_change", c_double), ("summary", c_char * 160)]


class pt_denoise_info(Sized):
    _fields_ = [("struct_size", c_uint32), ("width", c_uint32), ("height", c_uint32), ("any_device", c_uint32),
                ("first", POINTER(c_float)), ("second", POINTER(c_float)), ("albedo", POINTER(c_float)),
                ("normal", POINTER(c_float)), ("denoised", POINTER(c_float)), ("library", c_char_p)]


class pt_device_info(ctypes.Structure):
    _fields_ = [("kind", c_uint32), ("suitable", c_uint32), ("memory_bytes", c_uint64), ("uuid", c_uint8 * 16),
                ("name", c_char * 256), ("driver", c_char * 256), ("reason", c_char * 256)]


class pt_broken_rule(Sized):
    _fields_ = [("struct_size", c_uint32), ("component", c_int32), ("index", c_int64), ("subject", c_char_p),
                ("member", c_char_p), ("with", c_char_p), ("value", c_char_p), ("rule", c_char_p)]


class pt_film_info(Sized):
    _fields_ = [("struct_size", c_uint32), ("width", c_uint32), ("height", c_uint32), ("x", c_uint32), ("y", c_uint32),
                ("columns", c_uint32), ("rows", c_uint32), ("max_path_length", c_uint32), ("seed", c_uint64),
                ("estimator", c_uint32), ("sampler", c_uint32), ("tile_count", c_uint32),
                ("lamp_sample_count", c_uint32), ("device", c_char_p)]


class pt_film_tile(Sized):
    _fields_ = [("struct_size", c_uint32), ("x", c_uint32), ("y", c_uint32), ("width", c_uint32), ("height", c_uint32),
                ("range_count", c_uint32)]


class pt_sample_range(ctypes.Structure):
    _fields_ = [("first", c_uint64), ("end", c_uint64)]


class pt_stats(Sized):
    _fields_ = [("struct_size", c_uint32), ("sample_count", c_uint32), ("rejected_samples", c_uint64),
                ("device_bytes", c_uint64), ("submit_count", c_uint64), ("device_seconds", c_double),
                ("features", c_uint32), ("device_count", c_uint32), ("max_sample_count", c_uint32),
                ("reserved", c_uint32), ("mean_sample_count", c_double)]


class pt_error_estimate(Sized):
    _fields_ = [("struct_size", c_uint32), ("uncertain", c_uint32), ("rmse", c_double), ("rmse_low", c_double),
                ("rmse_high", c_double), ("relative_rmse", c_double), ("relative_rmse_low", c_double),
                ("relative_rmse_high", c_double)]
