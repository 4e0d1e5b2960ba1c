from __future__ import annotations

from typing import Any, Final

import numpy as np
import numpy.typing as npt

from pt import _structs as structs
from pt._enums import ColumnType

Array = npt.NDArray[Any]

LARGEST_STRIDE: Final = 2**31 - 1
TYPES: Final = {np.dtype(np.float32): ColumnType.FLOAT32, np.dtype(np.float64): ColumnType.FLOAT64,
                np.dtype(np.uint32): ColumnType.UINT32, np.dtype(np.uint8): ColumnType.SRGB8}


def _readable(array: Array) -> bool:
    if array.ndim == 2 and array.strides[1] != array.itemsize:
        return False
    sphere_bytes = array.itemsize * (array.shape[1] if array.ndim == 2 else 1)
    return len(array) < 2 or array.strides[0] == 0 or sphere_bytes <= array.strides[0] <= LARGEST_STRIDE


def _laid_out(name: str, array: Array, components: int, count: int | None) -> Array:
    single = (3,) if components == 3 else ()
    if array.shape == single and count is not None:
        return np.broadcast_to(array, (count, *single))
    if array.shape[1:] != single or array.ndim != len(single) + 1 or (count is not None and len(array) != count):
        rows = "n" if count is None else str(count)
        shapes = f"({rows}, 3)" if components == 3 else f"({rows},)"
        if count is not None:
            shapes += f" or {single}"
        raise ValueError(f"{name}.shape = {array.shape}: must be {shapes}")
    return array if _readable(array) else np.ascontiguousarray(array)


def real_column(name: str, values: npt.ArrayLike, components: int, count: int | None) -> Array:
    array = np.asarray(values)
    if array.dtype.kind not in "fiu":
        raise TypeError(f"{name}.dtype = {array.dtype}: must be of real numbers")
    if array.dtype not in (np.float32, np.float64):
        array = array.astype(np.float32 if array.dtype.kind == "f" and array.itemsize <= 4 else np.float64)
    return _laid_out(name, array, components, count)


def check_finite(name: str, values: npt.ArrayLike, *, positive: bool = False) -> None:
    array = np.asarray(values)
    good = np.isfinite(array)
    if positive:
        good &= array > 0
    if not good.all():
        place = tuple(np.argwhere(~good)[0].tolist())
        index = f"[{', '.join(map(str, place))}]" if place else ""
        raise ValueError(f"{name}{index} = {array[place]}: must be {'> 0 and ' if positive else ''}finite")


def color_column(name: str, values: npt.ArrayLike, count: int) -> Array:
    array = np.asarray(values)
    if array.dtype == np.uint8:
        return _laid_out(name, array, 3, count)
    if array.dtype.kind != "f":
        raise TypeError(f"{name}.dtype = {array.dtype}: must be uint8 (sRGB, 0 to 255) or floats (linear, 0 to 1)")
    return real_column(name, array, 3, count)


def index_column(name: str, values: npt.ArrayLike, count: int) -> Array:
    array = np.asarray(values)
    if array.dtype.kind not in "iu":
        raise TypeError(f"{name}.dtype = {array.dtype}: must be of integers")
    if array.dtype != np.uint32:
        if array.size and not 0 <= array.min() <= array.max() < 2**32:
            raise ValueError(f"{name} has {array.min()} to {array.max()}: must be indices of materials")
        array = array.astype(np.uint32)
    return _laid_out(name, array, 1, count)


def sphere_column(name: str, values: npt.ArrayLike, count: int | None) -> Array:
    components, types = structs.SPHERE_COLUMNS[name]
    if types == "real" or count is None:
        return real_column(name, values, components, count)
    return (color_column if types == "color" else index_column)(name, values, count)


def column_of(array: Array | None) -> structs.pt_column:
    if array is None:
        return structs.pt_column()
    stride = array.strides[0] if len(array) > 1 else 0
    return structs.pt_column(array.ctypes.data, stride, TYPES[array.dtype])
