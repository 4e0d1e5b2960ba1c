from __future__ import annotations

import colorsys
import difflib
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Final, TypeAlias

import numpy as np
import numpy.typing as npt

from pt._fit import Array, chunks
from pt.figures import _elements as elements
from pt.figures._elements import categories
from pt.figures._errors import module
from pt.figures._options import Options
from pt.figures._particles import Particles
from pt.figures._select import chosen, column, rules
from pt.figures._templates import polymers_of

Bytes: TypeAlias = npt.NDArray[np.uint8]
RGB: TypeAlias = tuple[int, ...]

PLAIN: Final = "#96aabe"
# Okabe and Ito 2008, "Color Universal Design". The first two also differ most in lightness.
PALETTE: Final = ((0, 114, 178), (230, 159, 0), (0, 158, 115), (213, 94, 0), (86, 180, 233), (204, 121, 167), (240, 228, 66))
PALE: Final = 0.6  # distance of carbon's shade from white, relative to the column's color
TINT: Final = 0.6  # fraction of the element's own color; N, O and S stay recognizable
SOFT: Final = 0.75  # like PALE, for elements
MOST_CATEGORIES: Final = 1000
SKEW: Final = 4.0  # limit of (full range) / (range from 1% to 99%), which is 3 for exponential values


@dataclass(frozen=True)
class ColorBar:
    """`low` and `high` have the first and last color."""

    title: str
    low: float
    high: float
    norm: Any
    colormap: Any
    no_value: RGB | None


@dataclass(frozen=True)
class Swatches:
    title: str
    names: tuple[str, ...]
    colors: Bytes


Legend: TypeAlias = "ColorBar | Swatches | None"


def joined(legends: Sequence[Legend]) -> Legend:
    """Returns the first legend, with the names of all legends."""
    all_swatches = [legend for legend in legends if isinstance(legend, Swatches)]
    if not isinstance(legends[0], Swatches):
        return legends[0]
    table = {name: color for legend in all_swatches for name, color in zip(legend.names, legend.colors)}
    return Swatches(legends[0].title, tuple(table), np.array([*table.values()], np.uint8))


def srgb(name: str, color: Any) -> RGB:
    if isinstance(color, str) and len(color) == 7 and color[0] == "#":
        try:
            red, green, blue = bytes.fromhex(color[1:])
            return red, green, blue
        except ValueError:
            pass
    named = module("matplotlib.colors", f"{name} = {color!r}")
    try:
        red, green, blue = (math.floor(255 * float(each) + 0.5) for each in named.to_rgb(color))
    except ValueError:
        raise ValueError(f"{name} = {color!r}: must be a color like #ff8000 or orange") from None
    return red, green, blue


def colors_of(particles: Particles, given: Options, notes: list[str]) -> tuple[Bytes, Legend]:
    base, types, picks = rules(given.color)
    colors, legend = _rest_of_colors(particles, types or base, given, notes)
    if not picks:
        return colors, legend
    colors = np.array(np.broadcast_to(colors, (len(particles), 3)))
    named = {selection: srgb(f"color of {selection}", each) for selection, each in picks.items()}
    for selection, each in named.items():
        colors[chosen(particles, selection, "color")] = each
    if isinstance(legend, ColorBar):
        return colors, legend
    names, table = ((), []) if legend is None else (legend.names, [legend.colors])
    return colors, Swatches(given.title or (legend.title if legend else ""), (*names, *named),
                            np.concatenate([*table, np.array([*named.values()], np.uint8)]))


def _rest_of_colors(particles: Particles, color: Any, given: Options, notes: list[str]) -> tuple[Bytes, Legend]:
    count = len(particles.positions)
    if color is None:
        if particles.types is None and particles.elements is None:
            each = particles.colors
            return (np.array(srgb("color", PLAIN), np.uint8), None) if each is None else (_direct(each, notes), None)
        color = {}
    if isinstance(color, Mapping):
        return _of_types(particles, given, color)
    if isinstance(color, str):
        return _named(particles, color, given, notes)
    array = np.asarray(color)
    if array.shape in ((3,), (4,)) and array.dtype.kind in "fiu" and count not in (3, 4):
        return _direct(array, notes), None
    if array.shape in ((count, 3), (count, 4)) and array.dtype.kind in "fiu":
        return _direct(array, notes), None
    if array.shape != (count,):
        raise ValueError(f"color has shape {array.shape}: must be ({count},), numbers or words, or ({count}, 3), colors")
    return _of_values(array, given.title or "", given, notes)


