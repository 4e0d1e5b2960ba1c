from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from pt._columns import check_finite
from pt._fit import Array, Doubles
from pt.figures._cell import Cell
from pt.figures._colors import components
from pt.figures._options import Vectors
from pt.figures._particles import Particles
from pt.figures._radii import typical_radius
from pt.figures._select import column

LONGEST: Final = 4.0  # length of the longest arrow, in typical radii; by taste, like the next five values
WIDTH: Final = 0.03  # largest radius of a shaft, relative to LONGEST, like HEAD
HEAD: Final = 0.28  # largest length
MOST_HEAD: Final = 0.4  # relative to the arrow
SLOPE: Final = 0.35  # radius of the head's base, relative to its length
SHAFT: Final = 0.4  # relative to the head's base
PIECES: Final = 20  # capsules of a head


@dataclass(frozen=True)
class Rods:
    """k capsules, each with the color of a particle.

    atoms    indices of these particles
    others   indices of second particles, which must also be shown
    ways     shape (k, 3): from one end to the other
    radius   one number, or shape (k,)
    starts   shape (k, 3): from the particle's center to the first end; None: 0
    """

    atoms: Array
    others: Array
    ways: Doubles
    radius: float | Doubles
    starts: Doubles | None = None

    def among(self, shown: Array) -> Rods:
        kept = shown[self.atoms] & shown[self.others]
        index = np.cumsum(shown) - 1
        return replace(self, atoms=index[self.atoms[kept]], others=index[self.others[kept]], ways=self.ways[kept],
                       radius=self.radius if isinstance(self.radius, float) else self.radius[kept],
                       starts=None if self.starts is None else self.starts[kept])

    def times(self, scale: float, least: float) -> Rods:
        return replace(self, ways=self.ways * scale, radius=np.maximum(self.radius * scale, least),
                       starts=None if self.starts is None else self.starts * scale)


def vectors_of(particles: Particles, given: Vectors, scale: float | None) -> tuple[Rods, float]:
    if isinstance(given, str):
        names = components(particles, given)
        if len(names) != 3:
            raise ValueError(f"vectors = {given!r}: must be three columns like vx,vy,vz, or their common name, like v")
        vectors = np.stack([column(particles, name) for name in names], axis=-1)
    else:
        vectors = np.asarray(given)
    if vectors.dtype.kind not in "fiu" or vectors.shape != (len(particles), 3):
        raise ValueError(f"vectors = {vectors.dtype} of shape {vectors.shape}: must be numbers of shape ({len(particles)}, 3)")
    check_finite("vectors", vectors)
    vectors = vectors.astype(np.float64)
    lengths = np.linalg.norm(vectors, axis=1)
    longest, usual = float(lengths.max()), LONGEST * typical_radius(particles.positions)
    if scale is None:
        scale = usual / longest if longest > 0.0 else 0.0
    atoms = np.flatnonzero(lengths)
    return _arrows(atoms, vectors[atoms] * scale, usual), scale


def _arrows(atoms: Array, ways: Doubles, usual: float) -> Rods:
    """Heads are cones of ever thinner capsules."""
    lengths = np.linalg.norm(ways, axis=1)
    heads = np.minimum(HEAD * usual, MOST_HEAD * lengths)
    left = np.arange(PIECES, -1.0, -1.0)[:, None] / PIECES
    places = np.concatenate([np.zeros((1, len(ways))), 1.0 - left * heads / lengths])
    radii = np.concatenate([np.minimum(WIDTH * usual, SHAFT * SLOPE * heads)[None], SLOPE * heads * (left[:-1] - 0.5 / PIECES)])
    starts, steps = (each[:, :, None] * ways for each in (places[:-1], np.diff(places, axis=0)))
    rows = np.tile(atoms, PIECES + 1)
    return Rods(rows, rows, steps.reshape(-1, 3), radii.reshape(-1), starts.reshape(-1, 3))


def cell_corners(cell: Cell) -> Doubles:
    vectors = cell.vectors[cell.vectors.any(axis=1)]
    edges = np.arange(len(vectors))
    corners: Doubles = cell.origin + (np.arange(2**len(vectors))[:, None] >> edges & 1) @ vectors
    return corners


def cell_edges(cell: Cell) -> Doubles:
    corners = cell_corners(cell)
    steps = [1 << edge for edge in range(len(corners).bit_length() - 1)]
    pairs = [(k, k | step) for k in range(len(corners)) for step in steps if not k & step]
    return np.stack([corners[list(ends)] for ends in zip(*pairs)])
