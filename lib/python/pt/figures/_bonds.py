"""Bonds between particles: by covalent radii, by a cutoff or given; each is drawn as two halves, one of each atom."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any, Final

import numpy as np

from pt._fit import Array, Doubles
from pt.figures import _elements as elements
from pt.figures._options import Options
from pt.figures._particles import Cell, Particles
from pt.figures._rods import Rods

# O'Boyle et al. 2011, "Open Babel: An open chemical toolbox", Journal of Cheminformatics 3:33, and its documentation:
# two atoms are bonded if their distance is at most the sum of their covalent radii and this tolerance, and more than
# the least distance, below which they are alternative places of one atom. In angstroms.
TOLERANCE: Final = 0.45
LEAST_DISTANCE: Final = 0.4
BALL_SHARE: Final = 0.5  # radius of a ball that has a stick, as a share of that of a ball alone; by taste
STICK_SHARES: Final = {"space-filling": 0.07, "ball-and-stick": 0.07, "sticks": 0.14}  # of the median bond; by taste
MOST_COMPARED: Final = 400_000_000  # pairs, which takes about a minute
MOST_FOUND: Final = 40_000_000  # of these, in both orders, which takes 4 GB
ROWS_AT_ONCE: Final = 2048
SLACK: Final = 1.0 + 2.0**-30  # so that roundings put no neighbour two cells away


def bonds_of(particles: Particles, options: Options, radii: Array, notes: list[str]) -> Rods:
    """Halves of bonds, from their atoms to their middles. radii: of the particles, if no bonds were wanted."""
    rule = _rule(options.bond_rule)
    cell = particles.cell
    if isinstance(rule, np.ndarray):
        atoms, others, ways, shifted = _given(particles, rule, cell)
    else:
        atoms, others, ways, shifted = _near(particles, rule, cell, notes)
    kept: Any = slice(None) if options.wall_bonds == "halves" else ~shifted
    atoms, others, ways = atoms[kept], others[kept], 0.5 * ways[kept]
    if not len(atoms):
        notes.append("bonds: there are none" if isinstance(rule, np.ndarray) else
                     f"bonds = {options.bond_rule!r}: no two particles are near enough")
    return Rods(atoms, others, ways, options.bond_radius or stick_radius(ways, options.drawn_model, radii))


def _rule(bonds: Any) -> float | None | Array:
    """A cutoff, pairs, or None: covalent radii."""
    if bonds is True or isinstance(bonds, str) and bonds == "auto":
        return None
    try:
        array = np.asarray(float(bonds) if isinstance(bonds, str) else bonds)
    except ValueError:
        array = np.zeros(0)
    if array.shape == () and array.dtype.kind in "fiu" and 0.0 < array < np.inf:
        return float(array)
    if array.ndim != 2 or array.shape[1] != 2 or array.dtype.kind not in "iu":
        said = repr(bonds) if array.ndim < 2 else f"of shape {array.shape} and {array.dtype}"
        raise ValueError(f"bonds = {said}: must be auto, a cutoff > 0, or pairs: whole numbers of shape (k, 2)")
    return array


def _given(particles: Particles, pairs: Array, cell: Cell | None) -> tuple[Array, Array, Doubles, Array]:
    """In a periodic cell, with the nearest image: that is so for bonds shorter than half of the cell's thickness."""
    bad = ((pairs < 0) | (pairs >= len(particles))).any(axis=1) | (pairs[:, 0] == pairs[:, 1])
    if bad.any():
        row = int(bad.argmax())
        raise ValueError(f"bonds[{row}] = {pairs[row].tolist()}: must be two different particles, from 0 to "
                         f"{len(particles) - 1}")
    first, second = pairs.astype(np.intp).T
    ways = particles.positions[second].astype(np.float64) - particles.positions[first]
    turns = np.zeros(ways.shape)
    if cell is not None:
        turns = np.rint(ways @ np.linalg.inv(cell.vectors)) * cell.periodic
        ways -= turns @ cell.vectors
    both = np.concatenate
    return (both([first, second]), both([second, first]), both([ways, -ways]), both([turns, turns]).any(axis=1))


