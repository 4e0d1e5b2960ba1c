from __future__ import annotations

import difflib
import operator
import re
from collections.abc import Callable, Mapping
from typing import Any, Final

import numpy as np
import numpy.typing as npt

from pt._fit import Array
from pt.figures._elements import SYMBOLS
from pt.figures._errors import DataError
from pt.figures._neighbours import pairs_within
from pt.figures._particles import Particles
from pt.figures._residues import AMINO_ACIDS, NUCLEOTIDES, WATERS

Mask = npt.NDArray[np.bool_]

COMPARISONS: Final[dict[str, Callable[[Any, Any], Any]]] = {
    "<=": operator.le, ">=": operator.ge, "==": operator.eq, "!=": operator.ne, "<": operator.lt, ">": operator.gt}
OPERATORS: Final = ("and", "or", "not", "within", "of")
OTHER_NAMES: Final = {"resi": "resid", "resn": "resname", "residue": "resid", "symbol": "element", "elem": "element"}
RESIDUES: Final = {"water": WATERS, "protein": AMINO_ACIDS, "nucleic": NUCLEOTIDES}
_WORD: Final = re.compile(r'\s*(?:"([^"]*)"|(<=|>=|==|!=|[()<>,])|([^\s()<>=!,"]+))')
_RANGE: Final = re.compile(r"(-?[\d.]+)[-:](-?[\d.]+)")


def column(particles: Particles, name: str) -> Array:
    known = {"radius": particles.radii, "type": particles.types, "element": particles.elements}
    values = known.get(name) if name not in particles.columns else None
    if values is None:
        return particles.column(name)
    if name == "element":
        return np.array(SYMBOLS)[values]
    return values


def chosen(particles: Particles, text: str, option: str = "where") -> Mask:
    """`text` is like "resname XK2 or within 5 of (chain A and z > 3)". Raises ValueError, with the word and its position from 1."""
    return _Reader(particles, text, option).all()


def masked(particles: Particles, key: str, option: str) -> Mask:
    kind = "type" if particles.elements is None else "element"
    return chosen(particles, key if is_selection(key) else f'{kind} "{key}"', option)


def is_selection(text: str) -> bool:
    """Other texts are names of types or elements."""
    return bool(re.search(r"[\s()<>]", text.strip())) or text.strip() in (*RESIDUES, "all")


def rules(given: Any) -> tuple[Any, dict[str, Any], dict[str, Any]]:
    """Splits a mapping, or "BASE,O=1,chain A=2", into the base or None, values of types, and values of selections."""
    base, pairs = None, given
    if not isinstance(given, Mapping):
        if not isinstance(given, str) or "=" not in given:
            return given, {}, {}
        parts = given.split(",")
        base = ",".join(part for part in parts if "=" not in part).strip() or None
        pairs = dict(part.rsplit("=", 1) for part in parts if "=" in part)
    pairs = {str(key).strip(): value.strip() if isinstance(value, str) else value for key, value in pairs.items()}
    return (base, {key: value for key, value in pairs.items() if not is_selection(key)},
            {key: value for key, value in pairs.items() if is_selection(key)})


