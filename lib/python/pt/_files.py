"""Files that are there whole or not at all."""

from __future__ import annotations

import os
import pathlib
import uuid
from typing import TypeAlias

Path: TypeAlias = "str | os.PathLike[str]"


def write_atomically(path: Path, data: bytes) -> None:
    """Writes a file beside its place, and moves it there; what was there before stays until then."""
    place = pathlib.Path(path)
    beside = place.with_name(f".{place.name}.{uuid.uuid4().hex}")
    try:
        beside.write_bytes(data)
        beside.replace(place)
    finally:
        beside.unlink(missing_ok=True)
