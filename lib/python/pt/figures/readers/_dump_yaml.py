"""LAMMPS' dumps of the style yaml, of which only what LAMMPS writes is read."""

from __future__ import annotations

import re

import numpy as np

from pt.figures._cell import Cell
from pt.figures._particles import Table, coordinate_names
from pt.figures.readers._frames import TextFrames
from pt.figures.readers._lines import Lines
from pt.figures.readers._rows import Layout, Rows, are_numbers, number, shown


class DumpYaml(TextFrames):
    def __init__(self, lines: Lines) -> None:
        super().__init__(lines)
        self._names: list[str] = []
        self._cell: Cell | None = None

    def head(self) -> int | None:
        lines, count, names, periodic = self.lines, None, [], [True] * 3
        bounds: list[list[float]] = []
        key = ""
        while (line := lines.line()) is not None:
            words = re.split(r"[\s,\[\]]+", line.partition(":")[2].strip(" []"))
            if not line.startswith((" ", "-")):
                key = line.partition(":")[0]
            if key == "natoms" and words[0].isdecimal():
                count = int(words[0])
            elif key == "boundary":
                if len(words) < 6:
                    raise lines.refuse(f"{shown(line)}: must have six boundaries, like p, p, p, p, p, p")
                periodic = [word.startswith("p") for word in words[:6:2]]
            elif key == "keywords":
                names = [word for word in words if word]
            elif key == "box" and line.lstrip().startswith("-"):
                bounds.append(self._bounds(line))
            elif key == "data":
                if count is None or not names:
                    raise lines.refuse("data: natoms and keywords must come before")
                self._names = names
                self._cell = None
                if bounds:
                    if [len(row) for row in bounds] not in ([2, 2, 2], [2, 2, 2, 3]):
                        raise lines.refuse("box: must be three pairs of bounds and, if it is tilted, three tilts")
                    low, high = np.array(bounds[:3]).T
                    (x, y, z), (xy, xz, yz) = high - low, bounds[3] if len(bounds) > 3 else (0, 0, 0)
                    self._cell = Cell.of([[x, 0, 0], [xy, y, 0], [xz, yz, z]], low, periodic)
                return count
        if count is not None:
            raise lines.refuse("the file ends within the head of a frame: it was cut short")
        return None

    def _bounds(self, line: str) -> list[float]:
        words = [word for word in re.split(r"[\s,\[\]]+", line.lstrip(" -")) if word]
        if len(words) not in (2, 3) or not are_numbers(words):
            raise self.lines.refuse(f"{shown(line)}: must be bounds of the box, like - [ 0, 1 ]")
        return [number(word) for word in words]

    def body(self, count: int) -> Table:
        rows = Rows(self.lines, Layout(self._names, coordinate_names(self._names)[0]))
        while rows.count < count:
            first = self.lines.number + 1
            data, height = self.lines.block(count - rows.count)
            if not height:
                raise self.lines.refuse(f"the file ends after {rows.count:,} of {count:,} particles: it was cut short")
            rows.add(re.sub(rb"- \[|[\],]", b" ", data), height, first)
        return Table(rows.columns(), self._cell, rows.notes, is_text=True)
