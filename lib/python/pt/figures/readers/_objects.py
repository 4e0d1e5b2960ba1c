"""Objects of other packages, recognised by their type's name, so that no package is imported for that."""

from __future__ import annotations

from typing import Any

import numpy as np

from pt.figures._elements import distinct
from pt.figures._particles import Cell, Table
from pt.figures.readers._frames import Frames, Listed


def of_ase(atoms: Any) -> Table:
    columns = {"positions": atoms.positions, **{key: values for key, values in atoms.arrays.items() if key != "positions"}}
    return Table(columns, Cell.of(atoms.cell.array, periodic=atoms.pbc))


def of_mdanalysis(group: Any, name: str) -> Frames:
    """Frames of a universe or a group of atoms; lengths are in angstroms."""
    atoms = group.atoms
    trajectory = group.universe.trajectory

    def read(index: int) -> Table:
        step = trajectory[index]
        columns = {"positions": atoms.positions}  # a copy
        for key, attribute in (("element", "elements"), ("name", "names"), ("type", "types"), ("radius", "radii"),
                               ("mass", "masses"), ("charge", "charges"), ("resid", "resids"), ("resname", "resnames"),
                               ("segid", "segids")):
            values = getattr(atoms, attribute, None)
            if values is not None and (key != "element" or any(values)):
                columns[key] = values
        return Table(columns, None if step.dimensions is None else Cell.of(step.triclinic_dimensions))

    return Listed(name, len(trajectory), read, trajectory.frame)


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
        matrix = np.asarray(data.cell[...])  # columns are the edges and the origin
        cell = Cell.of(matrix[:, :3].T, matrix[:, 3], data.cell.pbc)
    return Table(columns, cell)
