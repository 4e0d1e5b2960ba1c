from __future__ import annotations

from collections.abc import Mapping
from typing import Final

import numpy as np

from pt._fit import Array, chunks
from pt.figures._cell import Cell
from pt.figures._columns import ELEMENTS, TYPES, column_name, coordinate_names, first_of, plain_name, split_columns
from pt.figures._elements import elements_of, listed
from pt.figures._errors import DataError
from pt.figures._particles import Particles, Table

NEGLIGIBLE: Final = 1e-12
_COLORS: Final = (("red", "green", "blue", "alpha"), ("r", "g", "b", "a"),
                  ("diffuse_red", "diffuse_green", "diffuse_blue", "diffuse_alpha"),
                  *(tuple(f"{name}[{i}]" for i in range(4)) for name in ("color", "colors", "rgb", "rgba")),
                  *(tuple(f"{name}:{i}" for i in range(4)) for name in ("color", "rgb")))
_HARMONICS: Final = ("f_dc_0", "f_dc_1", "f_dc_2")  # colors of Gaussian splats: spherical harmonics of degree 0
_HARMONIC: Final = 0.5 / np.sqrt(np.pi)
_SHAPES: Final = (("shapex", "shapey", "shapez"), ("c_shape[1]", "c_shape[2]", "c_shape[3]"))


def assembled(name: str, given: Table, mapping: Mapping[str, str], drop_nonfinite: bool) -> Particles:
    notes = list(given.notes)
    parts, table = split_columns(name, given.columns)
    chosen = {role: column_name(parts, source, name) for role, source in mapping.items()}
    positions = _positions(name, parts, table, chosen, given.cell, notes)
    if len(positions) == 0:
        raise DataError(f"{name}: has no particles")
    found = Particles(positions, parts, given.elements, given.types, cell=given.cell, bonds=given.bonds, name=name, notes=notes)
    found.colors = _colors(parts, chosen, given.is_text, notes)
    _put_radii(found, chosen)
    if (found.elements is None and found.types is None) or not {"element", "type"}.isdisjoint(chosen):
        found.elements = found.types = None
        _put_labels(found, chosen)
    found = _with_extent(found)
    return _finite(found, drop_nonfinite)


def _positions(name: str, parts: dict[str, Array], table: Array | None, chosen: dict[str, str], cell: Cell | None,
               notes: list[str]) -> Array:
    axes, scaled = coordinate_names(list(parts)) if table is None else (list("xyz")[:table.shape[1]], False)
    if any(axis in chosen for axis in "xyz"):
        axes, scaled = [chosen.get(axis, axis) for axis in "xyz" if axis in chosen or axis in axes], False
        table = None
    if len(axes) < 2:
        raise DataError(f"{name}: no columns of positions, such as x, y, z: the columns are {listed(list(parts), 30)}; "
                        "say which by columns, like x=lon,y=lat,z=height")
    for axis in axes:
        if parts[axis].dtype.kind not in "fiub":
            raise DataError(f"{name}: column {axis} has words, {str(parts[axis][0])!r}: positions must be numbers")
    is_usual = [plain_name(axis) for axis in axes] in (["x", "y", "z"], ["x", "y"], ["pos0", "pos1", "pos2"])
    if not is_usual or len({axis.islower() for axis in axes}) > 1:
        notes.append(f"positions are the columns {', '.join(axes)}")
    if len(axes) == 2:
        notes.append(f"positions have two coordinates, {axes[0]} and {axes[1]}: the third one is 0")
    kind = np.result_type(*(parts[axis].dtype for axis in axes))
    kind = np.dtype(np.float32 if kind.kind == "f" and kind.itemsize <= 4 else np.float64)
    positions = _common_table([parts[axis] for axis in axes]) if table is None else table
    if positions is None or positions.shape[1] != 3 or positions.dtype != kind or not positions.dtype.isnative:
        positions = np.zeros((len(parts[axes[0]]), 3), kind)
        for i, axis in enumerate(axes):
            positions[:, i] = parts[axis]
    if scaled:
        if cell is None:
            raise DataError(f"{name}: {', '.join(axes)} are fractions of a cell, but the data have none")
        with np.errstate(invalid="ignore", over="ignore"):
            positions = positions @ cell.vectors + cell.origin
    positions = _flushed(positions)
    for i, axis in enumerate("xyz"):
        if not scaled and i < len(axes):
            parts[axes[i]] = positions[:, i]
        parts.setdefault(axis, positions[:, i])
    return positions


def _common_table(columns: list[Array]) -> Array | None:
    table, count = columns[0].base, len(columns[0])
    if not isinstance(table, np.ndarray) or table.ndim != 2 or len(table) < count or table.shape[1] != len(columns):
        return None
    same = all(each.base is table and each.ctypes.data == table[:, i].ctypes.data and each.strides == table.strides[:1]
               for i, each in enumerate(columns))
    return table[:count] if same else None


def _flushed(positions: Array) -> Array:
    least, largest = np.inf, 0.0
    for rows in chunks(len(positions)):
        sizes = np.abs(positions[rows])
        largest = max(largest, float(sizes.max(where=np.isfinite(sizes), initial=0)))
        least = min(least, float(sizes.min(where=sizes > 0, initial=np.inf)))
    if least >= NEGLIGIBLE * largest:
        return positions
    return np.where(np.abs(positions) < NEGLIGIBLE * largest, 0, positions)


