from __future__ import annotations

import math
from typing import Any, Final

import numpy as np

from pt._files import Path, format_of, write_atomically
from pt._fit import Doubles
from pt.figures._colors import ColorBar, Legend, Swatches
from pt.figures._errors import module

POINTS_PER_INCH: Final = 72.0
SHEET: Final = 3.0  # inches
INK: Final = "#222222"
LEGENDS: Final = ("svg", "pdf", "png")


def matplotlib(part: str = "") -> Any:
    return module(f"matplotlib.{part}".rstrip("."), "a legend, axes, words or a scale bar")


def plain(text: str) -> str:
    return text.replace("$", r"\$")


def put_legend(sheet: Any, legend: Legend, left: float, bottom: float, height: float, font: float, ink: Any) -> None:
    """`font` is in points, lengths are in inches. `height` is the height of a color bar and the limit for a column of swatches."""
    if legend is None:
        raise ValueError("legend: is empty, because all colors are given or alike")
    colors = ("text.color", "axes.labelcolor", "axes.edgecolor", "xtick.color", "ytick.color")
    with matplotlib().rc_context({"font.size": font, "axes.linewidth": font / 14.0, **dict.fromkeys(colors, ink)}):
        place = np.array([left, bottom]) / sheet.get_size_inches()
        if isinstance(legend, ColorBar):
            _put_bar(sheet, legend, place, height, font, ink)
        else:
            _put_swatches(sheet, legend, place, height, font, ink)


def _put_bar(sheet: Any, bar: ColorBar, place: Doubles, height: float, font: float, ink: Any) -> None:
    width, whole = sheet.get_size_inches()
    axes = sheet.add_axes((*place, 1.6 * font / POINTS_PER_INCH / width, height / whole))
    sheet.colorbar(matplotlib("cm").ScalarMappable(bar.norm, bar.colormap), cax=axes, label=bar.title)
    if bar.no_value:
        patch = matplotlib("patches").Patch(facecolor=np.array(bar.no_value) / 255.0, edgecolor=ink, label="no value")
        sheet.legend(handles=[patch], loc="upper left", bbox_to_anchor=(place[0], place[1] - 0.5 * font / POINTS_PER_INCH / whole),
                     frameon=False, borderpad=0.0, handlelength=1.6, handletextpad=0.4, borderaxespad=0.0)


def _put_swatches(sheet: Any, swatches: Swatches, place: Doubles, height: float, font: float, ink: Any) -> None:
    line = matplotlib("lines").Line2D
    dots = [line([], [], linestyle="none", marker="o", markersize=0.9 * font, markerfacecolor=color / 255.0,
                 markeredgecolor=ink, markeredgewidth=font / 20.0) for color in swatches.colors]
    rows = max(int(1.45 * height * POINTS_PER_INCH / (1.6 * font)) - 2, 1)
    sheet.legend(dots, [plain(name) for name in swatches.names], title=swatches.title, loc="center left",
                 bbox_to_anchor=(place[0], place[1] + 0.5 * height / sheet.get_size_inches()[1]), ncols=math.ceil(len(dots) / rows),
                 frameon=False, handletextpad=0.2, borderpad=0.0, borderaxespad=0.0, alignment="left")


def _alone(legend: Legend, height: float, font: float) -> Any:
    sheet = matplotlib("figure").Figure(figsize=(SHEET, height))
    put_legend(sheet, legend, 0.0, 0.0, height, font, INK)
    return sheet


def save_legend(legend: Legend, path: Path) -> None:
    format = format_of(path, LEGENDS)
    sheet = _alone(legend, 2.4, 10.0)
    write_atomically(path, lambda file: write(sheet, file, format, dpi=200, bbox_inches="tight", pad_inches=0.08))


def write(sheet: Any, file: Any, format: str, **more: Any) -> None:
    """Equal sheets give equal bytes. Words remain text, not outlines."""
    dates = {"svg": {"Date": None}, "pdf": {"CreationDate": None}}
    with matplotlib().rc_context({"svg.hashsalt": "pt", "svg.fonttype": "none", "pdf.fonttype": 42}):
        sheet.savefig(file, format=format, metadata=dates.get(format), **more)


def extent_of(legend: Legend, height: float, font: float, dpi: float) -> tuple[float, float, float, float]:
    """Returns left, bottom, right and top in inches, relative to the place of put_legend()."""
    sheet = _alone(legend, height, font)
    sheet.set_dpi(dpi)
    box = sheet.get_tightbbox(matplotlib("backends.backend_agg").FigureCanvasAgg(sheet).get_renderer())
    return box.x0, box.y0, box.x1, box.y1
