from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import numpy.typing as npt

from pt import _structs as structs
from pt._columns import check_finite, real_column
from pt._enums import Estimator, Projection, RenderFlag, Sampler
from pt._fit import SIDES, Extents, apex, pyramid, reach
from pt._vectors import Vector, vector


@dataclass(frozen=True)
class Camera:
    """A pinhole, a thin lens (with an aperture) or parallel rays.

    position          parallel rays start on the plane through it that is perpendicular to them
    target            middle of the image; must differ from position
    up                must not be parallel to the viewing direction
    vertical_fov      full angle in radians, in [1e-8, pi); default pi / 4; None with parallel rays
    shutter           0 <= open <= close <= 1; the image averages this interval
    vertical_extent   full height of the view with parallel rays, in [1e-18, 1e18]
    aperture          diameter of the lens, at most twice the focus; 0 for a pinhole
    focus             depth of the plane in focus; 0 for the distance of target
    projection        "perspective" or "orthographic" (parallel rays); by default orthographic with a vertical_extent
    """

    position: Vector
    target: Vector
    up: Vector = (0.0, 1.0, 0.0)
    vertical_fov: float | None = None
    shutter: tuple[float, float] = (0.0, 1.0)
    vertical_extent: float | None = None
    aperture: float = 0.0
    focus: float = 0.0
    projection: Projection | str | None = None

    def __post_init__(self) -> None:
        projection = _projection(self.projection, self.vertical_extent)
        object.__setattr__(self, "projection", projection)
        if projection == Projection.ORTHOGRAPHIC:
            if self.vertical_fov is not None:
                raise ValueError(f"camera.vertical_fov = {self.vertical_fov}: must be None with a vertical_extent, which is "
                                 "for orthographic projections")
            if not self.vertical_extent:
                raise ValueError(f"camera.vertical_extent = {self.vertical_extent}: must be > 0")
        elif self.vertical_extent is not None:
            raise ValueError(f"camera.vertical_extent = {self.vertical_extent}: must be None without an orthographic projection")
        elif self.vertical_fov is None:
            object.__setattr__(self, "vertical_fov", math.pi / 4)
        for name in ("position", "target", "up"):
            object.__setattr__(self, name, vector(name, getattr(self, name)))

    @staticmethod
    def around(center: npt.ArrayLike, radius: npt.ArrayLike, *, direction: Vector = (0.5, 0.4, 1.0),
               up: Vector = (0.0, 1.0, 0.0), vertical_fov: float = math.pi / 6, aspect: float = 4 / 3,
               margin: float = 1.05) -> Camera:
        """Returns the nearest camera that sees all spheres.

        center      shape (n, 3), n >= 1
        radius      shape (n,), or one number for all
        direction   toward the camera, not 0
        aspect      width / height of the image
        margin      width of the view relative to the tightest view
        """
        centers = real_column("center", center, 3, None)
        if not len(centers):
            raise ValueError("center has no spheres: must have at least one")
        check_finite("center", center)
        check_finite("radius", radius, positive=True)
        right, above, back = _axes(direction, up)
        axes = np.array([right, above, -back])
        tangent = math.tan(0.5 * vertical_fov) / margin
        normals = pyramid((aspect * tangent, tangent))
        reaches = reach(centers, real_column("radius", radius, 1, len(centers)), axes, np.vstack([SIDES, normals]))
        position = apex(reaches[6:], axes, normals)
        distance = Extents.of(reaches[:6]).middle[2] + float(back @ position)
        return Camera(position=position, target=position - distance * back, up=up, vertical_fov=vertical_fov)

    def axes(self) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64], npt.NDArray[np.float64]]:
        """Returns unit vectors: right and up in the image, and from the target to the camera."""
        return _axes(np.subtract(self.position, self.target), self.up)

    def _view_height(self, depth: Any) -> Any:
        """Returns the image's height, which is 0 at depth 0 if all rays start at a point."""
        if self.projection == Projection.ORTHOGRAPHIC:
            return self.vertical_extent
        assert self.vertical_fov is not None
        return 2.0 * math.tan(0.5 * self.vertical_fov) * depth

    def _scaled(self, scale: float) -> Camera:
        extent = self.vertical_extent
        return replace(self, position=np.multiply(self.position, scale), target=np.multiply(self.target, scale),
                       vertical_extent=None if extent is None else extent * scale,
                       aperture=self.aperture * scale, focus=self.focus * scale)

    def _section(self) -> dict[str, Any]:
        section: dict[str, Any] = {"position": list(self.position), "look_at": list(self.target), "up": list(self.up)}
        if self.projection != Projection.PERSPECTIVE:
            section["projection"] = _projection(self.projection, None).name.lower()
        if self.vertical_fov is not None:
            section["vertical_fov"] = math.degrees(self.vertical_fov)
        if self.vertical_extent is not None:
            section["vertical_extent"] = self.vertical_extent
        lens = {"aperture": self.aperture, "focus": self.focus} if self.aperture else {}
        shutter = {} if tuple(self.shutter) == (0.0, 1.0) else {"shutter": list(self.shutter)}
        return {**section, **lens, **shutter}

    @staticmethod
    def _of_section(section: dict[str, Any]) -> Camera:
        others = {name: float(section[name]) for name in ("vertical_extent", "aperture", "focus") if name in section}
        angle = section.get("vertical_fov")
        first, last = map(float, section.get("shutter", (0.0, 1.0)))
        camera = Camera(section["position"], section["look_at"], section.get("up", (0.0, 1.0, 0.0)),
                        vertical_fov=None if angle is None else math.radians(angle), shutter=(first, last),
                        projection=section.get("projection"), **others)
        if not all(map(math.isfinite, (*camera.position, *camera.target, *camera.up, angle or 0.0, *others.values(), first,
                                       last))):
            raise ValueError("camera: must be finite")
        return camera

    def _struct(self) -> structs.pt_camera:
        shutter_open, shutter_close = self.shutter
        return structs.pt_camera(projection=_projection(self.projection, None), position=self.position, target=self.target, up=self.up,
                                 vertical_fov=self.vertical_fov or 0.0, shutter_open=shutter_open,
                                 shutter_close=shutter_close, vertical_extent=self.vertical_extent or 0.0,
                                 aperture=self.aperture, focus=self.focus)


