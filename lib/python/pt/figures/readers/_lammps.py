"""LAMMPS dumps of atoms (docs.lammps.org/dump.html)."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from pt.figures._cell import Cell
from pt.figures._columns import coordinate_names
from pt.figures._particles import Table
from pt.figures.readers._frames import TextFrames
from pt.figures.readers._lines import Lines
from pt.figures.readers._rows import Layout, Rows, are_numbers, number, shown

HEAD_ENDS = "the file ends within the header of a frame: it was cut short"


class LammpsDump(TextFrames):
    def __init__(self, lines: Lines) -> None:
        super().__init__(lines)
        self._names: list[str] = []
        self._cell: Cell | None = None

    def head(self) -> int | None:
        lines = self.lines
        count = None
        self._cell = None
        is_first = True
        while (line := lines.line()) is not None:
            if is_first and not line.strip():
                continue
            is_first = False
            if not line.startswith("ITEM: "):
                raise lines.refuse(f"{shown(line)}: must begin with ITEM:, like every frame: are there more lines "
                                   "than particles, or is one a comment?")
            item = line.removeprefix("ITEM: ").strip()
            if item == "NUMBER OF ATOMS":
                text = self._line().strip()
                if not text.isdecimal():
                    raise lines.refuse(f"{shown(text)}: must be the number of atoms")
                count = int(text)
            elif item.startswith("BOX BOUNDS"):
                self._cell = self._box(item.split()[2:])
            elif item in ("TIMESTEP", "UNITS", "TIME"):
                self._line()
            elif item.startswith("ATOMS"):
                self._names = item.split()[1:]
                if count is None:
                    raise lines.refuse("ITEM: ATOMS comes before ITEM: NUMBER OF ATOMS")
                if len(set(self._names)) < max(1, len(self._names)):
                    raise lines.refuse(f"{shown(line)}: must have the names of columns, each once")
                return count
            else:
                raise lines.refuse(f"{shown(line)}: is not part of a dump of atoms with positions")
        if is_first:
            return None
        raise lines.refuse(HEAD_ENDS)

    def body(self, count: int) -> Table:
        rows = Rows(self.lines, Layout(self._names, coordinate_names(self._names)[0]))
        rows.read(count)
        return Table(rows.columns(), self._cell, rows.notes, is_text=True)

    def _line(self) -> str:
        line = self.lines.line()
        if line is None:
            raise self.lines.refuse(HEAD_ENDS)
        return line

    def _numbers(self, count: int) -> list[float]:
        line = self._line()
        words = line.split()
        if len(words) != count or not are_numbers(words):
            raise self.lines.refuse(f"{shown(line)}: the cell has {count} numbers in a line")
        return [number(word) for word in words]

    def _box(self, words: list[str]) -> Cell | None:
        """Reads "pp pp ff". "xy xz yz" precedes it for tilted cells, and "abc origin" for general ones."""
        tilted, general = words[:3] == ["xy", "xz", "yz"], words[:2] == ["abc", "origin"]
        flags = words[3 if tilted else 2 if general else 0:]
        if len(flags) not in (0, 3):
            raise self.lines.refuse(f"BOX BOUNDS {' '.join(words)}: must have three boundaries, like pp pp ff")
        periodic = [flag == "pp" for flag in flags] or [True] * 3
        rows: npt.NDArray[Any] = np.array([self._numbers(4 if general else 3 if tilted else 2) for _ in range(3)])
        if general:
            return Cell.of(rows[:, :3], rows[:, 3], periodic)
        return cell_within(rows[:, :2], rows[:, 2] if tilted else np.zeros(3), periodic)


def cell_within(bounds: npt.ArrayLike, tilts: npt.ArrayLike, periodic: list[bool]) -> Cell | None:
    """See docs.lammps.org/Howto_triclinic.html."""
    low, high = np.array(bounds, np.float64).T
    xy, xz, yz = np.array(tilts, np.float64)
    low -= min(0, xy, xz, xy + xz), min(0, yz), 0
    high -= max(0, xy, xz, xy + xz), max(0, yz), 0
    x, y, z = high - low
    return Cell.of([[x, 0, 0], [xy, y, 0], [xz, yz, z]], low, periodic)
