"""A picture of spheres in one call."""

from __future__ import annotations

import contextlib
import math

import numpy as np
import numpy.typing as npt

from pt._callbacks import Progress
from pt._camera import Camera, RenderSettings
from pt._columns import check_finite
from pt._context import Context
from pt._image import Image
from pt._scene import Material, Plane, Scene, Sphere, SphereArray
from pt._vectors import Vector

WHITE = Material(diffuse=0.8)
SKY_RADIANCE = 0.9  # nearly white, so that bright spheres stand out from it
LAMP_IRRADIANCE = 0.7  # of a surface that faces the lamp: a quarter of what the whole sky gives
LAMP_DIRECTION = (-0.5, 0.7, 0.5)  # right, up and back as the camera sees it
LAMP_SHARE = 0.35  # its radius over its distance: its shadows are soft
MOST_SAMPLES = 65536  # for a target error


def render(positions: npt.ArrayLike, radii: npt.ArrayLike, colors: npt.ArrayLike | None = None, *,
           size: tuple[int, int] = (640, 480), samples: int | None = None, error: float | None = None,
           camera: Camera | None = None, up: Vector = (0.0, 1.0, 0.0), floor: bool = False,
           material: Material = WHITE, max_path_length: int = 6, seed: int = 0, device: str | None = None,
           context: Context | None = None, progress: Progress | None = None) -> Image:
    """Renders spheres under a white sky and a soft lamp, from a camera that sees all of them.

    positions         shape (n, 3), n >= 1, scene units
    radii             shape (n,), or one number for all; > 0, scene units
    colors            shape (n, 3) or (3,): floats in [0, 1], linear, or uint8, sRGB. They multiply the material's
                      diffuse; None: all are as the material is
    size              width and height of the image, pixels
    samples           a pixel; default 64. With an error the most that a pixel gets, by default 65536
    error             > 0: ends when the image's relative error is at or below it; 0.01 is 1%
    camera            default: Camera.around the spheres
    up                the vertical direction, of the camera that is fitted and of the floor
    floor             whether there is a white plane below the spheres
    material          of the spheres; by default they scatter 0.8 of the light
    max_path_length   surface vertices after the camera, in [1, 1024]
    seed              another one gives other noise
    device            as for Context
    context           takes this one, for many pictures, in place of one that is made and closed
    progress          called with the share that is done; returning True ends the samples early

    Arrays are read in place where SphereArray says so. For anything else than this light, make a Scene and use a
    Context.
    """
    if error is not None and not 0.0 < error < math.inf:
        raise ValueError(f"error = {error}: must be > 0 and finite, or None to take all samples")
    spheres = SphereArray(positions, radii, material, color=colors)
    check_finite("positions", spheres.center)  # camera and light follow from them, and would be what is refused
    check_finite("radii", radii, positive=True)
    if camera is None:
        camera = Camera.around(spheres.center, spheres.radius, aspect=size[0] / size[1], up=up)
    scene = Scene(surroundings(spheres, camera), [ground(spheres, up)] if floor else [], [spheres])
    settings = RenderSettings(*size, max_path_length=max_path_length, seed=seed)
    if samples is None:
        samples = 64 if error is None else MOST_SAMPLES
    with contextlib.ExitStack() as stack:
        used = context or stack.enter_context(Context(device))
        image = used.render(scene, camera, settings, samples, target_error=error or 0.0, progress=progress)
    image.exposure = 0.0  # what this light is made for
    return image


def surroundings(spheres: SphereArray, camera: Camera) -> list[Sphere]:
    """A sky around everything, and a lamp behind the camera."""
    position = np.array(camera.position)
    reach = float((np.linalg.norm(spheres.center - position, axis=1) + spheres.radius).max())
    right, above, back = camera.axes()
    direction = np.column_stack((right, above, back)) @ np.array(LAMP_DIRECTION)
    direction /= np.linalg.norm(direction)
    # All of the lamp is behind the camera, as its radius is less than its way back, so that it is not in the picture.
    distance = 2 * reach
    place, radius = position + distance * direction, LAMP_SHARE * distance
    # A ball of radiance L and radius r at a distance d gives a surface that faces it pi L (r / d)^2.
    square = float(np.square(place - camera.target).sum()) / radius**2
    lamp = Sphere(place, radius, Material(emission=LAMP_IRRADIANCE / np.pi * square))
    sky = Sphere(position, 10 * distance, Material(emission=SKY_RADIANCE))
    return [lamp, sky]


def ground(spheres: SphereArray, up: Vector) -> Plane:
    """Touches the lowest sphere from below."""
    normal = np.array(up, np.float64)
    normal /= np.linalg.norm(normal)
    return Plane(normal, -float((spheres.center @ normal - spheres.radius).min()), WHITE)
