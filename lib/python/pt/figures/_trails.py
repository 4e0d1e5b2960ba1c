from __future__ import annotations

from collections.abc import Sequence
from typing import Final

import numpy as np

from pt._fit import Array
from pt.figures._errors import DataError
from pt.figures._particles import Particles
from pt.figures._rods import Rods

WIDTH: Final = 0.2  # radius of trails, in median radii of particles; by taste


def trails_of(particles: Particles, past: Sequence[Particles], radii: Array) -> Rods:
    """`past` begins with the latest frame. Steps longer than half of a periodic cell cross its walls and are left out."""
    positions = particles.positions.astype(np.float64)
    newer, known = positions, np.ones(len(positions), bool)
    atoms, starts, ways = [], [], []
    for frame in past:
        rows = _rows(particles, frame)
        older, there = frame.positions[rows].astype(np.float64), rows >= 0
        steps = older - newer
        drawn = known & there & steps.any(axis=1)
        if particles.cell is not None:
            turns = np.rint(steps @ particles.cell.inverse) * particles.cell.periodic
            drawn &= ~turns.any(axis=1)
        atoms.append(np.flatnonzero(drawn))
        starts.append((newer - positions)[drawn])
        ways.append(steps[drawn])
        newer, known = older, there
    indices = np.concatenate(atoms)
    return Rods(indices, indices, np.concatenate(ways), WIDTH * float(np.median(radii)), np.concatenate(starts))


def _rows(particles: Particles, frame: Particles) -> Array:
    if "id" not in particles.columns or "id" not in frame.columns:
        if len(particles) != len(frame):
            raise DataError(f"trails: {frame.name}: of {len(frame):,} particles and, later, {len(particles):,}, there must "
                            "be a column id to tell which is which")
        return np.arange(len(particles))
    ids, wanted = frame.columns["id"], particles.columns["id"]
    order = np.argsort(ids, kind="stable")
    rows: Array = order[np.minimum(np.searchsorted(ids, wanted, sorter=order), len(ids) - 1)]
    return np.where(ids[rows] == wanted, rows, -1)