def _projection(given: Projection | str | None, vertical_extent: float | None) -> Projection:
    if given is None:
        return Projection.PERSPECTIVE if vertical_extent is None else Projection.ORTHOGRAPHIC
    if isinstance(given, Projection):
        return given
    if given not in (names := [name.lower() for name in Projection.__members__]):
        raise ValueError(f"camera.projection = {given!r}: must be one of {', '.join(names)}")
    return Projection[given.upper()]


def _axes(direction: Vector, up: Vector
          ) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64], npt.NDArray[np.float64]]:
    back = np.array(vector("direction", direction))
    right = np.cross(vector("up", up), back)
    if not right.any():
        raise ValueError(f"direction = {direction!r}: must not be parallel to up, nor 0")
    back /= np.linalg.norm(back)
    right /= np.linalg.norm(right)
    return right, np.cross(back, right), back


@dataclass(frozen=True)
class RenderSettings:
    """width, height     pixels, >= 1
    max_path_length   surface vertices after the camera, in [1, 1024]; 1 shows emission only
    seed              the same inputs, device, driver and seed give the same bits
    first_sample      index of the first sample; films of different index ranges can be added
    first_row         first row to render; readback() returns only rendered rows
    row_count         0: all rows from first_row on
    coverage          counts samples that hit a surface, for Image.coverage and Quantity.COVERAGE
    """

    width: int
    height: int
    max_path_length: int = 6
    seed: int = 0
    first_sample: int = 0
    estimator: Estimator = Estimator.BEST
    sampler: Sampler = Sampler.BEST
    first_row: int = 0
    row_count: int = 0
    coverage: bool = False

    def _struct(self) -> structs.pt_render:
        for name, bits in (("width", 32), ("height", 32), ("max_path_length", 32), ("seed", 64), ("first_sample", 32),
                           ("first_row", 32), ("row_count", 32)):
            if not 0 <= getattr(self, name) < 2**bits:
                raise ValueError(f"render.{name} = {getattr(self, name)}: must be at least 0 and below 2^{bits}")
        return structs.pt_render(
            width=self.width, height=self.height, max_path_length=self.max_path_length, seed=self.seed,
            first_sample=self.first_sample, estimator=self.estimator, sampler=self.sampler, first_row=self.first_row,
            row_count=self.row_count, flags=RenderFlag.COVERAGE * self.coverage)

    def shape(self) -> tuple[int, int]:
        return self.row_count or self.height - self.first_row, self.width
