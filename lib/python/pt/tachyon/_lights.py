from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from pt._scene import Material, Plane, Sphere
from pt._vectors import Triple

FloatArray = npt.NDArray[np.float64]

DEFAULT_RADIUS = 1 / 50
LEAST_RADIUS = 1e-6  # relative to the extent; only lights on surfaces would get smaller lamps
SUN_DISTANCE = 100.0
LEAST_SHARE = 1 / 3  # a bright background dims lights at most to this fraction; by taste


@dataclass(frozen=True)
class Light:
    """A white matt surface that faces the light at distance d has the radiance color / (a + b d + c d^2) with attenuation (a, b, c)."""

    file_place: str
    color: Triple
    place: Triple  # position, or the direction towards a directional light
    is_directional: bool = False
    attenuation: Triple = (1.0, 0.0, 0.0)
    radius: float = 0.0  # radius of the visible ball; 0 for a point light


@dataclass(frozen=True)
class Surroundings:
    centers: FloatArray
    ends: FloatArray  # (n, 3); equal to the centers for spheres
    radii: FloatArray
    planes: list[Plane]
    camera: FloatArray
    target: FloatArray

    def clearance(self, point: FloatArray) -> float:
        ways = self.ends - self.centers
        squares = np.maximum((ways * ways).sum(axis=1), np.finfo(np.float64).tiny)
        shares = np.clip(((point - self.centers) * ways).sum(axis=1) / squares, 0.0, 1.0)
        nearest = self.centers + shares[:, None] * ways
        gaps = np.abs(np.linalg.norm(nearest - point, axis=1) - self.radii).tolist()
        gaps += [abs(float(np.dot(plane.normal, point)) + plane.offset) / float(np.linalg.norm(plane.normal))
                 for plane in self.planes]
        return float(min(gaps, default=np.inf))

    def extent(self, lights: list[Light]) -> float:
        reach = np.linalg.norm(np.array([self.centers, self.ends]) - self.target, axis=2).max(axis=0) + self.radii
        places = [np.array(light.place) for light in lights if not light.is_directional] + [self.camera]
        return float(max([float(np.linalg.norm(place - self.target)) for place in places] + reach.tolist()))


def view_target(centers: FloatArray, radii: FloatArray, planes: list[Plane], position: Triple,
                direction: Triple) -> FloatArray:
    """Returns the point on the viewing ray nearest to the middle of the spheres' bounding box. Without spheres ahead,
    returns the point on the nearest plane, or at distance 1."""
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


def dimmed(lights: list[Light], background: Triple) -> list[Light]:
    """Unlike Tachyon's, pt's background gives light, so lights are dimmed."""
    together = max(map(sum, zip(*(light.color for light in lights))), default=0.0)
    share = max(1.0 - max(background) / together, LEAST_SHARE) if together else 1.0
    return [replace(light, color=(share * light.color[0], share * light.color[1], share * light.color[2]))
            for light in lights]


def lamps_of(lights: list[Light], around: Surroundings) -> tuple[list[Sphere], list[str]]:
    """Returns balls, and warnings about omitted lights. A white surface that faces a ball of radius r and radiance L at distance d has the
    radiance L (r / d)^2. L is chosen so that the surface would get the light's radiance at the camera's target."""
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
            if distance <= LEAST_RADIUS * extent:  # the light is at the target
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
