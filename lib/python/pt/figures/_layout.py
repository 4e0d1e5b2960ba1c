from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any, Final

import numpy as np

from pt._camera import Camera
from pt._fit import SIDES, Array, Doubles, Extents, Spin, apex, pyramid, reach
from pt._scene import Plane
from pt.figures._options import Direction
from pt.figures._stage import FLOOR, FLOOR_GAP, Stage, make_stage
from pt.figures._view import Compass, principal_axes, relative_height, toward_camera, up_vector, view_axes

VERTICAL_FOV: Final = 20.0 * math.pi / 180.0
MARGIN: Final = 0.03  # free fraction of the picture at each side; by taste
PIXELS: Final = 1024.0 * 768.0
MOST_ASPECT: Final = 2.0
BLUR: Final = 0.012  # by taste


@dataclass(frozen=True)
class Balls:
    centers: Array
    radii: Array
    points: Array

    def reach(self, axes: Doubles, directions: Doubles, spin: Spin | None = None) -> Doubles:
        far = reach(self.centers, self.radii, axes, directions, spin)
        if len(self.points):
            far = np.maximum(far, reach(self.points, np.zeros(len(self.points)), axes, directions, spin))
        return far


@dataclass(frozen=True)
class View:
    compass: Compass
    axes: Doubles
    size: tuple[int, int]
    projection: str
    spin: Spin | None = None
    camera: Camera | None = None

    @staticmethod
    def through(camera: Camera, up: Direction, size: tuple[int, int], scale: float) -> View:
        right, above, back = camera.axes()
        return View(Compass.of(up_vector(up)), np.array([right, above, -back]), size, "", camera=camera._scaled(scale))

    @staticmethod
    def of(balls: Balls, view: Direction, up: Direction, projection: str, size: tuple[int, int] | None,
           turns: bool = False) -> View:
        """`turns` keeps a turntable's whole turn in view."""
        compass = Compass.of(up_vector(up))
        height = 0.0
        if view == "three-quarter":
            world = np.array([compass.right, compass.front, compass.up])
            points = np.broadcast_to(0.0, len(balls.centers))
            height = relative_height(Extents.of(reach(balls.centers, points, world, SIDES)).size)
        axes = (principal_axes(balls.centers, compass) if view == "best" else view_axes(toward_camera(view, compass, height), compass))
        spin = None
        if turns:
            extents = Extents.of(balls.reach(axes, SIDES))
            spin = Spin(compass.up, extents.middle @ axes)
        if size is None:
            size = _shape(Extents.of(balls.reach(axes, SIDES, spin)).size)
        return View(compass, axes, size, projection, spin)

    def turned(self, angle: float) -> View:
        assert self.spin is not None
        return replace(self, axes=self.axes @ _rotation(self.spin.axis, angle).T)

    @property
    def tangents(self) -> tuple[float, float]:
        vertical = (1.0 - 2.0 * MARGIN) * math.tan(0.5 * VERTICAL_FOV)
        return vertical * (self.size[0] / self.size[1]), vertical

    def reaches(self, balls: Balls) -> Doubles:
        down = -(self.axes @ self.compass.up)
        return balls.reach(self.axes, np.vstack([SIDES, down[None], pyramid(self.tangents)]), self.spin)


def _shape(extents: Doubles) -> tuple[int, int]:
    aspect = min(max(float(extents[0] / extents[1]), 1.0 / MOST_ASPECT), MOST_ASPECT)
    sides = [8 * math.floor(side / 8.0 + 0.5) for side in (math.sqrt(PIXELS * aspect), math.sqrt(PIXELS / aspect))]
    return sides[0], sides[1]


@dataclass(frozen=True)
class Layout:
    """`distance` goes along the view from the camera to the middle of the contents, or is half of their extent if the camera is inside.
    `deep` is their extent along the view."""

    size: tuple[int, int]
    axes: Doubles
    camera: Camera
    distance: float
    stage: Stage
    deep: float = 0.0

    @staticmethod
    def of(view: View, reaches: Doubles, style: str, floor: bool) -> Layout:
        """Raises ValueError if the camera is below the floor."""
        axes, forward = view.axes, view.axes[2]
        extents = Extents.of(reaches[:6])
        middle = extents.middle
        center = middle[0] * axes[0] + middle[1] * axes[1] + middle[2] * forward
        radius = 0.5 * float(extents.size.max())
        if view.camera is not None:
            camera, position = view.camera, np.asarray(view.camera.position)
            distance = max(abs(float(forward @ (center - position))), radius)
        elif view.projection == "orthographic":
            aspect = view.size[0] / view.size[1]
            height = float(max(extents.size[1], extents.size[0] / aspect)) / (1.0 - 2.0 * MARGIN)
            distance = float(extents.size[2]) + height
            position = center - distance * forward
            camera = Camera(position, position + distance * forward, axes[1], vertical_extent=height, projection="orthographic")
        else:
            position = apex(reaches[7:11], axes, pyramid(view.tangents))
            if view.spin is not None:
                position = position - ((position - view.spin.through) @ axes[0]) * axes[0]
            distance = float(forward @ (center - position))
            camera = Camera(position, position + distance * forward, axes[1], vertical_fov=VERTICAL_FOV,
                            **(_lens(distance, float(extents.size[2])) if style == "cover" else {}))
        plane = None
        if floor:
            up, height = view.compass.up, -float(reaches[6]) - FLOOR_GAP * radius
            if up @ position <= height:
                raise ValueError("floor: the view puts the camera below it, where the floor would hide everything")
            plane = Plane(up, -height, FLOOR)
        return Layout(view.size, axes, camera, distance, make_stage(style, axes, distance, center, radius, plane),
                      float(extents.size[2]))


def _lens(distance: float, deep: float) -> dict[str, Any]:
    """The far end is blurred to a circle whose diameter is BLUR of the picture's height."""
    focus = distance - 0.25 * deep
    spread = 1.0 / focus - 1.0 / (distance + 0.5 * deep)
    return {"aperture": min(2.0 * BLUR * math.tan(0.5 * VERTICAL_FOV) / spread, focus), "focus": focus} if spread > 0.0 else {}


def _rotation(axis: Doubles, angle: float) -> Doubles:
    crossed = np.cross(axis, np.eye(3)).T
    result: Doubles = (math.cos(angle) * np.eye(3) + math.sin(angle) * crossed + (1.0 - math.cos(angle)) * np.outer(axis, axis))
    return result
