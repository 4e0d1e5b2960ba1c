from __future__ import annotations

from typing import Any, Final

import numpy as np
import numpy.typing as npt

from pt._fit import Array, Doubles
from pt.figures._overlay import Shares

WINDOW: Final = 9  # pixels
FLAT: Final = 0.75  # fraction of unlit color in the illustrative style; by taste


def compose(radiance: npt.NDArray[np.float32], stage: Any, shares: Shares, exposure: float) -> tuple[Doubles, Doubles]:
    """Returns linear light multiplied by alpha, shape (height, width, 3), and alpha, shape (height, width). `stage` is the radiance of the
    scene without particles: an image, or a number if all pixels are alike.

    Debevec 1998, "Rendering Synthetic Objects into Real Scenes", section 5: the background gets the change that the particles make. A
    pixel with coverage a and exposure T has the light T(radiance) + (1 - a) (1 - T(stage)) over white. Alpha is the smallest that gives
    this light.
    """
    if shares.floor is not None:
        radiance = np.where(shares.shapes[:, :, None] > 0.0, radiance, shares.floor)
    if shares.flat is not None:
        radiance = radiance + np.float32(FLAT) * (shares.flat + (1.0 - shares.shapes[:, :, None]) * stage - radiance)
    behind = np.clip(stage * 2.0**exposure, 0.0, 1.0)
    share = shares.shapes[:, :, None]
    light = np.clip(radiance * 2.0**exposure, 0.0, 1.0) + (1.0 - share) * (1.0 - behind)
    light = np.clip(light, 0.0, 1.0)
    alpha = np.maximum(shares.shapes, 1.0 - light.min(axis=2))
    light = np.maximum(light - (1.0 - alpha[:, :, None]), 0.0)
    light += shares.outlines[:, :, None] * (shares.ink - light)
    alpha += shares.outlines * (1.0 - alpha)
    if shares.fade is None:
        return light, alpha
    kept = 1.0 - shares.fade
    return light * kept[:, :, None], alpha * kept


def smoothed(shadow: Array, error: Array, floor: Array) -> Array:
    """Averages windows of floor pixels whose spread is due to noise (Lee 1980, "Digital Image Enhancement and Noise Filtering by Use of
    Local Statistics")."""
    count = np.maximum(around(floor, WINDOW), 1)[:, :, None]
    mean, square, noise = (around(np.where(floor[:, :, None], each, 0.0), WINDOW) / count for each in (shadow, shadow**2, error**2))
    spread = (square - mean**2).sum(axis=2, keepdims=True)
    kept = np.clip(1.0 - noise.sum(axis=2, keepdims=True) / np.maximum(spread, 1e-30), 0.0, 1.0)
    return np.where(floor[:, :, None], mean + kept * (shadow - mean), shadow)


def around(values: Array, side: int) -> Doubles:
    """Sums of windows."""
    padded: Any = np.pad(values.astype(np.float64), [(side // 2, side // 2)] * 2 + [(0, 0)] * (values.ndim - 2))
    height, width = values.shape[:2]
    rows: Any = sum(padded[down:down + height] for down in range(side))
    sums: Doubles = sum(rows[:, right:right + width] for right in range(side))
    return sums


def lay_over(light: Doubles, alpha: Doubles, background: Doubles) -> Doubles:
    result: Doubles = light + (1.0 - alpha[:, :, None]) * background
    return result
