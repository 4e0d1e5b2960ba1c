from __future__ import annotations

from collections.abc import Sequence
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt

Triple: TypeAlias = tuple[float, float, float]
Vector: TypeAlias = "Sequence[float] | npt.NDArray[Any]"
Color: TypeAlias = "float | Sequence[float] | npt.NDArray[Any]"


def vector(name: str, value: Vector) -> Triple:
    numbers = np.asarray(value, np.float64)
    if numbers.shape != (3,):
        raise ValueError(f"{name} = {value!r}: must be three numbers")
    x, y, z = numbers.tolist()
    return x, y, z


def color(name: str, value: Color) -> Triple:
    numbers = np.asarray(value, np.float64)
    return vector(name, np.broadcast_to(numbers, 3) if numbers.ndim == 0 else numbers)
