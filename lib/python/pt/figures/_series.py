from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np

from pt._fit import Doubles
from pt.figures._bonds import BALL_SHARE
from pt.figures._colors import ColorBar, Swatches
from pt.figures._drawn import Drawn, prepare
from pt.figures._figure import Staged, view_of
from pt.figures._layout import Layout, View
from pt.figures._options import Options, Radius
from pt.figures._particles import Particles
from pt.figures._radii import covalent_factor
from pt.figures._styles import styled


def frames(read: Callable[[], Iterator[Particles]], options: Options, trails: int = 0) -> Iterator[Staged]:
    """Reads all frames twice, first to choose one view and scale. `trails` is the number of earlier frames in a trail."""
    options, view, reaches, scale = _common(read(), options)
    layout = Layout.of(view, reaches, options.style, options.floor)
    past: deque[Particles] = deque(maxlen=trails)
    for particles in read():
        yield Staged(prepare(particles, options, scale, past), layout, options)
        past.appendleft(particles.wrapped() if options.wrap else particles)


def _common(trajectory: Iterator[Particles], options: Options) -> tuple[Options, View, Doubles, float]:
    view: View | None = None
    reaches: Doubles | None = None
    scale: float | None = None
    bars: list[ColorBar] = []
    names: dict[str, None] = {}
    for particles in trajectory:
        if view is None:
            options = styled(particles, options, particles.notes)
        drawn = prepare(particles, options, scale)
        if view is None:
            options = replace(options, radius=_rule(particles, drawn, options))
            view, scale = view_of(drawn, options), drawn.scale
        options = replace(options, **drawn.settled)
        mine = view.reaches(drawn.balls)
        reaches = mine if reaches is None else np.maximum(reaches, mine)
        if isinstance(drawn.legend, ColorBar):
            bars.append(drawn.legend)
        elif isinstance(drawn.legend, Swatches):
            names.update(dict.fromkeys(drawn.legend.names))
    if view is None or reaches is None or scale is None:
        raise ValueError("frames: there are none")
    if bars:
        options = replace(options, range=(min(bar.low for bar in bars), max(bar.high for bar in bars)))
    return replace(options, categories=tuple(names) or options.categories), view, reaches, scale


def _rule(particles: Particles, drawn: Drawn, options: Options) -> Radius:
    if options.radius is not None or particles.radii is not None:
        return options.radius
    factor = covalent_factor(particles)
    if factor is None:
        return float(drawn.radii[0]) / drawn.scale
    return f"{(BALL_SHARE if options.drawn_model in ('ball-and-stick', 'tube') else 1.0) * factor!r}*covalent"


def turntable(particles: Particles, count: int, options: Options) -> Iterator[Staged]:
    options = styled(particles, options, particles.notes)
    drawn = prepare(particles, options)
    view = view_of(drawn, options, turns=True)
    for k in range(count):
        turned = view.turned(2.0 * math.pi * k / count)
        yield Staged.seen(drawn, turned, options)
