from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Final

from pt._fit import Doubles
from pt._scene import Material, Plane, Sphere

# Lit surfaces have a radiance near their albedo, so their colors match the legend.
SURROUND_BRIGHTNESS: Final = 0.4375
KEY_BRIGHTNESS: Final = 0.75
KEY_HALF_ANGLE: Final = math.radians(14.0)
KEY_AZIMUTH: Final = math.radians(-35.0)
KEY_ELEVATION: Final = math.radians(40.0)
FLOOR: Final = Material(diffuse=0.8)
EDGES: Final = Material(diffuse=0.09)
FLOOR_GAP: Final = 1e-4  # relative to the radius; a smaller gap could vanish by rounding


@dataclass(frozen=True)
class Stage:
    """The lamps are an evenly shining sphere around everything, and a large lamp (key) behind the camera's left shoulder."""

    lamps: tuple[Sphere, ...]
    floor: Plane | None
    material: Material


AMBIENT: Final = frozenset(("ambient-occlusion", "protein", "point-cloud", "soft", "illustrative"))
GLOSSY: Final = frozenset(("glossy", "cover"))


def material_of(style: str) -> Material:
    specular = 0.12 if style in GLOSSY else 0.0
    return Material(diffuse=1.0 - specular, specular=specular, glossiness=60.0 if specular else 0.0)


def make_stage(style: str, axes: Doubles, distance: float, center: Doubles, radius: float, floor: Plane | None) -> Stage:
    """`distance` goes from the camera to `center`, the center of a ball around everything."""
    material = material_of(style)
    # The key lamp is farther than the camera, so its light hardly falls off over the data.
    far = max(20.0 * radius, 4.0 * distance)
    occlusion = style in AMBIENT
    surround = Sphere(center, 10.0 * far, Material(emission=1.0 if occlusion else SURROUND_BRIGHTNESS))
    if occlusion:
        return Stage((surround,), floor, material)
    level = math.cos(KEY_ELEVATION)
    direction = (level * math.sin(KEY_AZIMUTH) * axes[0] - level * math.cos(KEY_AZIMUTH) * axes[2] + math.sin(KEY_ELEVATION) * axes[1])
    # A white surface that faces a lamp of radiance L and half angle a has the radiance L sin^2(a) (Lambert).
    sine = math.sin(KEY_HALF_ANGLE)
    key = Sphere(center + far * direction, far * sine, Material(emission=KEY_BRIGHTNESS / (sine * sine)))
    return Stage((surround, key), floor, material)
