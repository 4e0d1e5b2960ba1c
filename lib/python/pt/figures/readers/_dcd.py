"""DCD files without a cell. MDAnalysis writes these with edges of length 0, which chemfiles refuses."""

from __future__ import annotations

import os
from typing import Any, Final

import numpy as np
import numpy.typing as npt

_CONTROL: Final = 8
_TITLE: Final = 92
_LENGTHS: Final = (0, 2, 5)


def frames_without_cell(path: str) -> npt.NDArray[Any] | None:
    """Returns records with fields x, y and z, or None if frames have a cell or another layout."""
    size = os.path.getsize(path)
    with open(path, "rb") as file:
        start = file.read(_TITLE + 4)
        if len(start) < _TITLE + 4 or start[:_CONTROL] != b"T\0\0\0CORD":
            return None
        control = np.frombuffer(start, "<i4", 20, _CONTROL)
        place = _TITLE + 8 + int.from_bytes(start[_TITLE:], "little")
        file.seek(place)
        count = int.from_bytes(file.read(8)[4:], "little")
    fixed_atoms, has_cell, has_fourth_axis = (bool(control[number]) for number in (8, 10, 11))
    if fixed_atoms or has_fourth_axis or not has_cell or not 0 < 12 * count <= size:
        return None
    parts = (("cell", "<f8", 6), *((axis, "<f4", count) for axis in "xyz"))
    kind = np.dtype([field for name, number, length in parts for field in
                     ((f"before_{name}", "<i4"), (name, number, (length,)), (f"after_{name}", "<i4"))])
    frames = max(size - place - 12, 0) // kind.itemsize
    if not frames:
        return None
    records = np.memmap(path, kind, "r", place + 12, (frames,))
    return None if records["cell"][:, _LENGTHS].any() or (records["before_x"] != 4 * count).any() else records
