"""Molecules (SDF, MOL, MOL2, CML) and trajectories (XTC, TRR, DCD, ...), read by chemfiles."""

from __future__ import annotations

import functools
import re
from collections.abc import Callable
from typing import Any, Final

import numpy as np
import numpy.typing as npt

from pt.figures._cell import Cell
from pt.figures._elements import NUMBERS
from pt.figures._errors import DataError, module
from pt.figures._particles import Bonds, Table
from pt.figures._residues import VIRTUAL
from pt.figures.readers._atoms import atoms_table
from pt.figures.readers._dcd import frames_without_cell
from pt.figures.readers._frames import Frames, Listed
from pt.figures.readers._lines import Lines
from pt.figures.readers._other import tried

MOLECULES: Final = {"sdf": "SDF", "mol2": "MOL2", "cml": "CML"}
TRAJECTORIES: Final = {"xtc": "XTC", "trr": "TRR", "dcd": "DCD", "tng": "TNG", "netcdf": "Amber NetCDF"}
_NUMBERS: Final = {**NUMBERS, **dict.fromkeys(("Du", "LP", "Lp", "Xx"), VIRTUAL)}


def read_molecules(lines: Lines, format: str) -> Listed:
    chemfiles = module("chemfiles", f"{lines.name}: {format}")
    text = lines.text().decode("utf-8", "replace")
    if format == "mol2" and "@<TRIPOS>BOND" not in text:
        text += "\n@<TRIPOS>BOND\n"
    file = tried(lines.name, "chemfiles", lambda: chemfiles.MemoryTrajectory(text, "r", MOLECULES[format]))
    count = file.nsteps
    if not count:
        raise DataError(f"{lines.name}: has no molecule")

    def read(index: int) -> Table:
        frame = tried(lines.name, "chemfiles", lambda: file.read_step(index))
        table = _molecule(frame)
        if count > 1:
            table.notes.append(f"molecule {index} of {count:,} is shown: frame chooses another, from 0")
        return table

    return Listed(lines.name, count, read, current=0)


def _molecule(frame: Any) -> Table:
    atoms = list(frame.atoms)
    kinds = [re.split(r"[.\d]", atom.type.strip())[0] for atom in atoms]
    elements = np.array([_NUMBERS.get(kind, 0) for kind in kinds], np.uint8)
    columns: dict[str, Any] = {"name": np.array([atom.name or atom.type for atom in atoms], str),
                               "charge": np.array([atom.charge for atom in atoms])}
    return atoms_table(np.array(frame.positions), columns, elements, _cell(frame), Bonds.of(frame.topology.bonds))


def _cell(frame: Any) -> Cell | None:
    lengths, angles = frame.cell.lengths, frame.cell.angles
    return Cell.of_lengths(lengths, angles) if min(lengths) > 0 else None


def read_trajectory(path: str, format: str, topology: Callable[[], Table]) -> Frames:
    count, step = _steps(path, format)
    atoms = topology()
    positions = next(iter(atoms.columns.values()))
    sites = atoms.sites or len(np.asarray(positions))
    columns = {key: values for key, values in atoms.columns.items() if key not in ("positions", "vx", "vy", "vz")}

    def read(index: int) -> Table:
        places, cell = step(index)
        if len(places) != sites:
            raise DataError(f"{path}: has {len(places):,} atoms, and the topology {sites:,}: they must be of one system")
        chosen = places if atoms.rows is None else places[atoms.rows]
        return Table({"positions": chosen, **columns}, cell, list(atoms.notes), elements=atoms.elements, types=atoms.types,
                     bonds=atoms.bonds)

    return Listed(path, count, read)


def _steps(path: str, format: str) -> tuple[int, Callable[[int], tuple[npt.NDArray[Any], Cell | None]]]:
    records = frames_without_cell(path) if format == "dcd" else None
    if records is not None:
        return len(records), functools.partial(_without_cell, records)
    chemfiles = module("chemfiles", f"{path}: {format}")
    file = tried(path, "chemfiles", lambda: chemfiles.Trajectory(path, "r", TRAJECTORIES[format]))

    def read(index: int) -> tuple[npt.NDArray[Any], Cell | None]:
        frame = tried(path, "chemfiles", lambda: file.read_step(index))
        return np.array(frame.positions), _cell(frame)

    return file.nsteps, read


def _without_cell(records: npt.NDArray[Any], index: int) -> tuple[npt.NDArray[Any], None]:
    return np.stack([records[index][axis] for axis in "xyz"], axis=1), None
