"""What stands around the particles of a figure: soft light, and a floor where one is wanted. All is sized by the data,
so that angstroms and light years look alike."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Final

from pt._fit import Doubles
from pt._scene import Material, Plane, Sphere

# A surface that faces the key lamp and sees all of the surround has the radiance of its albedo: the colors of a legend
# are those of the lit sides.
SURROUND_BRIGHTNESS: Final = 0.4375  # of few bits, so that means are the same number
KEY_BRIGHTNESS: Final = 0.75
KEY_HALF_ANGLE: Final = math.radians(14.0)  # shadows as soft as of a window three times as far as wide
KEY_AZIMUTH: Final = math.radians(-35.0)  # by eye: shapes show best, and shadows fall to where there is room
KEY_ELEVATION: Final = math.radians(40.0)
FLOOR: Final = Material(diffuse=0.8)
FLOOR_GAP: Final = 1e-4  # of the radius: a ball that touched the floor would meet it where roundings decide


@dataclass(frozen=True)
class Stage:
    """lamps      the surround, a sphere around everything that shines evenly, and the key, a large lamp far behind the
                  left shoulder of the camera
    floor      white, below all
    material   of the particles, whose diffuse their colors multiply
    """

    lamps: tuple[Sphere, ...]
    floor: Plane | None
    material: Material


def material_of(style: str) -> Material:
    """A white ball gives off no more than it receives."""
    specular = 0.12 if style == "glossy" else 0.0
    return Material(diffuse=1.0 - specular, specular=specular, glossiness=60.0 if specular else 0.0)


def make_stage(style: str, axes: Doubles, distance: float, center: Doubles, radius: float, floor: Plane | None) -> Stage:
    """axes: right, up, forward of the view. distance: of the camera from the middle of the data. center, radius: of a
    ball around everything that is seen."""
    material = material_of(style)
    # The lamp is farther than the camera, and so far that the light is nearly as strong at the far end of the data.
    far = max(20.0 * radius, 4.0 * distance)
    occlusion = style == "ambient-occlusion"
    surround = Sphere(center, 10.0 * far, Material(emission=1.0 if occlusion else SURROUND_BRIGHTNESS))
    if occlusion:
        return Stage((surround,), floor, material)
    level = math.cos(KEY_ELEVATION)
    direction = (level * math.sin(KEY_AZIMUTH) * axes[0] - level * math.cos(KEY_AZIMUTH) * axes[2] +
                 math.sin(KEY_ELEVATION) * axes[1])
    # A lamp of the half angle a gives surfaces that face it the irradiance pi L sin^2(a), and white ones give back a
    # pi-th of that (Lambert).
    sine = math.sin(KEY_HALF_ANGLE)
    key = Sphere(center + far * direction, far * sine, Material(emission=KEY_BRIGHTNESS / (sine * sine)))
    return Stage((surround, key), floor, material)
