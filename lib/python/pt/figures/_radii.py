from __future__ import annotations

import math
import re
from collections.abc import Mapping
from typing import Final

import numpy as np
import numpy.typing as npt

from pt._fit import Array, Doubles, chunks, coordinates
from pt.figures import _elements as elements
from pt.figures._options import Opacity, Radius
from pt.figures._particles import Particles
from pt.figures._select import chosen, column, rules
from pt.figures._spread import reaches_of, usual_reach

PROBES: Final = 1000
PROBE: Final = 1.4  # angstroms: radius of a water molecule (Lee and Richards 1971)
IN_CELL: Final = 8
MOST_PAIRS: Final = 4_000_000
TABLE_BITS: Final = 20
COVER: Final = 0.01  # least fraction of the picture that balls of unknown radii cover; by taste
THIN: Final = 0.001  # least radius of these balls, relative to the picture's side
SLACK: Final = 0.225  # angstroms; a bond exceeds two covalent radii by at most twice this
MOST_FACTOR: Final = 3.0  # largest factor of covalent radii, so that balls of dilute gases stay apart; by taste
STEPS: Final = np.indices((3, 3, 3)).reshape(3, 1, 27) - 1


def radii_of(particles: Particles, radius: Radius, notes: list[str]) -> Array:
    base, types, picks = rules(radius)
    try:
        types, picks = ({name: float(number) for name, number in each.items()} for each in (types, picks))
    except ValueError:
        raise ValueError(f"radius = {radius!r}: must be like O=0.7,H=0.3 or chain A=2") from None
    radii = _rest_of_radii(particles, types or base, notes)
    if picks:
        radii = np.array(np.broadcast_to(radii, len(particles)))
        for selection, number in picks.items():
            radii[chosen(particles, selection, "radius")] = number
    return radii


def _rest_of_radii(particles: Particles, radius: Radius, notes: list[str]) -> Array:
    factor = 1.0
    if isinstance(radius, str):
        product = re.fullmatch(r"\s*([-+.\deE]+)\s*\*\s*(.+?)\s*", radius)
        if product:
            factor, radius = float(product[1]), product[2]
        radius = _from_text(radius)
    radii = _unscaled(particles, radius, notes)
    if factor != 1.0:
        radii = radii * radii.dtype.type(factor)
    return radii


def _from_text(text: str) -> Radius:
    try:
        return float(text)
    except ValueError:
        return None if text == "auto" else text


def _unscaled(particles: Particles, radius: Radius, notes: list[str]) -> Array:
    if radius is None:
        return _automatic(particles, notes)
    if isinstance(radius, str):
        if radius in ("covalent", "van-der-waals", "solvent-accessible"):
            if particles.elements is None:
                raise ValueError(f"radius = {radius!r}: {particles.name} has no elements")
            each = _of_elements(particles, particles.elements, radius, notes)
            if radius == "solvent-accessible":
                each = each + each.dtype.type(PROBE)
            return each
        radius = column(particles, radius)
    if isinstance(radius, Mapping):
        return _of_types(particles, radius)
    return _numbers("radius", radius, len(particles.positions))


def opacities_of(particles: Particles, opacity: Opacity) -> Array | None:
    if opacity is None:
        return None
    base, types, picks = rules(opacity)
    if types:
        raise ValueError(f"opacity: {next(iter(types))!r} must be a selection, like element O")
    base = 1.0 if base is None else base
    shares = _numbers("opacity", _number_or_column(particles, base) if isinstance(base, str) else base, len(particles.positions))
    if picks:
        shares = np.array(np.broadcast_to(shares, len(particles)), np.float64)
        for selection, number in picks.items():
            shares[chosen(particles, selection, "opacity")] = float(number)
    good = (shares >= 0.0) & (shares <= 1.0)
    if not good.all():
        raise ValueError(f"opacity of particle {int(good.argmin()) + 1:,} = {shares[good.argmin()]}: must lie in [0, 1]")
    return shares


