from __future__ import annotations

from typing import Final

import numpy as np

from pt._fit import Array, Doubles, chunks, coordinates

FEW: Final = 0.005
LEAST_COUNT: Final = 5
SAMPLE: Final = 100_000


def middle_of(positions: Array) -> Doubles:
    middle: Doubles = np.median(positions[::max(len(positions) // SAMPLE, 1)], axis=0).astype(np.float64)
    return middle


def reaches_of(positions: Array, radii: Array) -> Doubles:
    middle = middle_of(positions)[:, None]
    reaches = np.broadcast_to(radii, len(positions)).astype(np.float64)
    for rows in chunks(len(positions)):
        reaches[rows] += np.abs(coordinates(positions[rows]) - middle).max(axis=0)
    return reaches


def usual_reach(reaches: Doubles) -> float:
    count = len(reaches)
    last = count - 1 - (max(int(FEW * count), 1) if count >= LEAST_COUNT else 0)
    return float(np.partition(reaches, last)[last])
