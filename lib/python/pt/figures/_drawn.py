from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Final

import numpy as np
import numpy.typing as npt

from pt._fit import Array, chunks
from pt.figures._bonds import among_sticks, ball_radii, bonds_of, meeting_in_sight, models_of, whole
from pt.figures._cell import Cell
from pt.figures._colors import Legend, colors_of
from pt.figures._framing import drawn_cell, far_away
from pt.figures._layout import Balls
from pt.figures._marks import Marks
from pt.figures._options import Options
from pt.figures._particles import Particles
from pt.figures._radii import opacities_of, radii_of
from pt.figures._rods import Rods, cell_corners, vectors_of
from pt.figures._select import chosen
from pt.figures._styles import completed, groups_of, has_corners, repeated
from pt.figures._tubes import trace_of, tubes_of

LEAST_LENGTH: Final = 1e-18
BESIDE_ARROWS: Final = 0.25  # by taste


@dataclass(frozen=True)
class Drawn:
    """Balls and rods in scene units: the data's units, times a power of two if lengths are far from 1.

    colors      shape (n, 3), or (3,) for one color
    scale       scene units per unit of the data
    settled     values that options get from the data, in its units
    opacities   shape (n,); None if all are opaque
    groups      shape (n, 2): chain and residue
    """

    centers: Array
    radii: Array
    colors: npt.NDArray[np.uint8]
    legend: Legend
    cell: Cell | None
    scale: float
    notes: list[str] = field(default_factory=list)
    rods: Sequence[Rods] = ()
    settled: dict[str, float] = field(default_factory=dict)
    opacities: Array | None = None
    groups: Array | None = None
    marks: Marks = Marks()

    @property
    def all_groups(self) -> Array | None:
        return None if self.groups is None else np.concatenate([self.groups, *(self.groups[each.atoms] for each in self.rods)])

    @property
    def balls(self) -> Balls:
        corners = np.zeros((0, 3)) if self.cell is None else cell_corners(self.cell)
        if not self.rods:
            return Balls(self.centers, self.radii, corners)
        return Balls(np.concatenate([self.centers, *map(self.ends, self.rods)]), self.all_radii, corners)

    def begins(self, rods: Rods) -> Array:
        centers = self.centers[rods.atoms]
        return centers if rods.starts is None else centers + rods.starts

    def ends(self, rods: Rods) -> Array:
        return self.begins(rods) + rods.ways

    @property
    def all_radii(self) -> Array:
        if not self.rods:
            return self.radii
        return np.concatenate([self.radii, *(np.broadcast_to(each.radius, len(each.atoms)) for each in self.rods)])