def _number_or_column(particles: Particles, text: str) -> npt.ArrayLike:
    try:
        return float(text)
    except ValueError:
        return column(particles, text)


def _numbers(name: str, values: npt.ArrayLike, count: int) -> Array:
    numbers = np.asarray(values)
    if numbers.dtype.kind not in "fiu" or numbers.shape not in ((), (1,), (count,)):
        raise ValueError(f"{name} has shape {numbers.shape} of {numbers.dtype}: must be one number or {count}")
    each: Array = np.atleast_1d(numbers if numbers.dtype in (np.float32, np.float64) else numbers.astype(np.float64))
    return each


def _automatic(particles: Particles, notes: list[str]) -> Array:
    if particles.radii is not None:
        return np.atleast_1d(particles.radii)
    factor = covalent_factor(particles)
    if factor is None or particles.elements is None:
        return np.array([_seen(typical_radius(particles.positions), particles.positions, notes)])
    radii = _of_elements(particles, particles.elements, "covalent", notes)
    if factor == 1.0:
        return radii
    notes.append(f"neighbours are not bonded: radii are {factor:.3g} times the covalent ones")
    larger: Array = radii * radii.dtype.type(factor)
    return larger


def covalent_factor(particles: Particles) -> float | None:
    """Returns a factor for covalent radii: 1 for bonded neighbours, more for noble gases and C-alphas. Returns None if distances are not in
    angstroms."""
    if particles.elements is None:
        return None
    radii = elements.COVALENT_RADII[np.unique(particles.elements)]
    radii = radii[radii > 0]
    typical = typical_radius(particles.positions)
    # Distances of neighbours in covalent radii: 2 if bonded, up to 6 in other solids, 32 in a gas at 0 degrees Celsius and 1 bar.
    if not len(radii) or not 0.7 * radii.min() <= typical <= 30.0 * radii.max():
        return None
    largest = float(radii.max())
    if typical <= largest + SLACK or len(particles) == 1:
        return 1.0
    area = math.pi * float(np.square(elements.COVALENT_RADII[particles.elements], dtype=np.float64).sum())
    return min(max(typical / largest, _span(particles.positions) * math.sqrt(COVER / area)), MOST_FACTOR)


def _span(positions: Array) -> float:
    return 2.0 * usual_reach(reaches_of(positions, np.zeros(1)))


def _seen(typical: float, positions: Array, notes: list[str]) -> float:
    span = _span(positions)
    if math.pi * len(positions) * typical * typical >= COVER * span * span:
        return typical
    radius = max(span * math.sqrt(COVER / (math.pi * len(positions))), THIN * span, typical)
    notes.append(f"the radius is {radius:.3g}: balls of {typical:.3g}, which would touch their neighbours, would hardly be seen")
    return radius


def _of_elements(particles: Particles, numbers: npt.NDArray[np.uint8], kind: str, notes: list[str]) -> Array:
    table = (elements.COVALENT_RADII if kind == "covalent" else elements.VAN_DER_WAALS_RADII).astype(np.float32)
    there = np.flatnonzero(np.bincount(numbers, minlength=len(table)))
    known = there[table[there] > 0]
    if not len(known):
        raise ValueError(f"radius = {kind!r}: no element of {particles.name} has a known radius")
    if len(known) < len(there):
        missing = np.setdiff1d(there, known)
        names = ", ".join(elements.SYMBOLS[number] for number in missing)
        notes.append(f"no {kind} radius is known of {names}: the mean of the others stands for it")
        table = table.copy()
        table[missing] = table[known].mean()
    each: Array = table[numbers]
    return each


def _of_types(particles: Particles, radii: Mapping[str, float]) -> Array:
    names, codes = elements.categories(column(particles, "type" if particles.elements is None else "element"))
    missing = [name for name in names if name not in radii]
    if missing:
        raise ValueError(f"radius: the type {missing[0]} has no radius, unlike {', '.join(radii)}")
    each: Array = np.array([radii[name] for name in names], np.float32)[codes]
    return each


