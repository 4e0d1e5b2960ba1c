"""Objects of other packages. Names of types identify these objects, so no package is imported."""

from __future__ import annotations

from typing import Any, Final

import numpy as np

from pt.figures._cell import Cell
from pt.figures._elements import NUMBERS, distinct
from pt.figures._particles import Bonds, Table
from pt.figures.readers._atoms import atoms_table
from pt.figures.readers._frames import Frames, Listed

_ATTRIBUTES: Final = {"element": "elements", "name": "names", "type": "types", "radius": "radii", "mass": "masses",
                      "charge": "charges", "resid": "resids", "resname": "resnames", "chain": "segids"}


def of_ase(atoms: Any) -> Table:
    columns = {"positions": atoms.positions, **{key: values for key, values in atoms.arrays.items() if key != "positions"}}
    return Table(columns, Cell.of(atoms.cell.array, periodic=atoms.pbc))


def of_mdanalysis(group: Any, name: str) -> Frames:
    atoms = group.atoms
    trajectory = group.universe.trajectory

    def read(index: int) -> Table:
        step = trajectory[index]
        columns = {key: np.asarray(values) for key, attribute in _ATTRIBUTES.items()
                   if (values := getattr(atoms, attribute, None)) is not None}
        columns = {key: values.astype(str) if values.dtype == object else values for key, values in columns.items()}
        symbols = columns.pop("element", np.full(len(atoms.positions), "", "U1"))
        values, codes = np.unique(symbols, return_inverse=True)
        elements = np.array([NUMBERS.get(value.capitalize(), 0) for value in values.tolist()], np.uint8)[codes.reshape(-1)]
        cell = None if step.dimensions is None else Cell.of(step.triclinic_dimensions)
        return atoms_table(atoms.positions, columns, elements, cell, _bonds_of(group))

    return Listed(name, len(trajectory), read, trajectory.frame)


def _bonds_of(group: Any) -> Bonds | None:
    everything = getattr(group.universe, "bonds", None)
    if everything is None:
        return None
    return Bonds.of(everything.to_indices()).among(group.atoms.indices, len(group.universe.atoms))


def of_ovito(data: Any) -> Table:
    particles = data.particles
    columns = {"positions" if key == "Position" else key: np.asarray(particles[key]) for key in particles.keys()}
    kinds = particles.get("Particle Type")
    if kinds is not None:
        columns["type"] = columns.pop("Particle Type")
        named = {each.id: each.name for each in kinds.types if each.name}
        if named:
            values, codes = distinct(columns["type"])
            columns["type"] = np.array([named.get(value, f"type {value}") for value in values.tolist()])[codes]
    cell = None
    if data.cell is not None:
        matrix = np.asarray(data.cell[...])
        cell = Cell.of(matrix[:, :3].T, matrix[:, 3], data.cell.pbc)
    return Table(columns, cell)
