from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Final

import numpy as np

from pt._fit import Array, Doubles
from pt.figures._options import VIEWS, Direction
from pt.figures._spread import SAMPLE

# The three-quarter view, by taste. Neither an edge of a box nor its diagonal is along the line of sight.
AZIMUTH: Final = 30.0
ELEVATION_OF_BODIES: Final = 22.0
ELEVATION_OF_DISCS: Final = 50.0
BODY: Final = 0.5


def unit(vector: Doubles) -> Doubles:
    """First divides by the largest component, because squares could overflow."""
    scaled = vector / np.abs(vector).max()
    result: Doubles = scaled * (1.0 / math.sqrt(scaled[0] * scaled[0] + scaled[1] * scaled[1] + scaled[2] * scaled[2]))
    return result


def three_numbers(name: str, value: Direction, rule: str) -> Doubles:
    try:
        numbers = np.array(value.split(",") if isinstance(value, str) else value, np.float64)
    except ValueError:
        numbers = np.zeros(0)
    if numbers.shape != (3,) or not np.isfinite(numbers).all() or not numbers.any():
        raise ValueError(f"{name} = {value!r}: must be {rule}")
    return unit(numbers)


def up_vector(up: Direction) -> Doubles:
    if isinstance(up, str) and up.lstrip("-") in ("x", "y", "z") and len(up) < 3:
        axis = np.zeros(3)
        axis["xyz".index(up[-1])] = -1.0 if up[0] == "-" else 1.0
        return axis
    return three_numbers("up", up, "x, y or z, with or without a minus sign, or three numbers, not all 0")


@dataclass(frozen=True)
class Compass:
    """Right is x, or y if up is nearest to x. Front is right x up: -y if z is up, as in simulations, and z if y is up, as for molecules."""

    right: Doubles
    front: Doubles
    up: Doubles

    @staticmethod
    def of(up: Doubles) -> Compass:
        axis = np.eye(3)[1 if abs(up[0]) > max(abs(up[1]), abs(up[2])) else 0]
        right = unit(axis - (axis @ up) * up)
        return Compass(right, np.cross(right, up), up)


def relative_height(extents: Doubles) -> float:
    """Returns 0 for a layer, 1 for a cube. `extents` are along right, front and up."""
    across = math.hypot(extents[0], extents[1])
    return float(extents[2] / (across / math.sqrt(2.0))) if across > 0.0 else 1.0


def toward_camera(view: Direction, compass: Compass, height: float) -> Doubles:
    if view == "three-quarter":
        if height == 0.0:
            return compass.up
        share = min(height / BODY, 1.0)
        elevation = math.radians((1.0 - share) * ELEVATION_OF_DISCS + share * ELEVATION_OF_BODIES)
        azimuth = math.radians(AZIMUTH)
        level = math.cos(azimuth) * compass.front + math.sin(azimuth) * compass.right
        result: Doubles = math.cos(elevation) * level + math.sin(elevation) * compass.up
        return result
    names = {"front": compass.front, "back": -compass.front, "right": compass.right, "left": -compass.right,
             "top": compass.up, "bottom": -compass.up}
    if isinstance(view, str) and view in names:
        return names[view]
    return three_numbers("view", view, ", ".join(VIEWS) + ", or three numbers like 1,-2,0.5, not all 0")


def view_axes(toward: Doubles, compass: Compass) -> Doubles:
    """Rows are right, up and forward. If the view is along up, right comes from the compass."""
    forward = -toward
    across = np.cross(forward, compass.up)
    right = compass.right if np.linalg.norm(across) < 1e-6 else unit(across)
    return np.array([right, np.cross(right, forward), forward])


def principal_axes(centers: Array, compass: Compass) -> Doubles:
    """Like view_axes(). The longest axis is right. The second one is up, on the side of the data's up. The shortest one is toward the
    camera, on the side of the three-quarter view."""
    sample = centers[::max(len(centers) // SAMPLE, 1)].astype(np.float64)
    spread = sample - sample.mean(axis=0)
    _, vectors = np.linalg.eigh(spread.T @ spread)
    toward, above, _ = vectors.T
    toward = toward * np.copysign(1.0, toward @ toward_camera("three-quarter", compass, 1.0))
    above = above * np.copysign(1.0, above @ compass.up)
    return np.array([np.cross(above, toward), above, -toward])
