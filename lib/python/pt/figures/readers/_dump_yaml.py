from __future__ import annotations

import re

from pt.figures._cell import Cell
from pt.figures.readers._lammps import HEAD_ENDS, LammpsDump, cell_within
from pt.figures.readers._rows import are_numbers, number, shown


class DumpYaml(LammpsDump):
    marks = re.compile(rb"- \[|[\],]")

    def head(self) -> int | None:
        lines, count, names, periodic = self.lines, None, [], [True] * 3
        bounds: list[list[float]] = []
        key = ""
        while (line := lines.line()) is not None:
            words = re.split(r"[\s,\[\]]+", line.partition(":")[2].strip(" []"))
            if not line.startswith((" ", "-")):
                key = line.partition(":")[0]
            if key == "natoms" and words[0].isdecimal():
                count = int(words[0])
            elif key == "boundary":
                if len(words) < 6:
                    raise lines.refuse(f"{shown(line)}: must have six boundaries, like p, p, p, p, p, p")
                periodic = [word.startswith("p") for word in words[:6:2]]
            elif key == "keywords":
                names = [word for word in words if word]
            elif key == "box" and line.lstrip().startswith("-"):
                bounds.append(self._bounds(line))
            elif key == "data":
                if count is None or not names:
                    raise lines.refuse("data: natoms and keywords must come before it")
                self._names = names
                self._cell = self._cell_of(bounds, periodic)
                return count
        if count is not None:
            raise lines.refuse(HEAD_ENDS)
        return None

    def _bounds(self, line: str) -> list[float]:
        words = [word for word in re.split(r"[\s,\[\]]+", line.lstrip(" -")) if word]
        if len(words) not in (2, 3) or not are_numbers(words):
            raise self.lines.refuse(f"{shown(line)}: must be bounds of the box, like - [ 0, 1 ]")
        return [number(word) for word in words]

    def _cell_of(self, bounds: list[list[float]], periodic: list[bool]) -> Cell | None:
        if not bounds:
            return None
        if [len(row) for row in bounds] not in ([2, 2, 2], [2, 2, 2, 3]):
            raise self.lines.refuse("box: must be three pairs of bounds and, if it is tilted, three tilts")
        return cell_within(bounds[:3], bounds[3] if len(bounds) > 3 else (0, 0, 0), periodic)
