"""A style sets options that the user left at their defaults."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields, replace
from typing import Any, Final

import numpy as np

from pt._fit import Array
from pt.figures._colors import components
from pt.figures._options import Options
from pt.figures._particles import Particles
from pt.figures._radii import covalent_factor
from pt.figures._templates import polymers_of
from pt.figures._tubes import trace_of

MOST_ATOMS: Final = 500  # in a molecule or crystal that is drawn with bonds; by taste
LEAST_POLYMER: Final = 20  # atoms
LEAST_POINTS: Final = 1000
SPACE: Final = 60.0  # most cubic angstroms per atom in a crystal's cell
WALL: Final = 1e-3  # atoms this near to a wall, relative to the edge, are also drawn at the opposite wall
STARS: Final = ("age", "stellar_age", "metallicity", "formation_time")

VALUES: Final[dict[str, dict[str, Any]]] = {
    "molecule": {"bonds": "auto"},
    "protein": {"radius": "van-der-waals", "color": "chain+element", "where": ("not water",), "box": "none"},
    "crystal": {"bonds": "auto", "wall_bonds": "none", "box": "lines"},
    "point-cloud": {"box": "none"},
    "galaxy": {"background": "#04060c", "box": "none", "colormap": "coolwarm"},
    "soft": {"outlines": True},
    "illustrative": {"outlines": True, "box": "none"},
    "cover": {"floor": True},
}
LOOKS: Final = ("soft", "illustrative", "cover")
WORDS: Final = {"molecule": "balls and sticks", "protein": "chains by color, no water, no cell", "crystal": "bonds, cell and all corner atoms",
                "point-cloud": "soft light", "galaxy": "a dark background"}


def styled(particles: Particles, options: Options, notes: list[str]) -> Options:
    style, kind = options.style, options.style
    if style in ("auto", *LOOKS):
        kind = kind_of(particles, options)
        style = kind if style == "auto" else style
        if kind in WORDS:
            notes.append(f"style is {style}{f' of a {kind}' * (style != kind)}: {WORDS[kind]}; --style particles (style='particles') is "
                         "the plain one")
    values = {**VALUES.get(kind, {}), **VALUES.get(style, {})}
    if particles.elements is None:
        values = {name: value for name, value in values.items() if name not in ("bonds", "radius")}
    if kind == "protein" and trace_of(particles)[polymers_of(particles)].all():
        values["model"] = "tube"
    if kind == "protein" and "tube" in (options.model, values.get("model")):
        style = "matte" if style == kind else style
        if "resid" in particles.columns and len(set(particles.columns.get("chain", ()))) == 1:
            values["color"] = "resid"
    if options.drawn_model != "space-filling":
        values.pop("radius", None)
    if "chain" not in particles.columns or "resname" not in particles.columns:
        values = {name: value for name, value in values.items() if name not in ("color", "where")}
    if values.get("bonds") and options.drawn_model == "space-filling" and options.model != "auto":
        del values["bonds"]
    defaults = {each.name: each.default for each in fields(Options)}
    return replace(options, style=style, **{name: value for name, value in values.items()
                                            if _is(getattr(options, name), defaults[name])})


def _is(value: Any, default: Any) -> bool:
    return value is default or (isinstance(value, list) and not value) or type(value) is type(default) and bool(value == default)


def kind_of(particles: Particles, options: Options) -> str:
    count, cell, elements = len(particles), particles.cell, particles.elements
    if elements is not None:
        if np.count_nonzero(polymers_of(particles)) >= LEAST_POLYMER:
            return "protein"
        is_small = count <= MOST_ATOMS and bool(elements.all()) and options.radius is None and particles.radii is None
        if is_small and cell is not None and cell.periodic.all():
            return "crystal" if abs(np.linalg.det(cell.vectors)) < SPACE * count else "particles"
        return "molecule" if is_small and count > 1 and covalent_factor(particles) == 1.0 else "particles"
    if particles.types is None and count >= LEAST_POINTS and cell is None:
        if any(name in particles.columns for name in STARS):
            return "galaxy"
        if particles.colors is not None or len(components(particles, "n")) == 3 and "nx" in particles.columns:
            return "point-cloud"
    return "particles"


def has_corners(particles: Particles, options: Options) -> bool:
    is_look = options.style in LOOKS and options.bonds is not None  # frames and panels settle radii
    return options.style == "crystal" or is_look and kind_of(particles, replace(options, radius=None)) == "crystal"


def completed(particles: Particles, options: Options) -> Particles:
    """Adds atoms at opposite walls, so that a crystal's cell has all corners. The copies are bonded by distance."""
    cell = particles.cell
    if cell is None or has_arrays(options):
        return particles
    shares = (particles.positions - cell.origin) @ cell.inverse
    rows, steps = np.arange(len(particles)), np.zeros((len(particles), 3))
    for axis in np.flatnonzero(cell.periodic):
        places = shares[rows, axis] + steps[:, axis]
        way = np.where(np.abs(places) < WALL, 1.0, np.where(np.abs(places - 1.0) < WALL, -1.0, 0.0))
        more = np.flatnonzero(way)
        rows = np.concatenate([rows, rows[more]])
        steps = np.concatenate([steps, steps[more] + way[more, None] * np.eye(3)[axis]])
    if len(rows) == len(particles):
        return particles
    result = replace(particles, bonds=None).select(rows)
    result.positions += (steps @ cell.vectors).astype(result.positions.dtype)
    return result


def has_arrays(options: Options) -> bool:
    """Whether an option has a value for each particle of the data."""
    values = (options.color, options.radius, options.opacity, options.vectors, options.bonds)
    return any(not isinstance(value, (str, int, float, Mapping, type(None))) for value in values)


def repeated(particles: Particles, counts: tuple[int, int, int], options: Options) -> Particles:
    """Repeats the cell along its edges. Particles of all copies are bonded by distance."""
    cell = particles.cell
    if cell is None:
        raise ValueError(f"repeat: {particles.name} has no cell")
    if has_arrays(options):
        raise ValueError("repeat: color, radius, opacity, vectors and bonds must not be arrays")
    steps = np.array(list(np.ndindex(*counts)), np.float64)
    rows = np.tile(np.arange(len(particles)), len(steps))
    result = replace(particles, bonds=None).select(rows)
    result.positions += np.repeat(steps @ cell.vectors, len(particles), axis=0).astype(result.positions.dtype)
    result.cell = replace(cell, vectors=cell.vectors * np.array(counts)[:, None])
    return result


def groups_of(particles: Particles) -> Array | None:
    if "chain" not in particles.columns:
        return None
    _, chains = np.unique(particles.columns["chain"].astype(str), return_inverse=True)
    residues = particles.columns.get("resid", np.zeros(len(particles), np.int64))
    groups: Array = np.stack([chains.reshape(-1), residues.astype(np.int64)], axis=1)
    return groups
