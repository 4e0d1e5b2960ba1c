"""What is laid over a rendered figure: the share of each pixel that particles cover, the cell's lines, which particles
hide, and outlines. All of it follows from what camera rays meet first, 16 rays a pixel."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any, Final

import numpy as np

from pt._camera import Camera, RenderSettings
from pt._context import Context
from pt._enums import Format, Quantity
from pt._fit import Array, Doubles

PER_SIDE: Final = 4  # rays along each side of a pixel
BAND_ROWS: Final = 32  # few enough that their hits take less memory on the device than the picture does
ROUNDING: Final = 1e-5  # relative, of depths in float32 and of what they are computed from
LEAST_STEP: Final = 0.1  # depth behind an outline, as a share of the radius: less has no outline
LEAST_RADIUS: Final = 2.5  # of a ball with an outline, in line widths: smaller ones would be all outline


@dataclass(frozen=True)
class Shares:
    """Shares of each pixel, shape (height, width), from 0 to 1."""

    particles: Doubles
    lines: Doubles
    outlines: Doubles


@dataclass(frozen=True)
class Overlaid:
    """first      index of the first particle among all spheres
    radii      shape (n,): of particles, then of bonds and vectors, which count as particles
    segments   pairs of end points of lines, each of shape (3,), scene units
    """

    first: int
    radii: Array
    segments: Sequence[tuple[Doubles, Doubles]]
    outlines: bool


def line_width(size: tuple[int, int]) -> float:
    """Width of lines in pixels: 0.0016 of the picture's longer side, at least one."""
    return max(1.0, 0.0016 * max(size))


def cell_edges(origin: Doubles, vectors: Doubles) -> list[tuple[Doubles, Doubles]]:
    """The twelve edges of the cell."""
    corners = cell_corners(origin, vectors)
    return [(corners[k], corners[k | 1 << edge]) for k in range(8) for edge in range(3) if not k >> edge & 1]


def cell_corners(origin: Doubles, vectors: Doubles) -> Doubles:
    """The corners of the cell, shape (8, 3): bit i of a corner's index says whether it is at the end of edge i."""
    ends = np.arange(8)[:, None] >> np.arange(3) & 1
    corners: Doubles = origin + ends @ vectors
    return corners


def read_shares(context: Context, camera: Camera, settings: RenderSettings, overlaid: Overlaid) -> Shares:
    """Shares of the pixels. The context must have the scene and the camera; its render settings are replaced."""
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
            here = (lines[0] >= top * PER_SIDE) & (lines[0] < bottom * PER_SIDE)
            rows, columns, ways = (each[here] for each in lines)
            rows -= top * PER_SIDE
            shown = ways * (1.0 - ROUNDING) <= depths[rows, columns]
            covered[rows[shown], columns[shown]] = True
            shares.lines[first:end] = _share(covered[wanted])
        if overlaid.outlines:
            pixels = _pixels_per_length(camera, height, depths)
            covered = _outlines(objects, depths, is_particle, overlaid, pixels, line_width((width, height)))
            shares.outlines[first:end] = _share(covered[wanted])
    return shares


def _share(hits: Array) -> Doubles:
    counts: Any = hits.view(np.uint8)
    rows: Any = sum(counts[i::PER_SIDE] for i in range(PER_SIDE))  # NumPy takes twenty times as long along short axes
    cells: Doubles = sum(rows[:, i::PER_SIDE] for i in range(PER_SIDE)) / PER_SIDE**2
    return cells


def _first_hits(context: Context, settings: RenderSettings, top: int, bottom: int, with_depths: bool
                ) -> tuple[Array, Array]:
    context.set_render(replace(settings, width=settings.width * PER_SIDE, height=settings.height * PER_SIDE,
                               first_row=top * PER_SIDE, row_count=(bottom - top) * PER_SIDE))
    objects = context.readback(Quantity.OBJECT, format=Format.R32UI)[:, :, 0]
    depths = context.readback(Quantity.DEPTH)[:, :, 0] if with_depths else objects
    return objects, depths


def _pixels_per_length(camera: Camera, height: int, depths: Array) -> Array:
    """Pixels per length across the view, at these depths."""
    if camera.vertical_extent is not None:
        return np.broadcast_to(height / camera.vertical_extent, depths.shape)
    assert camera.vertical_fov is not None
    scale: Array = 0.5 * height / (depths * math.tan(0.5 * camera.vertical_fov))
    return scale


def _line_hits(camera: Camera, size: tuple[int, int], segments: Sequence[tuple[Doubles, Doubles]], radius: float
               ) -> tuple[Array, Array, Array]:
    """Rows and columns of the hits that lines pass nearer than radius, and the lines' depths there."""
    axes = np.array(camera.axes())
    limits = np.array(size) * PER_SIDE
    wide = np.arange(2 * math.ceil(1.5 * radius) + 1) - math.ceil(1.5 * radius)  # at 45 degrees, sqrt(2) times radius
    power = -1.0 if camera.vertical_extent is None else 1.0
    found = [np.zeros((3, 0))]
    for segment in segments:
        seen = (np.array(segment) - camera.position) @ axes.T * (1, 1, -1)  # to the right, up, and depth
        seen = seen[np.argsort(seen[:, 2])]
        if seen[1, 2] <= 0.0:
            continue  # behind the camera
        hidden = max(0.0, (1e-6 * seen[1, 2] - seen[0, 2]) / (seen[1, 2] - seen[0, 2] or 1.0))
        seen[0] += hidden * (seen[1] - seen[0])
        scale = _pixels_per_length(camera, size[1], seen[:, 2])[:, None] * PER_SIDE
        begin, end = 0.5 * limits + scale * seen[:, :2] * (1, -1)
        way = end - begin
        steep = int(abs(way[1]) > abs(way[0]))  # then it is followed row by row, otherwise column by column
        first, last = np.clip(np.sort((begin[steep], end[steep])) + (-radius, radius), 0, limits[steep]).astype(int)
        along = np.arange(first, last)
        across = begin[1 - steep] + (along + 0.5 - begin[steep]) * way[1 - steep] / (way[steep] or 1.0)
        hits = np.stack(np.broadcast_arrays(along[:, None], np.floor(across)[:, None] + wide))[[steep, 1 - steep]]
        offset = hits + 0.5 - begin[:, None, None]
        share = np.clip(np.tensordot(way, offset, 1) / (way @ way or 1.0), 0.0, 1.0)
        near = np.hypot(*(share * way[:, None, None] - offset)) <= radius
        near &= ((hits >= 0) & (hits < limits[:, None, None])).all(axis=0)
        # Along a straight line in the picture, the inverse of the depth is linear in a perspective (Blinn 1992,
        # "Hyperbolic interpolation"); with parallel rays the depth itself is.
        nearest, farthest = seen[:, 2]**power
        found.append(np.stack([hits[1][near], hits[0][near], (nearest + share[near] * (farthest - nearest))**power]))
    rows, columns, depths = np.concatenate(found, axis=1)
    return rows.astype(np.intp), columns.astype(np.intp), depths


def _outlines(objects: Array, depths: Array, is_particle: Array, overlaid: Overlaid, pixels: Array, width: float
              ) -> Array:
    """The outlines of balls: where a ball ends in front of something that is not a ball, or is farther by more than a
    tenth of the ball's radius."""
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
