"""What is wrong with data, and modules that are not installed."""

from __future__ import annotations

import importlib
from types import ModuleType
from typing import Final

# The extra of this package that installs a module.
EXTRAS: Final = {"matplotlib": "figure", "PIL": "figure", "pandas": "figure", "zstandard": "figure-atoms",
                 "ase": "figure-atoms", "MDAnalysis": "figure-atoms", "trimesh": "figure-points",
                 "pyvista": "figure-points", "laspy": "figure-points"}


class DataError(ValueError):
    """Data that cannot be drawn as they are. The message names the file, the line or byte, and what was expected."""


def module(name: str, purpose: str) -> ModuleType:
    """An optional module, which is imported when it is first needed: most take long and have no types."""
    try:
        return importlib.import_module(name)
    except ImportError as error:
        package = name.partition(".")[0]
        if (error.name or name).partition(".")[0] != package:
            raise  # the module is there, and something that it needs is not
        raise DataError(f"{purpose} needs the module {package}: pip install 'pt[{EXTRAS[package]}]', or {package} "
                        "alone") from None