def _near(particles: Particles, cutoff: float | None, cell: Cell | None, notes: list[str]
          ) -> tuple[Array, Array, Doubles, Array]:
    """All pairs, in both orders, that are near enough."""
    radii: Array | None = None
    largest, least = cutoff or 0.0, 0.0
    if cutoff is None:
        if particles.elements is None:
            raise ValueError(f"bonds = 'auto': {particles.name} has no elements: must be a cutoff or pairs")
        radii, least = elements.COVALENT_RADII.astype(np.float64)[particles.elements], LEAST_DISTANCE
        largest = 2.0 * float(radii.max()) + TOLERANCE
        if unknown := int((radii == 0.0).sum()):
            notes.append(f"{unknown:,} particles have no bonds: their elements have no covalent radius")
    positions = particles.positions.astype(np.float64)
    sources, shifts = _images(positions, cell, largest)
    vectors = np.zeros((3, 3)) if cell is None else cell.vectors
    places = positions[sources] + shifts @ vectors
    found = []
    total = 0
    for atoms, images in _candidates(places, len(positions), largest):
        ways = places[images] - places[atoms]
        others = sources[images]
        distances = np.sqrt(np.einsum("ij,ij->i", ways, ways))
        near = (distances > least) & (distances <= largest)
        if radii is not None:
            near &= (distances <= radii[atoms] + radii[others] + TOLERANCE) & (radii[atoms] > 0.0) & (radii[others] > 0.0)
        atoms, others, images = atoms[near], others[near], images[near]
        # A particle that has left the cell is bonded to the others where it is, with no wall between them.
        shifted = (shifts[images] != shifts[atoms]).any(axis=1)
        found.append((atoms, others, ways[near], shifted))
        total += len(atoms)
        _check_count(total, largest, MOST_FOUND)
    joined = [np.concatenate(each) for each in zip(*found)]
    return joined[0], joined[1], joined[2], joined[3]


def _images(positions: Doubles, cell: Cell | None, cutoff: float) -> tuple[Array, Doubles]:
    """The particles brought into the cell, then their images that are no farther from it than the cutoff: indices of
    the particles, and by how many edges each has been moved."""
    sources = np.arange(len(positions))
    if cell is None:
        return sources, np.zeros((len(positions), 3))
    inverse = np.linalg.inv(cell.vectors)
    shares = (positions - cell.origin) @ inverse
    turns = np.floor(shares) * cell.periodic
    shares, shifts = shares - turns, -turns
    margins = cutoff * np.linalg.norm(inverse, axis=0) * cell.periodic  # the cell's thicknesses are 1 / norm
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


def _candidates(places: Doubles, count: int, cutoff: float) -> Iterator[tuple[Array, Array]]:
    """Pairs of one of the first count places and any other, in the same or adjacent cells of a grid whose sides are the
    cutoff."""
    low = places.min(axis=0)
    side = max(cutoff * SLACK, float((places.max(axis=0) - low).max()) * 2.0**-20)  # so that keys fit into 64 bits
    cells = np.floor((places - low) / side).astype(np.int64) + 1
    _, columns, layers = cells.max(axis=0) + 2
    keys = (cells[:, 0] * columns + cells[:, 1]) * layers + cells[:, 2]
    order = np.argsort(keys, kind="stable")
    ordered = keys[order]
    steps = (np.arange(-1, 2)[:, None] * columns + np.arange(-1, 2)).ravel() * layers  # of rows of three cells each
    total = 0
    for start in range(0, count, ROWS_AT_ONCE):
        middle = keys[start:min(start + ROWS_AT_ONCE, count), None] + steps
        begin = np.searchsorted(ordered, middle - 1, "left").ravel()
        counts = np.searchsorted(ordered, middle + 1, "right").ravel() - begin
        here = int(counts.sum())
        total += here
        _check_count(max(total, 20 * here), cutoff)  # the pairs of one turn are in memory, 100 bytes each
        atoms = np.repeat(np.repeat(np.arange(len(middle)) + start, len(steps)), counts)
        images = order[np.arange(len(atoms)) + np.repeat(begin - np.cumsum(counts) + counts, counts)]
        different = atoms != images
        yield atoms[different], images[different]


def _check_count(count: float, cutoff: float, most: int = MOST_COMPARED) -> None:
    if count > most:
        raise ValueError(f"bonds: more than {most:.0e} pairs are within about {cutoff:g}: the cutoff, or the "
                         "covalent radii, must be about as large as the distances between neighbours")


def stick_radius(ways: Doubles, model: str, radii: Array) -> float:
    """The radius of sticks that options do not give; without bonds, as if balls touched."""
    lengths = 2.0 * np.linalg.norm(ways, axis=1)
    return STICK_SHARES[model] * float(np.median(lengths if len(lengths) else 2.0 * radii))


def meeting_in_sight(halves: Rods, balls: Array) -> Rods:
    """Halves of bonds that meet in the middle of what is seen of a bond between its balls, where these differ.

    balls   radii, in shape (n,) or (1,)
    """
    if len(balls) == 1:
        return halves
    lengths = 2.0 * np.linalg.norm(halves.ways, axis=1)
    shares = np.clip(1.0 + (balls[halves.atoms] - balls[halves.others]) / lengths, 0.0, 2.0)
    return replace(halves, ways=halves.ways * shares[:, None])


def ball_radii(radii: Array, model: str, stick: float, is_given: bool) -> Array:
    """Radii of the balls of a model: sticks end in balls of their own radius."""
    if model == "sticks":
        return np.array([stick])
    result: Array = radii * radii.dtype.type(BALL_SHARE) if model == "ball-and-stick" and not is_given else radii
    return result
