"""Points of the Point Cloud Library: a head, then records, binary or as text."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Final

import numpy as np
import numpy.typing as npt

from pt.figures._particles import Particles, assembled
from pt.figures.readers._lines import Lines
from pt.figures.readers._ply import records
from pt.figures.readers._rows import Layout, Rows, shown

_PACKED_COLORS: Final = ("rgb", "rgba")


def read_pcd(lines: Lines, mapping: Mapping[str, str], drop_nonfinite: bool) -> Particles:
    head: dict[str, list[str]] = {}
    while "DATA" not in head:
        line = lines.line()
        if line is None:
            raise lines.refuse("the file ends within its head: it was cut short")
        if line.strip() and not line.startswith("#"):
            key, *words = line.split()
            head[key] = words
    try:
        fields = head["FIELDS"]
        counts = [int(word) for word in head.get("COUNT", ["1"] * len(fields))]
        kinds = [{"F": "f", "U": "u", "I": "i"}[kind] + size for kind, size in zip(head["TYPE"], head["SIZE"])]
        count = int(head["POINTS"][0])
        names = [name if width == 1 else f"{name}[{i}]" for name, width in zip(fields, counts) for i in range(width)]
        kind = np.dtype([(f"{name} {i}", each) for i, (name, each) in enumerate(zip(names, (
            each for each, width in zip(kinds, counts, strict=True) for _ in range(width)), strict=True))])
    except (KeyError, ValueError, IndexError, TypeError) as error:
        raise lines.refuse(f"the head must have FIELDS, SIZE, TYPE, COUNT and POINTS that fit together: {error}") from None
    notes: list[str] = []
    if head["DATA"] == ["binary"]:
        columns = dict(zip(names, records(lines, kind, count).values()))
    elif head["DATA"] == ["ascii"]:
        rows = Rows(lines, Layout(names, names))
        rows.read(count)
        notes = rows.notes
        columns = {name: values.astype(kind[i]) for i, (name, values) in enumerate(rows.columns().items())}
    else:
        raise lines.refuse(f"DATA {shown(' '.join(head['DATA']))}: must be ascii or binary; pcl_convert_pcd_ascii_binary "
                           "writes these")
    return assembled(lines.name, _with_colors(columns), mapping=mapping, drop_nonfinite=drop_nonfinite, notes=notes)


def _with_colors(columns: dict[str, npt.NDArray[Any]]) -> dict[str, npt.NDArray[Any]]:
    """Three bytes that are packed into one number of 32 bits, whatever its type."""
    for name in _PACKED_COLORS:
        if name in columns and columns[name].dtype.itemsize == 4:
            packed = np.ascontiguousarray(columns.pop(name)).view(np.uint32)
            for key, shift in (("red", 16), ("green", 8), ("blue", 0)):
                columns[key] = (packed >> shift & 255).astype(np.uint8)
    return columns
