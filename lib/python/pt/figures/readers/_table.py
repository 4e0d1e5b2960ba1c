from __future__ import annotations

import csv
import re
from collections.abc import Mapping
from typing import Any, Final

import numpy.typing as npt

from pt.figures._columns import coordinate_names
from pt.figures._particles import Table
from pt.figures.readers._lines import Lines
from pt.figures.readers._rows import Layout, Rows, fields_of, is_comment, is_number, shown

_SEPARATORS: Final = ("\t", ";", ",")
_MOST_BYTE: Final = 255


def read_table(lines: Lines, mapping: Mapping[str, str]) -> Table:
    comment = ""
    start = lines.place()
    while (line := lines.line()) is not None and (not line.strip() or is_comment(line)):
        comment = line.lstrip("#/ \t") or comment
        start = lines.place()
    if line is None:
        raise lines.refuse("the file has no rows")
    if line.strip().isdecimal() and lines.peek(1):
        start = lines.place()
        line = lines.line() or ""
    layout, has_names = _layout(line, comment, lines)
    if not has_names:
        lines.go_to(start)
    mapped = dict.fromkeys(mapping[axis] for axis in "xyz" if axis in mapping)
    layout.positions = [name for name in mapped or coordinate_names(layout.names)[0] if name in layout.names]
    rows = Rows(lines, layout)
    rows.read()
    columns = rows.columns()
    if not has_names and "4" in columns:
        columns = _with_colors(columns, rows.notes)
    return Table(columns, notes=rows.notes, is_text=True)


def _layout(line: str, comment: str, lines: Lines) -> tuple[Layout, bool]:
    """The first line that is not a comment determines the layout. Also returns whether this line has names."""
    separator = next((each for each in _SEPARATORS if each in line), "")
    has_comma = separator != "," and re.search(r"\d,\d", line + lines.peek(1000).decode("utf-8", "replace")) is not None
    decimal = "," if has_comma else "."
    if separator == "," and re.fullmatch(r"\s*([-+]?\d+,\d+\s+)+[-+]?\d+,\d+\s*", line):
        separator, decimal = "", ","  # commas are decimal marks, and blanks separate columns
    try:
        first = fields_of(line, separator)
    except csv.Error:
        raise lines.refuse(f"{shown(line)}: a quoted field must end in the line in which it begins") from None
    numbers = sum(is_number(word, decimal) and word != "" for word in first)
    has_names = numbers < min(2, len(first))
    names = first
    if not has_names:
        named = fields_of(comment, "," if "," in comment else "")
        names = named if len(named) == len(first) and not any(map(is_number, named)) else _default_names(first, decimal)
    names = [name or f"column {i}" for i, name in enumerate(names, 1)]
    if len(set(names)) < len(names):
        double = next(name for name in names if names.count(name) > 1)
        raise lines.refuse(f"there are two columns {double!r}")
    return Layout(names, separator=separator, decimal=decimal, is_table=True), has_names


def _default_names(first: list[str], decimal: str) -> list[str]:
    is_labelled = len(first) > 3 and not is_number(first[0], decimal)
    names = (["species"] if is_labelled else []) + ["x", "y", "z"]
    return (names + [str(i) for i in range(len(names) + 1, len(first) + 1)])[:len(first)]


def _with_colors(columns: dict[str, npt.NDArray[Any]], notes: list[str]) -> dict[str, npt.NDArray[Any]]:
    """Scanners write colors as the last three columns, integers from 0 to 255."""
    names = list(columns)[-3:]
    last = [columns[name] for name in names]
    if len(columns) < 6 or any(column.dtype.kind != "i" for column in last):
        return columns
    if min(column.min() for column in last) < 0 or not 1 < max(column.max() for column in last) <= _MOST_BYTE:
        return columns
    notes.append(f"columns {', '.join(names)} are taken for colors: whole numbers from 0 to 255")
    return dict(zip([*list(columns)[:-3], "red", "green", "blue"], columns.values()))
