from __future__ import annotations

import math
from typing import Final

import numpy as np

from pt._fit import Array, chunks
from pt.figures._cell import Cell
from pt.figures._particles import Particles
from pt.figures._rods import cell_corners
from pt.figures._spread import middle_of, reaches_of, usual_reach

FAR: Final = 4.0
BEYOND: Final = 1.25
LARGE: Final = 10.0  # a cell larger than this multiple of the particles' reach is not drawn; by taste
OUTSIDE: Final = 0.1
WALL: Final = 0.01
LEAST_COVER: Final = 0.1
WIDTH: Final = 8.0


def far_away(positions: Array, radii: Array, notes: list[str]) -> Array | None:
    """Masks balls so far away that the others would hardly be visible. A ball as large as all others together is never far away."""
    reaches = reaches_of(positions, radii)
    usual = usual_reach(reaches)
    usual = max(usual, float(reaches.max(where=radii > usual, initial=0.0)))
    largest = float(reaches.max())
    if largest <= FAR * usual:
        return None
    far: Array = reaches > BEYOND * usual
    count = int(np.count_nonzero(far))
    notes.append(f"{count:,} of {len(far):,} balls {'is' if count == 1 else 'are'} not drawn, up to {largest / usual:.3g} times as "
                 "far away as the others: --frame-all (frame_all=True) draws all")
    return far


def drawn_cell(particles: Particles, box: str, positions: Array, radii: Array, notes: list[str]) -> Cell | None:
    """`positions` and `radii` belong to drawn particles."""
    cell = particles.cell
    if cell is None or box == "none" or (box == "auto" and cell.is_crystal_of_macromolecule):
        return None
    outside = _count_outside(cell, positions)
    if outside > OUTSIDE * len(positions):
        notes.append(f"{outside:,} of {len(positions):,} particles are outside of their periodic cell: --wrap (wrap=True) brings "
                     "them back")
    if box == "auto" and (2 * outside > len(positions) or _hides(cell, positions, radii)):
        notes.append("the cell is not drawn: most particles are outside of it, or would be small beside it. --box lines "
                     "(box=\"lines\") draws it")
        return None
    return cell


def _count_outside(cell: Cell, positions: Array) -> int:
    count = 0
    for rows in chunks(len(positions)):
        outside = np.abs((positions[rows] - cell.origin) @ cell.inverse - 0.5) > 0.5 + WALL
        count += int((outside & cell.periodic).any(axis=1).sum())
    return count


def _hides(cell: Cell, positions: Array, radii: Array) -> bool:
    corners, middle = cell_corners(cell), middle_of(positions)
    reach, half = float(reaches_of(positions, radii).max()), 0.5 * float(np.ptp(corners, axis=0).max())
    whole = float(np.abs(corners - middle).max())
    return whole > FAR * max(reach, half) or whole > LARGE * reach


def narrow_note(radii: Array, pixels: float, size: tuple[int, int], scale: float) -> str | None:
    """`radii` are in scene units, `pixels` counts pixels per scene unit, and `scale` is in scene units per unit of the data."""
    if float(radii.min()) >= 0.5 / pixels:
        return None
    halves = radii * pixels
    narrow = radii < 0.5 / pixels
    count = int(np.count_nonzero(narrow))
    cover = math.pi * float(np.square(halves).sum(where=narrow))
    if cover > LEAST_COVER * size[0] * size[1]:
        return None
    radius = f"{0.5 * WIDTH / (pixels * scale):.2g}"
    return (f"narrower than a pixel: {count:,} of {len(radii):,} balls. --radius {radius} (radius={radius}) "
            f"makes balls {WIDTH:.0f} pixels wide")
