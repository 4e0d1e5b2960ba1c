from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from pathlib import PurePath
from typing import Any

import numpy as np

from pt._context import Context
from pt._fit import Doubles
from pt.figures._accept import load
from pt.figures._bonds import BALL_SHARE
from pt.figures._colors import ColorBar, Legend, Swatches, colors_of, joined
from pt.figures._drawn import BESIDE_ARROWS, Drawn, prepare
from pt.figures._figure import Staged, context_of, view_of
from pt.figures._layout import Layout, View
from pt.figures._options import Options, Radius
from pt.figures._particles import Particles
from pt.figures._picture import Picture
from pt.figures._radii import covalent_factor
from pt.figures._styles import styled


def frames(read: Callable[[], Iterator[Particles]], options: Options) -> Iterator[Staged]:
    """Reads all frames twice, first to choose one view and scale."""
    options, view, reaches, scale = _common(((each, {}) for each in read()), options)
    layout = Layout.of(view, reaches, options.style, options.floor)
    for particles in read():
        yield Staged(prepare(particles, options, scale), layout, options)


class Panels(Picture):
    """Figures with the same camera, scale and range of colors. sources: particles, the column that colors them or None, the title."""

    def __init__(self, sources: Sequence[tuple[Particles, str | None, str]], options: Options) -> None:
        given = [(particles, {"color": column, "title": options.title or " "} if column else {}) for particles, column, _ in sources]
        self.columns = len(sources) if len(sources) <= 3 else math.ceil(math.sqrt(len(sources)))
        options = styled(given[0][0], options, given[0][0].notes)
        options = _with_colors_of(_legends(given, options), options)
        self.legend = joined(_legends(given, options))
        options, view, reaches, scale = _common(iter(given), options, (self.columns, math.ceil(len(sources) / self.columns)), self.legend)
        layout = Layout.of(view, reaches, options.style, options.floor)
        self.staged = [Staged(prepare(particles, replace(options, **more), scale), layout, options) for particles, more in given]
        self.titles = [title for *_, title in sources]
        self.notes = list(dict.fromkeys(note for each in self.staged for note in each.notes))

    def draw(self, context: Context) -> Panels:
        self.figures = [each.draw(context) for each in self.staged]
        return self

    @property
    def error_bounds(self) -> tuple[float, float]:
        worst: tuple[float, float] = max((each.error_bounds for each in self.figures), key=lambda bounds: float(bounds[1]))
        return worst

    def __repr__(self) -> str:
        return "\n".join(map(repr, self.figures))


def panels(data: Sequence[Any], columns: Sequence[str] = (), **options: Any) -> Panels:
    """Renders a panel for each data set of load() or, with columns, for each column of the only data set. options: as in figure()."""
    given = Options(**options)
    with context_of(given) as context:
        return Panels(sources_of(data, columns, given), given).draw(context)


def sources_of(data: Sequence[Any], columns: Sequence[str], options: Options) -> list[tuple[Particles, str | None, str]]:
    if not data or columns and len(data) > 1:
        raise ValueError("panels: must have one data set with columns, or several data sets without")
    loaded = [load(each, frame=options.frame, model_number=options.model_number, **options.reading) for each in data]
    if columns:
        return [(loaded[0], column, column) for column in columns]
    return [(each, None, PurePath(each.name).stem) for each in loaded]


def _legends(given: Sequence[tuple[Particles, dict[str, Any]]], options: Options) -> list[Legend]:
    return [colors_of(particles, replace(options, **more), [])[1] for particles, more in given]


def _with_colors_of(legends: Sequence[Legend], options: Options) -> Options:
    bars = [legend for legend in legends if isinstance(legend, ColorBar)]
    names = dict.fromkeys(name for legend in legends if isinstance(legend, Swatches) for name in legend.names)
    if bars:
        options = replace(options, range=(min(bar.low for bar in bars), max(bar.high for bar in bars)))
    return replace(options, categories=tuple(names) or options.categories)


def _common(trajectory: Iterator[tuple[Particles, dict[str, Any]]], options: Options, grid: tuple[int, int] = (1, 1),
            legend: Legend = None) -> tuple[Options, View, Doubles, float]:
    view: View | None = None
    reaches: Doubles | None = None
    scale: float | None = None
    legends: list[Legend] = []
    for particles, more in trajectory:
        if view is None:
            options = styled(particles, options, particles.notes)
        drawn = prepare(particles, replace(options, **more), scale)
        if view is None:
            options = replace(options, radius=_rule(particles, drawn, options))
            view, scale = view_of(replace(drawn, legend=legend or drawn.legend), options, grid=grid), drawn.scale
        options = replace(options, **drawn.settled)
        mine = view.reaches(drawn.balls)
        reaches = mine if reaches is None else np.maximum(reaches, mine)
        legends.append(drawn.legend)
    if view is None or reaches is None or scale is None:
        raise ValueError("frames: there are none")
    return _with_colors_of(legends, options), view, reaches, scale


def _rule(particles: Particles, drawn: Drawn, options: Options) -> Radius:
    if options.radius is not None or particles.radii is not None:
        return options.radius
    factor = covalent_factor(particles)
    if factor is None:
        return float(drawn.radii[0]) / drawn.scale
    share = BESIDE_ARROWS if options.vectors is not None and options.bond_rule is None else 1.0
    return f"{(BALL_SHARE if options.drawn_model in ('ball-and-stick', 'tube') else 1.0) * share * factor!r}*covalent"


def turntable(particles: Particles, count: int, options: Options) -> Iterator[Staged]:
    options = styled(particles, options, particles.notes)
    drawn = prepare(particles, options)
    view = view_of(drawn, options, turns=True)
    for k in range(count):
        yield Staged.seen(drawn, view.turned(2.0 * math.pi * k / count), options)
