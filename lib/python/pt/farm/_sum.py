"""The picture so far, as the exact sum of the parts that came back, and its file."""

from __future__ import annotations

import pathlib

from pt._errors import IncompatibleError
from pt._film import Film
from pt._files import Path, write_atomically
from pt.farm import _packing
from pt.farm._identity import Identity, identity_of, with_models
from pt.farm._workers import now

PIXEL_BYTES = 112
BATCH_SHARE = 0.5  # of a film, in parts that are not yet in it: adding to the film costs by its size, not by the part's
SHOW_SHARE = 0.1  # of the time, for adding less than that, so that the picture so far is recent


class Sum:
    """mixed: films of other devices are added too, and it says of which."""

    def __init__(self, kept: Film | None, width: int, height: int, *, mixed: bool = False) -> None:
        self.film = kept
        self.identity: Identity | None = None if kept is None else identity_of(kept.to_bytes())
        self._mixed = mixed
        self._models = self.identity.models if self.identity else frozenset()
        self._parts: list[Film] = []
        self._bytes = 0
        self._most_bytes = int(BATCH_SHARE * PIXEL_BYTES * width * height)
        self._merged, self._cost = now(), 0.0

    def add(self, part: Film, size: int, models: frozenset[str]) -> None:
        """size: of its bytes. models: of the device that took its samples."""
        if self._mixed and not models <= self._models:
            self.merge()
            self._models |= models
            if self.film is not None:
                self.film = Film(with_models(self.film.to_bytes(), self._models))
        if self._mixed and models != self._models:
            part = Film(with_models(part.to_bytes(), self._models))
        self._parts.append(part)
        self._bytes += size

    def is_due(self) -> bool:
        if not self._parts:
            return False
        return self._bytes >= self._most_bytes or now() - self._merged > self._cost / SHOW_SHARE

    def merge(self) -> None:
        """First parts with each other, as sums of few tiles are short."""
        if not self._parts:
            return
        start, sums = now(), self._parts
        self._parts, self._bytes = [], 0
        while len(sums) > 1:
            pairs = [sums[i:i + 2] for i in range(0, len(sums), 2)]
            sums = [pair[0] if len(pair) == 1 else _added(pair[0], pair[1]) for pair in pairs]
        self.film = sums[0] if self.film is None else _added(self.film, sums[0])
        self._merged = now()
        self._cost = self._merged - start


def _added(film: Film, other: Film) -> Film:
    film += other
    return film


def write_film(film: Film, path: Path) -> None:
    """Packed by zstd where there is a module for it, as the program does; `pt merge` and `pt render --resume` read
    both."""
    module = _packing.zstd()
    data = film.to_bytes()
    write_atomically(path, module.compress(data) if module else data)


def read_film(path: Path) -> Film | None:
    """None: there is none yet."""
    if not pathlib.Path(path).exists():
        return None
    try:
        return Film.load(path)
    except IncompatibleError as error:
        raise IncompatibleError(f"{path}: {error}") from error
