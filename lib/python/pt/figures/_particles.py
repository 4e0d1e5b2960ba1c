from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt

from pt._fit import Array, chunks
from pt.figures._cell import Cell
from pt.figures._columns import column_name
from pt.figures._errors import DataError


@dataclass(frozen=True)
class Bonds:
    """Bonds that the data state, each once.

    pairs        shape (k, 2): indices
    images       shape (k, 3): the second particle moves by images @ cell.vectors; None: to its nearest image
    is_complete  whether the data state all bonds
    """

    pairs: Array
    images: Array | None = None
    is_complete: bool = True

    @staticmethod
    def of(pairs: npt.ArrayLike, images: Array | None = None, is_complete: bool = True) -> Bonds:
        rows = np.array(pairs, np.intp).reshape(-1, 2)
        if images is None:
            rows = np.unique(np.sort(rows[rows[:, 0] != rows[:, 1]], axis=1), axis=0)
        return Bonds(rows, images, is_complete)

    def among(self, rows: Array, count: int) -> Bonds:
        """`rows` are old indices in the new order; `count` is the old number of particles."""
        new = np.full(count, -1, np.intp)
        new[rows] = np.arange(len(rows))
        pairs = new[self.pairs]
        kept = (pairs >= 0).all(axis=1)
        return dataclasses.replace(self, pairs=pairs[kept], images=None if self.images is None else self.images[kept])


@dataclass
class Particles:
    """n particles, n >= 1.

    positions  shape (n, 3), float32 or float64, finite
    columns    all columns by name, shape (n,), numbers or str; coordinates are views
    elements   shape (n,), uint8: atomic numbers, 0 if unknown; None if the data have no elements
    types      shape (n,), int or str: labels that are not elements
    radii      shape (n,): a column "radius", or half a column "diameter"
    colors     shape (n, 3) or (n, 4): sRGB, floats in [0, 1], uint8 or uint16
    bonds      None if unknown
    """

    positions: Array
    columns: dict[str, Array] = field(default_factory=dict)
    elements: Array | None = None
    types: Array | None = None
    radii: Array | None = None
    colors: Array | None = None
    cell: Cell | None = None
    bonds: Bonds | None = None
    name: str = "array"
    notes: list[str] = field(default_factory=list)

    def __len__(self) -> int:
        return len(self.positions)

    def column(self, name: str) -> Array:
        return self.columns[column_name(self.columns, name, self.name)]

    def select(self, mask: Array) -> Particles:
        """Takes a mask, a slice or indices, in their order. A mask of all particles copies nothing."""
        if mask.dtype == bool and mask.all():
            return self
        chosen = {key: None if value is None else value[mask] for key, value in
                  (("elements", self.elements), ("types", self.types), ("radii", self.radii), ("colors", self.colors))}
        bonds = None if self.bonds is None else self.bonds.among(np.arange(len(self))[mask], len(self))
        return self._moved(self.positions[mask], mask, bonds=bonds, **chosen)

    def wrapped(self) -> Particles:
        if self.cell is None:
            raise DataError(f"wrap: {self.name} has no cell")
        return self.turned(self.cell.turns(self.positions))

    def turned(self, turns: Array) -> Particles:
        """Moves particles back by turns @ cell.vectors. turns: shape (n, 3)."""
        assert self.cell is not None
        bonds, positions = self.bonds, self.positions.copy()
        for rows in chunks(len(positions)):
            positions[rows] -= (turns[rows] @ self.cell.vectors).astype(positions.dtype)
        if bonds is not None and bonds.images is not None:
            first, second = bonds.pairs.T
            bonds = dataclasses.replace(bonds, images=bonds.images + turns[second] - turns[first])
        return self._moved(positions, slice(None), bonds=bonds)

    def _moved(self, positions: Array, rows: Any, **changed: Any) -> Particles:
        axes = {self.positions[:, axis].ctypes.data: axis for axis in range(3)}
        columns = {}
        for name, values in self.columns.items():
            is_view = np.shares_memory(values[:1], self.positions[:1])
            columns[name] = positions[:, axes[values.ctypes.data]] if is_view else values[rows]
        return dataclasses.replace(self, positions=positions, columns=columns, notes=list(self.notes), **changed)


@dataclass
class Table:
    """Contents of a file or an object, before columns are interpreted.

    columns   arrays of one or two dimensions; one may have positions of two or three components
    is_text   numbers come from text, so their type does not determine the scale of colors
    elements  atomic numbers, 0 if unknown; None: columns may have them
    rows      indices of the file's atoms in this table; None: all
    sites     number of atoms in the file
    """

    columns: Mapping[str, npt.ArrayLike]
    cell: Cell | None = None
    notes: list[str] = field(default_factory=list)
    is_text: bool = False
    elements: Array | None = None
    types: Array | None = None
    bonds: Bonds | None = None
    rows: Array | None = None
    sites: int = 0
