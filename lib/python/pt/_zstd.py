from __future__ import annotations

import importlib
from typing import Any

MAGIC = bytes.fromhex("28b52ffd")


def module() -> Any:
    for name in ("compression.zstd", "zstandard"):
        try:
            return importlib.import_module(name)
        except ImportError:
            continue
    return None


def packer(size: int) -> Any:
    """Returns an object with compress(piece) and flush(), or None without a module. The frame states the size of its contents, which film
    readers require."""
    found = module()
    if found is None:
        return None
    if hasattr(found.ZstdCompressor, "compressobj"):
        return found.ZstdCompressor().compressobj(size=size)
    compressor = found.ZstdCompressor()
    compressor.set_pledged_input_size(size)
    return compressor
