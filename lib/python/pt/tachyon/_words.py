from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from typing import NoReturn

from pt._vectors import Triple


class Words:
    def __init__(self, lines: Iterable[str], name: str) -> None:
        self._lines: Iterator[str] = iter(lines)
        self._name = name
        self._row: list[str] = []
        self._next = 0
        self._row_line = 0
        self._line = 1

    @property
    def line(self) -> int:
        return self._line

    def place(self) -> str:
        return f"{self._name}:{self._line}"

    def refuse(self, what: str) -> NoReturn:
        raise ValueError(f"{self.place()}: {what}")

    def peek(self) -> str | None:
        while self._next == len(self._row):
            line = next(self._lines, None)
            if line is None:
                return None
            self._row_line += 1
            self._row, self._next = line.split(), 0
            for index, word in enumerate(self._row):
                if word.startswith("#"):
                    del self._row[index:]
                    break
        return self._row[self._next]

    def word(self, what: str) -> str:
        word = self.peek()
        if word is None:
            self.refuse(f"the file ends where {what} must be: it was cut short")
        self._line = self._row_line
        self._next += 1
        return word

    def keyword(self, what: str) -> str:
        return self.word(what).upper()

    def expect(self, *keywords: str) -> None:
        for keyword in keywords:
            found = self.word(keyword)
            if found.upper() != keyword:
                self.refuse(f'"{found}" must be {keyword}')

    def take_if(self, keyword: str) -> bool:
        found = (self.peek() or "").upper() == keyword
        if found:
            self.word(keyword)
        return found

    def number(self, what: str, *, least: float = -math.inf, positive: bool = False) -> float:
        word = self.word(what)
        try:
            value = float(word) if "_" not in word else math.nan
        except ValueError:
            value = math.nan
        if not math.isfinite(value):
            self.refuse(f'{what} = "{word}": must be a finite number')
        if value < least or (positive and value <= 0.0):
            self.refuse(f"{what} = {word}: must " + ("be above 0" if positive else "not be negative"))
        return value

    def named(self, keyword: str, *, least: float = -math.inf, positive: bool = False) -> float:
        self.expect(keyword)
        return self.number(keyword, least=least, positive=positive)

    def size(self, what: str) -> int:
        value = self.number(what)
        if value != int(value) or not 1 <= value < 2**32:
            self.refuse(f"{what} = {value:g}: must be a whole number from 1 to 2^32 - 1")
        return int(value)

    def vector(self, keyword: str) -> Triple:
        self.expect(keyword)
        return self.point(keyword)

    def point(self, what: str) -> Triple:
        return self.number(what), self.number(what), -self.number(what)

    def direction(self, keyword: str) -> Triple:
        value = self.vector(keyword)
        if not any(value):
            self.refuse(f"{keyword}: must not be 0 0 0")
        return value

    def color(self, keyword: str) -> Triple:
        return self.number(keyword, least=0.0), self.number(keyword, least=0.0), self.number(keyword, least=0.0)
