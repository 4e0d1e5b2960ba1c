from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from pt._film import TILE_SIDE, Film, FilmTile

Indices = npt.NDArray[np.uint32]
Goals = npt.NDArray[np.uint32]


@dataclass(frozen=True)
class Part:
    """The samples from first to end - 1 of some tiles, which are numbered row by row."""

    first: int
    end: int
    tiles: Indices

    @property
    def work(self) -> int:
        return (self.end - self.first) * len(self.tiles)

    def split(self, work: int, least_tiles: int) -> tuple[Part, list[Part]]:
        """The first part has few tiles rather than few samples, so that its film is small."""
        samples = self.end - self.first
        if self.work <= work:
            return self, []
        tiles = min(max(work // samples, least_tiles), len(self.tiles))
        middle = self.first + max(min(work // tiles, samples), 1)
        rest = []
        if tiles < len(self.tiles):
            rest.append(Part(self.first, self.end, self.tiles[tiles:]))
        if middle < self.end:
            rest.append(Part(middle, self.end, self.tiles[:tiles]))
        return Part(self.first, middle, self.tiles[:tiles]), rest


def is_film_of(film: Film, part: Part, shape: tuple[int, int]) -> bool:
    indices = np.arange(shape[0] * shape[1], dtype=np.uint32).reshape(shape)
    found = []
    for tile in film.tiles:
        if tile.samples != (range(part.first, part.end),) or tile.x % TILE_SIDE or tile.y % TILE_SIDE:
            return False
        found.append(_tiles_of(tile, indices))
    return bool(np.array_equal(np.sort(np.concatenate(found)), np.sort(part.tiles)))


def _tiles_of(tile: FilmTile, indices: Indices) -> Indices:
    rows = slice(tile.y // TILE_SIDE, -(-(tile.y + tile.height) // TILE_SIDE))
    across = slice(tile.x // TILE_SIDE, -(-(tile.x + tile.width) // TILE_SIDE))
    return indices[rows, across].ravel()


def grid_shape(width: int, height: int) -> tuple[int, int]:
    return -(-height // TILE_SIDE), -(-width // TILE_SIDE)


Cells = list[tuple[tuple[range, ...], Indices]]


def cells_of(film: Film | None, shape: tuple[int, int]) -> Cells:
    found: dict[tuple[range, ...], list[Indices]] = {}
    seen = np.zeros(shape, bool)
    indices = np.arange(seen.size, dtype=np.uint32).reshape(shape)
    for tile in film.tiles if film else ():
        inside = _tiles_of(tile, indices)
        seen.ravel()[inside] = True
        found.setdefault(tile.samples, []).append(inside)
    if not seen.all():
        found.setdefault((), []).append(indices[~seen])
    return [(samples, np.unique(np.concatenate(pieces))) for samples, pieces in found.items()]


def missing_parts(cells: Cells, first_sample: int, goals: Goals) -> list[Part]:
    """Depends only on the film, so a checkpoint suffices to resume."""
    wanted: dict[tuple[int, int], list[Indices]] = {}
    for samples, tiles in cells:
        tile_goals = goals.ravel()[tiles]
        for goal in np.unique(tile_goals):
            for first, end in _gaps(samples, first_sample, first_sample + int(goal)):
                wanted.setdefault((first, end), []).append(tiles[tile_goals == goal])
    return _joined(wanted)


def has_only(cells: Cells, first_sample: int, goals: Goals) -> bool:
    for samples, tiles in cells:
        present = sum(map(len, samples))
        if (samples and samples != (range(first_sample, first_sample + present),)
                or (goals.ravel()[tiles] != present).any()):
            return False
    return True


def further_parts(before: Goals, after: Goals, first_sample: int) -> list[Part]:
    tiles = np.flatnonzero(after.ravel() > before.ravel()).astype(np.uint32)
    wanted: dict[tuple[int, int], list[Indices]] = {}
    steps = np.stack([before.ravel()[tiles], after.ravel()[tiles]])
    for first, end in np.unique(steps, axis=1).T:
        chosen = tiles[(steps[0] == first) & (steps[1] == end)]
        wanted[first_sample + int(first), first_sample + int(end)] = [chosen]
    return _joined(wanted)


def _joined(wanted: dict[tuple[int, int], list[Indices]]) -> list[Part]:
    return [Part(first, end, np.sort(np.concatenate(tiles))) for (first, end), tiles in sorted(wanted.items())]


def _gaps(samples: tuple[range, ...], first: int, end: int) -> Iterator[tuple[int, int]]:
    for present in samples:
        if present.start > first:
            yield first, min(present.start, end)
        first = max(first, present.stop)
        if first >= end:
            return
    if first < end:
        yield first, end
