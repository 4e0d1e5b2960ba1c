"""Particles as a figure draws them: positions, columns, elements, types, radii and colors."""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Final

import numpy as np
import numpy.typing as npt

from pt._fit import chunks, coordinates
from pt.figures._cell import Cell
from pt.figures._elements import elements_of, listed
from pt.figures._errors import DataError

Array = npt.NDArray[Any]

NEGLIGIBLE: Final = 1e-12  # relative to the largest coordinate: 1e-5 of float32's resolution
MANY_COLUMNS: Final = 1000
MOST_COMPARED: Final = 2_000_000  # particles that are compared to find coinciding ones
MOST_SORTED: Final = 100_000
_ODD: Final = np.uint64(0x9E3779B97F4A7C15)  # 2^64 over the golden ratio: Knuth's multiplicative hash

# Names of columns of positions, best first: a letter with a stem before or after it, or a stem with a number.
_STEMS: Final = ("", "pos", "position", "positions", "point", "points", "coord", "coords", "coordinate", "coordinates",
                 "center", "centre", "centroid", "location", "loc", "xyz")
_LAMMPS: Final = ("u", "s", "su")  # after the letter: unwrapped, fractions of the cell, both
_SCALED: Final = _LAMMPS[1:]
_TABLES: Final = (*_STEMS[1:], "vertices", "r", "x", "arr0")  # of two or three columns
_COLORS: Final = (("red", "green", "blue", "alpha"), ("r", "g", "b", "a"),
                  ("diffuse_red", "diffuse_green", "diffuse_blue", "diffuse_alpha"),
                  *(tuple(f"{name}[{i}]" for i in range(4)) for name in ("color", "colors", "rgb", "rgba")),
                  *(tuple(f"{name}:{i}" for i in range(4)) for name in ("color", "rgb")))
_HARMONICS: Final = ("f_dc_0", "f_dc_1", "f_dc_2")  # Gaussian splats: spherical harmonics of degree 0
_HARMONIC: Final = 0.5 / np.sqrt(np.pi)
_SHAPES: Final = (("shapex", "shapey", "shapez"), ("c_shape[1]", "c_shape[2]", "c_shape[3]"))  # diameters, in LAMMPS
_ELEMENTS: Final = ("element", "elements", "species", "symbol", "symbols", "elem", "numbers", "atomic_number",
                    "atomic_numbers")
_TYPES: Final = ("type", "types", "particle_type", "atom_type", "label", "name", "names")
LABELS: Final = frozenset(_ELEMENTS + _TYPES)


@dataclass(frozen=True)
class Bonds:
    """Bonds that the data give, each of them once.

    pairs        shape (k, 2): indices of the particles
    images       shape (k, 3): moves the second particle by images @ cell.vectors; None: to its nearest image
    is_complete  whether there are no other bonds
    """

    pairs: Array
    images: Array | None = None
    is_complete: bool = True

    @staticmethod
    def of(pairs: npt.ArrayLike, images: Array | None = None, is_complete: bool = True) -> Bonds:
        """Drops bonds of particles to themselves, and duplicates."""
        rows = np.array(pairs, np.intp).reshape(-1, 2)
        if images is None:
            rows = np.unique(np.sort(rows[rows[:, 0] != rows[:, 1]], axis=1), axis=0)
        return Bonds(rows, images, is_complete)

    def among(self, rows: Array, count: int) -> Bonds:
        """The bonds between selected particles, by their new indices. count: of all. rows: the old indices, in the new
        order."""
        new = np.full(count, -1, np.intp)
        new[rows] = np.arange(len(rows))
        pairs = new[self.pairs]
        kept = (pairs >= 0).all(axis=1)
        return dataclasses.replace(self, pairs=pairs[kept], images=None if self.images is None else self.images[kept])


