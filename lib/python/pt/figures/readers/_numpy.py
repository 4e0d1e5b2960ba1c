from __future__ import annotations

import io
import sys
import zipfile
import zlib
from collections.abc import Mapping
from types import SimpleNamespace
from typing import Any, Final, cast

import numpy as np

from pt._fit import Array
from pt.figures._cell import Cell
from pt.figures._errors import DataError
from pt.figures._particles import Table
from pt.figures.readers._frames import Frames, Listed
from pt.figures.readers._lines import Lines

_CELLS: Final = ("cell", "box", "lattice")


def read_npy(lines: Lines) -> Frames:
    return frames_of_array(lines.name, _array(lines))


def read_npz(lines: Lines) -> Frames:
    source: Any = lines.path if lines.is_file and not lines.is_packed else io.BytesIO(lines.take(sys.maxsize))
    try:
        with np.load(source, allow_pickle=False) as file:
            arrays = {name: file[name] for name in file.files}
    except (OSError, ValueError, EOFError, KeyError, zlib.error, zipfile.BadZipFile, RuntimeError) as error:
        raise DataError(f"{lines.name}: {str(error)[:200]}: damaged, or no NPZ file of numbers") from None
    return frames_of_arrays(lines.name, arrays)


def _array(lines: Lines) -> Array:
    stream, npy = SimpleNamespace(read=lines.take), cast(Any, np.lib.format)
    try:
        is_first = npy.read_magic(stream) == (1, 0)
        shape, is_fortran, kind = (npy.read_array_header_1_0 if is_first else npy.read_array_header_2_0)(stream)
    except Exception as error:  # NumPy evaluates the header as Python, so any exception is possible
        raise DataError(f"{lines.name}: byte {lines.byte}: {str(error)[:200]}: the header of an NPY file is damaged or was cut "
                        "short") from None
    if kind.hasobject or not kind.itemsize or min(shape, default=0) < 0:
        raise DataError(f"{lines.name}: an array of {kind} with the shape {shape}: must have numbers")
    count = int(np.prod(shape, dtype=object))
    values = lines.mapped(kind, count)
    if len(values) < count:
        raise DataError(f"{lines.name}: byte {lines.byte + values.nbytes:,}: the file ends after {len(values):,} of "
                        f"{count:,} numbers: it was cut short")
    _require_text(lines.name, values)
    return values.reshape(shape[::-1]).T if is_fortran else values.reshape(shape)


def _require_text(name: str, values: Array) -> None:
    for field in values.dtype.names or ("",):
        column = values[field] if field else values
        if column.dtype.kind == "U" and column.dtype.itemsize:
            points = np.ascontiguousarray(column).view(column.dtype.byteorder + "u4")
            if points.max(initial=0) > sys.maxunicode:
                raise DataError(f"{name}: the column {field or 'of text'} has bytes that are no text: it is damaged")


def frames_of_arrays(name: str, arrays: Mapping[str, Any]) -> Frames:
    """Named arrays become columns. Each may have a first dimension of frames."""
    columns = {key: np.asarray(values) for key, values in arrays.items() if np.ndim(values)}
    box = next((columns.pop(key) for key in list(columns) if key.lower() in _CELLS), None)
    cell = Cell.of(box) if box is not None and box.shape in ((3,), (3, 3)) else None
    frames = max((len(values) for values in columns.values() if values.ndim == 3), default=None)

    def read(index: int) -> Table:
        rows = {key: values[index] if values.ndim == 3 else values for key, values in columns.items()}
        size = max((len(values) for values in rows.values() if values.ndim == 2), default=None)
        return Table({key: values for key, values in rows.items() if size in (None, len(values))}, cell)

    return Listed(name, frames or 1, read)


def frames_of_array(name: str, array: Array) -> Frames:
    if array.dtype.names:
        return frames_of_arrays(name, {key: array[key] for key in array.dtype.names})
    if array.dtype.kind not in "fiub" or array.ndim not in (2, 3) or not 2 <= array.shape[-1]:
        raise DataError(f"{name}: an array of {array.dtype} with the shape {array.shape}: must have numbers and the shape "
                        "(n, 3), (n, 2) or, of frames, (t, n, 3)")
    if array.ndim == 3 and array.shape[2] > 3:
        raise DataError(f"{name}: the shape {array.shape}: frames must have the shape (t, n, 3) or (t, n, 2)")
    if array.shape[-1] <= 3:
        return frames_of_arrays(name, {"positions": array})
    names = ["x", "y", "z", *map(str, range(4, array.shape[1] + 1))]
    return frames_of_arrays(name, dict(zip(names, array.T)))