def _finite(particles: Particles, drop: bool) -> Particles:
    good = np.isfinite(particles.positions[:, 0])
    for column in (*particles.positions.T[1:], *(() if particles.radii is None else (particles.radii,))):
        good &= np.isfinite(column)
    if good.all():
        return particles
    count = int(len(good) - good.sum())
    if drop and count < len(good):
        particles.notes.append(f"{count:,} of {len(good):,} particles are left out: they are not finite")
        return particles.select(good)
    row = int(np.argmin(good))
    values = dict(zip("xyz", particles.positions[row].tolist()))
    if particles.radii is not None:
        values["radius"] = float(particles.radii[row])
    said = ", ".join(f"{key} = {value}" for key, value in values.items() if not np.isfinite(value))
    raise DataError(f"{particles.name}: particle {row + 1:,} of {len(good):,}: {said}: must be finite" + (
        "" if drop else f"; drop_nonfinite leaves {'it' if count == 1 else f'the {count:,} such'} out"))


def _put_radii(particles: Particles, chosen: dict[str, str]) -> None:
    columns = particles.columns
    numbers = [key for key in columns if columns[key].dtype.kind in "fiu"]
    by_plain = {plain_name(key): key for key in reversed(numbers)} | {key: key for key in numbers}
    for name, factor in (("radius", 1.0), ("radii", 1.0), ("diameter", 0.5), ("diameters", 0.5)):
        source = chosen.get(name) or by_plain.get(name)
        if source is None:
            continue
        if source not in numbers:
            raise DataError(f"{particles.name}: column {source} has words, {str(columns[source][0])!r}: a {name} must be a number")
        particles.radii = columns[source] if factor == 1 else columns[source] * factor
        break
    if particles.radii is None and particles.colors is None and (source := by_plain.get("r")):
        particles.notes.append(f'column {source} is not taken for the radius: --columns "radius={source}" '
                               f'(columns="radius={source}") takes it')
    names = next((names for names in _SHAPES if all(name in columns for name in names)), None)
    if names is None or chosen.keys() & {"radius", "diameter"}:
        return
    diameters = np.stack([columns[name] for name in names], 1)
    is_ellipsoid = (diameters > 0).all(axis=1)
    if is_ellipsoid.any():
        others = np.zeros(len(particles)) if particles.radii is None else particles.radii
        particles.radii = np.where(is_ellipsoid, 0.5 * diameters.mean(axis=1), others)
        particles.notes.append(f"{int(is_ellipsoid.sum()):,} ellipsoids are drawn as balls of their mean diameter "
                               f"({', '.join(names)})")


def _with_extent(particles: Particles) -> Particles:
    if particles.radii is None or (particles.radii != 0).all():
        return particles
    count = int((particles.radii == 0).sum())
    if count == len(particles):
        particles.radii = None
        particles.notes.append("the radius is 0 for all particles, and is not used")
        return particles
    particles.notes.append(f"{count:,} of {len(particles):,} particles are left out: their radius is 0")
    return particles.select(particles.radii != 0)


def _put_labels(particles: Particles, chosen: dict[str, str]) -> None:
    """A column `type` has elements if most of its words are element symbols."""
    columns = particles.columns
    element, kind = (chosen.get(role) or first_of(columns, names) for role, names in (("element", ELEMENTS), ("type", TYPES)))
    for source in (element, kind):
        if source is None or (source != element and _are_numbers(columns[source])):
            continue
        elements, notes = elements_of(columns[source])
        if elements is not None and (source == element or 2 * np.count_nonzero(elements) >= len(elements)):
            particles.elements = elements
            particles.notes += notes
            return
    source = kind or element
    particles.types = None if source is None else columns[source]


def _are_numbers(labels: Array) -> bool:
    return labels.dtype.kind not in "US" or all(str(label).isdecimal() for label in np.unique(labels))


def _colors(columns: Mapping[str, Array], chosen: dict[str, str], is_text: bool, notes: list[str]) -> Array | None:
    """Floats and unsigned integers are scaled by their type. Other integers and text are scaled by their largest number."""
    choices = (tuple(chosen.get(key, key) for key in _COLORS[0]), *_COLORS)
    found = next((names for names in ([first_of(columns, (name,)) for name in choice] for choice in choices)
                  if None not in names[:3]), None)
    if found is None:
        for choice in choices:
            if sum(first_of(columns, (name,)) is not None for name in choice[:3]) == 2:
                notes.append(f"colors need {', '.join(choice[:3])}: one of them is missing")
                break
        if not all(name in columns for name in _HARMONICS):
            return None
        notes.append("colors are the splats' means over all directions: f_dc_0, f_dc_1, f_dc_2")
        colors: Array = 0.5 + _HARMONIC * np.stack([columns[name] for name in _HARMONICS], 1)
        return np.clip(colors, 0, 1)
    names = [name for name in found if name is not None]
    parts = [columns[name] for name in names]
    if any(part.dtype.kind not in "fiu" for part in parts):
        return None
    colors = np.stack(parts, axis=1)
    kinds = {"f" if part.dtype.kind == "f" else part.dtype.str[1:] for part in parts}
    if kinds in ({"u1"}, {"u2"}) or (kinds == {"f"} and not is_text):
        return colors
    largest = float(np.nanmax(colors[:, :3], initial=0))
    scale = 1.0 if largest <= 1.5 else 255.0 if largest <= 258 else 65535.0
    notes.append(f"colors {', '.join(names)} are taken to go from 0 to {scale:g}: the largest is {largest:g}")
    return np.clip(colors / scale, 0, 1)
