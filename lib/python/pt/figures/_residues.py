from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Final

import numpy as np

from pt._fit import Array
from pt.figures._elements import NUMBERS, SYMBOLS, listed

VIRTUAL: Final = 255

AMINO_ACIDS: Final = frozenset(
    "ALA ARG ASN ASP CYS GLN GLU GLY HIS ILE LEU LYS MET PHE PRO SER THR TRP TYR VAL MSE SEC ASX GLX ACE NME NMA NH2 "
    "HID HIE HIP HSD HSE HSP HISA HISB HISD HISE HISH HISP CYX CYM CYS2 CYSH ASH ASPH GLH GLUH LYN LYSH LSN ARGN MLY "
    "SEP TPO PTR HYP PCA CSO".split())
NUCLEOTIDES: Final = frozenset(
    "A C G U I T N DA DC DG DT DU DI ADE CYT GUA THY URA RA RC RG RU".split()) | frozenset(
    f"{prefix}{base}{end}" for prefix in ("D", "R", "") for base in "ACGTU" for end in "35N")
WATERS: Final = frozenset("HOH WAT SOL H2O DOD TIP TIP2 TIP3 TIP4 TIP5 TP3 TP4 TP5 T3P T4P T5P TIP3P TIP4P SPC SPCE HO4 HO5 "
                          "OPC".split())
_NUMBERS: Final = {symbol.upper(): number for symbol, number in NUMBERS.items()}
_ALKALI_AND_HALIDES: Final = frozenset((3, 11, 19, 37, 55, 12, 20, 38, 56, 9, 17, 35, 53))
_IONS: Final = {**{symbol: _NUMBERS[symbol] for symbol in (
    "LI NA K RB CS MG CA SR BA ZN FE MN CU NI CO CD HG AG AU AL PB TL CR V Y LA CE EU GD TB YB LU PT F CL BR I").split()},
    "SOD": 11, "CLA": 17, "POT": 19, "CAL": 20, "CES": 55, "RUB": 37, "LIT": 3, "BAR": 56, "IOD": 53, "CIO": 55, "CIM": 17,
    "CIP": 11, "IB": 35}
_CHARGED: Final = frozenset(("ION", "IONS", "IB"))
_TWO_LETTERS: Final = frozenset("CL BR FE ZN MG MN CU SI SE LI AL AG AU PT RU RH IR TI ZR MO AS".split())
_ONE_LETTER: Final = frozenset("HCNOPSFBID")
_POLYMERS: Final = frozenset("HCNOPSD")
_AUTODOCK: Final = {"A": 6, "OA": 8, "NA": 7, "SA": 16, "HD": 1, "HS": 1, "NS": 7, "OS": 8, "G": 6, "GA": 6, "J": 6, "Q": 6,
                    "Z": 6, "CG0": 6, "CG1": 6, "G0": VIRTUAL, "G1": VIRTUAL, "W": VIRTUAL}
_SITE: Final = re.compile(r"(M|MW|EP|EPW|EP\d|LP[A-Z]?|L\d?|OM|MP|IW|XX|DUM|VS|VW)\d*")
_ANYWHERE: Final = re.compile(r"(MW|EPW?|LP[A-Z]?|DUM|DU)\d*")


def element_of(name: str, residue: str) -> int:
    letters = re.sub(r"[^A-Za-z]", "", name)
    capitals, kind = letters.upper(), re.sub(r"[-+\d]", "", residue).upper()
    if not letters:
        return 0
    if capitals in _IONS and (kind in _CHARGED or _IONS[capitals] == _IONS.get(kind)):
        return _IONS[capitals]
    is_water, residue = residue.upper() in WATERS, residue.upper()
    if _ANYWHERE.fullmatch(name.upper()) or (is_water and _SITE.fullmatch(name.upper())):
        return VIRTUAL
    if is_water or is_polymer(residue):
        if capitals.startswith("SE") and residue in ("MSE", "SEC"):
            return 34
        if capitals[0] in "ML":
            return VIRTUAL
        return _NUMBERS[capitals[0]] if capitals[0] in _POLYMERS else 0
    if capitals == "WAT":
        return 8
    is_symbol = len(letters) > 1 and letters[0].isupper() and letters[1].islower() and capitals[:2] in _NUMBERS
    if is_symbol or capitals[:2] in _TWO_LETTERS:
        return _NUMBERS[capitals[:2]]
    return _NUMBERS.get(capitals[0], 0) if len(letters) == 1 or capitals[0] in _ONE_LETTER else 0


def is_free_ion(residue: str) -> bool:
    return _IONS.get(re.sub(r"[-+\d]", "", residue).upper(), 0) in _ALKALI_AND_HALIDES or residue in _CHARGED


def is_polymer(residue: str) -> bool:
    return residue in AMINO_ACIDS or residue in NUCLEOTIDES or (len(residue) == 4 and residue[0] in "NC" and residue[1:] in AMINO_ACIDS)


def autodock_element(kind: str) -> int:
    return _AUTODOCK.get(kind.upper(), _NUMBERS.get(kind.upper(), 0))


def are_beads(names: Array, residues: Array) -> bool:
    found = set(np.unique(names).tolist())
    if "GL1" in found and "PO4" in found:
        return True
    if "BB" in found:
        return not AMINO_ACIDS.isdisjoint(np.unique(residues[names == "BB"]).tolist())
    return "W" in found and not {"W", "WN"}.isdisjoint(np.unique(residues[names == "W"]).tolist())


@dataclass
class Guess:
    elements: Array
    notes: list[str]


def elements_by_residue(names: Array, residues: Array, wanted: Array | None = None) -> Guess:
    pairs = np.char.add(np.char.add(names, " of "), residues)
    chosen = pairs if wanted is None else pairs[wanted]
    values, codes = np.unique(chosen, return_inverse=True)
    split = [value.rpartition(" of ") for value in values.tolist()]
    numbers = np.array([element_of(name, residue) for name, _, residue in split], np.uint8)
    elements = np.zeros(len(names), np.uint8)
    elements[slice(None) if wanted is None else wanted] = numbers[codes.reshape(-1)]
    notes = []
    if len(numbers) and (numbers != VIRTUAL).any():
        odd = [f"{value.removesuffix(' of ')} is {SYMBOLS[number]}"
               for value, (name, *_), number in zip(values.tolist(), split, numbers.tolist())
               if 0 < number < VIRTUAL and len(name) > 1 and name[:2].upper() in _NUMBERS]
        notes.append("elements are guessed from the names of residues and atoms" + (f": {listed(odd, 4)}" if odd else ""))
    if unknown := [value.removesuffix(" of ") for value in values[numbers == 0].tolist()]:
        notes.append(f"no elements are known of {listed(unknown, 4)}: a ball of mean size stands for each")
    return Guess(elements, notes)
