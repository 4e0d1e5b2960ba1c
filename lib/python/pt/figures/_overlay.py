"""What is laid over a rendered figure: the share of each pixel that particles cover, lines of the cell that go behind
them, and outlines; all from what rays meet first, 16 to a pixel."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from pt._camera import Camera, RenderSettings
from pt._context import Context
from pt._enums import Format, Quantity
from pt._fit import Array, Doubles

PER_SIDE: Final = 4  # rays, along each side of a pixel
BAND_ROWS: Final = 16  # whose hits take less memory on the device than the picture does
ROUNDING: Final = 1e-5  # of depths in float32 and of what they are computed from
LEAST_STEP: Final = 0.1  # of the radius, by which something is behind an outline
LEAST_RADIUS: Final = 2.5  # of a ball with an outline, in widths of the line: others would be all outline


@dataclass(frozen=True)
class Shares:
    """Of each pixel, shape (height, width), from 0 to 1."""

    particles: Doubles
    lines: Doubles
    outlines: Doubles


@dataclass(frozen=True)
class Overlaid:
    """first      index of the first particle among all spheres
    radii      shape (n,)
    segments   ends of lines, scene units: pairs of shape (3,)
    """

    first: int
    radii: Array
    segments: Sequence[tuple[Doubles, Doubles]]
    outlines: bool


def line_width(size: tuple[int, int]) -> float:
    """Pixels: a thousandth and a half of the picture's longer side, and never less than one."""
    return max(1.0, 0.0016 * max(size))


def cell_edges(origin: Doubles, vectors: Doubles) -> list[tuple[Doubles, Doubles]]:
    """Twelve lines."""
    corners = cell_corners(origin, vectors)
    return [(corners[k], corners[k | 1 << edge]) for k in range(8) for edge in range(3) if not k >> edge & 1]


def cell_corners(origin: Doubles, vectors: Doubles) -> Doubles:
    """Shape (8, 3): bit i of a corner's index says whether it is at the end of edge i."""
    ends = np.arange(8)[:, None] >> np.arange(3) & 1
    corners: Doubles = origin + ends @ vectors
    return corners


def read_shares(context: Context, camera: Camera, settings: RenderSettings, overlaid: Overlaid) -> Shares:
    """The context has the scene and the camera; its render settings are replaced."""
    width, height = settings.width, settings.height
    shares = Shares(*(np.zeros((height, width)) for _ in range(3)))
    radius = 0.5 * line_width((width, height)) * PER_SIDE
    lines = _line_hits(camera, (width, height), overlaid.segments, radius)
    margin = math.ceil(0.5 * line_width((width, height))) + 1 if overlaid.outlines else 0
    for first in range(0, height, BAND_ROWS):
        end = min(first + BAND_ROWS, height)
        top, bottom = max(first - margin, 0), min(end + margin, height)
        objects, depths = _first_hits(context, settings, top, bottom, overlaid.outlines or len(lines[0]) > 0)
        is_particle = objects - np.uint32(overlaid.first) < len(overlaid.radii)
        wanted = slice((first - top) * PER_SIDE, (end - top) * PER_SIDE)
        shares.particles[first:end] = _share(is_particle[wanted])
        if len(lines[0]):
            covered = np.zeros(objects.shape, bool)
            begin, stop = np.searchsorted(lines[0], (top * PER_SIDE, bottom * PER_SIDE))
            rows, columns, ways = (each[begin:stop] for each in lines)
            rows = rows - top * PER_SIDE
            shown = ways * (1.0 - ROUNDING) <= depths[rows, columns]
            covered[rows[shown], columns[shown]] = True
            shares.lines[first:end] = _share(covered[wanted])
        if overlaid.outlines:
            pixels = _pixels_per_length(camera, height, depths)
            covered = _outlines(objects, depths, is_particle, overlaid, pixels, line_width((width, height)))
            shares.outlines[first:end] = _share(covered[wanted])
    return shares


