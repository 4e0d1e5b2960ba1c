"""Identity of a film: the lines of its header from `scene` to `device` (lib/film/FORMAT.md). Films with equal identity can be added."""

from __future__ import annotations

import importlib
from dataclasses import dataclass

FIRST, LAST = "scene", "device"
WORTH_ANOTHER_WORKER = ("estimator_version", "kernel", LAST)  # independent of the picture
CHECKSUM_BYTES = 8


@dataclass(frozen=True)
class Identity:
    lines: tuple[tuple[str, str], ...]

    @property
    def models(self) -> frozenset[str]:
        return frozenset(dict(self.lines)[LAST].split(" and "))

    def differences(self, other: Identity, but: tuple[str, ...] = ()) -> list[str]:
        mine, its = dict(self.lines), dict(other.lines)
        return [name for name in {**mine, **its} if mine.get(name) != its.get(name) and name not in but]


def identity_of(data: bytes) -> Identity:
    names = dict(line.partition(" ")[::2] for line in _header(data).decode("ascii", "replace").splitlines())
    keys = list(names)
    if FIRST not in names or LAST not in names:
        raise ValueError("a film's header has no identity")
    return Identity(tuple((name, names[name]) for name in keys[keys.index(FIRST):keys.index(LAST) + 1]))


def with_models(data: bytes, models: frozenset[str]) -> bytes:
    """Replaces the models of devices, so that films of mixed devices can be added."""
    xxhash = importlib.import_module("xxhash")
    header = _header(data)
    start = header.index(b"\n" + LAST.encode() + b" ") + 1
    end = header.index(b"\n", start)
    line = f"{LAST} {' and '.join(sorted(models))}".encode("ascii")
    changed = data[:start] + line + data[end:-CHECKSUM_BYTES]
    return changed + int(xxhash.xxh3_64_intdigest(changed)).to_bytes(CHECKSUM_BYTES, "little")


def _header(data: bytes) -> bytes:
    end = data.find(b"\n\n")
    if end < 0:
        raise ValueError("a film's header has no end")
    return data[:end + 1]
