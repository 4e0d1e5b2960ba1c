"""LAMMPS' data files (docs.lammps.org/read_data.html)."""

from __future__ import annotations

import re
from typing import Final

import numpy as np

from pt._fit import Array
from pt.figures._cell import Cell
from pt.figures._elements import SYMBOLS, elements_of_masses, listed
from pt.figures._errors import DataError
from pt.figures._particles import Bonds, Table
from pt.figures.readers._atoms import atoms_table
from pt.figures.readers._lines import Lines
from pt.figures.readers._rows import Layout, Rows, are_numbers, is_number, number, shown

CONTENT: Final = re.compile(rb"(?m)^\s*\d+\s+atoms\s*(?:#.*)?$")
STYLES: Final = {style: columns.split() for style, columns in {
    "atomic": "id type x y z", "charge": "id type q x y z", "molecular": "id mol type x y z", "full": "id mol type q x y z",
    "sphere": "id type diameter density x y z", "ellipsoid": "id type is_ellipsoid density x y z",
    "dipole": "id type q x y z mux muy muz", "spin": "id type x y z spx spy spz sp", "peri": "id type volume density x y z",
    "line": "id mol type is_line density x y z", "tri": "id mol type is_triangle density x y z",
    "body": "id type is_body mass x y z",
    "electron": "id type q spin eradius x y z", "dpd": "id type theta x y z", "mdpd": "id type rho x y z",
    "edpd": "id type temperature cv x y z", "tdpd": "id type x y z", "sph": "id type rho esph cv x y z",
    "template": "id mol index atom type x y z", "dielectric": "id mol type q x y z", "hybrid": "id type x y z",
    "wavepacket": "id type q spin eradius etag cs_re cs_im x y z",
    "smd": "id type mol volume mass kernel_radius contact_radius x0 y0 z0 x y z",
    "mesont": "id mol type tube mass radius length buckling_type x y z"}.items()}
STYLES.update(bond=STYLES["molecular"], angle=STYLES["molecular"], amoeba=STYLES["full"])
_OF_COUNT: Final = {5: ("atomic",), 6: ("charge", "molecular"), 7: ("full", "sphere")}
_SECTION: Final = re.compile(r"[A-Z][A-Za-z]+( [A-Z]?[A-Za-z]+)* ?( Coeffs)?")
_HEADER: Final = re.compile(r"(\d+)\s+([a-z][a-z ]*)")
_BOUNDS: Final = re.compile(r"(.+?)\s+(xlo xhi|ylo yhi|zlo zhi|xy xz yz|avec|bvec|cvec|abc origin)")
_IMAGES: Final = ("ix", "iy", "iz")
_SHAPES: Final = ("shapex", "shapey", "shapez")
_TURN: Final = ("quatw", "quati", "quatj", "quatk")
_COMMENT: Final = re.compile(rb"#[^\n]*")
_BLANK: Final = re.compile(rb"[ \t\r]*(#[^\n]*)?\n")
_MOST_BLANK: Final = 4096
_PEEKED: Final = 1 << 14


