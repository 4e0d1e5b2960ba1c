from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, Final

import numpy as np
import numpy.typing as npt

from pt._display import encode_png, linear
from pt._files import Path, format_of, write_atomically
from pt._fit import Doubles
from pt.figures._colors import Legend, srgb
from pt.figures._files import encode_jpeg
from pt.figures._legend import INK, POINTS_PER_INCH, extent_of, save_legend
from pt.figures._marks import MARGIN, Page
from pt.figures._options import Options

PIXELS_PER_INCH: Final = 100.0
BAR: Final = 0.62  # relative to the picture's height
PAGES: Final = ("png", "jpg", "jpeg", "pdf", "svg")


def font_of(height: int, options: Options) -> float:
    return options.font_size or max(9.0, 0.02 * height * POINTS_PER_INCH / PIXELS_PER_INCH)


def strip_of(legend: Legend, height: int, options: Options) -> int:
    """Returns the width in pixels."""
    if not options.colorbar or legend is None:
        return 0
    dpi = options.printed_dpi or PIXELS_PER_INCH
    left, _, right, _ = extent_of(legend, BAR * height / dpi, font_of(height, options), dpi)
    return math.ceil((right - left) * dpi) + 2 * max(8, round(0.025 * height))


def background_of(options: Options) -> tuple[Doubles | None, str]:
    """Returns the background's color, None if transparent, and the words' color."""
    if isinstance(options.background, str) and options.background == "transparent":
        return None, INK
    is_white = isinstance(options.background, str) and options.background == "white"
    signal = np.array((255, 255, 255) if is_white else srgb("background", options.background)) / 255.0
    return signal, INK if linear(signal) @ (0.2126, 0.7152, 0.0722) > 0.18 else "#dddddd"


class Picture:
    """Figures in rows of `columns`, with words over them."""

    figures: Sequence[Any]
    columns: int = 1
    titles: Sequence[str] = ("",)
    formats: Sequence[str] = PAGES
    legend: Legend = None

    @property
    def _options(self) -> Options:
        options: Options = self.figures[0]._staged.options
        return options

    @property
    def picture_size(self) -> tuple[int, int]:
        height, width = self.figures[0].shape[:2]
        height, width = height * math.ceil(len(self.figures) / self.columns), width * self.columns
        return self._options.size or (self._options.pixel_width or width + strip_of(self.legend, height, self._options), height)

    def to_srgb8(self, exposure: float | None = None, **display: Any) -> npt.NDArray[np.uint8]:
        """Returns sRGB, shape (height, width, 3), or 4 channels with a transparent background. exposure: stops; None:
        the figure's exposure, else automatic. display: as in Image, applied to the light over the background."""
        return self.picture(np.uint8, exposure, **display)

    def picture(self, dtype: Any = np.uint8, exposure: float | None = None, **display: Any) -> npt.NDArray[Any]:
        pixels = self._bare(dtype, exposure, **display)
        page = self._page()
        return pixels if page is None else page.over(pixels)

    def _bare(self, dtype: Any, exposure: float | None, **display: Any) -> npt.NDArray[Any]:
        (width, height), (background, _), most = self.picture_size, background_of(self._options), np.iinfo(dtype).max
        paper = np.zeros(4) if background is None else background
        pixels = np.empty((height, width, len(paper)), dtype)
        pixels[:] = np.floor(most * paper + 0.5)
        for figure, (left, top) in zip(self.figures, self._places):
            rows, columns = figure.shape[:2]
            pixels[top:top + rows, left:left + columns] = figure._pixels(dtype, exposure, background, **display)
        return pixels

    @property
    def _places(self) -> list[tuple[int, int]]:
        height, width = self.figures[0].shape[:2]
        return [(k % self.columns * width, k // self.columns * height) for k in range(len(self.figures))]

    def _page(self, always: bool = False) -> Page | None:
        options, (width, height) = self._options, self.picture_size
        legend = self.legend if options.colorbar else None
        is_plain = options.scale_bar is None and not (options.axes or any(self.titles) or legend)
        if is_plain and not always and not any(each._staged.drawn.marks for each in self.figures):
            return None
        background, ink = background_of(options)
        dpi = options.printed_dpi or PIXELS_PER_INCH
        page = Page((width, height), dpi, font_of(height, options), ink)
        for figure, place, title in zip(self.figures, self._places, self.titles, strict=True):
            (rows, columns), drawn, camera = figure.shape[:2], figure._staged.drawn, figure.camera
            margin = round(MARGIN * min(rows, columns))
            page.add_marks(drawn.marks, figure._shares.seen, camera, np.array(place), (columns, rows), "w" if background is None else background)
            if options.scale_bar is not None:
                page.add_bar(options.scale_bar, camera, drawn.scale, figure._shares.shapes, place)
            if options.axes:
                page.add_axes(camera, drawn.cell, figure._shares.shapes, place)
            if title:
                page.word(place[0] + 0.5 * columns, place[1] + margin, title, va="top")
        if legend is not None:
            page.add_legend(legend, self.columns * columns, BAR * height / dpi)
        return page

    def encode(self, format: str, *, exposure: float | None = None, bits: int = 8) -> bytes:
        """Returns a png, jpg, pdf or svg file, or for a figure an exr file with linear radiance. bits: 8 or, for png, 16."""
        dpi = self._options.printed_dpi
        if format in ("jpg", "jpeg"):
            if self._options.background == "transparent":
                raise ValueError("background = transparent: JPEG has no alpha; PNG has")
            return encode_jpeg(self.picture(np.uint8, exposure), dpi)
        if format in ("pdf", "svg"):
            page = self._page(always=True)
            assert page is not None
            return page.file(format, self._bare(np.uint8, exposure), self._options.inches or self.picture_size[0] / page.dpi)
        if format != "png" or bits not in (8, 16):
            raise ValueError(f"format = {format!r}, bits = {bits}: must be {', '.join(self.formats)}, of 8 bits, or of 16 in a png")
        return encode_png(self.picture(np.uint8 if bits == 8 else np.uint16, exposure), dpi)

    def save(self, path: Path, *, exposure: float | None = None, bits: int = 8) -> None:
        """Writes a file atomically. In .pdf and .svg, words and lines are vectors over the picture."""
        data = self.encode(format_of(path, self.formats), exposure=exposure, bits=bits)
        write_atomically(path, lambda file: file.write(data))

    def save_legend(self, path: Path) -> None:
        """Writes .svg, .pdf or .png. Raises ValueError if there is no legend."""
        save_legend(self.legend, path)

    def _repr_png_(self) -> bytes:
        return self.encode("png")
