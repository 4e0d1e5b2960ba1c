from __future__ import annotations

from collections.abc import Callable
from typing import Final

import numpy as np

from pt._fit import Array
from pt.figures._particles import Particles
from pt.figures._residues import WATERS, is_free_ion, is_polymer

# Pairs of heavy atoms within a residue.
_WITHIN: Final = (
    "N-CA CA-C C-O C-OXT C-OT1 C-OT2 C-OC1 C-OC2 C-CH3 N-CH3 CA-CB CB-CG CB-CG1 CB-CG2 CB-OG CB-OG1 CB-SG CG-CD CG-CD1 CG-CD2 "
    "CG1-CD1 CG1-CD CG-OD1 CG-OD2 CG-ND1 CG-ND2 CG-SD CG-SE CD-N CD-NE CD-CE CD-OE1 CD-OE2 CD-NE2 CD1-CE1 CD1-NE1 CD2-CE2 "
    "CD2-CE3 CD2-NE2 NE-CZ CE-NZ SD-CE SE-CE CE1-CZ CE2-CZ CE1-NE2 ND1-CE1 NE1-CE2 CE2-CZ2 CE3-CZ3 CZ2-CH2 CZ3-CH2 CZ-NH1 "
    "CZ-NH2 CZ-OH P-OP1 P-OP2 P-OP3 P-O1P P-O2P P-O3P P-O5' O5'-C5' C5'-C4' C4'-O4' C4'-C3' C3'-O3' C3'-C2' C2'-O2' C2'-C1' "
    "C1'-O4' C1'-N9 C1'-N1 N9-C8 N9-C4 C8-N7 N7-C5 C5-C6 C5-C4 C6-N6 C6-O6 C6-N1 N1-C2 C2-N2 C2-O2 C2-N3 N3-C4 C4-N4 C4-O4 "
    "C5-C7 C5-C5M").split()
_PAIRS: Final = frozenset(frozenset(pair.split("-")) for pair in _WITHIN)
_KNOWN: Final = frozenset().union(*_PAIRS)
_BETWEEN: Final = frozenset((frozenset(("C", "N")), frozenset(("O3'", "P")), frozenset(("SG",))))
_HYDROGEN: Final = 1


def known_residues(particles: Particles) -> Array:
    return _of_names(particles, lambda name: name.upper() in WATERS or is_polymer(name.upper()))


def polymers_of(particles: Particles) -> Array:
    if "resname" not in particles.columns:
        return np.zeros(len(particles), bool)
    return _of_names(particles, lambda name: is_polymer(name.upper()))


def free_ions(particles: Particles) -> Array:
    residues = residues_of(particles)
    result: Array = _of_names(particles, is_free_ion) & (np.bincount(residues)[residues] == 1)
    return result


def _of_names(particles: Particles, rule: Callable[[str], bool]) -> Array:
    names, codes = np.unique(particles.columns["resname"], return_inverse=True)
    result: Array = np.array([rule(str(name)) for name in names], bool)[codes.reshape(-1)]
    return result


def residues_of(particles: Particles) -> Array:
    changes = np.zeros(len(particles), bool)
    for key in ("resname", "resid", "chain", "icode"):
        if key in particles.columns:
            values = particles.columns[key]
            changes[1:] |= values[1:] != values[:-1]
    result: Array = np.cumsum(changes)
    return result


def agreeing(particles: Particles, first: Array, second: Array, squares: Array) -> Array:
    """Masks pairs whose atom names mean a bond, and all pairs of unknown residues."""
    names = np.char.replace(np.char.upper(particles.columns["name"].astype(str)), "*", "'")
    words, codes = np.unique(names, return_inverse=True)
    known, residues = known_residues(particles), residues_of(particles)
    inside = residues[first] == residues[second]
    both = known[first] & known[second]
    hydrogens = np.asarray(particles.elements) == _HYDROGEN
    with_hydrogen = hydrogens[first] | hydrogens[second]
    kept: Array = ~both
    pairs, places = np.unique(codes[first] * len(words) + codes[second], return_inverse=True)
    named = [(str(words[pair // len(words)]), str(words[pair % len(words)])) for pair in pairs.tolist()]
    within = np.array([frozenset(pair) in _PAIRS or not _KNOWN.issuperset(pair) for pair in named], bool)
    between = np.array([frozenset(pair) in _BETWEEN for pair in named], bool)
    if len(pairs):
        kept |= np.where(inside, within[places.reshape(-1)], between[places.reshape(-1)]) & ~with_hydrogen
    chosen = np.flatnonzero(both & inside & with_hydrogen & ~(hydrogens[first] & hydrogens[second]))
    own = np.where(hydrogens[first[chosen]], first[chosen], second[chosen])
    order = np.lexsort((squares[chosen], own))
    nearest = np.ones(len(order), bool)
    nearest[1:] = own[order[1:]] != own[order[:-1]]
    kept[chosen[order[nearest]]] = True
    return kept
