from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

from pt.figures._errors import DataError
from pt.figures._particles import Table
from pt.figures.readers._lines import Lines


class Frames(Protocol):
    """Frames of a source that have particles.

    current  index of the default frame; None: the last
    models   model numbers of a structure; None if frames are not models
    """

    name: str
    current: int | None
    models: list[int] | None

    def count(self) -> int: ...

    def has(self, index: int) -> bool:
        """Reads only as far as necessary. `index` is >= 0."""

    def read(self, index: int) -> Table:
        ...


class Listed:
    def __init__(self, name: str, count: int, read: Callable[[int], Table], current: int | None = None,
                 models: list[int] | None = None) -> None:
        self.name = name
        self.current = current
        self.models = models
        self.read = read
        self._count = count

    def count(self) -> int:
        return self._count

    def has(self, index: int) -> bool:
        return index < self._count


def one_frame(name: str, read: Callable[[], Table]) -> Listed:
    return Listed(name, 1, lambda index: read())


class TextFrames:
    """A format whose frames have a header with the number of particles, and `lines_after` lines after the particles."""

    lines_after = 0

    current: int | None = None
    models: list[int] | None = None

    def __init__(self, lines: Lines) -> None:
        self.lines = lines
        self.name = lines.name
        self.notes: list[str] = []
        self._empty = 0
        self._places = [lines.place()]
        self._is_whole = False

    def head(self) -> int | None:
        raise NotImplementedError

    def body(self, count: int) -> Table:
        raise NotImplementedError

    def count(self) -> int:
        while self._pass():
            pass
        return len(self._places) - 1

    def has(self, index: int) -> bool:
        while len(self._places) <= index + 1 and self._pass():
            pass
        return len(self._places) > index + 1

    def _pass(self) -> bool:
        if self._is_whole:
            return False
        index = len(self._places) - 1
        self.lines.go_to(self._places[-1])
        try:
            count = self._next()
        except DataError:
            if index:
                self.read(index - 1)
            raise
        if count is None:
            self._is_whole = True
            return False
        passed = self.lines.skip(count + self.lines_after)
        if passed < count + self.lines_after:
            before = f"; frame {index - 1} is whole" if index else ""
            raise self.lines.refuse(f"the file ends after {passed:,} of {count:,} particles of frame {index}: it was cut "
                                    f"short{before}")
        self._places.append(self.lines.place())
        return True

    def _next(self) -> int | None:
        while (count := self.head()) == 0:
            self._empty += 1
            self.lines.skip(self.lines_after)
            self._places[-1] = self.lines.place()
        return count

    def read(self, index: int) -> Table:
        lines = self.lines
        lines.go_to(self._places[index])
        is_new = len(self._places) == index + 1
        count = self._next() if is_new else self.head()
        if count is None:
            raise DataError(f"{self.name}: there is no frame {index}: the file has {index}")
        table = self.body(count)
        if is_new:
            self._places.append(lines.place())
        table.notes += self.notes
        if self._empty:
            table.notes.append(f"frames that have no particles are not counted ({self._empty:,})")
        return table
