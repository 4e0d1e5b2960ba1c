"""What is kept of a rendering: its film, which alone says what is done. `pt merge` and `pt render --resume` read it too."""

from __future__ import annotations

import pathlib

from pt._film import Film
from pt._files import Path, write_atomically
from pt.farm import _packing


def write_film(film: Film, path: Path) -> None:
    """Packed by zstd where there is a module for it, as the program does."""
    module = _packing.zstd()
    data = film.to_bytes()
    write_atomically(path, module.compress(data) if module else data)


def read_film(path: Path) -> Film | None:
    """None: there is none yet."""
    return Film.load(path) if pathlib.Path(path).exists() else None