def _named(particles: Particles, color: str, given: Options, notes: list[str]) -> tuple[Bytes, Legend]:
    title = given.title or color
    if color in ("type", "element") and color not in particles.columns:
        return _of_types(particles, given, {})
    if color.startswith("|"):
        parts = [column(particles, name) for name in components(particles, color.strip("|"))]
        return _of_values(np.sqrt(np.asarray(sum(np.square(part) for part in parts))), title, given, notes)
    if color.endswith("+element") and particles.elements is not None:
        return _tinted(particles, color.removesuffix("+element"), given, notes)
    if color.count(",") == 2:
        return _direct(np.stack([column(particles, name) for name in color.split(",")], axis=-1), notes), None
    try:
        values = column(particles, color)
    except ValueError as unknown:
        try:
            return np.array(srgb("color", color), np.uint8), None
        except ValueError:
            raise ValueError(f"color = {color!r} is no color, and {unknown}") from None
    return _of_values(values, title, given, notes)


def _tinted(particles: Particles, name: str, given: Options, notes: list[str]) -> tuple[Bytes, Legend]:
    """Carbon and hydrogen have a paler shade of the column's color. Other elements mix in their own."""
    pale, legend = _named(particles, name, given, notes)
    pale = np.broadcast_to((255.0 + PALE * (pale - 255.0)), (len(particles), 3))
    numbers = np.asarray(particles.elements)
    own = elements.COLORS[numbers].astype(np.float64)
    tinted = np.where(np.isin(numbers, (1, 6))[:, None], pale, (1.0 - TINT) * pale + TINT * (255.0 + SOFT * (own - 255.0)))
    if "resname" in particles.columns:
        tinted[~polymers_of(particles)] = own[~polymers_of(particles)]
    if isinstance(legend, Swatches):
        legend = Swatches(legend.title, legend.names, (255.5 + PALE * (legend.colors - 255.0)).astype(np.uint8))
    return (tinted + 0.5).astype(np.uint8), legend


def components(particles: Particles, name: str) -> list[str]:
    ways = [[f"{name}[{k}]" for k in range(3)], [f"{name}{axis}" for axis in "xyz"], [f"{name}_{axis}" for axis in "xyz"]]
    found = [way for way in ways if all(each in particles.columns for each in way)]
    return found[0] if found else name.split(",")


def _direct(colors: Any, notes: list[str]) -> Bytes:
    """White is 1 for floats, 255 for signed integers, and the type's largest value for unsigned ones."""
    array = np.asarray(colors)
    if array.dtype.kind == "i" and array.size and 0 <= array.min() and array.max() <= 255:
        array = array.astype(np.uint8)
    if array.dtype.kind not in "fu":
        raise TypeError(f"colors.dtype = {array.dtype}: must be floats from 0 to 1, uint8 or uint16, sRGB")
    most = 1.0 if array.dtype.kind == "f" else np.iinfo(array.dtype).max
    if array.shape[-1] == 4 and (array[..., 3] < most).any():
        notes.append("alpha is not drawn: balls are opaque")
    array = array[..., :3]
    if array.dtype == np.uint8:
        return array
    result = np.empty(array.shape, np.uint8)
    least, largest = 0.0, 1.0
    for rows in chunks(len(array)):
        shares = np.nan_to_num(array[rows] / most)
        least, largest = min(least, float(shares.min())), max(largest, float(shares.max()))
        result[rows] = np.floor(255.0 * np.clip(shares, 0.0, 1.0) + 0.5)
    if least < -1e-3 or largest > 1.001:
        notes.append(f"colors from {least:.3g} to {largest:.3g} are clipped to 0 to 1")
    return result


def _of_values(values: Array, title: str, given: Options, notes: list[str]) -> tuple[Bytes, Legend]:
    if given.categories or values.dtype.kind in "USOb":
        names, codes = categories(values)
        return _of_categories(title, names, codes, given, {}, values.dtype.kind in "iu")
    if values.dtype.kind not in "fiu":
        raise TypeError(f"color has {values.dtype}: must be numbers or words")
    return _of_numbers(values, title, given, notes)


def _of_types(particles: Particles, given: Options, own: Mapping[str, str]) -> tuple[Bytes, Legend]:
    known: dict[str, RGB] = {}
    kind, labels = ("type", column(particles, "type")) if particles.elements is None else ("element", particles.elements)
    names, codes = categories(labels)
    if kind == "element":
        numbers = [int(name) for name in names]
        names = [elements.SYMBOLS[number] for number in numbers]
        known = {name: tuple(elements.COLORS[number].tolist()) for name, number in zip(names, numbers)}
    there = names if isinstance(given.categories, bool) else given.categories
    if missing := [name for name in own if name not in there]:
        raise ValueError(f"color: {missing[0]!r} is none of the {kind}s, {', '.join(there[:20])}; a selection is like resname XK2")
    known.update((str(name), srgb(f"color of {name}", color)) for name, color in own.items())
    return _of_categories(given.title or kind, names, codes, given, known, labels.dtype.kind in "if")


