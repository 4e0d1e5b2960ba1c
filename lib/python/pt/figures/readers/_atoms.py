from __future__ import annotations

from typing import Final

import numpy as np

from pt._fit import Array
from pt.figures._cell import Cell
from pt.figures._elements import SYMBOLS
from pt.figures._particles import Bonds, Table
from pt.figures._residues import VIRTUAL, are_beads, elements_by_residue

NO_ELEMENT: Final = 0


def atoms_table(positions: Array, columns: dict[str, Array], elements: Array | None = None, cell: Cell | None = None,
                bonds: Bonds | None = None, notes: list[str] | None = None, kept: Array | None = None) -> Table:
    """Returns a table without virtual sites.

    columns   with names of atoms ("name") and residues ("resname"), if the file has them
    elements  atomic numbers, VIRTUAL for sites that are not atoms, 0 where names decide; None: names decide all
    kept      masks atoms to draw; None: all
    """
    notes = notes or []
    count = len(positions)
    shown: Array = np.ones(count, bool) if kept is None else kept
    elements = np.zeros(count, np.uint8) if elements is None else elements
    silent = elements == NO_ELEMENT
    if silent.any() and "name" in columns:
        names, residues = columns["name"], columns.get("resname", np.full(count, "", "U1"))
        if silent.all() and are_beads(names, residues):
            notes.append("names of atoms are those of beads (MARTINI), which have no elements")
            columns = {**columns, "type": names}
            silent[:] = False
        guess = elements_by_residue(names, residues, silent)
        elements = np.where(silent, guess.elements, elements)
        notes += guess.notes
    virtual = shown & (elements == VIRTUAL)
    if virtual.any() and not virtual.all():
        notes.append(f"{int(virtual.sum()):,} virtual sites of {count:,} sites are no atoms, and are not drawn")
        shown = shown & ~virtual
    rows = None
    if not shown.all():
        rows = np.flatnonzero(shown)
        positions, elements = positions[rows], elements[rows]
        columns = {key: values[rows] for key, values in columns.items()}
        bonds = None if bonds is None else bonds.among(rows, count)
    elements = np.where(elements == VIRTUAL, NO_ELEMENT, elements).astype(np.uint8)
    if elements.any():
        columns = {"element": np.array(SYMBOLS)[elements], **columns}
    has_elements = bool(elements.any())
    return Table({"positions": positions, **columns}, cell, notes, elements=elements if has_elements else None,
                 types=None if has_elements else columns.get("type"), bonds=bonds, rows=rows, sites=count)
