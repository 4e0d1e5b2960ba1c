from __future__ import annotations

import io
import re
from typing import Any, Final

import numpy as np
import numpy.typing as npt

from pt._camera import Camera
from pt._fit import Doubles
from pt.figures._errors import module
from pt.figures._legend import POINTS_PER_INCH

MARGIN: Final = 0.04  # relative to the picture's shorter side; by taste
THICK: Final = 0.25  # relative to the font size


def bar_length(text: str | float) -> float:
    """Returns the first number of `text`, in units of the data."""
    found = re.match(r"\s*([\d.]+(?:[eE][-+]?\d+)?)", str(text))
    return float(found[1]) if found else 0.0


def with_scale_bar(pixels: npt.NDArray[Any], text: str | float, camera: Camera, scale: float, ink: Any, dpi: float, font: float
                   ) -> npt.NDArray[Any]:
    """`scale` is in scene units per unit of the data, `font` in points. The bar is exact to a fraction of a pixel."""
    height, width = pixels.shape[:2]
    assert camera.vertical_extent is not None
    length = bar_length(text) * scale * height / camera.vertical_extent
    if not 0.0 < length <= width * (1.0 - 2.0 * MARGIN):
        raise ValueError(f"scale_bar = {text!r}: is longer than the picture, {width / height * camera.vertical_extent / scale:.3g}")
    thick, margin = max(2, round(THICK * font * dpi / POINTS_PER_INCH)), round(MARGIN * min(width, height))
    shares = np.zeros((height, width))
    bottom = height - margin
    ends = np.clip(np.arange(1, width + 1) - margin, 0, 1), np.clip(margin + length - np.arange(width), 0, 1)
    shares[bottom - thick:bottom] = np.minimum(*ends)
    words = _words(str(text), ink, dpi, font)[:, :, 3]
    top, left = bottom - 2 * thick - words.shape[0], max(round(margin + 0.5 * length - 0.5 * words.shape[1]), margin)
    if top >= 0:
        part = shares[top:top + words.shape[0], left:left + words.shape[1]]
        part[:] = np.maximum(part, words[:part.shape[0], :part.shape[1]])
    most = np.iinfo(pixels.dtype).max
    color = np.array([*(most * np.array(list(bytes.fromhex(ink[1:]))) / 255.0), *[most] * (pixels.shape[2] - 3)])
    result: npt.NDArray[Any] = np.floor(pixels + shares[:, :, None] * (color - pixels) + 0.5).astype(pixels.dtype)
    return result


def _words(text: str, ink: Any, dpi: float, font: float) -> Doubles:
    sheet = module("matplotlib.figure", "a scale bar").Figure(figsize=(0.1, 0.1))
    sheet.text(0.0, 0.0, text.replace("$", r"\$"), color=ink, fontsize=font)
    buffer = io.BytesIO()
    sheet.savefig(buffer, format="png", dpi=dpi, bbox_inches="tight", pad_inches=0.0, transparent=True)
    buffer.seek(0)
    return np.asarray(module("matplotlib.image", "a scale bar").imread(buffer), np.float64)
