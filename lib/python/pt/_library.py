from __future__ import annotations

import ctypes
import functools
import os
import pathlib
import sys
from ctypes import POINTER, c_char_p, c_double, c_float, c_int32, c_uint32, c_uint64, c_void_p
from typing import Any, Final

from pt import _structs as structs
from pt._enums import Result
from pt._errors import ERROR_OF_RESULT, BrokenRule, Error

VERSION: Final = "0.4"
SONAME: Final = {"win32": "pt.dll", "darwin": f"libpt.{VERSION}.dylib"}.get(sys.platform, f"libpt.so.{VERSION}")
BROKEN_RULES_KEPT: Final = 8

# Without types ctypes truncates pointers to 32 bits, so every function is listed.
PARAMETERS: Final[dict[str, list[Any]]] = {
    "pt_version": [],
    "pt_result_name": [c_int32],
    "pt_last_error": [c_void_p],
    "pt_get_broken_rule": [c_void_p, c_uint32, POINTER(structs.pt_broken_rule)],
    "pt_create": [POINTER(structs.pt_create_info), POINTER(c_void_p)],
    "pt_destroy": [c_void_p],
    "pt_get_devices": [POINTER(structs.pt_device_info), POINTER(c_uint32)],
    "pt_get_context_device": [c_void_p, POINTER(structs.pt_device_info)],
    "pt_set_scene": [c_void_p, POINTER(structs.pt_scene)],
    "pt_set_camera": [c_void_p, POINTER(structs.pt_camera)],
    "pt_set_render": [c_void_p, POINTER(structs.pt_render)],
    "pt_prepare": [c_void_p],
    "pt_reload_shaders": [c_void_p],
    "pt_accumulate": [c_void_p, POINTER(structs.pt_accumulate_info)],
    "pt_readback": [c_void_p, POINTER(structs.pt_image)],
    "pt_get_warning": [c_void_p, POINTER(structs.pt_broken_rule)],
    "pt_get_stats": [c_void_p, POINTER(structs.pt_stats)],
    "pt_get_error_estimate": [c_void_p, POINTER(structs.pt_error_estimate)],
    "pt_next_check": [c_uint32],
    "pt_save_film": [c_void_p, c_void_p, POINTER(c_uint64)],
    "pt_add_film": [c_void_p, c_char_p, c_uint64],
    "pt_open_film": [c_char_p, c_uint64, POINTER(c_void_p)],
    "pt_close_film": [c_void_p],
    "pt_merge_film": [c_void_p, c_char_p, c_uint64],
    "pt_write_film": [c_void_p, c_void_p, POINTER(c_uint64)],
    "pt_stream_film": [c_void_p, structs.pt_take_bytes_fn, c_void_p],
    "pt_read_film": [c_void_p, POINTER(structs.pt_image)],
    "pt_get_film_info": [c_void_p, POINTER(structs.pt_film_info)],
    "pt_get_film_tile": [c_void_p, c_uint32, POINTER(structs.pt_film_tile)],
    "pt_get_film_ranges": [c_void_p, c_uint32, POINTER(structs.pt_sample_range), POINTER(c_uint32)],
    "pt_plan_film": [c_void_p, c_double, c_uint32, POINTER(c_uint32), POINTER(c_uint32)],
    "pt_get_film_stats": [c_void_p, POINTER(structs.pt_stats)],
    "pt_get_film_error_estimate": [c_void_p, POINTER(structs.pt_error_estimate)],
    "pt_compare": [POINTER(structs.pt_compare_info), POINTER(structs.pt_comparison), POINTER(structs.pt_compared_region),
                   POINTER(c_uint32)],
    "pt_display": [POINTER(structs.pt_display_info)],
    "pt_automatic_exposure": [POINTER(c_float), c_uint64, POINTER(c_double)],
    "pt_denoise_rounds": [POINTER(structs.pt_rounds_info), POINTER(structs.pt_denoise_info), POINTER(structs.pt_error_estimate)],
}
NOT_RESULTS: Final[dict[str, Any]] = {
    "pt_version": c_uint32, "pt_result_name": c_char_p, "pt_last_error": c_char_p, "pt_get_broken_rule": c_uint64,
    "pt_destroy": None, "pt_next_check": c_uint32, "pt_close_film": None,
}


def library_path() -> str:
    named = os.environ.get("PT_LIBRARY")
    if named:
        return named
    beside = pathlib.Path(__file__).with_name(SONAME)
    return str(beside) if beside.exists() else SONAME


def load_library(path: str) -> ctypes.CDLL:
    """Raises ImportError if the library is missing or has other structs. A function that an older build lacks raises AttributeError when
    called."""
    try:
        loaded = ctypes.CDLL(path)
        for name, parameters in PARAMETERS.items():
            if name == "pt_version" or hasattr(loaded, name):
                function = getattr(loaded, name)
                function.argtypes = parameters
                function.restype = NOT_RESULTS.get(name, c_int32)
    except (OSError, AttributeError) as error:
        raise ImportError(f"{path} cannot be loaded as libpt (PT_LIBRARY can name another file): {error}") from error
    if version_text(loaded).rpartition(".")[0] != VERSION:
        raise ImportError(f"{path} is libpt {version_text(loaded)}; this package is for {SONAME}")
    return loaded


def version_text(loaded: ctypes.CDLL) -> str:
    number = int(loaded.pt_version())
    return f"{number // 1_000_000}.{number // 1000 % 1000}.{number % 1000}"


@functools.lru_cache(maxsize=1)
def library() -> ctypes.CDLL:
    return load_library(library_path())


def _text(value: bytes | None) -> str:
    return "" if value is None else value.decode(errors="replace")


def broken_rule_of(rule: structs.pt_broken_rule) -> BrokenRule:
    return BrokenRule(
        subject=_text(rule.subject), index=None if rule.index < 0 else rule.index, member=_text(rule.member),
        component=None if rule.component < 0 else rule.component, joined_with=_text(getattr(rule, "with")),
        value=_text(rule.value), rule=_text(rule.rule))


def _broken_rules(loaded: ctypes.CDLL, context: c_void_p | None) -> tuple[BrokenRule, ...]:
    rules = []
    for index in range(min(loaded.pt_get_broken_rule(context, 0, None), BROKEN_RULES_KEPT)):
        rule = structs.pt_broken_rule()
        loaded.pt_get_broken_rule(context, index, rule)
        rules.append(broken_rule_of(rule))
    return tuple(rules)


def checked(loaded: ctypes.CDLL, result: int, context: c_void_p | None = None) -> Result:
    """Raises negative results as errors."""
    if result >= 0:
        return Result(result)
    message = _text(loaded.pt_last_error(context))
    if result not in ERROR_OF_RESULT:
        raise Error(f"{_text(loaded.pt_result_name(result))} ({result}): {message}")
    raise ERROR_OF_RESULT[result](message, _broken_rules(loaded, context))
