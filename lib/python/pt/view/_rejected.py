from __future__ import annotations

import re
from typing import Final

import numpy as np
import numpy.typing as npt

from pt._film import Film

PLANES: Final = 14
REJECTED: Final = 13


def rejected_samples(film: Film) -> npt.NDArray[np.uint32]:
    """Returns the numbers of samples that pixels left out (lib/film/FORMAT.md)."""
    header, body = film.to_bytes().split(b"\n\n", 1)
    lines = header.decode()
    covered = bool(re.search(r"^planes .* covered 1$", lines, re.MULTILINE))
    tiles = [[int(number) for number in tile.replace("samples", "").split()]
             for tile in re.findall(r"^tile (.+(?:\nsamples .+)+)", lines, re.MULTILINE)]
    left, top = (min(tile[axis] for tile in tiles) for axis in (0, 1))
    width, height = (max(tile[axis] + tile[axis + 2] for tile in tiles) - first for axis, first in ((0, left), (1, top)))
    rejected = np.zeros((height, width), np.uint32)
    begin = 0
    for column, row, columns, rows, *ends in tiles:
        first, last = ends[0], ends[-1] - 1
        bit = max((first ^ last).bit_length() - 1, 0)
        parts = 2 if last > first and (last >> bit << bit) % 8 == 0 else 1
        planes = np.frombuffer(body, "<u4", (parts * PLANES + covered) * rows * columns, begin).reshape(-1, rows, columns)
        place = np.s_[row - top:row - top + rows, column - left:column - left + columns]
        rejected[place] += planes[REJECTED:parts * PLANES:PLANES].sum(axis=0, dtype=np.uint32)
        begin += planes.nbytes
    return rejected
