from __future__ import annotations

import re
from typing import Any, Final

import numpy as np
import numpy.typing as npt

from pt._fit import Array

SYMBOLS: Final = tuple(
    "? H He Li Be B C N O F Ne Na Mg Al Si P S Cl Ar K Ca Sc Ti V Cr Mn Fe Co Ni Cu Zn Ga Ge As Se Br Kr Rb Sr Y Zr Nb "
    "Mo Tc Ru Rh Pd Ag Cd In Sn Sb Te I Xe Cs Ba La Ce Pr Nd Pm Sm Eu Gd Tb Dy Ho Er Tm Yb Lu Hf Ta W Re Os Ir Pt Au "
    "Hg Tl Pb Bi Po At Rn Fr Ra Ac Th Pa U Np Pu Am Cm".split())
"""Indexed by atomic number, like the tables below. 0 is an unknown element."""

# Angstroms, 0 if unknown. Alvarez, Dalton Trans. 42 (2013) 8617.
VAN_DER_WAALS_RADII: Final = np.array((
    0,
    1.2, 1.43, 2.12, 1.98, 1.91, 1.77, 1.66, 1.5, 1.46, 1.58, 2.5, 2.51, 2.25, 2.19, 1.9, 1.89, 1.82, 1.94, 2.73,
    2.62, 2.58, 2.46, 2.42, 2.45, 2.45, 2.44, 2.4, 2.4, 2.38, 2.39, 2.32, 2.29, 1.88, 1.82, 1.86, 2.07, 3.21, 2.84,
    2.75, 2.52, 2.56, 2.45, 2.44, 2.46, 2.44, 2.15, 2.53, 2.49, 2.43, 2.42, 2.47, 1.99, 2.04, 2.28, 3.48, 3.03, 2.98,
    2.88, 2.92, 2.95, 0, 2.9, 2.87, 2.83, 2.79, 2.87, 2.81, 2.83, 2.79, 2.8, 2.74, 2.63, 2.53, 2.57, 2.49, 2.48, 2.41,
    2.29, 2.32, 2.45, 2.47, 2.6, 2.54, 0, 0, 2.4, 0, 0, 2.8, 2.93, 2.88, 2.71, 2.82, 2.81, 2.83, 3.05), np.float32)

# Angstroms. Cordero et al., Dalton Trans. (2008) 2832: sp3 for C, low spin for Mn, Fe and Co.
COVALENT_RADII: Final = np.array((
    0,
    0.31, 0.28, 1.28, 0.96, 0.84, 0.76, 0.71, 0.66, 0.57, 0.58, 1.66, 1.41, 1.21, 1.11, 1.07, 1.05, 1.02, 1.06, 2.03,
    1.76, 1.7, 1.6, 1.53, 1.39, 1.39, 1.32, 1.26, 1.24, 1.32, 1.22, 1.22, 1.2, 1.19, 1.2, 1.2, 1.16, 2.2, 1.95, 1.9,
    1.75, 1.64, 1.54, 1.47, 1.46, 1.42, 1.39, 1.45, 1.44, 1.42, 1.39, 1.39, 1.38, 1.39, 1.4, 2.44, 2.15, 2.07, 2.04,
    2.03, 2.01, 1.99, 1.98, 1.98, 1.96, 1.94, 1.92, 1.92, 1.89, 1.9, 1.87, 1.87, 1.75, 1.7, 1.62, 1.51, 1.44, 1.41,
    1.36, 1.36, 1.32, 1.45, 1.46, 1.48, 1.4, 1.5, 1.5, 2.6, 2.21, 2.15, 2.06, 2, 1.96, 1.9, 1.87, 1.8, 1.69), np.float32)

# Daltons. IUPAC 2016. An element without a stable isotope has the mass of its longest-lived one.
MASSES: Final = np.array((
    0,
    1.008, 4.0026, 6.94, 9.01218, 10.81, 12.011, 14.007, 15.999, 18.9984, 20.1797, 22.9898, 24.305, 26.9815,
    28.085, 30.9738, 32.06, 35.45, 39.948, 39.0983, 40.078, 44.9559, 47.867, 50.9415, 51.9961, 54.938, 55.845,
    58.9332, 58.6934, 63.546, 65.38, 69.723, 72.63, 74.9216, 78.971, 79.904, 83.798, 85.4678, 87.62, 88.9058,
    91.224, 92.9064, 95.95, 97.9072, 101.07, 102.906, 106.42, 107.868, 112.414, 114.818, 118.71, 121.76, 127.6,
    126.904, 131.293, 132.905, 137.327, 138.905, 140.116, 140.908, 144.242, 144.913, 150.36, 151.964, 157.25,
    158.925, 162.5, 164.93, 167.259, 168.934, 173.054, 174.967, 178.49, 180.948, 183.84, 186.207, 190.23, 192.217,
    195.084, 196.967, 200.592, 204.38, 207.2, 208.98, 208.982, 209.987, 222.018, 223.02, 226.025, 227.028, 232.038,
    231.036, 238.029, 237.048, 244.064, 243.061, 247.07))

