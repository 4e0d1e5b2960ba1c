from __future__ import annotations

import numpy.typing as npt

from pt._callbacks import Progress
from pt._camera import Camera
from pt._columns import check_finite, real_column
from pt._context import Context
from pt._scene import Material
from pt.figures import Figure, Particles, figure
from pt.figures._options import Direction


def render(positions: npt.ArrayLike, radii: npt.ArrayLike, colors: npt.ArrayLike | None = None, *,
           size: tuple[int, int] = (640, 480), samples: int | None = None, error: float | None = None,
           camera: Camera | None = None, up: Direction = "z", floor: bool = False, material: Material | None = None,
           max_path_length: int = 3, denoise: bool = False, seed: int = 0, device: str | None = None,
           context: Context | None = None, progress: Progress | None = None) -> Figure:
    """Renders spheres from arrays, by default with 640 x 480 pixels and 16 samples. Other parameters are as in figure().

    positions   shape (n, 3), n >= 1
    radii       shape (n,), or one number for all; > 0
    colors      shape (n, 3) or (3,), sRGB, floats in [0, 1] or uint8, times the material's diffuse; None: grey
    """
    centers = real_column("positions", positions, 3, None)
    if not len(centers):
        raise ValueError("positions has no spheres: must have at least one")
    check_finite("positions", centers)
    check_finite("radii", radii, positive=True)
    if samples is None and error is None:
        samples = 16
    return figure(Particles(centers), radius=real_column("radii", radii, 1, len(centers)), color=colors, size=size,
                  samples=samples, error=error, camera=camera, up=up, floor=floor, material=material,
                  max_path_length=max_path_length, denoise=denoise, seed=seed, device=device, context=context,
                  progress=progress)
