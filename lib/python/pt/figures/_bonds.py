from __future__ import annotations

from dataclasses import replace
from typing import Any, Final

import numpy as np

from pt._fit import Array, Doubles
from pt.figures import _elements as elements
from pt.figures._neighbours import pairs_within
from pt.figures._options import Options
from pt.figures._particles import Bonds, Particles
from pt.figures._rods import Rods
from pt.figures._select import chosen
from pt.figures._templates import agreeing, free_ions, known_residues, polymers_of
from pt.figures._tubes import trace_of

# O'Boyle et al. 2011, "Open Babel: An open chemical toolbox", Journal of Cheminformatics 3:33: atoms are bonded if their
# distance is at most the sum of their covalent radii and the tolerance. Atoms closer than the least distance are
# alternative positions of one atom. Angstroms.
TOLERANCE: Final = 0.45
LEAST_DISTANCE: Final = 0.4
BALL_SHARE: Final = 0.5  # radius of a ball with sticks, relative to its full radius; by taste
STICK_SHARES: Final = {"space-filling": 0.07, "ball-and-stick": 0.07, "sticks": 0.14, "tube": 0.07}


def bonds_of(particles: Particles, options: Options, radii: Array, notes: list[str]) -> Rods:
    found = _found(particles, options.bond_rule, notes)
    if options.wall_bonds == "none" and found.images is not None:
        found = Bonds(*(each[~found.images.any(axis=1)] for each in (found.pairs, found.images)))
    first, second = found.pairs.T
    ways = particles.positions[second].astype(np.float64) - particles.positions[first]
    if particles.cell is not None and found.images is not None:
        ways += found.images @ particles.cell.vectors
    if not len(first):
        notes.append("bonds: there are none" if not isinstance(options.bond_rule, (str, int, float)) else
                     f"bonds = {options.bond_rule!r}: no two particles are near enough")
    both = np.concatenate
    ways = 0.5 * both([ways, -ways])
    return Rods(both([first, second]), both([second, first]), ways,
                options.bond_radius or stick_radius(ways, options.drawn_model, radii))


def whole(particles: Particles, options: Options) -> Particles:
    """Moves atoms, except the first one of each molecule, so that no bond crosses a wall of the cell."""
    if particles.cell is None:
        raise ValueError(f"whole: {particles.name} has no cell")
    found = _found(particles, True if options.bond_rule is None else options.bond_rule, [])
    first, second = found.pairs.T
    images: Array = found.images if found.images is not None else np.zeros((len(first), 3))
    labels, turns, more = np.arange(len(particles)), np.zeros((len(particles), 3)), True
    while more:
        more = False
        for ends, others, steps in ((first, second, images), (second, first, -images)):
            lower = np.flatnonzero(labels[ends] < labels[others])
            labels[others[lower]] = labels[ends[lower]]
            turns[others[lower]] = turns[ends[lower]] - steps[lower]
            more |= len(lower) > 0
    return particles.turned(turns)


def _found(particles: Particles, given: Any, notes: list[str]) -> Bonds:
    rule = _rule(given)
    if rule is None:
        return _automatic(particles, notes)
    if isinstance(rule, np.ndarray):
        return _of_pairs(particles, rule)
    pairs = pairs_within(particles.positions, rule, particles.cell)
    apart = pairs.squares > 0.0
    return Bonds(np.stack(pairs[:2], 1)[apart], pairs.images[apart])


def _rule(bonds: Any) -> float | None | Array:
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


def _of_pairs(particles: Particles, pairs: Array) -> Bonds:
    bad = ((pairs < 0) | (pairs >= len(particles))).any(axis=1) | (pairs[:, 0] == pairs[:, 1])
    if bad.any():
        row = int(bad.argmax())
        raise ValueError(f"bonds[{row}] = {pairs[row].tolist()}: must be two different particles, from 0 to {len(particles) - 1}")
    return _with_images(particles, Bonds(pairs.astype(np.intp)))


def _with_images(particles: Particles, bonds: Bonds) -> Bonds:
    """Chooses the nearest image of each second particle, if bonds are shorter than half of the cell's thickness."""
    if particles.cell is None or bonds.images is not None:
        return bonds
    first, second = bonds.pairs.T
    ways = particles.positions[second].astype(np.float64) - particles.positions[first]
    turns = np.rint(ways @ particles.cell.inverse) * particles.cell.periodic
    return replace(bonds, images=-turns.astype(np.intp))


