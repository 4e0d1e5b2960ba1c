from __future__ import annotations

import re
from typing import Any, Final

import numpy as np

from pt.figures._cell import Cell
from pt.figures._columns import coordinate_names
from pt.figures._particles import Table
from pt.figures.readers._frames import TextFrames
from pt.figures.readers._lines import Lines
from pt.figures.readers._rows import Layout, Rows, are_numbers, is_number, number, shown

_PAIR: Final = re.compile(r"""([^\s="]+)\s*=\s*(?:"([^"]*)"|'([^']*)'|\{([^}]*)\}|(\[[^"'=]*\])(?=\s|$)|(\S*))""")
_MOST_COLUMNS: Final = 65536
_LEAST: Final = 4


class Xyz(TextFrames):
    def __init__(self, lines: Lines) -> None:
        super().__init__(lines)
        self._pairs: dict[str, str] = {}

    def head(self) -> int | None:
        lines = self.lines
        while (line := lines.line()) is not None and not line.strip():
            pass
        if line is None:
            return None
        if not line.strip().isdecimal():
            if len(self._places) > 1 and not _is_row(line):
                self.notes.append(f"the text after the last particle is not read, from line {lines.number} on")
                return None
            raise lines.refuse(f"{shown(line)}: must be the number of particles of a frame")
        comment = lines.line()
        if comment is None:
            raise lines.refuse("the file ends after the number of particles: it was cut short")
        self._pairs = {found[0].lower(): "".join(found[1:]) for found in _PAIR.findall(comment)}
        return int(line)

    def body(self, count: int) -> Table:
        cell = self._cell()
        names, least = self._names()
        positions = coordinate_names(names)[0]
        rows = Rows(self.lines, Layout(names, positions, least=least))
        rows.read(count)
        return Table(rows.columns(), cell, rows.notes, is_text=True)

    def _names(self) -> tuple[list[str], int | None]:
        """Also returns the least number of fields, if rows may have more."""
        properties = self._pairs.get("properties")
        if properties is None:
            first = self.lines.peek(1 << 16).split(b"\n", 1)[0].decode("utf-8", "replace").split()
            if len(first) == 3 and all(map(is_number, first)):
                return ["x", "y", "z"], None
            return ["species", "x", "y", "z", *map(str, range(5, len(first) + 1))], _LEAST
        parts = properties.split(":")
        names: list[str] = []
        for name, kind, count in zip(parts[::3], parts[1::3], parts[2::3]):
            if not (name and kind in ("S", "R", "I", "L") and count.isdecimal() and 0 < int(count) < _MOST_COLUMNS):
                break
            names += [name] if count == "1" else [f"{name}[{i}]" for i in range(int(count))]
        else:
            if len(parts) % 3 == 0 and len(names) < _MOST_COLUMNS:
                return names, None
        raise self.lines.refuse(f"Properties = {shown(properties)}: must be name:type:count for each column, where the "
                                "type is S, R, I or L")

    def _numbers(self, key: str, count: int) -> Any:
        words = re.findall(r"[^\s,\[\]]+", self._pairs[key])
        if len(words) != count or not are_numbers(words):
            raise self.lines.refuse(f"{key} = {shown(self._pairs[key])}: must have {count} numbers")
        return np.array([number(word) for word in words])

    def _cell(self) -> Cell | None:
        if "lattice" not in self._pairs:
            return None
        flags = re.findall(r"[^\s,\[\]]+", self._pairs.get("pbc", "T T T"))
        if len(flags) != 3:
            raise self.lines.refuse(f"pbc = {shown(self._pairs['pbc'])}: must have three flags, like T T F")
        origin = self._numbers("origin", 3) if "origin" in self._pairs else np.zeros(3)
        periodic = [flag.lower() in ("t", "true", "1") for flag in flags]
        return Cell.of(self._numbers("lattice", 9), origin, periodic)


def _is_row(line: str) -> bool:
    words = line.split()
    is_labelled = words[0].isdecimal() or not is_number(words[0])
    return len(words) >= _LEAST and is_labelled and all(map(is_number, words[1:_LEAST]))
