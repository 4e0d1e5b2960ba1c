"""Points in PLY (Stanford) and PCD (Point Cloud Library) files: a head, then records, binary or as text."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
import numpy.typing as npt

from pt.figures._particles import Particles, assembled
from pt.figures.readers._lines import Lines
from pt.figures.readers._rows import Layout, Rows, shown

Array = npt.NDArray[Any]

_TYPES: Final = {"char": "i1", "uchar": "u1", "short": "i2", "ushort": "u2", "int": "i4", "uint": "u4", "float": "f4",
                 "double": "f8", "int8": "i1", "uint8": "u1", "int16": "i2", "uint16": "u2", "int32": "i4",
                 "uint32": "u4", "float32": "f4", "float64": "f8"}
_ORDERS: Final = {"ascii": "", "binary_little_endian": "<", "binary_big_endian": ">"}


@dataclass
class _Element:
    name: str
    count: int
    properties: list[tuple[str, str, str]]  # name, type, and of lists the type of their length

    def has_lists(self) -> bool:
        return any(length for _, _, length in self.properties)


def read_ply(lines: Lines, mapping: Mapping[str, str], drop_nonfinite: bool) -> Particles:
    order, elements = _ply_head(lines)
    notes = [f"the {element.count:,} faces of the mesh are not drawn: only its vertices are" for element in elements
             if element.name == "face" and element.count]
    for element in elements:
        if element.name == "vertex":
            columns = _text(lines, element, notes) if not order else _binary(lines, element, order)
            return assembled(lines.name, columns, mapping=mapping, drop_nonfinite=drop_nonfinite, notes=notes)
        if not order:
            _require(lines, lines.skip(element.count), element)
        else:
            _binary(lines, element, order)
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
                raise lines.refuse("there is no line \"format\" in the head")
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
            raise lines.refuse(f"{shown(line)}: is no line of a PLY file's head")
    raise lines.refuse("the file ends within its head: it was cut short")


def _require(lines: Lines, found: int, element: _Element) -> None:
    if found < element.count:
        raise lines.refuse(f"the file ends after {found:,} of {element.count:,} of element {element.name}: it was cut "
                           "short")


def _text(lines: Lines, element: _Element, notes: list[str]) -> dict[str, Array]:
    """Numbers have the types of the head, which say the scale of colors."""
    kinds = {name: kind for name, kind, length in element.properties if not length}
    rows = Rows(lines, Layout(list(kinds), list(kinds)))
    if element.has_lists():
        for index in range(element.count):
            line = lines.line()
            if line is None:
                _require(lines, index, element)
            rows.add(_without_lists(lines, line or "", element).encode(), 1, lines.number)
    else:
        rows.read(element.count)
    notes += rows.notes
    columns = rows.columns()
    for name, values in columns.items():
        kind = np.dtype(kinds[name])
        if kind.kind in "iu" and len(values) and not (np.iinfo(kind).min <= values.min() <= values.max()
                                                      <= np.iinfo(kind).max):
            raise lines.refuse(f"{name} goes from {values.min():g} to {values.max():g}: its type is {kind}")
        columns[name] = values.astype(kind)
    return columns


def _without_lists(lines: Lines, line: str, element: _Element) -> str:
    words = line.split()
    kept = []
    for name, _, length in element.properties:
        if not words:
            raise lines.refuse(f"{shown(line)}: has no {name}")
        word = words.pop(0)
        if not length:
            kept.append(word)
        elif word.isdecimal() and int(word) <= len(words):
            del words[:int(word)]
        else:
            raise lines.refuse(f"{shown(line)}: the list {name} has fewer values than it says")
    if words:
        raise lines.refuse(f"{shown(line)}: has {len(words)} more values than the head says")
    return " ".join(kept)


def _binary(lines: Lines, element: _Element, order: str) -> dict[str, Array]:
    if element.has_lists():
        return _binary_with_lists(lines, element, order)
    kind = np.dtype([(name, order + kind) for name, kind, _ in element.properties])
    return records(lines, kind, element.count)


def records(lines: Lines, kind: npt.DTypeLike, count: int) -> dict[str, Array]:
    """Columns of binary records, in place."""
    kind = np.dtype(kind)
    if not kind.itemsize:
        return {}
    found = lines.mapped(kind, count)
    if len(found) < count:
        raise lines.refuse(f"the file ends after {len(found):,} of {count:,} records of {kind.itemsize} bytes: it was cut "
                           "short")
    return {name: found[name] for name in kind.names or ()}


def _binary_with_lists(lines: Lines, element: _Element, order: str) -> dict[str, Array]:
    """Value by value, as each record has a length of its own."""
    def take(kind: str, count: int) -> Array:
        kind = order + kind
        data = lines.take(np.dtype(kind).itemsize * count)
        if len(data) < np.dtype(kind).itemsize * count:
            raise lines.refuse(f"byte {lines.byte:,}: the file ends within element {element.name}: it was cut short")
        return np.frombuffer(data, kind)

    values: dict[str, list[Any]] = {name: [] for name, _, length in element.properties if not length}
    for _ in range(element.count):
        for name, kind, length in element.properties:
            if length:
                count = int(take(length, 1)[0])
                if count < 0:
                    raise lines.refuse(f"byte {lines.byte:,}: {name}: a list of {count} values")
                take(kind, count)
            else:
                values[name].append(take(kind, 1)[0])
    return {name: np.array(values[name], kind) for name, kind, length in element.properties if not length}