def prepare(particles: Particles, options: Options, scale: float | None = None) -> Drawn:
    """Hidden particles count for radii, color ranges and categories."""
    notes = list(particles.notes)
    if not len(particles.positions):
        raise ValueError(f"{particles.name} has no particles")
    if options.wrap:
        particles = particles.wrapped()
    if options.whole:
        particles = whole(particles, options)
    corners = has_corners(particles, options)
    if options.repeat is not None:
        particles = repeated(particles, options.repeat, options)
    if corners:
        particles = completed(particles, options)
    radii = radii_of(particles, options.radius, notes)
    if options.vectors is not None and options.radius is None and options.bond_rule is None and particles.radii is None:
        radii = radii * radii.dtype.type(BESIDE_ARROWS)
    colors, legend = colors_of(particles, options, notes)
    opacities = opacities_of(particles, options.opacity)
    rods: list[Rods] = []
    settled: dict[str, float] = {}
    if options.vectors is not None:
        vectors, vector_scale = vectors_of(particles, options.vectors, options.vector_scale)
        rods.append(vectors)
        settled.update({"vector_scale": vector_scale} if vector_scale else {})
    tubes = None
    if options.bond_rule is not None:
        models = models_of(particles, options)
        if not (models == "tube").all():
            bonds = among_sticks(bonds_of(particles, options, radii, notes), models)
            stick = float(np.max(bonds.radius))
            settled.update({"bond_radius": stick} if len(bonds.atoms) else {})
            radii = ball_radii(radii, models, stick, options.radius is not None)
            rods.append(meeting_in_sight(bonds, radii))
        tubes = models == "tube"
        if tubes.any():
            trace = trace_of(particles) & tubes
            rods.append(tubes_of(particles, trace, options.bond_radius))
            radii = np.where(trace, radii.dtype.type(rods[-1].radius), radii)
            tubes = tubes & ~trace
    shown = _shown(particles, options, radii, notes, tubes if tubes is not None and tubes.any() else None)
    positions, sizes = particles.positions, radii
    if shown is not None:
        positions = positions[shown]
        radii = radii[shown] if len(radii) > 1 else radii
        colors = colors[shown] if colors.ndim == 2 else colors
        opacities = opacities[shown] if opacities is not None and len(opacities) > 1 else opacities
        rods = [each.among(shown) for each in rods]
    groups = groups_of(particles) if options.style == "illustrative" else None
    groups = groups if shown is None or groups is None else groups[shown]
    cell = drawn_cell(particles, options.box, positions, radii, notes)
    centers, radii, cell, scale = _in_range(positions, radii, cell, scale)
    return Drawn(centers, np.broadcast_to(radii, len(centers)) if len(radii) == 1 else radii, colors, legend, cell,
                 scale, notes, [each.times(scale, LEAST_LENGTH) for each in rods], settled,
                 None if opacities is None else np.broadcast_to(opacities, len(centers)), groups,
                 Marks.of(particles, options.labels, options.distances, sizes, shown, scale))


def _shown(particles: Particles, options: Options, radii: Array, notes: list[str], hidden: Array | None) -> Array | None:
    conditions = [options.where] if isinstance(options.where, str) else options.where
    shown: Array | None = np.logical_and.reduce([chosen(particles, each) for each in conditions]) if conditions else None
    if shown is not None and not shown.any():
        raise ValueError(f"{particles.name} has no particles for which where = {', '.join(conditions)} holds")
    if hidden is not None:
        shown = ~np.broadcast_to(hidden, len(particles)) if shown is None else shown & ~hidden
    _check(particles.name, radii, shown)
    if options.frame_all or options.camera:
        return shown
    if shown is None:
        far = far_away(particles.positions, radii, notes)
        return None if far is None else ~far
    far = far_away(particles.positions[shown], radii[shown] if len(radii) > 1 else radii, notes)
    if far is not None:
        shown[shown] = ~far
    return shown


def _check(name: str, radii: Array, shown: Array | None) -> None:
    bad = ~(np.isfinite(radii) & (radii > 0.0))
    if shown is not None:
        bad = bad & shown
    if bad.any():
        row = int(bad.argmax())
        raise ValueError(f"{name}: particle {row + 1:,}: radius = {radii[row if len(radii) > 1 else 0]}: must be > 0 and finite "
                         "(where = 'radius > 0' leaves out such particles)")


def _in_range(positions: Array, radii: Array, cell: Cell | None, scale: float | None
              ) -> tuple[Array, Array, Cell | None, float]:
    if scale is None:
        largest = max(float(radii.max()), 0.0 if cell is None else float(np.abs(cell_corners(cell)).max()),
                      *(float(np.abs(positions[rows]).max()) for rows in chunks(len(positions))))
        scale = 1.0 if 2.0**-20 < largest < 2.0**40 else 2.0**-math.frexp(largest)[1]
    if scale == 1.0:
        return positions, np.maximum(radii, radii.dtype.type(LEAST_LENGTH)), cell, scale
    if cell is not None:
        cell = replace(cell, origin=cell.origin * scale, vectors=cell.vectors * scale)
    return positions * np.float64(scale), np.maximum(radii * np.float64(scale), LEAST_LENGTH), cell, scale
