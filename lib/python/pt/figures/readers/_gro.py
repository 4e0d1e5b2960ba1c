from __future__ import annotations

from typing import Any, Final

import numpy as np
import numpy.typing as npt

from pt.figures._cell import Cell
from pt.figures._errors import DataError
from pt.figures._particles import Table
from pt.figures.readers._atoms import atoms_table
from pt.figures.readers._frames import TextFrames
from pt.figures.readers._rows import are_numbers, is_number, shown

ANGSTROMS: Final = 10.0
_NAMES: Final = {"resid": slice(0, 5), "resname": slice(5, 10), "name": slice(10, 15)}
_START: Final = 20
_BOX: Final = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 0), (1, 2), (2, 0), (2, 1))


class Gro(TextFrames):
    lines_after = 1

    def head(self) -> int | None:
        lines = self.lines
        title = lines.line()
        count = lines.line()
        if count is None:
            if title is None or not title.strip():
                return None
            raise lines.refuse("the file ends after a title: it was cut short")
        if not count.strip().isdecimal():
            if not f"{title}{count}".strip():
                return None
            raise lines.refuse(f"{shown(count)}: must be the number of atoms")
        return int(count)

    def body(self, count: int) -> Table:
        first = self.lines.number + 1
        rows: list[bytes] = []
        while len(rows) < count:
            data, height = self.lines.block(count - len(rows))
            if not height:
                raise self.lines.refuse(f"the file ends after {len(rows):,} of {count:,} particles: it was cut short")
            rows += data.removesuffix(b"\n").split(b"\n")
        columns = self._columns(np.array(rows, "S"), first)
        positions = ANGSTROMS * np.stack([columns.pop(axis) for axis in "xyz"], 1)
        return atoms_table(positions, columns, cell=self._cell())

    def _columns(self, rows: npt.NDArray[np.bytes_], first: int) -> dict[str, npt.NDArray[Any]]:
        letters = rows.view(np.uint8).reshape(len(rows), -1)
        points = [place for place in range(_START, letters.shape[1]) if letters[0, place] == ord(".")]
        if len(points) < 3:
            raise self.lines.refuse(f"{shown(rows[0].decode('utf-8', 'replace'))}: must have three coordinates from column 21")
        width = points[1] - points[0]
        axes = ("x", "y", "z", "vx", "vy", "vz")[:6 if len(points) >= 6 else 3]
        fields = {**_NAMES, **{axis: slice(_START + i * width, _START + (i + 1) * width) for i, axis in enumerate(axes)}}
        columns: dict[str, npt.NDArray[Any]] = {}
        for name, place in fields.items():
            part = np.ascontiguousarray(letters[:, place])
            words = part.view(f"S{part.shape[1]}").reshape(-1)
            if name in ("name", "resname"):
                columns[name] = np.char.strip(np.char.decode(words, "utf-8", "replace"))
                continue
            try:
                columns[name] = words.astype(np.int64 if name == "resid" else np.float64)
            except ValueError:
                if name not in "xyz":
                    continue
                texts = [word.decode("utf-8", "replace").strip() for word in words]
                row = next(row for row, text in enumerate(texts) if not text or not is_number(text))
                raise DataError(f"{self.lines.name}:{first + row}: {name} = {texts[row]!r}: must be a number of {width} "
                                "columns") from None
        return columns

    def _cell(self) -> Cell | None:
        line = self.lines.line() or ""
        points = [place for place, letter in enumerate(line) if letter == "."]
        width = points[1] - points[0] if len(points) > 1 else 0
        words = line.split()
        if len(words) < 3 <= len(points):  # numbers may touch
            words = [line[start:start + width] for start in range(0, len(line.rstrip()), width)]
        if len(words) not in (3, 9) or not are_numbers(word.strip() for word in words):
            raise self.lines.refuse(f"{shown(line)}: the cell must have 3 or 9 numbers")
        vectors = np.zeros((3, 3))
        for place, word in zip(_BOX, words):
            vectors[place] = ANGSTROMS * float(word)
        return Cell.of(vectors)
