from __future__ import annotations

import io
import math
import re
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, Final

import numpy as np
import numpy.typing as npt

from pt._camera import Camera
from pt._fit import Array, Doubles
from pt.figures._cell import Cell
from pt.figures._colors import Legend
from pt.figures._legend import POINTS_PER_INCH, extent_of, matplotlib, plain, put_legend, write
from pt.figures._overlay import pixels_per_length
from pt.figures._particles import Particles
from pt.figures._select import column, masked, rules

MARGIN: Final = 0.04  # relative to the picture's shorter side; by taste
THICK: Final = 0.25  # relative to the font size, like ARROW
ARROW: Final = 3.0
AXES: Final = ("#c0392b", "#1e8449", "#2471a3")
MOST_WORDS: Final = 1000
HAIR: Final = 1e-3  # pixels, because matplotlib rounds sizes down
NEARER: Final = 1e-3  # relative to the radius


@dataclass(frozen=True)
class Marks:
    """Labels of balls, and distances, in scene units."""

    words: Sequence[str] = ()
    places: Doubles = field(default_factory=lambda: np.zeros((0, 3)))
    radii: Doubles = field(default_factory=lambda: np.zeros(0))
    ends: Doubles = field(default_factory=lambda: np.zeros((0, 2, 3)))
    lengths: Sequence[str] = ()

    def __bool__(self) -> bool:
        return len(self.words) + len(self.lengths) > 0

    @staticmethod
    def of(particles: Particles, labels: Any, distances: Any, radii: Array, shown: Array | None, scale: float) -> Marks:
        words = words_of(particles, labels)
        rows = np.flatnonzero((words != "") & (True if shown is None else shown))
        if len(rows) > MOST_WORDS:
            raise ValueError(f"labels: has {len(rows):,} words: must have at most {MOST_WORDS:,}")
        pairs = np.zeros((0, 2), np.intp) if distances is None else np.asarray(distances)
        if pairs.ndim != 2 or pairs.shape[1] != 2 or pairs.dtype.kind not in "iu":
            raise ValueError(f"distances = {distances!r}: must be pairs of indices, shape (k, 2)")
        if len(bad := pairs[(pairs < 0) | (pairs >= len(particles))]):
            raise ValueError(f"distances: {bad[0]}: must be an index of a particle, from 0 to {len(particles) - 1}")
        ends = particles.positions[pairs].astype(np.float64)
        lengths = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
        sizes = np.broadcast_to(radii, len(particles))[rows].astype(np.float64)
        return Marks(words[rows].tolist(), particles.positions[rows] * np.float64(scale), sizes * scale, ends * scale,
                     [f"{length:.3g}" for length in lengths])

    def seen(self, camera: Camera, depths: Array) -> Array:
        """Masks balls whose middle nothing hides. `depths` has first hits of pixels."""
        across, down, away = places_of(camera, depths.shape[::-1], self.places).T
        inside = (away > 0.0) & (across >= 0.0) & (down >= 0.0) & (across < depths.shape[1]) & (down < depths.shape[0])
        hits = depths[np.where(inside, down, 0).astype(np.intp), np.where(inside, across, 0).astype(np.intp)]
        seen: Array = inside & (hits >= away - (1.0 + NEARER) * self.radii)
        return seen


def words_of(particles: Particles, given: Any) -> Array:
    count = len(particles)
    base, types, picks = rules(given)
    if base is not None and not isinstance(base, str) and np.shape(base) != (count,):
        raise ValueError(f"labels has shape {np.shape(base)}: must be ({count},)")
    words = np.full(count, "", object)
    words[:] = _texts(particles, base) if base is not None else ""
    for selection, each in {**types, **picks}.items():
        chosen = masked(particles, selection, "labels")
        words[chosen] = _texts(particles, each)[chosen]
    return words


def _texts(particles: Particles, given: Any) -> Array:
    values = np.asarray(given)
    if values.shape == ():
        try:
            values = column(particles, str(given))
        except ValueError:
            return np.full(len(particles), str(given), object)
    return np.array([f"{each:.4g}" if isinstance(each, float) else str(each) for each in values.tolist()], object)


def places_of(camera: Camera, size: Sequence[int], points: Doubles) -> Doubles:
    """Returns pixels from the left and the top, and depths."""
    right, above, back = camera.axes()
    ways = points - np.asarray(camera.position)
    depths = -(ways @ back)
    with np.errstate(divide="ignore", invalid="ignore"):
        pixels = pixels_per_length(camera, size[1], depths)
        return np.stack([0.5 * size[0] + pixels * (ways @ right), 0.5 * size[1] - pixels * (ways @ above), depths], axis=1)


def bar_length(text: str | float) -> float:
    found = re.match(r"\s*([\d.]+(?:[eE][-+]?\d+)?)", str(text))
    return float(found[1]) if found else 0.0


