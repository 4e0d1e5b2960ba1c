from __future__ import annotations

import ctypes
import importlib.util
import os
import pathlib
from dataclasses import replace
from typing import Final

import numpy as np
import numpy.typing as npt

from pt import _structs as structs
from pt._camera import RenderSettings
from pt._image import Image
from pt._library import checked, library
from pt._stats import ErrorEstimate, Stats, error_estimate_of
from pt._text import c_string

Pixels = npt.NDArray[np.float32]

OTHER_SEED: Final = 2**63  # The seeds of the two images differ in this bit.


def denoise(first: npt.ArrayLike, second: npt.ArrayLike, albedo: npt.ArrayLike, normal: npt.ArrayLike, *,
            library_path: str | os.PathLike[str] | None = None, any_device: bool = False
            ) -> tuple[Pixels, ErrorEstimate]:
    """Returns an image without noise, and its error. Each pixel lies between the images' mean and the filtered image.

    first, second   radiance, shape (height, width, 3), of renderings that differ in RenderSettings.seed only; for
                    dependent images the stated error is too small
    albedo, normal  Quantity.ALBEDO and NORMAL, of the same shape
    library_path    Open Image Denoise 2; None for the module pyoidn's library, else the system's
    any_device      whether OIDN_DEFAULT_DEVICE or the library chooses the device, instead of the CPU

    Raises UnsupportedError if the library is not installed (`pip install pyoidn`), ValueError if shapes differ.
    """
    images = [np.ascontiguousarray(image, np.float32) for image in (first, second, albedo, normal)]
    shape = images[0].shape
    if len(shape) != 3 or shape[2] != 3 or any(image.shape != shape for image in images):
        raise ValueError(f"shapes = {[image.shape for image in images]}: must all be (height, width, 3)")
    result = np.empty(shape, np.float32)
    path = find_library() if library_path is None else os.fspath(library_path)
    pointers = [image.ctypes.data_as(ctypes.POINTER(ctypes.c_float)) for image in (*images, result)]
    info = structs.pt_denoise_info(
        width=shape[1], height=shape[0], any_device=any_device, library=c_string(path),
        **dict(zip(("first", "second", "albedo", "normal", "denoised"), pointers)))
    error, loaded = structs.pt_error_estimate(), library()
    checked(loaded, loaded.pt_denoise(info, error))
    return result, error_estimate_of(error)


def find_library() -> str | None:
    spec = importlib.util.find_spec("pyoidn")
    for folder in spec.submodule_search_locations or () if spec else ():
        path = pathlib.Path(folder, "oidn", "lib", "libOpenImageDenoise.so.2")
        if path.exists():
            return str(path)
    return None


def joined_halves(parts: list[tuple[Pixels, Stats, Pixels | None]], guides: tuple[Pixels, ...], settings: RenderSettings) -> Image:
    (first, of_first, coverage), (second, of_second, other_coverage) = parts
    if coverage is not None and other_coverage is not None:
        coverage = (coverage + other_coverage) / 2
    radiance, error = denoise(first, second, *guides)
    summed = ("sample_count", "max_sample_count", "mean_sample_count", "rejected_samples")
    stats = replace(of_second, **{name: getattr(of_first, name) + getattr(of_second, name) for name in summed})
    counts = np.full((*first.shape[:2], 1), stats.sample_count)
    return Image(radiance, np.abs(first - second) / 2, counts, error, stats, raw=(first + second) / 2,
                 sampler=settings.sampler, estimator=settings.estimator, coverage=coverage)
