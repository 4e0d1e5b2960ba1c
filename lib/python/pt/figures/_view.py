"""From where a figure is seen: sides by name or by a direction, and the axes of the picture that follow."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Final

import numpy as np

from pt._fit import Doubles
from pt.figures._options import VIEWS, Direction

# By taste the three-quarter view is so far from the front towards the right that neither an edge of a box nor its
# diagonal is in the line of sight, and above the horizon. Flat data would hide themselves, and are seen from higher.
AZIMUTH: Final = 30.0
ELEVATION_OF_BODIES: Final = 22.0
ELEVATION_OF_DISCS: Final = 50.0
BODY: Final = 0.5  # from this height over width on


def unit(vector: Doubles) -> Doubles:
    """Of any length but 0; squares of what is scaled by the largest do not leave the range of numbers."""
    scaled = vector / np.abs(vector).max()
    result: Doubles = scaled * (1.0 / math.sqrt(scaled[0] * scaled[0] + scaled[1] * scaled[1] + scaled[2] * scaled[2]))
    return result


def three_numbers(name: str, value: Direction, rule: str) -> Doubles:
    """A unit vector from three numbers, or from the text "1,-2,0.5"."""
    try:
        numbers = np.array(value.split(",") if isinstance(value, str) else value, np.float64)
    except ValueError:
        numbers = np.zeros(0)
    if numbers.shape != (3,) or not np.isfinite(numbers).all() or not numbers.any():
        raise ValueError(f"{name} = {value!r}: must be {rule}")
    return unit(numbers)


def up_vector(up: Direction) -> Doubles:
    """From "z", "-y" or three numbers."""
    if isinstance(up, str) and up.lstrip("-") in ("x", "y", "z") and len(up) < 3:
        axis = np.zeros(3)
        axis["xyz".index(up[-1])] = -1.0 if up[0] == "-" else 1.0
        return axis
    return three_numbers("up", up, "x, y or z, with or without a minus sign, or three numbers, not all 0")


@dataclass(frozen=True)
class Compass:
    """The directions in the data's coordinates that right and front are seen from. Right is x, or y where up is nearest
    to x; front is right x up: with z up that is -y, with y up it is z, as simulations and molecules have it."""

    right: Doubles
    front: Doubles
    up: Doubles

    @staticmethod
    def of(up: Doubles) -> Compass:
        axis = np.eye(3)[1 if abs(up[0]) > max(abs(up[1]), abs(up[2])) else 0]
        right = unit(axis - (axis @ up) * up)
        return Compass(right, np.cross(right, up), up)


def relative_height(extents: Doubles) -> float:
    """How large data are along up, as a share of how large they are across it: 0 of a layer, 1 of a cube.

    extents: of the centres along right, front and up.
    """
    across = math.hypot(extents[0], extents[1])
    return float(extents[2] / (across / math.sqrt(2.0))) if across > 0.0 else 1.0


def toward_camera(view: Direction, compass: Compass, height: float) -> Doubles:
    """height: relative_height, which the three-quarter view follows."""
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
    """Right, up and forward in the picture, in rows: right x up = -forward. Seen along up, right stays right."""
    forward = -toward
    across = np.cross(forward, compass.up)
    right = compass.right if np.linalg.norm(across) < 1e-6 else unit(across)
    return np.array([right, np.cross(right, forward), forward])
