from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any, Final

import numpy as np

from pt._camera import Camera, RenderSettings
from pt._context import Context
from pt._enums import Format, Quantity
from pt._fit import Array, Doubles

PER_SIDE: Final = 4
FINE: Final = 8  # if the rms error exceeds ROUGH
ROUGH: Final = 0.02
MOST_PER_SIDE: Final = 32
MOST_RAYS: Final = 2**32 - 1
BAND_ROWS: Final = 32
LEAST_STEP: Final = 0.1
LEAST_RADIUS: Final = 2.5
OUTLINE_LIGHT: Final = 0.01
SMALL_STEP: Final = 1.0  # in radii; by taste, like the next four values
LARGE_STEP: Final = 8.0
WIDER: Final = 2.0  # width of outlines at large steps
RESIDUES_APART: Final = 6
INK: Final = 0.2  # fraction of a shape's color in its outline, in the illustrative style


@dataclass(frozen=True)
class Shares:
    """Values of pixels from first hits: coverage by shapes and outlines, the shapes' mean depth, and the fraction by which they fade.
    `flat` has unlit colors. `seen` masks labels that nothing hides. `floor` is the radiance beside shapes. `error` belongs to `shapes`."""

    shapes: Doubles
    outlines: Doubles
    depths: Doubles | None = None
    fade: Doubles | None = None
    flat: Array | None = None
    ink: Any = OUTLINE_LIGHT
    seen: Array | None = None
    floor: Array | None = None
    error: Any = 0.0


@dataclass(frozen=True)
class Overlaid:
    """first    index of the first particle among all spheres and capsules
    count    number of particles, bonds, vectors and edges of the cell, in this order
    radii    of shapes with outlines: all except edges of the cell
    steps    draws outlines only at larger steps of depth and between groups
    groups   shape (n, 2): chain and residue
    """

    first: int
    count: int
    radii: Array
    outlines: bool
    depths: bool = False
    steps: bool = False
    groups: Array | None = None


def line_width(size: tuple[int, int]) -> float:
    return max(1.0, 0.0016 * max(size))


def rays_per_side(samples: float, pixels: int) -> int:
    most = min(MOST_PER_SIDE, math.isqrt(MOST_RAYS // pixels))
    return max(min(math.ceil(math.sqrt(samples)), most) & ~1, PER_SIDE)


def read_shares(context: Context, camera: Camera, settings: RenderSettings, overlaid: Overlaid, per_side: int = PER_SIDE
                ) -> Shares:
    """Replaces the render settings of the context."""
    width, height = settings.width, settings.height
    shares = Shares(np.zeros((height, width)), np.zeros((height, width)))
    margin = math.ceil(0.5 * WIDER * line_width((width, height))) + 1 if overlaid.outlines else 0
    means, error = np.zeros((height, width)), np.zeros((height, width))
    band = max(BAND_ROWS * PER_SIDE**2 // per_side**2, 1)
    for first in range(0, height, band):
        end = min(first + band, height)
        top, bottom = max(first - margin, 0), min(end + margin, height)
        objects, depths = _first_hits(context, settings, top, bottom, per_side, overlaid.outlines or overlaid.depths)
        index = objects - np.uint32(overlaid.first)
        wanted = slice((first - top) * per_side, (end - top) * per_side)
        hits = index[wanted] < overlaid.count
        shares.shapes[first:end] = _share(hits, per_side)
        error[first:end] = np.abs(_share(hits, per_side, -1))
        if overlaid.outlines:
            pixels = pixels_per_length(camera, height, depths)
            covered = _outlines(index, depths, overlaid, pixels, line_width((width, height)))
            shares.outlines[first:end] = _share(covered[wanted], per_side)
        if overlaid.depths:
            hits = hits.reshape(end - first, per_side, width, per_side)
            sums = depths[wanted].reshape(hits.shape).sum(axis=(1, 3), where=hits, dtype=np.float64)
            means[first:end] = sums / np.maximum(hits.sum(axis=(1, 3)), 1)
    return replace(shares, depths=means if overlaid.depths else None, error=error)


def _share(hits: Array, per_side: int, sign: int = 1) -> Doubles:
    """sign = -1: half the difference between two interleaved sets of rays, which estimates the error."""
    counts: Any = hits.view(np.int8)
    rows: Any = sum(sign**i * counts[i::per_side] for i in range(per_side))
    rows = rows.astype(np.int16)
    cells: Doubles = sum(sign**i * rows[:, i::per_side] for i in range(per_side)) / per_side**2
    return cells


def _first_hits(context: Context, settings: RenderSettings, top: int, bottom: int, per_side: int, with_depths: bool
                ) -> tuple[Array, Array]:
    context.set_render(replace(settings, width=settings.width * per_side, height=settings.height * per_side,
                               first_row=top * per_side, row_count=(bottom - top) * per_side))
    objects = context.readback(Quantity.OBJECT, format=Format.R32UI)[:, :, 0]
    depths = context.readback(Quantity.DEPTH)[:, :, 0] if with_depths else objects
    return objects, depths


def pixels_per_length(camera: Camera, height: int, depths: Any) -> Any:
    return height / camera._view_height(depths)


def _outlines(index: Array, depths: Array, overlaid: Overlaid, pixels: Any, width: float) -> Array:
    """A ball has an outline beside pixels without shapes, and beside shapes that are farther by a tenth of its radius."""
    has_outline, is_shape = index < len(overlaid.radii), index < overlaid.count
    radii = overlaid.radii[np.where(has_outline, index, 0) if overlaid.radii.strides[0] else np.zeros_like(index)]
    large = has_outline & (radii * pixels >= LEAST_RADIUS * width)
    groups = None if overlaid.groups is None else overlaid.groups[np.where(has_outline, index, 0)]
    edges, wide = np.zeros(index.shape, bool), np.zeros(index.shape, bool)
    for here, other in _neighbours():
        steps, open_ = depths[other] - depths[here], ~is_shape[other]
        behind = open_ | (steps > (SMALL_STEP if overlaid.steps else LEAST_STEP) * radii[here])
        if groups is not None:
            apart = np.abs(groups[here] - groups[other])
            behind |= ((apart[..., 0] > 0) | (apart[..., 1] >= RESIDUES_APART)) & (steps >= 0.0)
        edges[here] |= large[here] & (index[here] != index[other]) & behind
        if overlaid.steps:
            wide[here] |= large[here] & (open_ | (steps > LARGE_STEP * radii[here]))
    return _widened(edges, width) | (_widened(wide, WIDER * width) if overlaid.steps else False)


def _widened(edges: Array, width: float) -> Array:
    reach = math.floor(0.5 * width * PER_SIDE)
    covered = edges.copy()
    padded = np.pad(edges, reach)
    for down in range(-reach, reach + 1):
        for right in range(-reach, reach + 1):
            if math.hypot(down, right) <= 0.5 * width * PER_SIDE:
                covered |= padded[reach + down:reach + down + len(edges), reach + right:reach + right + edges.shape[1]]
    return covered


def _neighbours() -> Iterator[tuple[tuple[slice, slice], tuple[slice, slice]]]:
    whole, later, before = slice(None), slice(1, None), slice(None, -1)
    for first, second in ((later, before), (before, later)):
        yield (whole, first), (whole, second)
        yield (first, whole), (second, whole)