@dataclass
class Particles:
    """n particles, n >= 1.

    positions  shape (n, 3), float32 or float64, finite
    columns    every column of the data under its own name, shape (n,), numbers or str; coordinates are views
    elements   shape (n,), uint8: atomic numbers, 0: unknown; None: the data have no elements
    types      shape (n,), int or str: labels that are not elements
    radii      shape (n,): a column "radius", or half a column "diameter"
    colors     shape (n, 3) or (n, 4): sRGB, floats from 0 to 1, uint8 or uint16
    bonds      the data's; None: unknown
    name       name of the data, for messages
    notes      warnings for the user
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
        """By name, or by the only one that differs in case."""
        return self.columns[_found(self.columns, name, self.name)]

    def select(self, mask: Array) -> Particles:
        """Selects by a mask, a slice or indices, in their order. If all are kept, they are not copied."""
        if mask.dtype == bool and mask.all():
            return self
        chosen = {key: None if value is None else value[mask] for key, value in
                  (("elements", self.elements), ("types", self.types), ("radii", self.radii), ("colors", self.colors))}
        bonds = None if self.bonds is None else self.bonds.among(np.arange(len(self))[mask], len(self))
        return self._moved(self.positions[mask], mask, bonds=bonds, **chosen)

    def wrapped(self) -> Particles:
        """The particles moved into the cell along its periodic edges."""
        if self.cell is None:
            raise DataError(f"wrap: {self.name} has no cell")
        cell, bonds, positions = self.cell, self.bonds, self.positions.copy()
        for block in chunks(len(positions)):
            rows = positions[block]
            rows -= (cell.turns(rows) @ cell.vectors).astype(rows.dtype)
        if bonds is not None and bonds.images is not None:
            first, second = (cell.turns(self.positions[each]) for each in bonds.pairs.T)
            bonds = dataclasses.replace(bonds, images=bonds.images + second - first)
        return self._moved(positions, slice(None), bonds=bonds)

    def _moved(self, positions: Array, rows: Any, **changed: Any) -> Particles:
        """Other positions, and these rows of the other columns. Columns of coordinates stay views of positions."""
        axes = {self.positions[:, axis].ctypes.data: axis for axis in range(3)}
        columns = {}
        for name, values in self.columns.items():
            is_view = np.shares_memory(values[:1], self.positions[:1])
            columns[name] = positions[:, axes[values.ctypes.data]] if is_view else values[rows]
        return dataclasses.replace(self, positions=positions, columns=columns, notes=list(self.notes), **changed)


@dataclass
class Table:
    """The contents of a file or an object, before columns have meanings.

    columns   arrays of one or two dimensions; positions may also be one column of two or three components
    is_text   whether numbers come from text, so that their type does not tell the scale of colors
    elements  atomic numbers, 0: unknown; None: columns may have them
    types     labels that are not elements, though they may look so
    rows      indices of the file's atoms that the table has; None: all
    sites     how many atoms the file has, drawn or not
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


def assembled(name: str, given: Table, mapping: Mapping[str, str], drop_nonfinite: bool) -> Particles:
    """Columns are found by their names, or by those in a mapping: {"x": "pos_x", "radius": "r"}."""
    notes = list(given.notes)
    parts, table = _split(name, given.columns)
    chosen = {role: _found(parts, source, name) for role, source in mapping.items()}
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
    if len(parts) > MANY_COLUMNS:
        notes.append(f"{len(parts):,} columns, of which a figure uses few: is this a table of particles in rows?")
    return _finite(found, drop_nonfinite)


def _split(name: str, columns: Mapping[str, npt.ArrayLike]) -> tuple[dict[str, Array], Array | None]:
    """Splits columns into ones of one dimension; also returns the table of positions, if there is one, unchanged."""
    arrays = {key: _without_objects(np.asarray(values)) for key, values in columns.items()}
    count = next((array.shape[:1] for array in arrays.values()), ())
    for key, array in arrays.items():
        if array.shape[:1] != count or array.ndim not in (1, 2):
            raise DataError(f"{name}: column {key} has the shape {array.shape}: must have {count[0] if count else 'n'} "
                            "rows and one or two dimensions")
    tables = [key for key, array in arrays.items() if array.ndim == 2 and array.shape[1] in (2, 3)]
    known = sorted((key for key in tables if _plain(key) in _TABLES), key=lambda key: _TABLES.index(_plain(key)))
    chosen = known[0] if known else tables[0] if len(tables) == len(arrays) == 1 else None
    parts: dict[str, Array] = {}
    for key, array in arrays.items():
        if array.ndim == 1:
            parts[key] = array
        elif key == chosen:
            parts.update(zip("xyz", array.T))
        else:
            parts.update((f"{key}[{i}]", column) for i, column in enumerate(array.T))
    return parts, None if chosen is None else arrays[chosen]