class Page:
    """Lengths are in pixels from the upper left corner, `font` is in points."""

    def __init__(self, size: Sequence[int], dpi: float, font: float, ink: str) -> None:
        self.size, self.dpi, self.font, self.ink, self.em = size, dpi, font, ink, font * dpi / POINTS_PER_INCH
        self.taken: dict[tuple[int, ...], float] = {}
        self.sheet = matplotlib("figure").Figure(figsize=[(side + HAIR) / dpi for side in size], facecolor="none")
        self.axes = self.sheet.add_axes((0.0, 0.0, 1.0, 1.0))
        self.axes.set(xlim=(0, size[0]), ylim=(size[1], 0))
        self.axes.set_axis_off()

    def word(self, across: float, down: float, text: str, **more: Any) -> None:
        self.axes.text(across, down, plain(text), **{"color": self.ink, "fontsize": self.font, "ha": "center", "va": "center", **more})

    def free_corner(self, shapes: Array, place: Sequence[int], width: float, height: float) -> Doubles:
        """Returns the box's lower left in the emptiest corner of the figure at `place`."""
        size = np.array(shapes.shape[::-1])
        margin = round(MARGIN * size.min())
        rooms = np.array([(left, down) for down in (size[1] - margin, margin + height) for left in (margin, size[0] - margin - width)])
        sums = [shapes[int(down - height):int(down), int(left):int(left + width)].sum() + self.taken.get((*place, k), 0.0)
                for k, (left, down) in enumerate(rooms.clip(0.0))]
        corner = int(np.argmin(sums))
        self.taken[(*place, corner)] = math.inf
        chosen: Doubles = place + rooms[corner]
        return chosen

    def add_bar(self, text: str | float, camera: Camera, scale: float, shapes: Array, place: Sequence[int]) -> None:
        assert camera.vertical_extent is not None
        size = shapes.shape[::-1]
        length = bar_length(text) * scale * size[1] / camera.vertical_extent
        if not 0.0 < length <= size[0] * (1.0 - 2.0 * MARGIN):
            raise ValueError(f"scale_bar = {text!r}: is longer than the picture, of {size[0] / size[1] * camera.vertical_extent / scale:.3g}")
        thick = max(2, round(THICK * self.em))
        corner = self.free_corner(shapes, place, length, 3.0 * self.em)
        self.axes.add_patch(matplotlib("patches").Rectangle(corner - (0.0, thick), length, thick, color=self.ink, lw=0.0, snap=False))
        wide = length > 0.6 * len(str(text)) * self.em
        self.word(corner[0] + 0.5 * length * wide, corner[1] - 1.6 * thick, str(text), va="bottom", ha="center" if wide else "left")

    def add_axes(self, camera: Camera, cell: Cell | None, shapes: Array, place: Sequence[int]) -> None:
        right, above, back = camera.axes()
        vectors = np.eye(3) if cell is None else cell.vectors
        ways = {k: vector / np.linalg.norm(vector) for k, vector in enumerate(vectors) if vector.any()}
        side = 2.0 * ARROW * self.em
        middle = self.free_corner(shapes, place, side, side) + 0.5 * side * np.array([1.0, -1.0])
        for k in sorted(ways, key=lambda k: float(ways[k] @ back)):
            way = np.array([ways[k] @ right, -(ways[k] @ above)])
            self.axes.annotate("", middle + ARROW * self.em * way, middle, arrowprops={
                "arrowstyle": "-|>", "color": AXES[k], "lw": 0.14 * self.font, "shrinkA": 0.0, "shrinkB": 0.0,
                "mutation_scale": self.font})
            across, down = middle + (ARROW + 0.5 / max(float(np.hypot(*way)), 0.2)) * self.em * way
            self.word(across, down, ("xyz" if cell is None else "abc")[k])

    def add_marks(self, marks: Marks, seen: Array, camera: Camera, place: Doubles, size: Sequence[int], paper: Any) -> None:
        box = {"boxstyle": "round,pad=0.1", "facecolor": paper, "alpha": 0.7, "linewidth": 0.0}
        for first, second, text in zip(*(places_of(camera, size, ends) for ends in (marks.ends[:, 0], marks.ends[:, 1])), marks.lengths):
            if first[2] > 0.0 and second[2] > 0.0:
                (across, down), (x, y) = place + first[:2], place + second[:2]
                self.axes.plot((across, x), (down, y), color=self.ink, lw=0.12 * self.font, dashes=(3, 2))
                self.word(0.5 * (across + x), 0.5 * (down + y), text, bbox=box)
        for (across, down, _), text in zip(places_of(camera, size, marks.places)[seen], np.array(marks.words, object)[seen]):
            self.word(place[0] + across, place[1] + down, text, bbox=box)

    def add_legend(self, legend: Legend, left: int, height: float) -> None:
        box = extent_of(legend, height, self.font, self.dpi)
        width, whole = self.sheet.get_size_inches()
        put_legend(self.sheet, legend, 0.5 * (left / self.dpi + width - box[0] - box[2]), 0.5 * (whole - box[1] - box[3]), height,
                   self.font, self.ink)

    def over(self, pixels: npt.NDArray[Any]) -> npt.NDArray[Any]:
        """Porter and Duff 1984."""
        buffer, most = io.BytesIO(), np.iinfo(pixels.dtype).max
        self.sheet.savefig(buffer, format="rgba", dpi=self.dpi)
        marks = np.frombuffer(buffer.getvalue(), np.uint8).reshape(*pixels.shape[:2], 4) / 255.0
        share = marks[:, :, 3:]
        kept = (1.0 - share) * (pixels[:, :, 3:] / most if pixels.shape[2] == 4 else 1.0)
        colors = (share * marks[:, :, :3] * most + kept * pixels[:, :, :3]) / np.maximum(share + kept, 1e-9)
        result = np.concatenate([colors, most * (share + kept)], axis=2)[:, :, :pixels.shape[2]]
        rounded: npt.NDArray[Any] = np.floor(result + 0.5).astype(pixels.dtype)
        return rounded

    def file(self, format: str, pixels: npt.NDArray[np.uint8], inches: float) -> bytes:
        self.axes.imshow(pixels, extent=(0, self.size[0], self.size[1], 0), aspect="auto", interpolation="none", zorder=0)
        self.sheet.set_size_inches(inches, inches * self.size[1] / self.size[0])
        buffer = io.BytesIO()
        write(self.sheet, buffer, format)
        return buffer.getvalue()
