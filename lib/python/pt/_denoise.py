from __future__ import annotations

import ctypes
import importlib.util
import os
import pathlib
from collections.abc import Callable, Sequence
from typing import Any, Final

import numpy as np
import numpy.typing as npt

from pt import _structs as structs
from pt._callbacks import CallbackGuard
from pt._library import checked, library
from pt._stats import ErrorEstimate, error_estimate_of
from pt._text import c_string

Pixels = npt.NDArray[np.float32]

OTHER_SEED: Final = 2**63  # the seeds of the two images differ in this bit


def denoise(first: npt.ArrayLike, second: npt.ArrayLike, albedo: npt.ArrayLike, normal: npt.ArrayLike, *,
            library_path: str | os.PathLike[str] | None = None, any_device: bool = False
            ) -> tuple[Pixels, ErrorEstimate]:
    """Returns an image without noise, and its error. Each pixel lies between the images' mean and the filtered image.

    first, second   radiance, shape (height, width, 3), of renderings that differ in RenderSettings.seed only; for
                    dependent images the stated error is too small
    albedo, normal  Quantity.ALBEDO and NORMAL, of the same shape
    library_path    Open Image Denoise 2; None for the module pyoidn's library, else the system's
    any_device      uses the device of OIDN_DEFAULT_DEVICE, else the library's choice, instead of the CPU

    Raises UnsupportedError if the library is not installed (`pip install pyoidn`), ValueError if shapes differ.
    """
    images = [np.ascontiguousarray(image, np.float32) for image in (first, second, albedo, normal)]
    shape = images[0].shape
    if len(shape) != 3 or shape[2] != 3 or any(image.shape != shape for image in images):
        raise ValueError(f"shapes = {[image.shape for image in images]}: must all be (height, width, 3)")
    return denoise_rounds(lambda _: images, shape, 1, (0.0, 0.0), library_path, any_device)


def denoise_rounds(render: Callable[[int], Sequence[Pixels] | None], shape: tuple[int, ...], samples: int,
                   stopping: tuple[float, float], library_path: str | os.PathLike[str] | None = None,
                   any_device: bool = False) -> tuple[Pixels, ErrorEstimate]:
    """`render(count)` returns the images of denoise(), which must stay alive, or None to stop. `stopping` has pt_stopping's fields."""
    result, guard = np.empty(shape, np.float32), CallbackGuard()
    info = structs.pt_denoise_info(width=shape[1], height=shape[0], any_device=any_device, denoised=_pointer(result),
                                   library=c_string(find_library() if library_path is None else os.fspath(library_path)))

    def add_round(_: object, count: int) -> int:
        info.first = None  # The library refuses a round that raises.
        images = render(count)
        if images is not None:
            info.first, info.second, info.albedo, info.normal = map(_pointer, images)
        return int(images is None)

    guard.watch(add_round)
    rounds = structs.pt_rounds_info(sample_count=samples, render=structs.pt_round_fn(add_round), stopping=stopping)
    error, loaded = structs.pt_error_estimate(), library()
    with guard:
        ended = loaded.pt_denoise_rounds(rounds, info, error)
    guard.raise_caught()
    checked(loaded, ended)
    return result, error_estimate_of(error)


def _pointer(image: Pixels) -> Any:
    return image.ctypes.data_as(ctypes.POINTER(ctypes.c_float))


def find_library() -> str | None:
    spec = importlib.util.find_spec("pyoidn")
    for folder in spec.submodule_search_locations or () if spec else ():
        path = pathlib.Path(folder, "oidn", "lib", "libOpenImageDenoise.so.2")
        if path.exists():
            return str(path)
    return None