class LammpsData:
    def __init__(self, lines: Lines, style: str | None) -> None:
        if style is not None and style not in STYLES:
            raise DataError(f"atom_style = {style!r}: must be one of {listed(sorted(STYLES), 40)}")
        self.lines = lines
        self.style = style
        self.counts: dict[str, int] = {}
        self.box: dict[str, list[float]] = {}
        self.masses: dict[str, float] = {}
        self.names: dict[str, str] = {}
        self.notes: list[str] = []
        self.columns: dict[str, Array] = {}
        self.bonds: dict[str, Array] = {}
        self.shapes: dict[str, Array] = {}
        self._read()

    def _read(self) -> None:
        self.lines.line()
        while (line := self.lines.line()) is not None:
            text, _, hint = line.partition("#")
            text = text.strip()
            if text[:1].isupper() and _SECTION.fullmatch(text):
                self._section(text, hint.strip())
            elif self.columns:
                continue
            elif found := _BOUNDS.fullmatch(text):
                self.box[found[2]] = self._numbers(found[1], 2 if "lo" in found[2] else 3)
            elif found := _HEADER.fullmatch(text):
                self.counts[found[2].strip()] = int(found[1])

    def _section(self, name: str, hint: str) -> None:
        if name == "Atoms":
            self._atoms(hint)
        elif name == "Masses":
            for row in self._few_rows("atom types", "masses", with_comments=True):
                if len(row) < 2 or not is_number(row[1]):
                    raise self.lines.refuse(f"{shown(' '.join(row))}: must be a type and its mass")
                self.masses[row[0]] = number(row[1])
                self.names.setdefault(row[0], row[2] if len(row) > 2 else "")
        elif name == "Atom Type Labels":
            rows = self._few_rows("atom types", "labels")
            self.names.update((row[0], row[1]) for row in rows if len(row) > 1)
        elif name == "Bonds":
            self.bonds = self._rows("bonds", ["id", "type", "first", "second"])
        elif name == "Ellipsoids":
            self.shapes = self._rows("ellipsoids", ["id", *_SHAPES, *_TURN], 4)

    def _few_rows(self, counted: str, what: str, with_comments: bool = False) -> list[list[str]]:
        rows: list[list[str]] = []
        count = self.counts.get(counted, 0)
        while len(rows) < count:
            line = self.lines.line()
            if line is None:
                raise self.lines.refuse(f"the file ends after {len(rows):,} of {count:,} {what}: it was cut short")
            words = (line.replace("#", " ") if with_comments else line.partition("#")[0]).split()
            if words:
                rows.append(words)
        return rows

    def _rows(self, what: str, names: list[str], least: int | None = None) -> dict[str, Array]:
        """The first `least` columns are numbers, except labels of types. Further columns may have words."""
        least = least or len(names)
        rows = Rows(self.lines, Layout(names, [name for name in names[:least] if name != "type"], least=least, is_table=True,
                                       rows=what))
        rows.read(self.counts.get(what, 0), _COMMENT)
        return rows.columns()

    def _numbers(self, text: str, count: int) -> list[float]:
        if len(text.split()) != count or not are_numbers(text.split()):
            raise self.lines.refuse(f"{shown(text)}: must be {count} numbers")
        return [number(word) for word in text.split()]

    def _atoms(self, hint: str) -> None:
        lines = self.lines
        while _BLANK.match(lines.peek(_MOST_BLANK)):
            lines.line()
        start = lines.peek(_PEEKED)
        whole = start if len(start) < _PEEKED else start.rpartition(b"\n")[0]
        rows = _COMMENT.sub(b" ", whole).decode("utf-8", "replace").split("\n")
        some = [words for line in rows[:100] if (words := line.split())][:self.counts.get("atoms", 0)]
        if not some:
            return
        names = STYLES[self._style(some, hint)]
        width, least = len(some[0]), len(names)
        if width < least:
            raise DataError(f"{lines.name}:{lines.number + 1}: {shown(' '.join(some[0]))}: has {width} columns; atom_style "
                            f"{self.style} has {least}: {' '.join(names)}")
        if width >= least + 3 and all(is_whole(word) for word in some[0][-3:]):
            names = [*names, *(f"column {i}" for i in range(least + 1, width - 2)), *_IMAGES]
        self.columns = self._rows("atoms", names, least)

    def _style(self, some: list[list[str]], hint: str) -> str:
        hint = hint.split()[0] if hint else ""
        if self.style is None and hint in STYLES:
            self.style = hint
        if self.style is not None:
            return self.style
        width = len(some[0])
        has_images = width >= 8 and all(is_whole(word) for row in some for word in row[-3:])
        choices = _OF_COUNT.get(width - 3 * has_images, ())
        types = self.counts.get("atom types", 0)
        if choices and len(choices) > 1:
            has_molecules = all(len(row) > 2 and is_whole(row[2]) and 1 <= int(row[2]) <= types for row in some)
            choices = (choices[0],) if has_molecules == (width - 3 * has_images == 7) else choices[1:]
            if "sphere" in choices and (self.counts.get("bonds") or any(row[2].startswith("-") for row in some)):
                choices = ()
        if not choices:
            raise DataError(f"{self.lines.name}:{self.lines.number + 1}: the atom style is not known: {width} columns, like "
                            f"{shown(' '.join(some[0]))}, and no hint after Atoms: atom_style can give it")
        self.style = choices[0]
        self.notes.append(f"the atom style is taken to be {self.style}, by the columns")
        return self.style

    def cell(self) -> Cell | None:
        box = self.box
        if "avec" in box:
            return Cell.of([box[key] for key in ("avec", "bvec", "cvec")], box.get("abc origin", [0.0, 0.0, 0.0]))
        bounds = [box.get(f"{axis}lo {axis}hi", [-0.5, 0.5]) for axis in "xyz"]
        (x, y, z), (xy, xz, yz) = ([high - low for low, high in bounds], box.get("xy xz yz", [0.0, 0.0, 0.0]))
        return Cell.of([[x, 0, 0], [xy, y, 0], [xz, yz, z]], [low for low, _ in bounds]) if box else None

    def table(self) -> Table:
        if not self.columns:
            raise DataError(f"{self.lines.name}: has no atoms")
        columns = dict(self.columns)
        positions = np.stack([columns.pop(axis) for axis in "xyz"], 1)
        if self.shapes:
            self._put_shapes(columns)
        elements = self._elements(columns)
        return atoms_table(positions, columns, elements, self.cell(), self._pairs(columns["id"]), self.notes)

    def _elements(self, columns: dict[str, Array]) -> Array | None:
        types, codes = np.unique(columns["type"], return_inverse=True)
        kinds = types.astype(str).tolist()
        names = [self.names.get(kind, "") or kind for kind in kinds]
        if not self.masses:
            return None
        masses = np.array([self.masses.get(kind, 0.0) for kind in kinds])
        numbers = elements_of_masses(masses)
        if not numbers.any():
            return None
        said = [f"{name} is {SYMBOLS[each]}" for name, each in zip(names, numbers.tolist()) if each]
        self.notes.append(f"elements follow from masses: type {listed(said, 8)}")
        if unknown := [f"{name} ({mass:g})" for name, each, mass in zip(names, numbers, masses) if not each]:
            self.notes.append(f"no elements: types {listed(unknown)}, by their masses; a ball of mean size stands for each")
        elements: Array = numbers[codes.reshape(-1)]
        return elements

    def _pairs(self, ids: Array) -> Bonds | None:
        if not self.counts.get("bonds"):
            return None
        if not self.bonds:
            self.notes.append(f"the header has {self.counts['bonds']:,} bonds, but there is no section Bonds")
            return None
        return Bonds.of(np.stack([self._atoms_of("Bonds", self.bonds[end], ids) for end in ("first", "second")], axis=1))

    def _put_shapes(self, columns: dict[str, Array]) -> None:
        chosen = self._atoms_of("Ellipsoids", self.shapes["id"], columns["id"])
        for name in _SHAPES:
            columns[name] = np.zeros(len(columns["id"]))
            columns[name][chosen] = self.shapes[name]

    def _atoms_of(self, section: str, numbers: Array, ids: Array) -> Array:
        order = np.argsort(ids, kind="stable")
        found: Array = order[np.searchsorted(ids, numbers, sorter=order).clip(max=len(ids) - 1)]
        wrong = ids[found] != numbers
        if wrong.any():
            raise DataError(f"{self.lines.name}: {section}: atom {numbers[wrong][0]:g}: must be the number of an atom")
        return found


def is_whole(word: str) -> bool:
    return word.lstrip("+-").isdecimal()


def read_lammps_data(lines: Lines, style: str | None) -> Table:
    return LammpsData(lines, style).table()
