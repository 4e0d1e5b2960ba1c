from __future__ import annotations

import contextlib
import ctypes
import pathlib
from collections import deque
from typing import BinaryIO

from pt import _zstd
from pt._errors import IncompatibleError
from pt._film import Film
from pt._files import Path, write_atomically
from pt.farm._identity import Identity, identity_of, with_models
from pt.farm._workers import now

PIXEL_BYTES = 112
# Adding to a film takes time for each of its tiles, so parts are first added to one another, up to this fraction of a film.
BATCH_SHARE = 1 / 32
SHOW_SHARE = 0.02  # fraction of the time for early additions, which show recent samples


class Sum:
    def __init__(self, kept: Film | None, width: int, height: int, *, mixed: bool = False) -> None:
        self.film = kept
        self.identity: Identity | None = None if kept is None else identity_of(kept.to_bytes())
        self._mixed = mixed
        self._models = self.identity.models if self.identity else frozenset()
        self._parts: list[Film] = []
        self._bytes = self._freed = 0
        self._most_bytes = int(BATCH_SHARE * PIXEL_BYTES * width * height)
        self._merged, self._cost = now(), 0.0
        self.seconds = 0.0

    def add(self, part: Film, size: int, models: frozenset[str]) -> None:
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
        if not self._parts:
            return
        start, sums = now(), deque(self._parts)
        self._freed += self._bytes
        self._parts, self._bytes = [], 0
        while len(sums) > 1:
            film = sums.popleft()
            film += sums.popleft()
            sums.append(film)
        if self.film is None:
            self.film = sums.pop()
        else:
            self.film += sums.pop()
        if self._freed >= self._most_bytes:
            _give_back()
            self._freed = 0
        self._merged = now()
        self._cost = self._merged - start
        self.seconds += self._cost


def _give_back() -> None:
    """glibc keeps freed memory for each thread, in total more than a film."""
    with contextlib.suppress(AttributeError, OSError):
        ctypes.CDLL(None).malloc_trim(0)


def write_film(film: Film, path: Path) -> None:
    packer = _zstd.packer(film.size)
    if packer is None:
        film.save(path)
        return

    def write(file: BinaryIO) -> None:
        film.stream(lambda piece: file.write(packer.compress(piece)))
        file.write(packer.flush())

    write_atomically(path, write)


def read_film(path: Path) -> Film | None:
    if not pathlib.Path(path).exists():
        return None
    try:
        return Film.load(path)
    except IncompatibleError as error:
        raise IncompatibleError(f"{path}: {error}") from error
