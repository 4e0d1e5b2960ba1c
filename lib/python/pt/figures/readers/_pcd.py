from __future__ import annotations

from typing import Any, Final

import numpy as np
import numpy.typing as npt

from pt.figures._particles import Table
from pt.figures.readers._lines import Lines
from pt.figures.readers._ply import binary_columns, text_columns
from pt.figures.readers._rows import shown

_PACKED_COLORS: Final = ("rgb", "rgba")


def read_pcd(lines: Lines) -> Table:
    head: dict[str, list[str]] = {}
    while "DATA" not in head:
        line = lines.line()
        if line is None:
            raise lines.refuse("the file ends within its header: it was cut short")
        if line.strip() and not line.startswith("#"):
            key, *words = line.split()
            head[key] = words
    kinds: dict[str, str] = {}
    try:
        counts = map(int, head.get("COUNT", ["1"] * len(head["FIELDS"])))
        for name, kind, size, width in zip(head["FIELDS"], head["TYPE"], head["SIZE"], counts, strict=True):
            for i in range(width):
                key = name if width == 1 and name not in kinds else f"{name}[{i or len(kinds)}]"
                kinds[key] = np.dtype({"F": "f", "U": "u", "I": "i"}[kind] + size).str
        count = int(head["POINTS"][0])
    except (KeyError, ValueError, IndexError, TypeError) as error:
        raise lines.refuse(f"the header must have FIELDS, SIZE, TYPE, COUNT and POINTS that fit together: {error}") from None
    if head["DATA"] not in (["ascii"], ["binary"]):
        raise lines.refuse(f"DATA {shown(' '.join(head['DATA']))}: must be ascii or binary; pcl_convert_pcd_ascii_binary "
                           "writes these")
    notes: list[str] = []
    columns = (text_columns if head["DATA"] == ["ascii"] else binary_columns)(lines, kinds, count, notes)
    return Table(_with_colors(columns), notes=notes)


def _with_colors(columns: dict[str, npt.NDArray[Any]]) -> dict[str, npt.NDArray[Any]]:
    for name in _PACKED_COLORS:
        if name in columns and columns[name].dtype.itemsize == 4:
            packed = np.ascontiguousarray(columns.pop(name)).view(np.uint32)
            for key, shift in (("red", 16), ("green", 8), ("blue", 0)):
                columns[key] = (packed >> shift & 255).astype(np.uint8)
    return columns
