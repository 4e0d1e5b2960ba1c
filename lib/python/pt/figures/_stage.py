from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Final

from pt._fit import Doubles
from pt._scene import Material, Plane, Sphere

# The radiance of a surface that faces the key lamp, in full view of the surround, is its albedo: the legend's color.
SURROUND_BRIGHTNESS: Final = 0.4375  # has few bits, so that means are exact
KEY_BRIGHTNESS: Final = 0.75
KEY_HALF_ANGLE: Final = math.radians(14.0)
KEY_AZIMUTH: Final = math.radians(-35.0)
KEY_ELEVATION: Final = math.radians(40.0)
FLOOR: Final = Material(diffuse=0.8)
EDGES: Final = Material(diffuse=0.09)
FLOOR_GAP: Final = 1e-4  # relative to the radius; a smaller gap could vanish by rounding


@dataclass(frozen=True)
class Stage:
    """lamps: an evenly shining sphere around everything, and a large lamp behind the camera's left shoulder (key)."""

    lamps: tuple[Sphere, ...]
    floor: Plane | None
    material: Material


def material_of(style: str) -> Material:
    specular = 0.12 if style == "glossy" else 0.0
    return Material(diffuse=1.0 - specular, specular=specular, glossiness=60.0 if specular else 0.0)


def make_stage(style: str, axes: Doubles, distance: float, center: Doubles, radius: float, floor: Plane | None) -> Stage:
    """axes: right, up, forward. distance: from camera to middle. center, radius: a ball around everything."""
    material = material_of(style)
    # The key lamp is farther than the camera, so its light is nearly as strong at the far end of the data.
    far = max(20.0 * radius, 4.0 * distance)
    occlusion = style == "ambient-occlusion"
    surround = Sphere(center, 10.0 * far, Material(emission=1.0 if occlusion else SURROUND_BRIGHTNESS))
    if occlusion:
        return Stage((surround,), floor, material)
    level = math.cos(KEY_ELEVATION)
    direction = (level * math.sin(KEY_AZIMUTH) * axes[0] - level * math.cos(KEY_AZIMUTH) * axes[2] +
                 math.sin(KEY_ELEVATION) * axes[1])
    # A lamp of radiance L and half angle a gives a facing white surface the radiance L sin^2(a) (Lambert).
    sine = math.sin(KEY_HALF_ANGLE)
    key = Sphere(center + far * direction, far * sine, Material(emission=KEY_BRIGHTNESS / (sine * sine)))
    return Stage((surround, key), floor, material)
