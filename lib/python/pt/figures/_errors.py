from __future__ import annotations

import importlib
from types import ModuleType
from typing import Final

EXTRAS: Final = {"matplotlib": "figure", "PIL": "figure", "pandas": "figure", "zstandard": "figure-atoms",
                 "gemmi": "figure-atoms", "chemfiles": "figure-atoms", "gsd": "figure-atoms", "trimesh": "figure-points",
                 "pyvista": "figure-points", "laspy": "figure-points"}


class DataError(ValueError):
    """The message names the file, the line or byte, and the rule."""


def module(name: str, purpose: str) -> ModuleType:
    try:
        return importlib.import_module(name)
    except ImportError as error:
        package = name.partition(".")[0]
        if (error.name or name).partition(".")[0] != package:
            raise
        way = f"pip install 'pt[{EXTRAS[package]}]', or {package} alone" if package in EXTRAS else f"pip install {package}"
        raise DataError(f"{purpose} needs the module {package}: {way}") from None
