"""Lamps in the place of Tachyon's lights, which are points and directions without a size."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from pt._scene import Material, Plane, Sphere
from pt._vectors import Triple

FloatArray = npt.NDArray[np.float64]

DEFAULT_RADIUS = 1 / 50  # of a light without one, over its distance
LEAST_RADIUS = 1e-6  # likewise: what is smaller lies on a surface
SUN_DISTANCE = 100.0  # over the extent of the scene


@dataclass(frozen=True)
class Light:
    """A white matt surface that faces it has the radiance color / (a + b d + c d^2), (a, b, c) being its attenuation and
    d its distance."""

    file_place: str
    color: Triple
    place: Triple  # or, of a directional one, the direction towards the light
    is_directional: bool = False
    attenuation: Triple = (1.0, 0.0, 0.0)
    radius: float = 0.0  # at which it is seen; 0 if it has none


@dataclass(frozen=True)
class Surroundings:
    """What decides how large lamps are: the surfaces of the scene and its camera."""

    centers: FloatArray  # (n, 3)
    radii: FloatArray  # (n,)
    planes: list[Plane]
    camera: FloatArray  # (3,), its position
    target: FloatArray  # (3,), what it looks at

    def clearance(self, point: FloatArray) -> float:
        """From the point to the nearest surface."""
        gaps = np.abs(np.linalg.norm(self.centers - point, axis=1) - self.radii).tolist()
        gaps += [abs(float(np.dot(plane.normal, point)) + plane.offset) / float(np.linalg.norm(plane.normal))
                 for plane in self.planes]
        return float(min(gaps, default=np.inf))

    def extent(self, lights: list[Light]) -> float:
        """The largest distance from the target to anything but planes; above 0."""
        reach = np.linalg.norm(self.centers - self.target, axis=1) + self.radii
        places = [np.array(light.place) for light in lights if not light.is_directional] + [self.camera]
        return float(max([float(np.linalg.norm(place - self.target)) for place in places] + reach.tolist()))


def view_target(centers: FloatArray, radii: FloatArray, planes: list[Plane], position: Triple,
                direction: Triple) -> FloatArray:
    """What a camera that has only a direction looks at: of the points ahead the one nearest to the middle of the box
    around all spheres; without spheres ahead where the nearest plane is met; else the point at the distance 1."""
    start = np.array(position)
    way = np.array(direction) / np.linalg.norm(direction)
    distance = 0.0
    if len(centers):
        low, high = (centers - radii[:, None]).min(axis=0), (centers + radii[:, None]).max(axis=0)
        distance = float((0.5 * (low + high) - start) @ way)
    if not distance > 0.0:
        towards = [(float(np.dot(plane.normal, start)) + plane.offset, float(np.dot(plane.normal, way)))
                   for plane in planes]
        ahead = [-height / slope for height, slope in towards if height * slope < 0.0]
        distance = min(ahead, default=1.0)
    target: FloatArray = start + distance * way
    return target


def lamps_of(lights: list[Light], around: Surroundings) -> tuple[list[Sphere], list[str]]:
    """A ball for each light, and warnings about those that can have none.

    A ball of radius r and radiance L gives a white surface that faces it at the distance d the radiance L (r / d)^2: its
    L is such that this is what the light gives where the camera looks. A light without a radius gets a 50th of its
    distance and is hidden from the camera. Near surfaces, or near a camera that would see it, a lamp has half of that
    gap, if that is less. Directional lights are put at a hundred times the extent of the scene.
    """
    extent = around.extent(lights)
    lamps: list[Sphere] = []
    warnings: list[str] = []
    for light in lights:
        if not any(light.color):
            continue
        if light.is_directional:
            distance = SUN_DISTANCE * extent
            center = around.target + distance * np.array(light.place) / np.linalg.norm(light.place)
        else:
            center = np.array(light.place)
            distance = float(np.linalg.norm(center - around.target))
            if distance <= LEAST_RADIUS * extent:  # at the point that is looked at: measured at the camera
                distance = float(np.linalg.norm(center - around.camera))
        room = around.clearance(center)
        if light.radius > 0.0:
            room = min(room, float(np.linalg.norm(center - around.camera)))
        radius = min(light.radius or DEFAULT_RADIUS * distance, 0.5 * room)
        if radius < LEAST_RADIUS * distance:
            warnings.append(f"{light.file_place}: the light lies on a surface, and is left out")
            continue
        faded = light.attenuation[0] + distance * (light.attenuation[1] + distance * light.attenuation[2])
        emission = (distance / radius) ** 2 / faded * np.array(light.color)
        lamps.append(Sphere(center, radius, Material(emission=emission, hidden_from_camera=light.radius == 0.0)))
    return lamps, warnings
