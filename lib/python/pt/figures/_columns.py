from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Final

import numpy as np
import numpy.typing as npt

from pt._fit import Array
from pt.figures._elements import listed
from pt.figures._errors import DataError

# Names of columns of positions, best first: a letter before or after a stem, or a stem with a number.
_STEMS: Final = ("", "pos", "position", "positions", "point", "points", "coord", "coords", "coordinate", "coordinates",
                 "center", "centre", "centroid", "location", "loc", "xyz")
_LAMMPS: Final = ("u", "s", "su")
_SCALED: Final = _LAMMPS[1:]
_TABLES: Final = (*_STEMS[1:], "vertices", "r", "x", "arr0")
ELEMENTS: Final = ("element", "elements", "species", "symbol", "symbols", "elem", "numbers", "atomic_number",
                    "atomic_numbers")
TYPES: Final = ("type", "types", "particle_type", "atom_type", "label", "name", "names")
LABELS: Final = frozenset(ELEMENTS + TYPES)


def split_columns(name: str, columns: Mapping[str, npt.ArrayLike]) -> tuple[dict[str, Array], Array | None]:
    arrays = {key: _without_objects(np.asarray(values)) for key, values in columns.items()}
    count = next((array.shape[:1] for array in arrays.values()), ())
    for key, array in arrays.items():
        if array.shape[:1] != count or array.ndim not in (1, 2):
            raise DataError(f"{name}: column {key} has the shape {array.shape}: must have {count[0] if count else 'n'} "
                            "rows and one or two dimensions")
    tables = [key for key, array in arrays.items() if array.ndim == 2 and array.shape[1] in (2, 3)]
    known = sorted((key for key in tables if plain_name(key) in _TABLES), key=lambda key: _TABLES.index(plain_name(key)))
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
    if array.dtype != object:
        return array
    try:
        return array.astype(np.float64)
    except (TypeError, ValueError):
        return array.astype(str)


def plain_name(name: str) -> str:
    """Drops units, separators, quotes and case: posx for "Pos_X [m]"."""
    name = re.sub(r"\s*[\[(](?!\d+[\])])[^\])]*[\])]\s*$", "", name)
    return re.sub(r"[^a-z0-9]", "", name.lower())


def column_name(columns: Mapping[str, Array], name: str, data: str) -> str:
    if name in columns:
        return name
    similar = [each for each in columns if each.lower() == name.lower()]
    if len(similar) == 1:
        return similar[0]
    if name.isdecimal() and 1 <= int(name) <= len(columns):
        return list(columns)[int(name) - 1]
    raise DataError(f"{data}: there is no column {name!r}: the columns are {listed(list(columns), 30) or 'none'}")


def first_of(columns: Mapping[str, Array], names: tuple[str, ...]) -> str | None:
    folded: dict[str, str] = {}
    for each in columns:
        folded.setdefault(each.lower(), each)
    exact = (name for name in names if name in columns)
    return next(exact, next((folded[name] for name in names if name in folded), None))


def coordinate_names(names: list[str]) -> tuple[list[str], bool]:
    """Returns two, three or no names, and whether they are fractional coordinates. Z is the third coordinate only if there is no z."""
    if all(axis in names for axis in "xyz"):
        return ["x", "y", "z"], False
    by_plain: dict[str, str] = {}
    for name in names:
        by_plain.setdefault(plain_name(name), name)
    by_plain.update((name, name) for name in names if name in ("x", "y", "z"))
    for stem in (*_STEMS, *_LAMMPS):
        ways = [[axis + stem for axis in "xyz"]]
        if stem in _STEMS[1:]:
            ways += [[stem + axis for axis in axes] for axes in ("xyz", "012", "123")]
        for keys in ways:
            if all(key in by_plain for key in keys[:2]):
                return [by_plain[key] for key in keys if key in by_plain], stem in _SCALED
    return [], False
