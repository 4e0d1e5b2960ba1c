from __future__ import annotations

import re
from typing import Any

import numpy as np

from pt.figures._cell import Cell
from pt.figures._elements import elements_of
from pt.figures._particles import Table
from pt.figures.readers._atoms import atoms_table
from pt.figures.readers._lines import Lines
from pt.figures.readers._rows import Layout, Rows, are_numbers, is_number, number, shown


def read_poscar(lines: Lines) -> Table:
    comment = _line(lines)
    scales = _numbers(lines, (1, 3))
    vectors = np.array([_numbers(lines, (3,)) for _ in range(3)])
    if len(scales) == 1 and scales[0] < 0:
        scales = [float((-scales[0] / abs(np.linalg.det(vectors))) ** (1 / 3))]
    scale = np.array(scales if len(scales) == 3 else scales * 3)
    line = _line(lines)
    symbols = comment.split()
    if not line.strip()[:1].isdecimal():
        symbols, line = line.split(), _line(lines)
    counts = [int(word) for word in line.split("!")[0].split() if word.isdecimal()]
    if not counts or len(counts) > len(symbols):
        raise lines.refuse(f"{shown(line)}: must have the number of atoms of each of the elements, {' '.join(symbols)}")
    kind = _line(lines)
    if kind.lstrip()[:1] in ("S", "s"):
        kind = _line(lines)
    rows = Rows(lines, Layout(["x", "y", "z"], ["x", "y", "z"], least=3))
    rows.read(sum(counts))
    found = rows.columns()
    shares = np.stack([found[axis] for axis in "xyz"], 1)
    vectors = vectors * scale
    positions = shares * scale if kind.lstrip()[:1] in ("C", "c", "K", "k") else shares @ vectors
    words = np.repeat([re.split(r"[_/.]", symbol)[0] for symbol in symbols[:len(counts)]], counts)
    elements, notes = elements_of(words)
    return atoms_table(positions, {"species": words}, elements, Cell.of(vectors), notes=notes)


def _line(lines: Lines) -> str:
    line = lines.line()
    if line is None:
        raise lines.refuse("the file ends before the positions: it was cut short")
    return line


def _numbers(lines: Lines, counts: tuple[int, ...]) -> list[Any]:
    line = _line(lines)
    words = line.split("!")[0].split()
    while words and not is_number(words[-1]):
        words.pop()
    if len(words) not in counts or not are_numbers(words):
        raise lines.refuse(f"{shown(line)}: must have {' or '.join(map(str, counts))} numbers")
    return [number(word) for word in words]