def _share(hits: Array) -> Doubles:
    rows, columns = hits.shape
    cells: Doubles = hits.reshape(rows // PER_SIDE, PER_SIDE, columns // PER_SIDE, PER_SIDE).mean(axis=(1, 3))
    return cells


def _first_hits(context: Context, settings: RenderSettings, top: int, bottom: int, with_depths: bool
                ) -> tuple[Array, Array]:
    context.set_render(replace(settings, width=settings.width * PER_SIDE, height=settings.height * PER_SIDE,
                               first_row=top * PER_SIDE, row_count=(bottom - top) * PER_SIDE))
    objects = context.readback(Quantity.OBJECT, format=Format.R32UI)[:, :, 0]
    depths = context.readback(Quantity.DEPTH)[:, :, 0] if with_depths else objects
    return objects, depths


def _pixels_per_length(camera: Camera, height: int, depths: Array) -> Array:
    """Across the view, at these depths."""
    if camera.vertical_extent is not None:
        return np.broadcast_to(height / camera.vertical_extent, depths.shape)
    assert camera.vertical_fov is not None
    scale: Array = 0.5 * height / (depths * math.tan(0.5 * camera.vertical_fov))
    return scale


def _project(camera: Camera, size: tuple[int, int], point: Doubles) -> tuple[float, float, float]:
    """Column and row in hits, and depth along the view."""
    right, above, back = camera.axes()
    way = point - np.asarray(camera.position)
    depth = float(-(way @ back))
    scale = float(_pixels_per_length(camera, size[1], np.array([depth]))[0]) * PER_SIDE
    return (0.5 * size[0] * PER_SIDE + scale * float(way @ right), 0.5 * size[1] * PER_SIDE - scale * float(way @ above),
            depth)


def _line_hits(camera: Camera, size: tuple[int, int], segments: Sequence[tuple[Doubles, Doubles]], radius: float
               ) -> tuple[Array, Array, Array]:
    """Rows and columns of the hits that lines pass nearer than radius, ordered by row, and the lines' depths there."""
    parts = [_segment_hits(_project(camera, size, begin), _project(camera, size, end), size, radius, camera)
             for begin, end in segments]
    if not parts:
        return np.zeros(0, np.intp), np.zeros(0, np.intp), np.zeros(0)
    rows, columns, depths = (np.concatenate(each) for each in zip(*parts, strict=True))
    order = np.argsort(rows, kind="stable")
    return rows[order], columns[order], depths[order]


def _segment_hits(begin: tuple[float, float, float], end: tuple[float, float, float], size: tuple[int, int],
                  radius: float, camera: Camera) -> tuple[Array, Array, Array]:
    (x, y, depth), dx, dy = begin, end[0] - begin[0], end[1] - begin[1]
    first, last = np.clip((math.floor(min(y, end[1]) - radius), math.ceil(max(y, end[1]) + radius)), 0,
                          size[1] * PER_SIDE - 1).astype(int)
    rows = np.arange(first, last + 1)
    # The strip of that width cuts a row in a range that is no longer than the row's height and the radius make it.
    low, high = np.full(len(rows), min(x, end[0]) - radius), np.full(len(rows), max(x, end[0]) + radius)
    if abs(dy) > 1e-9:
        middle = x + dx * (rows + 0.5 - y) / dy
        wide = radius * math.hypot(dx, dy) / abs(dy) + radius
        low, high = np.maximum(low, middle - wide), np.minimum(high, middle + wide)
    starts = np.clip(np.floor(low), 0, size[0] * PER_SIDE).astype(int)
    counts = np.maximum(np.clip(np.ceil(high) + 1, 0, size[0] * PER_SIDE).astype(int) - starts, 0)
    within = np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)
    columns, rows = np.repeat(starts, counts) + within, np.repeat(rows, counts)
    square = dx * dx + dy * dy
    across, down = columns + 0.5 - x, rows + 0.5 - y
    share = np.clip((across * dx + down * dy) / square, 0.0, 1.0) if square > 0.0 else np.zeros(len(rows))
    near = np.hypot(share * dx - across, share * dy - down) <= radius
    rows, columns, share = rows[near], columns[near], share[near]
    # Along a straight line of the picture the inverse of the depth is linear in a perspective (Blinn 1992, "Hyperbolic
    # interpolation"), and the depth itself with parallel rays.
    if camera.vertical_extent is None:
        return rows, columns, 1.0 / (1.0 / depth + share * (1.0 / end[2] - 1.0 / depth))
    return rows, columns, depth + share * (end[2] - depth)


def _outlines(objects: Array, depths: Array, is_particle: Array, overlaid: Overlaid, pixels: Array, width: float
              ) -> Array:
    """Where a ball ends before something that is farther by more than a tenth of its radius, or that is no ball."""
    index = np.where(is_particle, objects - np.uint32(overlaid.first), 0)
    radii = overlaid.radii[index if overlaid.radii.strides[0] else np.zeros_like(index)]
    large = is_particle & (radii * pixels >= LEAST_RADIUS * width)
    edges = np.zeros(objects.shape, bool)
    for here, other in _neighbours():
        edges[here] |= (large[here] & (objects[here] != objects[other]) &
                        (~is_particle[other] | (depths[other] > depths[here] + LEAST_STEP * radii[here])))
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
