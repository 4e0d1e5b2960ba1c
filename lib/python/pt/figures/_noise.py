from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
import numpy.typing as npt

from pt._callbacks import Progress
from pt._camera import Camera, RenderSettings
from pt._context import Context
from pt._film import TILE_SIDE
from pt._fit import Array, Doubles
from pt._image import Image
from pt._scene import Scene
from pt.figures._compose import around

MOST_NOISE: Final = 1.5  # steps of 1/255; by taste
FIRST_SAMPLES: Final = 16  # for a stated error
MOST_SAMPLES: Final = 128  # of a pixel; fine textures hide the remaining noise
MOST_COVERAGE: Final = 0.25  # of the square noise
WORST: Final = 1.5  # largest noise of a neighbourhood, relative to MOST_NOISE; by taste
FLOOR: Final = 1.0  # like WORST, for a floor before its shadows are smoothed
SHARE: Final = 1.15  # the second round's aim, relative to the allowed square error
LEAST_GROWTH: Final = 1.02  # smaller rounds cost time
MOST_STEP: Final = 4.0  # most samples after a round, relative to those before
SEQUENCES: Final = 1.0 / math.sqrt(7.0)  # the error of quasi-random points may be this fraction of the stated one

Show = Callable[[Array, Array, float], Array]  # 16 bits of light; arguments: the exposure's image, a multiple of the coverage's error


@dataclass(frozen=True)
class Noise:
    """Root mean square error of means of 2 x 2 pixels that show particles, in steps of 1/255 of the display, with bounds of 95%
    confidence. The eye hardly resolves single pixels, whose errors are twice as large."""

    rms: float
    low: float
    high: float

    @staticmethod
    def of(squares: Doubles) -> Noise:
        """The bounds are as for n = (sum of squares)^2 / (sum of squared squares) pixels of equal error."""
        if not squares.size:
            return Noise(0.0, 0.0, 0.0)
        mean, spread = float(squares.mean()), 1.96 * math.sqrt(float(np.square(squares).sum())) / squares.size
        return Noise(math.sqrt(mean), SEQUENCES * math.sqrt(max(mean - spread, 0.0)), math.sqrt(mean + spread))

    def __str__(self) -> str:
        return f"noise {self.rms:.2g} of 255 ({self.low:.2g} to {self.high:.2g})"


def squares_of(show: Show, radiance: npt.NDArray[np.float32], error: Any, coverage: float = 0.0) -> Doubles:
    """Returns a quarter of each pixel's squared error, in steps of 1/255, averaged over channels."""
    low, high = (show(np.maximum(radiance + way * error, 0.0), radiance, way * coverage).astype(np.float64) for way in (-1, 1))
    squares: Doubles = np.square((high - low) * (0.25 * 255.0 / 65535.0)).mean(axis=2)
    return squares


def until_invisible(context: Context, scene: Scene, camera: Camera, settings: RenderSettings, show: Show, covered: Array,
                    progress: Progress | None) -> Image:
    """Returns an image even if progress stops the rendering."""
    done, ended = 0.5, False

    def watched(first: float, last: float) -> Progress | None:
        def share(fraction: float) -> bool:
            nonlocal ended
            ended = bool(progress and progress(first + (last - first) * fraction))
            return ended
        return share if progress else None

    image = context.render(scene, camera, settings, FIRST_SAMPLES, progress=watched(0.0, done))
    coverage = float(squares_of(show, image.radiance, 0.0, 1.0)[covered].mean()) if covered.any() else 0.0
    most = math.sqrt(MOST_NOISE**2 - min(coverage, MOST_COVERAGE * MOST_NOISE**2))
    while not ended:
        squares = squares_of(show, image.radiance, image.standard_error)
        noise, counts = Noise.of(squares[covered]), image.sample_count[::TILE_SIDE, ::TILE_SIDE].astype(np.float64)
        goals = _goals(squares, covered, counts, noise, most)
        is_small = goals.sum() < LEAST_GROWTH * counts.sum() and (goals < 1.5 * counts).all()
        if (goals == counts).all() or is_small and (noise.high <= most or counts.max() == MOST_SAMPLES):
            break
        needed = np.maximum(goals, counts * (noise.high / most)**2).sum()
        ahead = max(done, float(goals.sum() / needed))
        context.accumulate_tiles(goals - counts, progress=watched(done, ahead))
        image, done = context.image(), ahead
    if progress:
        progress(1.0)
    return image


def _goals(squares: Doubles, covered: Array, counts: Doubles, noise: Noise, aim: float) -> Doubles:
    """Returns each tile's samples after the next round. The least total reaches the noise with counts proportional to
    the root of the variance. Variances are means over neighbouring tiles, because a single one may be small by chance."""
    pixels = _by_tiles(covered | (squares > 0.0))
    variances = around(_by_tiles(squares) * counts, 3) / np.maximum(around(pixels, 3), 1.0) * (pixels > 0.0)
    weights = variances * _by_tiles(covered)
    needed = variances / np.square(np.where(weights > 0.0, WORST, FLOOR) * aim)
    if noise.high > aim:
        most = (SHARE if counts.max() == FIRST_SAMPLES else 1.0) * (aim * noise.rms / noise.high)**2 * float(covered.sum())
        roots = np.sqrt(weights)
        low, high = 0.0, float(roots.sum()) / most
        for _ in range(50):
            middle = 0.5 * (low + high)
            left = float((weights / np.maximum(counts, middle * roots)).sum())
            low, high = (middle, high) if left > most else (low, middle)
        needed = np.maximum(needed, high * roots)
    step = 2.0**np.floor(np.log2(counts)) / 4.0
    goals: Doubles = np.clip(step * np.ceil(needed / step), counts, np.minimum(MOST_STEP * counts, MOST_SAMPLES))
    return goals


def _by_tiles(values: Array) -> Doubles:
    rows, columns = (range(0, side, TILE_SIDE) for side in values.shape)
    sums: Doubles = np.add.reduceat(np.add.reduceat(values, rows, axis=0, dtype=np.float64), columns, axis=1)
    return sums
