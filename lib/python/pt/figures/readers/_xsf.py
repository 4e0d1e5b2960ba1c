from __future__ import annotations

from typing import Any, Final

import numpy as np
import numpy.typing as npt

from pt.figures._cell import Cell
from pt.figures._elements import elements_of
from pt.figures._errors import DataError
from pt.figures._particles import Table
from pt.figures.readers._atoms import atoms_table
from pt.figures.readers._frames import Listed
from pt.figures.readers._lines import Lines
from pt.figures.readers._rows import are_numbers, number, shown

_PERIODIC: Final = {"CRYSTAL": (True, True, True), "SLAB": (True, True, False), "POLYMER": (True, False, False)}


def read_xsf(lines: Lines) -> Listed:
    kind = "MOLECULE"
    vectors: npt.NDArray[Any] | None = None
    steps: list[tuple[npt.NDArray[Any] | None, list[list[str]]]] = []
    line = lines.line()
    while line is not None:
        word = line.split()[0].upper() if line.split() else ""
        if word in ("MOLECULE", *_PERIODIC):
            kind = word
        elif word == "PRIMVEC":
            vectors = np.array([_numbers(lines, 3) for _ in range(3)])
        elif word == "PRIMCOORD":
            count = (lines.line() or "").split()
            if not count or not count[0].isdecimal():
                raise lines.refuse(f"{shown(' '.join(count))}: must be the number of atoms")
            steps.append((vectors, [_row(lines, lines.line() or "") for _ in range(int(count[0]))]))
        elif word == "ATOMS":
            rows = []
            while (line := lines.line()) is not None and len(line.split()) >= 4:
                rows.append(_row(lines, line))
            steps.append((vectors, rows))
            continue
        elif word.startswith("BEGIN_BLOCK"):
            break
        line = lines.line()
    steps = [step for step in steps if step[1]]
    if not steps:
        raise DataError(f"{lines.name}: has no atoms: neither PRIMCOORD nor ATOMS")
    return Listed(lines.name, len(steps), lambda index: _table(kind, *steps[index]))


def _table(kind: str, vectors: npt.NDArray[Any] | None, rows: list[list[str]]) -> Table:
    elements, notes = elements_of(np.array([row[0] for row in rows], str))
    cell = None if vectors is None else Cell.of(vectors, periodic=_PERIODIC.get(kind, False))
    return atoms_table(np.array([[number(word) for word in row[1:4]] for row in rows]), {}, elements, cell, notes=notes)


def _row(lines: Lines, line: str) -> list[str]:
    words = line.split()
    if len(words) < 4 or not are_numbers(words[1:4]):
        raise lines.refuse(f"{shown(line)}: must be an element and three coordinates")
    return words


def _numbers(lines: Lines, count: int) -> list[float]:
    line = lines.line() or ""
    if len(line.split()) < count or not are_numbers(line.split()[:count]):
        raise lines.refuse(f"{shown(line)}: must have {count} numbers")
    return [number(word) for word in line.split()[:count]]
