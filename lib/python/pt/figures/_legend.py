from __future__ import annotations

import io
import math
from typing import Any, Final

import numpy as np
import numpy.typing as npt

from pt.figures._colors import ColorBar, Legend, Swatches
from pt.figures._errors import module

PIXELS_PER_INCH: Final = 100.0
POINTS_PER_INCH: Final = 72.0


def _matplotlib(part: str = "") -> Any:
    return module(f"matplotlib.{part}".rstrip("."), "a legend")


def _plain(text: str) -> str:
    return text.replace("$", r"\$")


def draw(legend: Legend, height: float, font: float, ink: Any) -> Any:
    """`height`, in inches, is the height of a color bar, and the limit for a column of swatches. `font` is in points."""
    if legend is None:
        raise ValueError("legend: is empty, because all colors are given or alike")
    with _matplotlib().rc_context({"font.size": font, "text.color": ink, "axes.labelcolor": ink, "axes.edgecolor": ink,
                     "xtick.color": ink, "ytick.color": ink, "axes.linewidth": font / 14.0}):
        sheet = _matplotlib("figure").Figure(figsize=(3.0, height))
        if isinstance(legend, ColorBar):
            _draw_bar(sheet, legend, height, font, ink)
        else:
            _draw_swatches(sheet, legend, height, font, ink)
    return sheet


def _draw_bar(sheet: Any, bar: ColorBar, height: float, font: float, ink: Any) -> None:
    axes = sheet.add_axes((0.0, 0.0, 1.6 * font / POINTS_PER_INCH / 3.0, 1.0))
    sheet.colorbar(_matplotlib("cm").ScalarMappable(bar.norm, bar.colormap), cax=axes, label=bar.title)
    if bar.no_value:
        patch = _matplotlib("patches").Patch(facecolor=np.array(bar.no_value) / 255.0, edgecolor=ink, label="no value")
        sheet.legend(handles=[patch], loc="upper left", bbox_to_anchor=(0.0, -0.5 * font / POINTS_PER_INCH / height),
                     frameon=False, borderpad=0.0, handlelength=1.6, handletextpad=0.4, borderaxespad=0.0)


def _draw_swatches(sheet: Any, swatches: Swatches, height: float, font: float, ink: Any) -> None:
    line = _matplotlib("lines").Line2D
    dots = [line([], [], linestyle="none", marker="o", markersize=0.9 * font, markerfacecolor=color / 255.0,
                 markeredgecolor=ink, markeredgewidth=font / 20.0) for color in swatches.colors]
    rows = max(int(1.45 * height * POINTS_PER_INCH / (1.6 * font)) - 2, 1)
    sheet.legend(dots, [_plain(name) for name in swatches.names], title=swatches.title, loc="center left",
                 bbox_to_anchor=(0.0, 0.5), ncols=math.ceil(len(dots) / rows), frameon=False, handletextpad=0.2,
                 borderpad=0.0, borderaxespad=0.0, alignment="left")


def save(legend: Legend, file: Any, format: str) -> None:
    dates = {"svg": {"Date": None}, "pdf": {"CreationDate": None}}
    with _matplotlib().rc_context({"svg.hashsalt": "pt"}):
        draw(legend, 2.4, 10.0, "#222222").savefig(file, format=format, dpi=200, bbox_inches="tight", pad_inches=0.08,
                                                   metadata=dates.get(format))


def font_of(height: int, font: float | None) -> float:
    return font or max(9.0, 0.02 * height * POINTS_PER_INCH / PIXELS_PER_INCH)


def raster(legend: Legend, height: int, ink: Any, dpi: float = PIXELS_PER_INCH, font: float | None = None
           ) -> npt.NDArray[np.float64]:
    buffer = io.BytesIO()
    draw(legend, 0.62 * height / dpi, font_of(height, font), ink).savefig(
        buffer, format="png", dpi=dpi, bbox_inches="tight", pad_inches=0.0, transparent=True)
    buffer.seek(0)
    return np.asarray(_matplotlib("image").imread(buffer), np.float64)