# sRGB. Jmol's colors, except that hydrogen has PyMOL's grey: Jmol's white would vanish on a white background.
COLORS: Final = np.frombuffer(bytes.fromhex(
    "ff1493 "
    "e6e6e6 d9ffff cc80ff c2ff00 ffb5b5 909090 3050f8 ff0d0d 90e050 b3e3f5 ab5cf2 8aff00 bfa6a6 f0c8a0 ff8000 ffff30 "
    "1ff01f 80d1e3 8f40d4 3dff00 e6e6e6 bfc2c7 a6a6ab 8a99c7 9c7ac7 e06633 f090a0 50d050 c88033 7d80b0 c28f8f 668f8f "
    "bd80e3 ffa100 a62929 5cb8d1 702eb0 00ff00 94ffff 94e0e0 73c2c9 54b5b5 3b9e9e 248f8f 0a7d8c 006985 c0c0c0 ffd98f "
    "a67573 668080 9e63b5 d47a00 940094 429eb0 57178f 00c900 70d4ff ffffc7 d9ffc7 c7ffc7 a3ffc7 8fffc7 61ffc7 45ffc7 "
    "30ffc7 1fffc7 00ff9c 00e675 00d452 00bf38 00ab24 4dc2ff 4da6ff 2194d6 267dab 266696 175487 d0d0e0 ffd123 b8b8d0 "
    "a6544d 575961 9e4fb5 ab5c00 754f45 428296 420066 007d00 70abfa 00baff 00a1ff 008fff 0080ff 006bff 545cf2 785ce3"),
    np.uint8).reshape(-1, 3)

NUMBERS: Final = {symbol: number for number, symbol in enumerate(SYMBOLS) if number} | {"D": 1, "T": 1}
_NUMBERS: Final = {symbol.lower(): number for symbol, number in NUMBERS.items()}

# Atom names of the Protein Data Bank and of water models. If they occur, CA is a carbon and HG a hydrogen.
_ATOM_NAMES: Final = frozenset("CB CG CZ CM HA HB HT HW OW OT OXT NZ NH".split())
_IONS: Final = {"NA": 11, "CL": 17, "MG": 12, "ZN": 30, "FE": 26, "MN": 25, "BR": 35, "LI": 3, "SE": 34, "SOD": 11,
                "CLA": 17, "POT": 19, "CAL": 20}
_MOST_LETTERS: Final = 3
_UNITED: Final = (13.019, 14.027, 15.035, 16.043)


def distinct(labels: Array) -> tuple[Array, Array]:
    codes = np.full(len(labels), -1, np.int32)
    values: list[Any] = []
    while (first := int(np.argmin(codes))) < len(labels) and codes[first] < 0:
        if len(values) == 64:
            unique, indices = np.unique(labels, return_inverse=True)
            return unique, indices.astype(np.int32).reshape(-1)
        codes[labels == labels[first]] = len(values)
        values.append(labels[first])
    return np.array(values, labels.dtype), codes


def categories(labels: Array) -> tuple[list[str], Array]:
    values, codes = distinct(labels)
    order = np.argsort(values)
    names = [f"{value:.9g}" if labels.dtype.kind == "f" else str(value) for value in values[order]]
    return names, np.argsort(order)[codes]


def _letters(label: str) -> str:
    found = re.match(r"[\d\s]*([A-Za-z]*)", label)
    return found.group(1) if found else ""


def _number(label: str, is_atom_name: bool) -> int:
    if label.strip().isdecimal():
        return int(label) if int(label) < len(SYMBOLS) else 0
    letters = _letters(label)
    if is_atom_name and letters.isupper() and len(letters) <= _MOST_LETTERS:
        return _IONS.get(letters, _NUMBERS[letters[0].lower()] if letters[0] in "HCNOSPD" else 0)
    return _NUMBERS.get(letters.lower(), 0)


def elements_of(labels: Array) -> tuple[Array | None, list[str]]:
    """Returns atomic numbers (0 if unknown, None if all are) and notes. `labels` are symbols in any case, also with digits or
    charges; PDB atom names; or atomic numbers."""
    values, codes = distinct(labels)
    names = [str(value) for value in values]
    if "A" in names and all(len(name) == 1 for name in names):
        return None, []
    is_atom_name = bool(_ATOM_NAMES.intersection(map(_letters, names)))
    numbers = [_number(name, is_atom_name) for name in names]
    if not any(numbers):
        return None, []
    notes = []
    unknown = [name for name, number in zip(names, numbers) if not number]
    if unknown:
        notes.append(f"no elements: {listed(unknown)}; their radius and color are unknown")
    if is_atom_name:
        read = [f"{name} is {SYMBOLS[number]}" for name, number in zip(names, numbers) if number]
        notes.append(f"labels are taken for names of atoms: {listed(read)}")
    return np.array(numbers, np.uint8)[codes], notes


def elements_of_masses(masses: Array) -> npt.NDArray[np.uint8]:
    """Returns 0 for unknown masses (daltons), and for all if none is heavier than helium. United atoms count as carbon."""
    away = np.abs(masses[:, None] - MASSES)
    away[:, 0] = np.inf
    nearest = away.argmin(axis=1)
    near = away[np.arange(len(masses)), nearest] <= np.where(masses < 20, 0.012, 0.07)
    united = (np.abs(masses[:, None] - _UNITED) <= 0.008).any(axis=1)
    numbers = np.where(united, 6, np.where(near, nearest, 0)).astype(np.uint8)
    return numbers if (numbers > 2).any() else np.zeros_like(numbers)


def listed(names: list[str], most: int = 8) -> str:
    return ", ".join(names[:most]) + (f" and {len(names) - most} more" if len(names) > most else "")
