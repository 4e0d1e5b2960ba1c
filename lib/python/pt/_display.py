"""From linear radiance to a picture, as the program pt does it by default: exposure, and IEC 61966-2-1 (sRGB)."""

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
    """The stops that bring the average of an image to middle grey: Reinhard, Stark, Shirley, Ferwerda 2002,
    "Photographic Tone Reproduction for Digital Images", eqs. 1 and 2, by the mean of the channels, without black
    pixels, and in hundredths."""
    means = radiance.astype(np.float64).mean(axis=2)
    means = means[means > 0]
    if not means.size:
        return 0.0
    stops = math.log2(MIDDLE_GREY) - float(np.log2(means).mean())
    hundredths = math.copysign(math.floor(abs(100 * stops) + 0.5), stops)  # halves away from zero
    return min(max(hundredths / 100, -MOST_STOPS), MOST_STOPS)


def to_srgb8(radiance: npt.NDArray[Any], exposure: float) -> npt.NDArray[np.uint8]:
    """255 times the sRGB signal of the radiance times 2^exposure, clamped to [0, 1]; halves are rounded up."""
    light = np.clip(radiance.astype(np.float64) * 2.0**exposure, 0.0, 1.0)
    signal = np.where(light <= 0.0031308, 12.92 * light, 1.055 * light**(1 / 2.4) - 0.055)
    pixels: npt.NDArray[np.uint8] = np.floor(255 * signal + 0.5).astype(np.uint8)
    return pixels


def encode_png(pixels: npt.NDArray[np.uint8]) -> bytes:
    """A PNG of sRGB bytes, shape (height, width, 3); W3C, "Portable Network Graphics (PNG) Specification", 2003."""
    height, width, _ = pixels.shape
    unfiltered = np.zeros((height, 1), np.uint8)  # before each row the number of its filter: none
    rows = np.hstack([unfiltered, pixels.reshape(height, 3 * width)])
    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)  # 8 bits, RGB, zlib, no interlacing
    return (b"\x89PNG\r\n\x1a\n" + _chunk(b"IHDR", header) + _chunk(b"sRGB", b"\0") +
            _chunk(b"IDAT", zlib.compress(rows.tobytes())) + _chunk(b"IEND", b""))


def _chunk(kind: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