class _Reader:
    """Recursive descent. `at` is the index of the next word."""

    def __init__(self, particles: Particles, text: str, option: str) -> None:
        self.particles, self.text, self.option, self.at = particles, text, option, 0
        self.words: list[tuple[str, int, bool]] = []
        place = 0
        while place < len(text.rstrip()):
            found = _WORD.match(text, place)
            if found is None:
                raise self.error(len(text[:place]) + len(text[place:]) - len(text[place:].lstrip()), text[place:].strip()[0],
                                 "no word begins so; == compares")
            quoted = found[1] is not None
            self.words.append((found[1] if quoted else found[2] or found[3], found.end() - len(found[0].lstrip()), quoted))
            place = found.end()

    def error(self, place: int, word: str, rule: str) -> ValueError:
        return ValueError(f"{self.option} = {self.text!r}: position {place + 1}, {word!r}: {rule}")

    def fail(self, rule: str) -> ValueError:
        word, place, _ = self.words[self.at] if self.at < len(self.words) else ("the end", len(self.text), False)
        return self.error(place, word, rule)

    def peek(self) -> str:
        return self.words[self.at][0] if self.at < len(self.words) and not self.words[self.at][2] else ""

    def takes(self, word: str) -> bool:
        found = self.peek().lower() == word
        self.at += found
        return found

    def all(self) -> Mask:
        result = self.any_of()
        if self.at < len(self.words):
            raise self.fail("must be and, or, or the end")
        return result

    def any_of(self) -> Mask:
        result = self.all_of()
        while self.takes("or"):
            result = result | self.all_of()
        return result

    def all_of(self) -> Mask:
        result = self.one()
        while self.takes("and"):
            result = result & self.one()
        return result

    def one(self) -> Mask:
        if self.takes("not"):
            return ~self.one()
        if self.takes("("):
            result = self.any_of()
            if not self.takes(")"):
                raise self.fail("must be and, or, or )")
            return result
        if self.takes("within"):
            return self.within()
        if self.takes("all"):
            return np.ones(len(self.particles), np.bool_)
        if self.peek() in RESIDUES and "resname" in self.particles.columns:
            names = RESIDUES[self.peek()]
            self.at += 1
            return np.isin(np.char.upper(self.particles.columns["resname"].astype(str)), list(names))
        return self.compared()

    def within(self) -> Mask:
        try:
            distance = float(self.peek())
        except ValueError:
            distance = -1.0
        if not 0.0 < distance < np.inf:
            raise self.fail("must be a distance > 0")
        self.at += 1
        if not self.takes("of"):
            raise self.fail("must be of")
        result = self.one()
        near = np.ones(len(result), np.bool_)
        positions, cell = self.particles.positions, self.particles.cell
        if cell is None and result.any():
            places = positions[result]
            near = ((positions >= places.min(axis=0) - distance) & (positions <= places.max(axis=0) + distance)).all(axis=1)
        rows = np.flatnonzero(near)
        pairs = pairs_within(positions[rows], distance, cell)
        first, second = rows[pairs.first], rows[pairs.second]
        around = result.copy()
        around[second[result[first]]] = True
        around[first[result[second]]] = True
        return around

    def compared(self) -> Mask:
        values, name = self.named()
        sign = self.peek()
        if sign in COMPARISONS:
            self.at += 1
            if self.at >= len(self.words) or self.peek() in (*COMPARISONS, *OPERATORS, "(", ")"):
                raise self.fail("must be a number or a word")
            limit: Any = self.words[self.at][0]
            if values.dtype.kind in "fiub":
                limit = self.number(name)
            elif sign not in ("==", "!="):
                self.at -= 1
                raise self.fail(f"must be == or !=, because {name} has words")
            self.at += 1
            return np.asarray(COMPARISONS[sign](values, limit), np.bool_)
        result, start = np.zeros(len(values), np.bool_), self.at
        while self.at < len(self.words) and self.peek() not in (*OPERATORS, *COMPARISONS, "(", ")"):
            if not self.takes(","):
                result |= self.equal(values, name)
                self.at += 1
        if self.at == start:
            raise self.fail(f"must be a value of {name}, or one of {', '.join(COMPARISONS)}")
        return result

    def named(self) -> tuple[Array, str]:
        start = self.at
        ends = [k for k in range(start + 1, min(start + 6, len(self.words))) if self.words[k][0] in COMPARISONS]
        if ends and start < len(self.words):
            name = self.text[self.words[start][1]:self.words[ends[0]][1]].strip().strip('"')
            if name in self.particles.columns:
                self.at = ends[0]
                return self.particles.columns[name], name
        if self.at >= len(self.words) or self.peek() in (*COMPARISONS, *OPERATORS, ")", ","):
            raise self.fail("must be a column, not, within, all or (")
        name = self.words[self.at][0]
        if name == "index" and name not in self.particles.columns:
            self.at += 1
            return np.arange(len(self.particles)), name
        known = name if name in self.particles.columns else OTHER_NAMES.get(name, name)
        try:
            values = np.asarray(column(self.particles, known))
        except DataError as error:
            raise self.fail(str(error).removeprefix(f"{self.particles.name}: ")) from None
        self.at += 1
        return values if values.dtype.kind in "fiub" else values.astype(str), known

    def number(self, name: str) -> float:
        try:
            return float(self.words[self.at][0])
        except ValueError:
            raise self.fail(f"must be a number, because {name} has numbers") from None

    def equal(self, values: Array, name: str) -> Mask:
        word, _, quoted = self.words[self.at]
        if values.dtype.kind in "fiub":
            found = _RANGE.fullmatch(word)
            if found is None:
                return np.asarray(values == self.number(name), np.bool_)
            first, last = map(float, found.groups())
            return np.asarray((values >= first) & (values <= last), np.bool_)
        result = np.asarray(values == word, np.bool_)
        if not result.any() and not quoted and difflib.get_close_matches(word.lower(), OPERATORS, 1, 0.75):
            raise self.fail(f"is no {name}; must be and, or, or the end")
        return result
