from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from pt._fit import Array
from pt.figures._errors import DataError
from pt.figures._particles import Table
from pt.figures.readers._lines import Lines
from pt.figures.readers._rows import Layout, Rows, shown

_TYPES: Final = {"char": "i1", "uchar": "u1", "short": "i2", "ushort": "u2", "int": "i4", "uint": "u4", "float": "f4",
                 "double": "f8", "int8": "i1", "uint8": "u1", "int16": "i2", "uint16": "u2", "int32": "i4",
                 "uint32": "u4", "float32": "f4", "float64": "f8"}
_ORDERS: Final = {"ascii": "", "binary_little_endian": "<", "binary_big_endian": ">"}


@dataclass
class _Element:
    name: str
    count: int
    properties: list[tuple[str, str, str]]


def read_ply(lines: Lines) -> Table:
    order, elements = _ply_head(lines)
    notes = [f"the {element.count:,} faces of the mesh are not drawn: only its vertices are" for element in elements
             if element.name == "face" and element.count]
    for element in elements:
        if any(length for _, _, length in element.properties):
            columns = _by_value(lines, element, order)
        else:
            kinds = {name: order + kind for name, kind, _ in element.properties}
            columns = (binary_columns if order else text_columns)(lines, kinds, element.count, notes)
        if element.name == "vertex":
            return Table(columns, notes=notes)
    raise lines.refuse('there is no element "vertex"')


def _ply_head(lines: Lines) -> tuple[str, list[_Element]]:
    order = None
    elements: list[_Element] = []
    lines.line()
    while (line := lines.line()) is not None:
        words = line.split()
        if not words or words[0] in ("comment", "obj_info"):
            continue
        if words[0] == "end_header":
            if order is None:
                raise lines.refuse("there is no line \"format\" in the header")
            return order, elements
        if words[0] == "format" and len(words) == 3 and words[1] in _ORDERS:
            order = _ORDERS[words[1]]
        elif words[0] == "element" and len(words) == 3 and words[2].isdecimal():
            elements.append(_Element(words[1], int(words[2]), []))
        elif words[0] == "property" and len(words) == 3 and words[1] in _TYPES and elements:
            elements[-1].properties.append((words[2], _TYPES[words[1]], ""))
        elif words[:2] == ["property", "list"] and len(words) == 5 and {words[2], words[3]} <= _TYPES.keys() \
                and elements and _TYPES[words[2]][0] != "f":
            elements[-1].properties.append((words[4], _TYPES[words[3]], _TYPES[words[2]]))
        else:
            raise lines.refuse(f"{shown(line)}: is no line of a PLY file's header")
    raise lines.refuse("the file ends within its header: it was cut short")


def text_columns(lines: Lines, kinds: Mapping[str, str], count: int, notes: list[str]) -> dict[str, Array]:
    """The header's types determine the scale of colors."""
    rows = Rows(lines, Layout(list(kinds), list(kinds)))
    rows.read(count)
    notes += rows.notes
    columns = rows.columns()
    for name, values in columns.items():
        kind = np.dtype(kinds[name])
        if kind.kind in "iu" and len(values) and not np.iinfo(kind).min <= values.min() <= values.max() <= np.iinfo(kind).max:
            raise lines.refuse(f"{name} goes from {values.min():g} to {values.max():g}: must fit its type, {kind}")
        with np.errstate(over="ignore"):
            columns[name] = values.astype(kind)
    return columns


def binary_columns(lines: Lines, kinds: Mapping[str, str], count: int, _: list[str]) -> dict[str, Array]:
    kind = np.dtype(list(kinds.items()))
    if not kind.itemsize:
        return {}
    found = lines.mapped(kind, count)
    if len(found) < count:
        raise lines.refuse(f"the file ends after {len(found):,} of {count:,} records of {kind.itemsize} bytes: it was cut short")
    return {name: found[name] for name in kinds}


def _by_value(lines: Lines, element: _Element, order: str) -> dict[str, Array]:
    """Reads single values, because lists give records different lengths. An empty order means text."""
    words: list[str] = []

    def take(kind: str, count: int) -> Array:
        size = np.dtype(kind).itemsize * count
        data = lines.take(size) if order else b""
        if len(data) < size if order else len(words) < count:
            raise lines.refuse(f"{f'byte {lines.byte:,}: ' if order else ''}the file ends within element {element.name}, or a "
                               "list has fewer values than it states")
        taken = np.frombuffer(data, order + kind) if order else np.array(words[:count]).astype(kind)
        del words[:count]
        return taken

    values: dict[str, list[Any]] = {name: [] for name, _, length in element.properties if not length}
    for _ in range(element.count):
        line = "" if order else lines.line() or ""
        words = line.split()
        try:
            for name, kind, length in element.properties:
                found = take(kind, int(take(length, 1)[0]) if length else 1)
                if not length:
                    values[name].append(found[0])
        except DataError:
            raise
        except (ValueError, OverflowError) as error:
            raise lines.refuse(f"{shown(line)}: {error}") from None
        if words:
            raise lines.refuse(f"{shown(line)}: has {len(words)} more values than the header states")
    return {name: np.array(values[name], kind) for name, kind, length in element.properties if not length}