def typical_radius(positions: Array) -> float:
    """Returns half of the median distance to the nearest neighbour or, for random points, to the fourth."""
    first, fourth = _neighbour_distances(positions)
    if not len(first):
        return 1.0
    median = float(np.median(first))
    # For random points, a twentieth of the distances is below sqrt(log(0.95) / log(0.5)) = 0.27 medians on a surface, and 0.42 in space.
    # Atoms are at least half of the median apart.
    if len(fourth) and float(np.quantile(first, 0.05)) < 0.5 * median:
        median = float(np.median(fourth))
    return 0.5 * median


def _neighbour_distances(positions: Array) -> tuple[Array, Array]:
    count = len(positions)
    fourth = min(4, max(count // 3, 1)) - 1
    low, high = (np.array([end(column) for column in positions.T], np.float64) for end in (np.min, np.max))
    extent = high - low
    broad = extent > 1e-6 * extent.max()
    if not broad.any():
        return np.zeros(0), np.zeros(0)
    places = positions[::-(-count // PROBES)].astype(np.float64)
    side = float(np.prod(extent[broad]) * IN_CELL / count) ** (1.0 / int(broad.sum()))
    if count <= 27 * IN_CELL:
        side = 2.0 * float(extent.max())
    sample = positions[::max(count // 50_000, 1)]
    for _ in range(8):
        _, begin, end = _near(sample, places, low, side)
        crowd = float(np.median((end - begin).sum(axis=1))) * count / len(sample)
        if crowd <= 64 * IN_CELL:
            break
        side *= max((27 * IN_CELL / crowd) ** (1 / 3), 0.05)
    near, begin, end = _near(positions, places, low, side)
    found: list[Array] = []
    pairs = 0
    for place, *cells in zip(places, begin.tolist(), end.tolist()):
        others = np.concatenate([near[first:last] for first, last in zip(*cells) if first < last])
        distances = np.linalg.norm(others - place, axis=1)
        # If the distance exceeds the side of a cell, a nearer neighbour may lie outside these cells.
        found.append(np.sort(distances[(distances > 0.0) & (distances <= side)]))
        pairs += len(others)
        if pairs > MOST_PAIRS:
            break
    return (np.array([each[0] for each in found if len(each)]), np.array([each[fourth] for each in found if len(each) > fourth]))


def _near(positions: Array, places: Doubles, low: Doubles, side: float) -> tuple[Doubles, Array, Array]:
    """Returns the positions in and around the cells of `places`, ordered by cell, and where each place's 27 cells begin and end."""
    keys = _keys(_cells(places, low, side)[:, :, None] + STEPS)
    wanted = np.zeros(1 << TABLE_BITS, bool)
    wanted[keys] = True
    near, hashes = [], []
    for rows in chunks(len(positions)):
        each = _keys(_cells(positions[rows], low, side))
        chosen = np.flatnonzero(wanted[each])
        near.append(positions[rows][chosen])
        hashes.append(each[chosen])
    ordered = np.concatenate(hashes)
    order = np.argsort(ordered, kind="stable")
    begin, end = np.searchsorted(ordered[order], keys, "left"), np.searchsorted(ordered[order], keys, "right")
    return np.concatenate(near)[order].astype(np.float64), begin, end


def _cells(positions: Array, low: Doubles, side: float) -> Array:
    cells: Array = np.floor((coordinates(positions) - low[:, None]) / side).astype(np.int64)
    return cells


def _keys(cells: Array) -> Array:
    """Teschner et al. 2003, "Optimized Spatial Hashing for Collision Detection of Deformable Objects". Collisions are harmless, because
    distances decide."""
    hashed = cells[0] * 73856093 ^ cells[1] * 19349663 ^ cells[2] * 83492791
    keys: Array = (hashed ^ hashed >> TABLE_BITS) & (1 << TABLE_BITS) - 1
    return keys
