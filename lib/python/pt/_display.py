"""The default display transform: exposure and sRGB (IEC 61966-2-1)."""

from __future__ import annotations

import math
import struct
import zlib
from typing import Any

import numpy as np
import numpy.typing as npt

MIDDLE_GREY = 0.18
MOST_STOPS = 64.0


def automatic_exposure(radiance: npt.NDArray[Any]) -> float:
    """Returns the stops that bring the average to middle grey, as automatic_exposure in cli/image/tone_map.h does."""
    means = radiance.astype(np.float64).mean(axis=2)
    means = means[means > 0]
    if not means.size:
        return 0.0
    level = math.inf
    for _ in range(4):
        level = float(np.minimum(means, level).mean())
    weights = means / (means + level / 128)
    stops = math.log2(MIDDLE_GREY) - float((weights * np.log2(means)).sum() / weights.sum())
    hundredths = math.copysign(math.floor(abs(100 * stops) + 0.5), stops)  # Halves round away from zero.
    return min(max(hundredths / 100, -MOST_STOPS), MOST_STOPS)


def to_srgb8(radiance: npt.NDArray[Any], exposure: float) -> npt.NDArray[np.uint8]:
    """Returns 255 times the sRGB signal of radiance times 2^exposure, clamped to [0, 1]. Halves round up."""
    pixels: npt.NDArray[np.uint8] = quantised(signal(radiance.astype(np.float64) * 2.0**exposure), np.uint8)
    return pixels


def signal(light: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    light = np.clip(light, 0.0, 1.0)
    return np.where(light <= 0.0031308, 12.92 * light, 1.055 * light**(1 / 2.4) - 0.055)


def linear(signal: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    return np.where(signal <= 0.04045, signal / 12.92, ((signal + 0.055) / 1.055)**2.4)


def quantised(signal: npt.NDArray[np.float64], dtype: Any) -> npt.NDArray[Any]:
    numbers: npt.NDArray[Any] = np.floor(np.iinfo(dtype).max * signal + 0.5).astype(dtype)
    return numbers


def encode_png(pixels: npt.NDArray[Any]) -> bytes:
    """Encodes uint8 or uint16 pixels of shape (height, width, 3), or 4 with alpha (W3C, "Portable Network Graphics (PNG)
    Specification", 2003)."""
    height, width, channels = pixels.shape
    big_endian = np.ascontiguousarray(pixels, pixels.dtype.newbyteorder(">"))
    unfiltered = np.zeros((height, 1), np.uint8)
    rows = np.hstack([unfiltered, big_endian.view(np.uint8).reshape(height, -1)])
    kind = {3: 2, 4: 6}[channels]
    header = struct.pack(">IIBBBBB", width, height, 8 * pixels.itemsize, kind, 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + _chunk(b"IHDR", header) + _chunk(b"sRGB", b"\0") +
            _chunk(b"IDAT", zlib.compress(rows.tobytes())) + _chunk(b"IEND", b""))


def _chunk(kind: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