def _of_categories(title: str, names: list[str], codes: Array, given: Options, known: Mapping[str, RGB], numbered: bool
                   ) -> tuple[Bytes, Legend]:
    order = names if isinstance(given.categories, bool) else list(given.categories)
    if missing := [name for name in names if name not in order]:
        raise ValueError(f"categories: {missing[0]!r} is in the data, but not among {', '.join(order[:20])}")
    if len(names) > MOST_CATEGORIES:
        raise ValueError(f"color: has {len(names)} categories: must have at most {MOST_CATEGORIES}")
    places = [order.index(name) for name in names]
    if numbered and all(name.isdigit() and 1 <= int(name) <= 64 for name in order):
        places = [int(name) - 1 for name in names]
    palette = distinct_colors(max(places, default=0) + 1)
    table = np.array([known.get(name, palette[place]) for name, place in zip(names, places, strict=True)], np.uint8)
    return table.reshape(-1, 3)[codes], Swatches(title, tuple(names), table)


def distinct_colors(count: int) -> list[RGB]:
    colors: list[RGB] = list(PALETTE)
    k = 0
    while len(colors) < count:
        ring = ((0.5, 0.55), (0.75, 0.45), (0.35, 0.7))[k % 3]
        red, green, blue = (round(255 * each) for each in colorsys.hls_to_rgb((0.12 + 0.618034 * k) % 1.0, *ring))
        if (red, green, blue) not in colors:
            colors.append((red, green, blue))
        k += 1
    return colors[:count]


def _colormap(colormap: Any) -> Any:
    if not isinstance(colormap, str):
        return colormap
    colormaps = module("matplotlib", "a color map").colormaps
    if colormap not in colormaps:
        near = difflib.get_close_matches(colormap, list(colormaps), 3)
        raise ValueError(f"colormap = {colormap!r}: must be one of matplotlib's, like "
                         f"{', '.join(near or ['viridis', 'magma', 'cividis', 'coolwarm', 'viridis_r'])}")
    return colormaps[colormap]


def _of_numbers(values: Array, title: str, given: Options, notes: list[str]) -> tuple[Bytes, Legend]:
    colormap = _colormap(given.colormap or ("coolwarm" if given.scale == "symmetric" else "viridis"))
    log = given.scale == "log"
    low, high = given.range or _range(values, given, title, notes)
    if not (math.isfinite(low) and math.isfinite(high) and low <= high and (not log or low > 0.0)):
        raise ValueError(f"color range = {low:g}, {high:g}: must be two numbers, the second larger"
                         f"{', and above 0 on a log scale' if log else ''}")
    wider = 0.5 * (abs(low) or 1.0) if low == high else 0.0
    norms = module("matplotlib.colors", "a color map")
    norm = (norms.LogNorm if log else norms.Normalize)(low - wider, high + wider)
    no_value = srgb("nan_color", given.nan_color)
    colors = np.empty((len(values), 3), np.uint8)
    nowhere = 0
    for rows in chunks(len(values)):
        numbers = values[rows].astype(np.float64)
        bad = ~(numbers > 0.0) if log else np.isnan(numbers)
        colors[rows] = colormap(norm(numbers), bytes=True)[:, :3]
        colors[rows][bad] = no_value
        nowhere += int(np.count_nonzero(bad))
    if nowhere:
        notes.append(f"{nowhere} particles have no {title or 'value'}{' above 0' if log else ''}: they are {given.nan_color}")
    return colors, ColorBar(title, low, high, norm, colormap, no_value if nowhere else None)


def _range(values: Array, given: Options, title: str, notes: list[str]) -> tuple[float, float]:
    least, largest = math.inf, -math.inf
    floor = 0.0 if given.scale == "log" else -math.inf
    for rows in chunks(len(values)):
        numbers = values[rows].astype(np.float64)
        numbers = numbers[np.isfinite(numbers) & (numbers > floor)]
        least = min(least, float(numbers.min(initial=math.inf)))
        largest = max(largest, float(numbers.max(initial=-math.inf)))
    if least > largest:
        return (1.0, 1.0) if given.scale == "log" else (0.0, 0.0)
    sample = values[::max(len(values) // 200_000, 1)]
    sample = sample[np.isfinite(sample) & (sample > floor)]
    words = "the least and the largest"
    if given.scale != "log" and len(sample) >= 100:
        first, last = (float(each) for each in np.quantile(sample, (0.01, 0.99)))
        if last > first and largest - least > SKEW * (last - first):
            words = f"1% to 99% of all, which go from {least:.6g} to {largest:.6g}"
            least, largest = first, last
    if given.scale == "symmetric":
        largest = max(abs(least), abs(largest))
        least, words = -largest, f"symmetric about 0; {words}"
    notes.append(f"colors of {title or 'values'} go from {least:.6g} to {largest:.6g}, {words}")
    return least, largest
