from __future__ import annotations

from typing import Any

import numpy as np

from pt.figures._cell import Cell
from pt.figures._elements import SYMBOLS, elements_of
from pt.figures._errors import module
from pt.figures._particles import Bonds, Table
from pt.figures.readers._frames import Frames, Listed
from pt.figures.readers._other import tried


def read_gsd(path: str) -> Frames:
    hoomd = module("gsd.hoomd", f"{path}: GSD")
    file = tried(path, "gsd", lambda: hoomd.open(path, "r" if hasattr(hoomd, "Frame") else "rb"))
    return Listed(path, len(file), lambda index: _table(file, index, tried(path, "gsd", lambda: file[index])))


def _table(file: Any, index: int, frame: Any) -> Table:
    particles, count = frame.particles, frame.particles.N
    columns: dict[str, Any] = {"positions": np.asarray(particles.position)}
    kinds = np.array(particles.types or ["A"], str)[np.asarray(particles.typeid)]
    columns["type"] = kinds
    for name in ("diameter", "charge", "mass", "body", "velocity"):
        # For missing arrays the package would return HOOMD's defaults.
        if any(file.file.chunk_exists(frame=each, name=f"particles/{name}") for each in {0, index}):
            columns[name] = np.asarray(getattr(particles, name))
    names = set(particles.types)
    elements = elements_of(kinds)[0] if count and names <= set(SYMBOLS) else None
    bonds = None if frame.bonds is None or frame.bonds.N == 0 else Bonds.of(np.asarray(frame.bonds.group))
    types = kinds if elements is None else None
    return Table(columns, _cell(frame.configuration), elements=elements, types=types, bonds=bonds)


def _cell(configuration: Any) -> Cell | None:
    if configuration.box is None:
        return None
    x, y, z, xy, xz, yz = map(float, configuration.box)
    if configuration.dimensions == 2:
        z = 0.0
    vectors = np.array([[x, 0, 0], [xy * y, y, 0], [xz * z, yz * z, z]])
    return Cell.of(vectors, -0.5 * vectors.sum(axis=0))