def _automatic(particles: Particles, notes: list[str]) -> Bonds:
    given = particles.bonds
    if given is not None and given.is_complete:
        notes.append(f"the {len(given.pairs):,} bonds of the data are drawn")
        return _with_images(particles, given)
    guessed = _guessed(particles, notes)
    if given is None:
        return guessed
    given = _with_images(particles, given)
    has_bonds = np.zeros(len(particles), bool)
    has_bonds[given.pairs] = True
    if "resname" in particles.columns:
        has_bonds &= ~known_residues(particles)
    added = ~has_bonds[guessed.pairs].all(axis=1) & ~_are_among(guessed.pairs, given.pairs)
    notes.append(f"bonds: {len(given.pairs):,} of the data, and {int(added.sum()):,} by distance")
    images = None
    if given.images is not None and guessed.images is not None:
        images = np.concatenate([given.images, guessed.images[added]])
    return Bonds(np.concatenate([given.pairs, guessed.pairs[added]]), images)


def _are_among(pairs: Array, others: Array) -> Array:
    count = max(int(each.max(initial=0)) for each in (pairs, others)) + 1
    first, second = (np.sort(each, axis=1) @ (count, 1) for each in (pairs, others))
    result: Array = np.isin(first, second)
    return result


def _guessed(particles: Particles, notes: list[str]) -> Bonds:
    if particles.elements is None:
        raise ValueError(f"bonds = 'auto': {particles.name} has no elements: must be a cutoff or pairs")
    radii = elements.COVALENT_RADII.astype(np.float64)[particles.elements]
    if unknown := int((radii == 0.0).sum()):
        notes.append(f"{unknown:,} particles have no bonds: their elements have no covalent radius")
    is_named = {"name", "resname"} <= particles.columns.keys()
    if is_named:
        radii[free_ions(particles)] = 0.0
    rows = np.flatnonzero(radii > 0.0)
    if not len(rows):
        return Bonds(np.zeros((0, 2), np.intp), np.zeros((0, 3), np.intp))
    radii = radii[rows]
    found = pairs_within(particles.positions[rows], 2.0 * float(radii.max()) + TOLERANCE, particles.cell, radii, TOLERANCE)
    apart = found.squares > LEAST_DISTANCE**2
    first, second, images, squares = (each[apart] for each in found)
    first, second = rows[first], rows[second]
    if is_named:
        kept = agreeing(particles, first, second, squares)
        first, second, images = first[kept], second[kept], images[kept]
    return Bonds(np.stack([first, second], 1), images)


def stick_radius(ways: Doubles, model: str, radii: Array) -> float:
    lengths = 2.0 * np.linalg.norm(ways, axis=1)
    return STICK_SHARES[model] * float(np.median(lengths if len(lengths) else 2.0 * radii))


def meeting_in_sight(halves: Rods, balls: Array) -> Rods:
    """Both halves end in the middle of the bond's visible part. `balls` has radii, shape (n,) or (1,)."""
    if len(balls) == 1:
        return halves
    lengths = 2.0 * np.linalg.norm(halves.ways, axis=1)
    shares = np.clip(1.0 + (balls[halves.atoms] - balls[halves.others]) / lengths, 0.0, 2.0)
    return replace(halves, ways=halves.ways * shares[:, None])


def models_of(particles: Particles, options: Options) -> Array:
    """Shape (n,), or (1,) without selections."""
    models = np.array([options.drawn_model], object)
    if options.picked_models:
        models = np.repeat(models, len(particles))
        for selection, model in options.picked_models.items():
            models[chosen(particles, selection, "model")] = model
    if (models == "tube").any():
        models = np.where((models == "tube") & ~polymers_of(particles), "ball-and-stick", models)
        if (models == "tube").any() and not trace_of(particles).any():
            raise ValueError(f"model = 'tube': {particles.name} has no atoms CA of amino acids or P of nucleotides")
    return models


def among_sticks(bonds: Rods, models: Array) -> Rods:
    if len(models) == 1:
        return bonds
    has_sticks = np.isin(models, ("ball-and-stick", "sticks"))
    kept = has_sticks[bonds.atoms] & has_sticks[bonds.others]
    return replace(bonds, atoms=bonds.atoms[kept], others=bonds.others[kept], ways=bonds.ways[kept])


def ball_radii(radii: Array, models: Array, stick: float, is_given: bool) -> Array:
    if len(models) == 1 and models[0] == "sticks":
        return np.array([stick])
    halves = (models == "ball-and-stick") & (not is_given)
    result: Array = np.where(halves, radii * radii.dtype.type(BALL_SHARE), radii) if halves.any() else radii
    return np.where(models == "sticks", radii.dtype.type(stick), result) if len(models) > 1 else result
