"""PSF of CHARMM, NAMD and X-PLOR: the atoms of a trajectory, without positions."""

from __future__ import annotations

import re
from typing import Any, Final

import numpy as np

from pt.figures._elements import elements_of_masses
from pt.figures._particles import Bonds, Table
from pt.figures._residues import VIRTUAL
from pt.figures.readers._atoms import atoms_table
from pt.figures.readers._lines import Lines

_LEAST: Final = 8
_MASSLESS: Final = 0.5  # daltons: lighter sites are Drude particles or lone pairs


def read_psf(lines: Lines) -> Table:
    rows: list[list[str]] = []
    pairs = np.zeros((0, 2), np.int64)
    while (line := lines.line()) is not None:
        if found := re.match(r"\s*(\d+)\s+!(NATOM|NBOND)", line):
            count = int(found[1])
            if found[2] == "NATOM":
                rows = [(lines.line() or "").split() for _ in range(count)]
                if any(len(row) < _LEAST for row in rows):
                    raise lines.refuse(f"!NATOM: each of the {count:,} atoms must have {_LEAST} fields or more")
            else:
                pairs = _pairs(lines, count)
                break
    if not rows:
        raise lines.refuse("has no atoms: no line with !NATOM")
    words: dict[str, Any] = {key: np.array([row[place] for row in rows]) for key, place in
                             (("chain", 1), ("resid", 2), ("resname", 3), ("name", 4))}
    charges, masses = (np.array([row[place] for row in rows]).astype(np.float64) for place in (6, 7))
    elements = np.where(masses < _MASSLESS, VIRTUAL, elements_of_masses(masses)).astype(np.uint8)
    positions = np.zeros((len(rows), 3))
    return atoms_table(positions, {**words, "charge": charges, "mass": masses}, elements, bonds=Bonds.of(pairs - 1))


def _pairs(lines: Lines, count: int) -> Any:
    words: list[str] = []
    while len(words) < 2 * count and (line := lines.line()) is not None:
        words += line.split()
    if len(words) < 2 * count or not all(word.isdecimal() for word in words):
        raise lines.refuse(f"!NBOND: must have {count:,} pairs of atoms' numbers")
    return np.array(words[:2 * count], np.int64).reshape(-1, 2)
