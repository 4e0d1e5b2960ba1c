from __future__ import annotations

from typing import Any, Final

import numpy as np
import numpy.typing as npt

from pt._columns import Array
from pt._display import automatic_exposure, to_pixels
from pt._scene_file import Display
from pt.view._frame import Frame

Pixels = npt.NDArray[np.uint8]
SPOILT: Final = (255, 0, 255)
SIGNALS: Final[dict[str, Any]] = {"exposure": 0.0, "gamma": 1.0}  # numbers in [0, 1] become 0 to 255


class Look:
    """A page's display. Only the radiance uses `display`; the colors of other layers are fixed.

    `stops` is the exposure, which stays while the camera moves.
    """

    def __init__(self, display: Display, stops: float = 0.0) -> None:
        self.is_automatic = display.exposure == "auto"
        self.stops = stops if self.is_automatic else float(display.exposure)
        self._fields = display.fields()
        self.pixels([0.0, 0.0, 0.0])  # raises for values that the library refuses

    def pixels(self, radiance: npt.ArrayLike) -> Pixels:
        return to_pixels(radiance, **{**self._fields, "exposure": self.stops})

    def shown(self, frame: Frame) -> bytes:
        pixels, layer = frame.pixels, frame.state["layer"]
        assert pixels is not None
        if layer == "radiance":
            if self.is_automatic and not frame.state.get("moving"):
                self.stops = automatic_exposure(pixels)
            shown = self.pixels(pixels)
            if frame.spoilt is not None:
                shown[frame.spoilt] = SPOILT
        elif layer in ("depth", "sample count"):
            shown = to_pixels(_greys(pixels[:, :, :1], layer == "depth"), **SIGNALS)
        elif layer == "normal":
            shown = to_pixels(0.5 + 0.5 * pixels, **SIGNALS)
        elif layer == "albedo":
            shown = to_pixels(pixels, 0.0)
        else:
            known = np.isfinite(pixels).all(axis=2, keepdims=True)
            shown = to_pixels(np.nan_to_num(pixels), automatic_exposure(np.where(known, pixels, 0.0)))
        data: bytes = np.concatenate([shown, np.full_like(shown[:, :, :1], 255)], axis=2).tobytes()
        return data


def _greys(values: Array, is_near_bright: bool) -> Array:
    """Infinite numbers are black."""
    finite = np.isfinite(values)
    known = values[finite] if finite.any() else np.zeros(1)
    least, extent = known.min(), np.ptp(known)
    shares = (np.where(finite, values, least) - least) / extent if extent > 0 else np.full(values.shape, 0.5)
    return np.repeat(np.where(finite, 1.0 - 0.9 * shares if is_near_bright else shares, 0.0), 3, axis=2)
