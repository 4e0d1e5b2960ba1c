"""CIF by gemmi: crystals, and macromolecules in mmCIF."""

from __future__ import annotations

from typing import Any, Final

import numpy as np

from pt.figures._cell import Cell
from pt.figures._elements import listed
from pt.figures._errors import DataError, module
from pt.figures._neighbours import pairs_within
from pt.figures._particles import Table
from pt.figures.readers._atoms import atoms_table
from pt.figures.readers._frames import Listed
from pt.figures.readers._lines import Lines
from pt.figures.readers._other import tried
from pt.figures.readers._structures import divide_chains, frames_of

SHARED: Final = 0.4  # angstroms; closer sites are alternatives for one place

WHOLE: Final = 0.99
ROUNDED: Final = 1e-4  # coordinates this little below 0, relative to the edge, are not wrapped


def read_cif(lines: Lines) -> Listed:
    gemmi = module("gemmi", f"{lines.name}: CIF")
    text = lines.text().decode("utf-8", "replace")
    document = tried(lines.name, "gemmi", lambda: gemmi.cif.read_string(text))
    for block in document:
        if block.find_loop("_atom_site.Cartn_x") or block.find_value("_atom_site.Cartn_x"):
            divide_chains(block)
            return frames_of(lines.name, tried(lines.name, "gemmi", lambda: gemmi.make_structure_from_block(block)))
    blocks = [block for block in document if block.find_values("_atom_site_fract_x")]
    if not blocks:
        raise DataError(f"{lines.name}: has no atoms: no data block has _atom_site.Cartn_x or _atom_site_fract_x")
    names = [block.name for block in blocks]

    for block in blocks:
        for tag in ("_symmetry_Int_Tables_number", "_space_group_IT_number"):
            if value := block.find_value(tag):
                block.set_pair(tag, gemmi.cif.as_string(value) or "?")

    def read(index: int) -> Table:
        structure = tried(lines.name, "gemmi", lambda: gemmi.make_small_structure_from_block(blocks[index]))
        table = _table(lines.name, structure)
        if len(blocks) > 1:
            table.notes.append(f"structure {index} of {len(blocks)} is shown, {names[index]}: frame chooses another of "
                               f"{listed(names)}")
        return table

    return Listed(lines.name, len(blocks), read, current=0)


def _table(name: str, structure: Any) -> Table:
    notes: list[str] = []
    _choose_sites(structure, notes)
    _set_symmetry(structure, notes)
    sites = structure.get_all_unit_cell_sites()
    if not len(sites):
        raise DataError(f"{name}: no site has a position")
    cell = Cell.of_lengths(structure.cell.parameters[:3], structure.cell.parameters[3:])
    if cell is None:
        raise DataError(f"{name}: the lengths and angles of the cell span no volume")
    shares = np.array([site.fract.tolist() for site in sites]).reshape(-1, 3)
    shares -= np.floor(shares + ROUNDED)
    occupancy = np.array([site.occ for site in sites])
    kept = _foremost(shares, occupancy, cell)
    if hidden := sorted({site.label for site in sites} - {sites[row].label for row in kept}):
        notes.append(f"sites that share a place with another one of no lower occupancy are not drawn: {listed(hidden)}")
    if partly := int((occupancy[kept] < WHOLE).sum()):
        notes.append(f"{partly:,} partly occupied sites are drawn like full ones")
    elements = np.array([sites[row].element.atomic_number for row in kept], np.uint8)
    columns = {"name": np.array([sites[row].label for row in kept], str), "occupancy": occupancy[kept]}
    return atoms_table(shares[kept] @ cell.vectors, columns, elements, cell, notes=notes)


def _set_symmetry(structure: Any, notes: list[str]) -> None:
    structure.determine_and_set_spacegroup("S.H2")
    if structure.spacegroup is None and not structure.symops:
        named = f" ({structure.spacegroup_hm})" if structure.spacegroup_hm else ""
        notes.append(f"the symmetry is not given or not known{named}: only the sites of the file are drawn")


def _choose_sites(structure: Any, notes: list[str]) -> None:
    sites = [site for site in structure.sites if np.isfinite(site.fract.tolist()).all()]
    if len(sites) < len(structure.sites):
        notes.append(f"{len(structure.sites) - len(sites):,} sites without a position are left out")
    groups: dict[int, list[float]] = {}
    for site in sites:
        if site.disorder_group > 0:
            groups.setdefault(site.disorder_group, []).append(site.occ)
    best = max(groups, key=lambda group: sum(groups[group]) / len(groups[group]), default=0)
    kept = [site for site in sites if site.disorder_group <= 0 or site.disorder_group == best]
    if len(kept) < len(sites):
        notes.append(f"{len(sites) - len(kept):,} sites of other disorder groups than {best} are not drawn")
    kept = [site.clone() for site in kept]
    del structure.sites[:]
    for site in kept:
        structure.add_site(site)


def _foremost(shares: Any, occupancy: Any, cell: Cell) -> Any:
    first, second = pairs_within(shares @ cell.vectors, SHARED, cell)[:2]
    order = np.argsort(-occupancy, kind="stable")
    rank = np.empty(len(order), np.intp)
    rank[order] = np.arange(len(order))
    lost = np.zeros(len(order), bool)
    for better, worse in sorted(np.sort(rank[np.stack([first, second], 1)], axis=1).tolist()):
        if not lost[better]:
            lost[worse] = True
    return np.flatnonzero(~lost[rank])
