"""Films on their way: zstd where both ends have it, else zlib, which Python has."""

from __future__ import annotations

import importlib
import zlib
from typing import Any

ZSTD_MAGIC = bytes.fromhex("28b52ffd")


def zstd() -> Any:
    """A module with compress and decompress; None if there is none."""
    for name in ("compression.zstd", "zstandard"):
        try:
            return importlib.import_module(name)
        except ImportError:
            continue
    return None


def pack(data: bytes, codecs: frozenset[str]) -> bytes:
    """codecs: those that the receiver has besides zlib."""
    module = zstd() if "zstd" in codecs else None
    return bytes(module.compress(data)) if module else zlib.compress(data, 1)


def packer(size: int) -> Any:
    """With compress(piece) and flush(), for a frame of zstd that tells the size of what is in it, as readers of films
    ask; None if there is no module for it."""
    module = zstd()
    if module is None:
        return None
    if hasattr(module.ZstdCompressor, "compressobj"):  # of zstandard
        return module.ZstdCompressor().compressobj(size=size)
    compressor = module.ZstdCompressor()
    compressor.set_pledged_input_size(size)
    return compressor


def unpack(data: bytes) -> bytes:
    """Of pack(). ValueError: damaged."""
    try:
        return bytes(zstd().decompress(data)) if data.startswith(ZSTD_MAGIC) else zlib.decompress(data)
    except Exception as error:
        raise ValueError(f"a part's bytes are damaged: {error}") from error


def codecs() -> frozenset[str]:
    return frozenset({"zstd"} if zstd() else ())