def _without_objects(array: Array) -> Array:
    """Objects, as pandas keeps them, become numbers or, failing that, words."""
    if array.dtype != object:
        return array
    try:
        return array.astype(np.float64)
    except (TypeError, ValueError):
        return array.astype(str)


def _plain(name: str) -> str:
    """Lower case without units in brackets, separators and quotes: posx for "Pos_X [m]"."""
    name = re.sub(r"\s*[\[(](?!\d+[\])])[^\])]*[\])]\s*$", "", name)
    return re.sub(r"[^a-z0-9]", "", name.lower())


def _found(columns: Mapping[str, Array], name: str, data: str) -> str:
    """The name of a column by name in any case, or by number from 1 if columns have no names."""
    if name in columns:
        return name
    similar = [each for each in columns if each.lower() == name.lower()]
    if len(similar) == 1:
        return similar[0]
    if name.isdecimal() and 1 <= int(name) <= len(columns):
        return list(columns)[int(name) - 1]
    raise DataError(f"{data}: there is no column {name!r}: the columns are {listed(list(columns), 30) or 'none'}")


def _first(columns: Mapping[str, Array], names: tuple[str, ...]) -> str | None:
    """The first of these names in the columns; an exact match comes before another case."""
    folded: dict[str, str] = {}
    for each in columns:
        folded.setdefault(each.lower(), each)
    exact = (name for name in names if name in columns)
    return next(exact, next((folded[name] for name in names if name in folded), None))


def coordinate_names(names: list[str]) -> tuple[list[str], bool]:
    """Which columns are positions (two, three or none), and whether they are fractions of the cell. Exact names come
    first, so that beside x, y and z a column Z is the atomic number."""
    if all(axis in names for axis in "xyz"):
        return ["x", "y", "z"], False
    plain: dict[str, str] = {}
    for name in names:
        plain.setdefault(_plain(name), name)
    plain.update((name, name) for name in names if name in ("x", "y", "z"))
    for stem in (*_STEMS, *_LAMMPS):
        ways = [[axis + stem for axis in "xyz"]]
        if stem in _STEMS[1:]:
            ways += [[stem + axis for axis in axes] for axes in ("xyz", "012", "123")]
        for keys in ways:
            if all(key in plain for key in keys[:2]):
                return [plain[key] for key in keys if key in plain], stem in _SCALED
    return [], False


def _positions(name: str, parts: dict[str, Array], table: Array | None, chosen: dict[str, str], cell: Cell | None,
               notes: list[str]) -> Array:
    """Positions of shape (n, 3); the columns that hold them become views of it."""
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
    is_usual = [_plain(axis) for axis in axes] in (["x", "y", "z"], ["x", "y"], ["pos0", "pos1", "pos2"])
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
            raise DataError(f"{name}: {', '.join(axes)} are fractions of a cell, and there is none")
        positions = positions @ cell.vectors + cell.origin
    positions = _flushed(positions)
    for i, axis in enumerate("xyz"):
        if not scaled and i < len(axes):
            parts[axes[i]] = positions[:, i]
        parts.setdefault(axis, positions[:, i])
    return positions


def _common_table(columns: list[Array]) -> Array | None:
    """The array that has exactly these columns, in order; None if there is none."""
    table, count = columns[0].base, len(columns[0])
    if not isinstance(table, np.ndarray) or table.ndim != 2 or len(table) < count or table.shape[1] != len(columns):
        return None
    same = all(each.base is table and each.ctypes.data == table[:, i].ctypes.data and each.strides == table.strides[:1]
               for i, each in enumerate(columns))
    return table[:count] if same else None


def _flushed(positions: Array) -> Array:
    """Replaces numbers such as 3e-19 that rounding leaves by 0: negligible beside the largest coordinate."""
    least, largest = np.inf, 0.0
    for rows in chunks(len(positions)):
        sizes = np.abs(positions[rows])
        largest = max(largest, float(sizes.max(where=np.isfinite(sizes), initial=0)))
        least = min(least, float(sizes.min(where=sizes > 0, initial=np.inf)))
    if least >= NEGLIGIBLE * largest:
        return positions
    return np.where(np.abs(positions) < NEGLIGIBLE * largest, 0, positions)  # a copy: the array may be the user's own


