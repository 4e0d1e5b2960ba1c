from __future__ import annotations

from collections.abc import Iterator
from typing import Final, NamedTuple

import numpy as np

from pt._fit import Array
from pt.figures._cell import Cell

MOST_COMPARED: Final = 400_000_000  # pairs
MOST_FOUND: Final = 20_000_000
COMPARED_AT_ONCE: Final = 1 << 21
SLACK: Final = 1.0 + 2.0**-30
AHEAD: Final = ((0, 1), (1, -1), (1, 0), (1, 1))  # steps to half of a grid's neighbouring rows; the other steps are opposite


class Pairs(NamedTuple):
    """Pairs of different particles or images, each once.

    images    shape (k, 3), int: the second particle moves by images @ cell.vectors
    squares   of distances
    """

    first: Array
    second: Array
    images: Array
    squares: Array


def pairs_within(positions: Array, cutoff: float, cell: Cell | None, radii: Array | None = None, slack: float = 0.0) -> Pairs:
    """Finds pairs at most `cutoff` apart and, with `radii`, at most the sum of both radii plus `slack`. Raises ValueError for too many."""
    positions = positions.astype(np.float64)
    sources, shifts = _images(positions, cell, cutoff)
    places = positions[sources] if cell is None else positions[sources] + shifts @ cell.vectors
    count, found, total = len(positions), [], 0
    for one, other in _candidates(places, cutoff):
        ways = places[other] - places[one]
        squares = np.einsum("ij,ij->i", ways, ways)
        limits = cutoff if radii is None else radii[sources[one]] + radii[sources[other]] + slack
        near = np.flatnonzero((squares <= np.square(limits)) & (np.minimum(one, other) < count))
        one, other, squares = one[near], other[near], squares[near]
        if cell is None:
            found.append((one, other, squares))
        else:
            inner, outer = np.minimum(one, other), np.maximum(one, other)
            steps = shifts[outer] - shifts[inner]
            once = _is_first(inner, sources[outer], steps) | (outer < count)
            found.append((inner[once], outer[once], squares[once]))
        total += len(found[-1][0])
        _check_count(total, cutoff, MOST_FOUND)
    if not found:
        return Pairs(np.zeros(0, np.intp), np.zeros(0, np.intp), np.zeros((0, 3), np.intp), np.zeros(0))
    inner, outer, squares = (np.concatenate(each) for each in zip(*found))
    return Pairs(inner, sources[outer], (shifts[outer] - shifts[inner]).astype(np.intp), squares)


def _is_first(first: Array, second: Array, steps: Array) -> Array:
    """Chooses one of each pair and its reverse, whose steps are opposite."""
    ahead = np.sign(steps) @ (9, 3, 1)
    result: Array = (first < second) | ((first == second) & (ahead > 0))
    return result


def _images(positions: Array, cell: Cell | None, cutoff: float) -> tuple[Array, Array]:
    """Returns indices of particles, and shifts as multiples of the cell's edges. Particles moved into the cell come first, then
    their images within the cutoff."""
    sources = np.arange(len(positions))
    if cell is None:
        return sources, np.zeros((len(positions), 3))
    turns = cell.turns(positions)
    shares: Array = (positions - cell.origin) @ cell.inverse - turns
    shifts = -turns
    margins = cutoff * np.linalg.norm(cell.inverse, axis=0) * cell.periodic
    _check_count(len(positions) * float(np.prod(1.0 + 2.0 * margins)), cutoff)
    for axis in np.flatnonzero(cell.periodic):
        reach = int(np.ceil(margins[axis]))
        moved = [(sources, shares, shifts)]
        for step in (*range(-reach, 0), *range(1, reach + 1)):
            place = shares[:, axis] + step
            kept = (place >= -margins[axis] * SLACK) & (place <= 1.0 + margins[axis] * SLACK)
            by = step * np.eye(3)[axis]
            moved.append((sources[kept], shares[kept] + by, shifts[kept] + by))
        sources, shares, shifts = (np.concatenate(each) for each in zip(*moved))
    return sources, shifts


def _candidates(places: Array, cutoff: float) -> Iterator[tuple[Array, Array]]:
    low = places.min(axis=0)
    side = max(cutoff * SLACK, float((places.max(axis=0) - low).max()) * 2.0**-20)
    cells = np.floor((places - low) / side).astype(np.int64) + 1
    _, columns, layers = cells.max(axis=0) + 2
    keys = (cells[:, 0] * columns + cells[:, 1]) * layers + cells[:, 2]
    order = np.argsort(keys, kind="stable")
    ordered = keys[order]
    different, starts = np.unique(ordered, return_index=True)
    sizes = np.diff(starts, append=len(ordered))
    cell_of = np.repeat(np.arange(len(different)), sizes)

    def bounds(least: Array, most: Array) -> tuple[Array, Array]:
        edges = np.append(starts, len(ordered))
        return edges[np.searchsorted(different, least, "left")], edges[np.searchsorted(different, most, "right")]

    reaches = [(np.arange(1, len(ordered) + 1), bounds(different, different + 1)[1][cell_of])]
    for row, column in AHEAD:
        middle = different + (row * columns + column) * layers
        begin, end = bounds(middle - 1, middle + 1)
        reaches.append((begin[cell_of], end[cell_of]))
    total = 0
    for begin, end in reaches:
        counts = end - begin
        passed = np.cumsum(counts)
        total += int(passed[-1])
        _check_count(total, cutoff)
        cuts = np.searchsorted(passed, np.arange(0, passed[-1], COMPARED_AT_ONCE), "right")
        for start, stop in zip(cuts, [*cuts[1:], len(counts)]):
            here = counts[start:stop]
            one = np.repeat(np.arange(start, stop), here)
            other = np.arange(len(one)) + np.repeat(begin[start:stop] - np.cumsum(here) + here, here)
            yield order[one], order[other]


def _check_count(count: float, cutoff: float, most: int = MOST_COMPARED) -> None:
    if count > most:
        raise ValueError(f"bonds: more than {most:.0e} pairs are within about {cutoff:g}: the cutoff, or the "
                         "covalent radii, must be about as large as the distances between neighbours")
