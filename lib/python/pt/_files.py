from __future__ import annotations

import errno
import os
import pathlib
import stat
import uuid
from collections.abc import Callable, Sequence
from typing import BinaryIO, Final, TypeAlias

Path: TypeAlias = "str | os.PathLike[str]"

PICTURES: Final = ("exr", "png", "jpg", "jpeg")


def format_of(path: Path, formats: Sequence[str]) -> str:
    ending = pathlib.Path(path).suffix.lower().removeprefix(".")
    if ending not in formats:
        *others, last = (f".{each}" for each in formats)
        raise ValueError(f"{os.fspath(path)!r}: must end in {', '.join(others)}{' or ' if others else ''}{last}")
    return ending


def regular(path: Path, flags: int) -> int:
    """An opener for open(). Raises OSError unless the file is regular: a pipe or a device may have no end."""
    descriptor = os.open(path, flags | getattr(os, "O_NONBLOCK", 0))
    if stat.S_ISREG(os.fstat(descriptor).st_mode):
        return descriptor
    os.close(descriptor)
    raise OSError(errno.EINVAL, "not a regular file", os.fspath(path))


def write_atomically(path: Path, write: Callable[[BinaryIO], object]) -> None:
    place = pathlib.Path(path)
    beside = place.with_name(f".{place.name}.{uuid.uuid4().hex}")
    try:
        with open(beside, "xb") as file:
            write(file)
        beside.replace(place)
    finally:
        beside.unlink(missing_ok=True)
