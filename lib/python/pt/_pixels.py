from __future__ import annotations

from typing import Any, Final

import numpy as np
import numpy.typing as npt

from pt import _structs as structs
from pt._enums import Format, Quantity

Rectangle = tuple[int, int, int, int]

LAYOUTS: Final[dict[Format, tuple[int, np.dtype[Any]]]] = {
    Format.RGB32F: (3, np.dtype(np.float32)), Format.RGBA32F: (4, np.dtype(np.float32)),
    Format.RGBA16F: (4, np.dtype(np.float16)), Format.R32UI: (1, np.dtype(np.uint32))
}


def new_pixels(shape: tuple[int, int], rectangle: Rectangle | None, format: Format) -> npt.NDArray[Any]:
    channels, dtype = LAYOUTS[Format(format)]
    rows, columns = shape if rectangle is None else (rectangle[3], rectangle[2])
    if rows < 0 or columns < 0:
        raise ValueError(f"rectangle = {rectangle!r}: must be x, y, width, height, none of them negative")
    return np.empty((rows, columns, channels), dtype)


def _format_of(array: npt.NDArray[Any]) -> Format:
    if array.ndim == 3 and array.dtype.isnative:
        for format, (channels, dtype) in LAYOUTS.items():
            dense = (channels * dtype.itemsize, dtype.itemsize)
            if array.shape[2] == channels and array.dtype == dtype and array.strides[1:] == dense:
                return format
    raise ValueError(f"out has shape {array.shape}, dtype {array.dtype} and strides {array.strides}: must be (height, "
                     "width, 3) or (.., .., 4) of float32, (.., .., 4) of float16, or (.., .., 1) of uint32, with adjacent "
                     "pixels in each row")


def image_struct(pixels: npt.NDArray[Any], quantity: Quantity, shape: tuple[int, int], rectangle: Rectangle | None
                 ) -> structs.pt_image:
    format = _format_of(pixels)
    if not pixels.flags.writeable:
        raise ValueError("out is read-only: must be writeable")
    rows, columns = pixels.shape[:2]
    if rectangle is None:
        rectangle = (0, 0, shape[1], shape[0])
    if (rows, columns) != (rectangle[3], rectangle[2]) or not rows or not columns:
        raise ValueError(f"out has {columns}x{rows} pixels: must have the {rectangle[2]}x{rectangle[3]} that are read")
    if not all(0 <= number < 2**32 for number in rectangle):
        raise ValueError(f"rectangle = {rectangle!r}: must be x, y, width, height, none of them negative")
    pixel_bytes = pixels.strides[1]
    row_bytes = pixels.strides[0] if rows > 1 else columns * pixel_bytes
    if row_bytes < columns * pixel_bytes:
        raise ValueError(f"out has rows {row_bytes} bytes apart: must be at least {columns * pixel_bytes}")
    x, y, width, height = rectangle
    return structs.pt_image(
        quantity=quantity, data=pixels.ctypes.data, size_bytes=(rows - 1) * row_bytes + columns * pixel_bytes,
        row_bytes=row_bytes, x=x, y=y, width=width, height=height, format=format)
