from __future__ import annotations

import functools
from dataclasses import dataclass
from typing import Final

import numpy as np
import numpy.typing as npt

from pt._fit import Array

FLAT: Final = 1e-10


@dataclass(frozen=True)
class Cell:
    """A cell, which may be triclinic, left-handed or flat.

    origin    corner at which the edges begin
    vectors   an edge in each row; zeros for a missing edge
    periodic  shape (3,): whether the cell repeats along each edge
    """

    origin: Array
    vectors: Array
    periodic: Array
    is_crystal_of_macromolecule: bool = False

    @staticmethod
    def of(vectors: npt.ArrayLike, origin: npt.ArrayLike = (0, 0, 0), periodic: npt.ArrayLike = True,
           is_crystal_of_macromolecule: bool = False) -> Cell | None:
        """Returns None if the vectors are not finite, all 0, or linearly dependent."""
        rows = np.array(vectors, np.float64)
        rows = np.diag(rows) if rows.shape == (3,) else rows.reshape(3, 3)
        lengths = np.linalg.norm(rows, axis=1)
        there = lengths > 0
        if not np.isfinite(rows).all() or not there.any():
            return None
        area = np.sqrt(max(np.linalg.det(rows[there] @ rows[there].T), 0.0))
        if area < FLAT * np.prod(lengths[there]):
            return None
        return Cell(np.array(origin, np.float64), rows, np.broadcast_to(np.array(periodic, bool), (3,)) & there,
                    is_crystal_of_macromolecule)

    @staticmethod
    def of_lengths(lengths: npt.ArrayLike, angles: npt.ArrayLike, periodic: npt.ArrayLike = True,
                   is_crystal_of_macromolecule: bool = False) -> Cell | None:
        """Puts the first edge along x and the second into the xy plane. angles: degrees, between edges 2 and 3, 1 and 3, 1 and 2."""
        a, b, c = np.array(lengths, np.float64)
        alpha, beta, gamma = np.cos(np.radians(np.array(angles, np.float64)))
        sine = np.sqrt(1 - gamma**2)
        if not sine > 0:
            return None
        across = (alpha - beta * gamma) / sine
        rest = 1 - beta**2 - across**2
        if rest < 0:
            return None
        rows = np.array([[a, 0, 0], [b * gamma, b * sine, 0], [c * beta, c * across, c * np.sqrt(rest)]])
        rows[np.abs(rows) < FLAT * np.abs(rows).max(initial=0)] = 0
        return Cell.of(rows, periodic=periodic, is_crystal_of_macromolecule=is_crystal_of_macromolecule)

    @functools.cached_property
    def inverse(self) -> Array:
        """(positions - origin) @ inverse are fractional coordinates, 0 along a missing edge."""
        inverse: Array = np.linalg.pinv(self.vectors)
        return inverse

    def turns(self, positions: Array) -> Array:
        turns: Array = np.floor((positions - self.origin) @ self.inverse) * self.periodic
        return turns
