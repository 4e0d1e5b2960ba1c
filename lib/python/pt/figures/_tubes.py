from __future__ import annotations

from typing import Final

import numpy as np

from pt._fit import Array
from pt.figures._particles import Particles
from pt.figures._residues import NUCLEOTIDES
from pt.figures._rods import Rods
from pt.figures._templates import polymers_of

PIECES: Final = 8  # capsules from one atom of a trace to the next
WIDTH: Final = 0.14  # radius of a tube, relative to the median distance of its atoms; by taste
GAP: Final = 1.6  # largest distance of consecutive atoms, in median distances
_CARBON: Final = (0, 6)


def trace_of(particles: Particles) -> Array:
    """CA of amino acids, and P of nucleotides."""
    if "name" not in particles.columns:
        return np.zeros(len(particles), bool)
    names = particles.columns["name"].astype(str)
    polymers = polymers_of(particles)
    if not polymers.any():
        return polymers
    nucleic = np.isin(np.char.upper(particles.columns["resname"].astype(str)), list(NUCLEOTIDES))
    carbon = True if particles.elements is None else np.isin(particles.elements, _CARBON)
    result: Array = polymers & np.where(nucleic, names == "P", (names == "CA") & carbon)
    return result


def tubes_of(particles: Particles, trace: Array, radius: float | None) -> Rods:
    """Each chain's capsules follow a Catmull-Rom curve through the atoms of `trace`. A capsule has the color of the nearest atom."""
    rows = np.flatnonzero(trace)
    places = particles.positions[rows].astype(np.float64)
    steps = np.linalg.norm(np.diff(places, axis=0), axis=1)
    chains, names = (particles.columns.get(key, np.zeros(len(particles)))[rows] for key in ("chain", "name"))
    linked = (chains[1:] == chains[:-1]) & (names[1:] == names[:-1])
    for name in np.unique(names):
        same = linked & (names[1:] == name)
        if same.any():
            linked[same] = steps[same] <= GAP * np.median(steps[same])
    typical = float(np.median(steps[linked])) if linked.any() else 1.0
    atoms, starts, ways = [], [], []
    times = np.arange(PIECES + 1)[:, None] / PIECES
    for k in np.flatnonzero(linked):
        second, third = places[k], places[k + 1]
        first = places[k - 1] if k > 0 and linked[k - 1] else 2.0 * second - third
        fourth = places[k + 2] if k + 1 < len(linked) and linked[k + 1] else 2.0 * third - second
        curve = 0.5 * (2.0 * second + (third - first) * times + (2.0 * first - 5.0 * second + 4.0 * third - fourth) * times**2 +
                       (3.0 * (second - third) + fourth - first) * times**3)
        near = np.where(np.arange(PIECES) < PIECES // 2, k, k + 1)
        atoms.append(rows[near])
        starts.append(curve[:-1] - places[near])
        ways.append(np.diff(curve, axis=0))
    indices = np.concatenate([np.zeros(0, np.intp), *atoms])
    empty = np.zeros((0, 3))
    return Rods(indices, indices, np.concatenate([empty, *ways]), radius or WIDTH * typical, np.concatenate([empty, *starts]))
