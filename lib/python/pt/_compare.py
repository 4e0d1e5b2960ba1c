from __future__ import annotations

import ctypes
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
import numpy.typing as npt

from pt import _structs as structs
from pt._enums import Light, Quantity
from pt._film import Film
from pt._image import Image
from pt._library import checked, library

WORST: Final = 5


@dataclass(frozen=True)
class Region:
    """A rectangle of the picture. Tuples are R, G, B."""

    x: int
    y: int
    width: int
    height: int
    light: tuple[float, float, float]  # mean of the second image
    difference: tuple[float, float, float]  # mean of the first image minus mean of the second
    deviation: tuple[float, float, float]  # standard deviation of the difference
    probability: float  # upper bound for the probability that equal light shows such a difference in some region of this size
    smallest_change: float  # smallest relative change that is found with 99% probability; infinite if none


@dataclass(frozen=True)
class Comparison:
    light: Light
    probability: float  # upper bound for the probability that equal light shows such differences
    smallest_change: float  # as in Region, of all light
    smallest_tile_change: float  # median of smallest_change over tiles of 32 x 32 pixels
    rate: float  # the light differs if a probability is below this
    summary: str
    regions: tuple[Region, ...]  # the whole picture, then tiles whose sides are halved down to 16 pixels

    def __str__(self) -> str:
        return self.summary


def compare(first: Film | Image | npt.ArrayLike, second: Film | Image | npt.ArrayLike, *, rate: float = 0.0,
            min_change: float = 1.0, look: int = 0) -> Comparison:
    """Tests whether two images show the same light (shaders/README.md, section 11).

    first, second   films, images (their raw mean if denoised) or radiance of shape (height, width, 3), equally
                    large. Changes are relative to the second. The same seed and sampler reveal smaller changes
    rate            probability of calling equal light different; 0: 10^-6
    min_change      Light.UNDECIDED if a relative change of all light by this much may be missed
    look            1, 2, ... for repeated tests of growing images; `rate` then holds for all tests together

    Raises InvalidArgumentError if tiles have different sample counts (their means are biased) or the sampler is HALTON
    (its errors are not random), and ValueError for unsuitable shapes."""
    images = [_radiance(each) for each in (first, second)]
    shape = images[0].shape
    if len(shape) != 3 or shape[2] != 3 or images[1].shape != shape:
        raise ValueError(f"shapes = {[image.shape for image in images]}: must both be (height, width, 3)")
    info = structs.pt_compare_info(width=shape[1], height=shape[0], look=look, rate=rate, min_change=min_change,
                                   first=_compared(images[0], first), second=_compared(images[1], second))
    found, count, loaded = structs.pt_comparison(), ctypes.c_uint32(), library()
    checked(loaded, loaded.pt_compare(info, None, None, count))
    regions = (structs.pt_compared_region * count.value)()
    checked(loaded, loaded.pt_compare(info, found, regions, count))
    return Comparison(Light(found.light), found.probability, found.smallest_change, found.smallest_tile_change,
                      found.rate, found.summary.decode(), tuple(map(_region, regions)))


def assert_same_light(first: Film | Image | npt.ArrayLike, second: Film | Image | npt.ArrayLike, *,
                      min_change: float = 0.01, rate: float = 0.0) -> None:
    """Raises AssertionError, with the most different regions, if the light of compare() is DIFFERENT or UNDECIDED."""
    comparison = compare(first, second, rate=rate, min_change=min_change)
    if comparison.light in (Light.EQUAL_BITS, Light.SAME):
        return
    worst = sorted(comparison.regions, key=lambda region: region.probability)[:WORST]
    lines = [f"  {each.width}x{each.height} pixels at {each.x},{each.y}: difference {_numbers(each.difference)} +- "
             f"{_numbers(each.deviation)} of {_numbers(each.light)}" for each in worst if each.probability <= comparison.rate]
    raise AssertionError("\n".join([str(comparison), *lines]))


def _radiance(image: Film | Image | npt.ArrayLike) -> npt.NDArray[np.float32]:
    if isinstance(image, Film):
        image = image.readback(Quantity.RADIANCE)
    elif isinstance(image, Image) and image.raw is not None:
        image = image.raw
    return np.ascontiguousarray(image, np.float32)


def _compared(radiance: npt.NDArray[np.float32], source: object) -> structs.pt_compared_image:
    struct = structs.pt_compared_image(radiance=radiance.ctypes.data_as(ctypes.POINTER(ctypes.c_float)))
    if isinstance(source, Film):
        source = source.image()
    if isinstance(source, Image):
        struct.sampler, struct.estimator = source.sampler, source.estimator
        struct.min_samples, struct.max_samples = source.stats.sample_count, source.stats.max_sample_count
    return struct


def _region(struct: structs.pt_compared_region) -> Region:
    values: dict[str, Any] = {name: getattr(struct, name) for name in Region.__dataclass_fields__}
    values.update({name: tuple(values[name]) for name in ("light", "difference", "deviation")})
    return Region(**values)


def _numbers(values: tuple[float, ...]) -> str:
    return "(" + ", ".join(f"{value:.3g}" for value in values) + ")"