def _finite(particles: Particles, drop: bool) -> Particles:
    """Refuses rows that cannot be drawn, naming the first; or, if drop, leaves them out."""
    good = np.isfinite(particles.positions[:, 0])
    for column in (*particles.positions.T[1:], *(() if particles.radii is None else (particles.radii,))):
        good &= np.isfinite(column)
    if good.all():
        _note_coinciding(particles)
        return particles
    count = int(len(good) - good.sum())
    if drop and count < len(good):
        particles.notes.append(f"{count:,} of {len(good):,} particles are left out: not finite")
        particles = particles.select(good)
        _note_coinciding(particles)
        return particles
    row = int(np.argmin(good))
    values = dict(zip("xyz", particles.positions[row].tolist()))
    if particles.radii is not None:
        values["radius"] = float(particles.radii[row])
    said = ", ".join(f"{key} = {value}" for key, value in values.items() if not np.isfinite(value))
    raise DataError(f"{particles.name}: particle {row + 1:,} of {len(good):,}: {said}: must be finite" + (
        "" if drop else f"; drop_nonfinite leaves {'it' if count == 1 else f'the {count:,} such'} out"))


def _note_coinciding(particles: Particles) -> None:
    """Notes how many particles coincide with another. Compares projections in which different places do not coincide;
    of many particles, only projections whose hash begins with zeros."""
    count, bits = len(particles), (len(particles) // MOST_SORTED).bit_length()
    if count > MOST_COMPARED:
        return
    found = []
    for rows in chunks(count):
        x, y, z = coordinates(particles.positions[rows])
        places = 0.6180339887498949 * x + 0.7548776662466927 * y + 0.8191725133961645 * z
        found.append(places[places.view(np.uint64) * _ODD < np.uint64(2**(64 - bits) - 1)] if bits else places)
    places = np.sort(np.concatenate(found))
    coinciding = int((places[1:] == places[:-1]).sum()) << bits
    if coinciding:
        particles.notes.append(f"{'about ' if bits else ''}{coinciding:,} of {count:,} particles lie exactly where another one "
                               "does")


def _put_radii(particles: Particles, chosen: dict[str, str]) -> None:
    columns = particles.columns
    for name, factor in (("radius", 1.0), ("radii", 1.0), ("diameter", 0.5), ("diameters", 0.5)):
        source = chosen.get(name) or _first(columns, (name,))
        if source is not None and columns[source].dtype.kind in "fiu":
            particles.radii = columns[source] if factor == 1 else columns[source] * factor
            break
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
    """Drops particles of radius 0. If all have it, the radii count as unknown."""
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
    """Fills in elements or, failing that, types. A column of types has elements if its words are mostly known symbols.
    """
    columns = particles.columns
    element, kind = (chosen.get(role) or _first(columns, names) for role, names in
                     (("element", _ELEMENTS), ("type", _TYPES)))
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
    """Whether labels are numbers of types, also as words."""
    return labels.dtype.kind not in "US" or all(str(label).isdecimal() for label in np.unique(labels))


def _colors(columns: Mapping[str, Array], chosen: dict[str, str], is_text: bool, notes: list[str]) -> Array | None:
    """Their type decides the scale; for other integers and for numbers from text, the largest number does."""
    choices = (tuple(chosen.get(key, key) for key in _COLORS[0]), *_COLORS)
    found = next((names for names in ([_first(columns, (name,)) for name in choice] for choice in choices)
                  if None not in names[:3]), None)
    if found is None:
        for choice in choices:
            if sum(_first(columns, (name,)) is not None for name in choice[:3]) == 2:
                notes.append(f"colors need {', '.join(choice[:3])}: one of them is missing")
                break
        if not all(name in columns for name in _HARMONICS):
            return None
        notes.append("colors are those of splats seen from all sides: f_dc_0, f_dc_1, f_dc_2")
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
    # Tolerates rounding: a component of 1.0000001 does not mean bytes.
    scale = 1.0 if largest <= 1.5 else 255.0 if largest <= 258 else 65535.0
    notes.append(f"colors {', '.join(names)} are taken to go from 0 to {scale:g}: the largest is {largest:g}")
    return np.clip(colors / scale, 0, 1)
