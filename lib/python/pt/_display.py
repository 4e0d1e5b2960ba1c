from __future__ import annotations

import ctypes
import struct
import zlib
from typing import Any

import numpy as np
import numpy.typing as npt

from pt import _structs as structs
from pt._library import checked, library


def automatic_exposure(radiance: npt.ArrayLike) -> float:
    """Returns stops, rounded to hundredths, that bring the average to middle grey, 0.18."""
    colors = np.ascontiguousarray(radiance, np.float32)
    exposure, loaded = ctypes.c_double(), library()
    checked(loaded, loaded.pt_automatic_exposure(_floats(colors), colors.size // 3, exposure))
    return exposure.value


def to_pixels(radiance: npt.ArrayLike, exposure: float | None, dtype: Any = np.uint8, *,
              alpha: npt.ArrayLike | None = None, **display: Any) -> npt.NDArray[Any]:
    """Returns sRGB signals of type uint8 or uint16. With alpha, radiance is premultiplied, and the last axis is R, G, B, A.

    exposure   stops; None: automatic
    display    other properties, as in pt_display_info: curve, gamma, white
    """
    colors = np.ascontiguousarray(radiance, np.float32)
    shares = None if alpha is None else np.ascontiguousarray(alpha, np.float32)
    pixels: npt.NDArray[Any] = np.empty((*colors.shape[:-1], 3 if shares is None else 4), dtype)
    info = structs.pt_display_info(
        bits=8 * pixels.itemsize, automatic_exposure=exposure is None, exposure=exposure or 0.0,
        pixel_count=colors.size // 3, radiance=_floats(colors), alpha=None if shares is None else _floats(shares),
        pixels=pixels.ctypes.data, size_bytes=pixels.nbytes,
        **{name: tuple(value) if isinstance(value, list) else value for name, value in display.items()})
    loaded = library()
    checked(loaded, loaded.pt_display(info))
    return pixels


def _floats(values: npt.NDArray[np.float32]) -> Any:
    return values.ctypes.data_as(ctypes.POINTER(ctypes.c_float))


def linear(signal: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    """Decodes sRGB (IEC 61966-2-1)."""
    return np.where(signal <= 0.04045, signal / 12.92, ((signal + 0.055) / 1.055)**2.4)


def encode_png(pixels: npt.NDArray[Any], dpi: float | None = None) -> bytes:
    """W3C, "Portable Network Graphics (PNG) Specification", 2003. `pixels` are uint8 or uint16, of shape (height, width, 3)
    or, with alpha, 4. The file states dpi, in pixels per inch."""
    height, width, channels = pixels.shape
    big_endian = np.ascontiguousarray(pixels, pixels.dtype.newbyteorder(">"))
    unfiltered = np.zeros((height, 1), np.uint8)
    rows = np.hstack([unfiltered, big_endian.view(np.uint8).reshape(height, -1)])
    kind = {3: 2, 4: 6}[channels]
    header = struct.pack(">IIBBBBB", width, height, 8 * pixels.itemsize, kind, 0, 0, 0)
    per_meter = b"" if dpi is None else _chunk(b"pHYs", struct.pack(">IIB", *2 * [round(dpi / 0.0254)], 1))
    return (b"\x89PNG\r\n\x1a\n" + _chunk(b"IHDR", header) + _chunk(b"sRGB", b"\0") + per_meter +
            _chunk(b"IDAT", zlib.compress(rows.tobytes())) + _chunk(b"IEND", b""))


def _chunk(kind: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
