from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[Any]
Doubles = npt.NDArray[np.float64]

ROWS_AT_ONCE: Final = 1 << 15


def chunks(count: int) -> Iterator[slice]:
    return (slice(start, start + ROWS_AT_ONCE) for start in range(0, count, ROWS_AT_ONCE))


def coordinates(rows: Array) -> Doubles:
    """Returns shape (3, n), because NumPy is slow along an axis of length 3."""
    return rows.T.astype(np.float64, order="C")


@dataclass(frozen=True)
class Spin:
    axis: Doubles
    through: Doubles


def reach(centers: Array, radii: Array, axes: Doubles, directions: Doubles, spin: Spin | None = None) -> Doubles:
    """The support function of the balls: the maximum of dot(direction, center) + radius for each direction.

    axes         unit vectors in rows
    directions   shape (k, 3); unit vectors in the coordinates of the axes
    spin         rotation of the balls; the result covers every angle
    """
    farthest = np.full(len(directions), -np.inf)
    world = directions @ axes
    for rows in chunks(len(centers)):
        places = coordinates(centers[rows])
        if spin is not None:
            places -= spin.through[:, None]
            height = _dot(spin.axis, places)
            across = np.sqrt(np.maximum(np.square(places).sum(axis=0) - np.square(height), 0.0))
            along = world @ spin.axis
            level = np.sqrt(np.maximum(1.0 - np.square(along), 0.0))
            offsets = world @ spin.through
            values = (level[k] * across + along[k] * height + offsets[k] for k in range(len(directions)))
        else:
            seen = [_dot(axis, places) for axis in axes]
            values = (_dot(direction, seen) for direction in directions)
        for k, value in enumerate(values):
            value += radii[rows]
            farthest[k] = max(farthest[k], float(value.max()))
    return farthest


def _dot(direction: Doubles, places: Any) -> Doubles:
    """A fixed order of sums makes all machines round alike."""
    terms = [factor * place for factor, place in zip(direction, places, strict=True) if factor != 0.0]
    total: Doubles = terms[0]
    for term in terms[1:]:
        total += term
    return total


SIDES: Final = np.vstack([np.eye(3), -np.eye(3)])


@dataclass(frozen=True)
class Extents:
    low: Doubles
    high: Doubles

    @staticmethod
    def of(reaches: Doubles) -> Extents:
        return Extents(-reaches[3:], reaches[:3])

    @property
    def size(self) -> Doubles:
        return self.high - self.low

    @property
    def middle(self) -> Doubles:
        return 0.5 * self.low + 0.5 * self.high


def pyramid(tangents: tuple[float, float]) -> Doubles:
    """Returns outward unit normals of a perspective's bounding planes, in the view's axes: left, right, bottom, top. `tangents` belong to
    the half angles."""
    across, upwards = (1.0 / math.hypot(1.0, tangent) for tangent in tangents)
    sines = tangents[0] * across, tangents[1] * upwards
    return np.array([(-across, 0.0, -sines[0]), (across, 0.0, -sines[0]),
                     (0.0, -upwards, -sines[1]), (0.0, upwards, -sines[1])])


def apex(reaches: Doubles, axes: Doubles, normals: Doubles) -> Doubles:
    """Returns the nearest pinhole that sees balls with these reaches along the pyramid's normals.

    All balls are in view of the pinhole p if dot(n, p) >= s for each outward normal n with the reach s. Let a be the horizontal half
    angle. The normals are -+cos(a) right - sin(a) forward. Their sum gives dot(forward, p) <= -(s_left + s_right) / (2 sin a). Their
    difference gives dot(right, p) = (s_right - s_left) / (2 cos a).
    """
    right, above, forward = axes
    low, high = -reaches[0::2], -reaches[1::2]
    cosines, sines = (normals[1, 0], normals[3, 1]), -normals[1::2, 2]
    along = float(((low + high) / (2.0 * sines)).min())
    sideways = [(low[k] - high[k]) / (2.0 * cosines[k]) for k in range(2)]
    place: Doubles = sideways[0] * right + sideways[1] * above + along * forward
    return place
