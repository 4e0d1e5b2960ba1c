from __future__ import annotations

import functools
import math
import textwrap
from collections.abc import Callable, Mapping, Sequence
from dataclasses import Field, dataclass, field, fields
from typing import Any, Final, TypeAlias

import numpy.typing as npt

from pt._callbacks import Progress
from pt._camera import Camera
from pt._context import Context
from pt._scene import Material

Color: TypeAlias = "str | Mapping[str, str] | Sequence[float] | npt.ArrayLike | None"
Radius: TypeAlias = "float | str | Mapping[str, float] | npt.ArrayLike | None"
Opacity: TypeAlias = "float | str | npt.ArrayLike | None"
Bonds: TypeAlias = "bool | str | float | npt.ArrayLike | None"
Vectors: TypeAlias = "str | npt.ArrayLike | None"
Direction: TypeAlias = "str | Sequence[float] | npt.NDArray[Any]"
Columns: TypeAlias = "Mapping[str, str] | str | None"

VIEWS: Final = ("three-quarter", "front", "back", "left", "right", "top", "bottom")
SAMPLES: Final = 128
MOST_SAMPLES: Final = 65536


def _option(group: str, default: Any, metavar: str, words: str, **more: Any) -> Any:
    """more: choices; rule, a condition on the value with its words; flag, the name on the command line; read, which
    converts text to the value."""
    return field(default=default, metadata={"group": group, "metavar": metavar, "words": words, **more})


def two(separator: str, kind: type) -> Callable[[str], Any]:
    def read(text: str) -> tuple[Any, Any]:
        first, second = map(kind, text.split(separator))
        return first, second
    return read


def _share(text: str) -> float:
    return float(text.removesuffix("%")) / (100.0 if text.endswith("%") else 1.0)


def _stops(text: str) -> float | None:
    return None if text == "auto" else float(text)


_data, _particles, _view, _look, _samples, _python = (
    functools.partial(_option, group) for group in ("data", "particles", "view", "look", "samples", ""))


@dataclass(frozen=True, kw_only=True)
class Options:
    frame: int | None = _data(None, "N", "0 is the first, -1 the last, which is the default; those without particles do not "
                              "count", read=int)
    model_number: int | None = _data(None, "N", "of PDB and mmCIF, by the file's number. By default the first model", read=int)
    format: str | None = _data(None, "NAME", "of the file; by default its first bytes or its name say it",
                               flag="--data-format")
    topology: str | None = _data(None, "FILE", "what the atoms of a trajectory (XTC, TRR, DCD, ...) are")
    atom_style: str | None = _data(None, "STYLE", "of a LAMMPS data file whose columns do not say it: atomic, full, ...")
    columns: Columns = _data(None, "x=NAME,...", "columns for x, y, z, radius, diameter, element, type, red, green, blue, in "
                             "place of those that are looked for")
    drop_nonfinite: bool = _data(False, "", "leaves out particles whose position or radius is no finite number")
    where: str | Sequence[str] = _data((), "CONDITION", "shows particles for which this holds, \"z < 5\", \"element != H\"; or "
                                       "several. Ranges of colors and radii are those of all")
    wrap: bool = _data(False, "", "brings particles that have left a periodic cell back into it")

    color: Color = _particles(
        None, "COLUMN|COLOR|...", "a column of numbers or words; \"|velocity|\" or \"|vx,vy,vz|\", a magnitude; "
        "\"red,green,blue\", columns of sRGB; a color for all, \"#ff8000\" or \"orange\"; of types, \"O=red,H=#ffffff\", in "
        "Python {\"O\": \"red\"} too, and arrays of shape (n,), or (n, 3) of sRGB, floats from 0 to 1 or uint8. By default of "
        "elements those of Jmol, but hydrogen light grey, of types a palette, those of the data, else grey")
    colormap: Any = _particles(None, "MAP", "of matplotlib, in Python as an object too; _r reverses it. By default viridis, and "
                               "coolwarm on a symmetric scale")
    range: tuple[float, float] | None = _particles(
        None, "LO,HI", "numbers that the first and the last color stand for. By default all there are, or, where these reach "
        "more than 4 times as far as 1% to 99% of them, those; it is said", flag="--color-range", read=two(",", float))
    scale: str = _particles("linear", "", "of the colors; symmetric is about 0", flag="--color-scale",
                            choices=("linear", "log", "symmetric"))
    categories: bool | Sequence[str] = _particles(False, "", "numbers name categories, no two of which have one color; in Python "
                                                  "all names, in their order, too")
    nan_color: str = _particles("#bfbfbf", "COLOR", "of particles without a number")
    title: str | None = _particles(None, "WORDS", "of the legend, with the unit; matplotlib's TeX. By default the column")
    colorbar: bool = _particles(False, "", "the legend is in the picture, at the right")
    radius: Radius = _particles(
        None, "R|COLUMN|...", "a number in the units of the data; a column; covalent or van-der-waals (of elements, in "
        "angstroms); of all types, \"O=0.7,H=0.3\", in Python {\"O\": 0.7} and arrays too; with a factor, \"0.5*diameter\". By "
        "default the data's, else covalent where distances are of angstroms, up to 3 times that where neighbours are not bonded, "
        "else half of what most neighbours are apart")

    opacity: Opacity = _particles(
        None, "A|COLUMN", "share of rays from 0 to 1 that meet the particles, and their bonds and vectors: a number or a column, "
        "in Python an array too. By default 1")
    bonds: Bonds = _particles(
        None, "auto|CUTOFF", "auto, in Python True too: atoms no farther apart than their covalent radii (Cordero 2008) and 0.45 "
        "angstroms, as in Open Babel; all within a cutoff; in Python pairs of indices, shape (k, 2), too. By default none")
    wall_bonds: str = _particles("halves", "", "of bonds through the walls of a periodic cell", choices=("halves", "none"))
    model: str = _particles("auto", "", "ball-and-stick has balls of half their radii, unless radius is given; sticks (licorice) "
                            "has none; both have bonds. auto is ball-and-stick with bonds, otherwise space-filling",
                            choices=("auto", "space-filling", "ball-and-stick", "sticks"))
    bond_radius: float | None = _particles(
        None, "R", "in the units of the data. By default 0.07 of the median length of a bond, in sticks 0.14", read=float,
        rule=(lambda radius: 0.0 < radius < math.inf, "> 0 and finite"))
    vectors: Vectors = _particles(None, "vx,vy,vz", "columns, or v or velocity as in color, or in Python an array of shape (n, 3): "
                                  "each is a capsule from the particle's center, in its color")
    vector_scale: float | None = _particles(
        None, "S", "length of a vector of 1. By default the longest one is as long as 4 median radii", read=float,
        rule=(lambda scale: 0.0 < scale < math.inf, "> 0 and finite"))

    size: tuple[int, int] | None = _view(None, "WxH", "pixels, with the color bar. By default as many as 1024x768 have, in the "
                                         "shape of the data", read=two("x", int))
    view: Direction = _view(VIEWS[0], "SIDE|X,Y,Z", f"{', '.join(VIEWS)}, or the direction to the camera")
    up: Direction = _view("z", "AXIS|X,Y,Z", "x, y, z, -x, -y or -z, or a direction: what is up in the data and the picture")
    projection: str = _view("perspective", "", "what the camera does", choices=("perspective", "orthographic"))
    frame_all: bool = _view(False, "", "shows balls that are very far from all others, too. By default up to 0.5% of the balls, at "
                            "least one, are left out where that brings the others 4 times as near; it is said")
    camera: Camera | None = _python(None, "", "takes this one, in the units of the data, in place of view and projection")

    style: str = _look("matte", "", "the last one: light from all sides alone",
                       choices=("matte", "glossy", "ambient-occlusion"))
    material: Material | None = _python(None, "", "of the particles, in place of the style's; colors multiply its diffuse")
    outlines: bool = _look(False, "", "dark lines round the balls; not with opacity")
    floor: bool = _look(False, "", "a floor that shows the shadows alone")
    background: Any = _look("white", "COLOR", "a color, or transparent")
    box: str = _look("auto", "", "what is shown of the cell, where the data have one. auto is lines, except of a protein's crystal "
                     "and of a cell with most particles outside, or ten times as large as all", choices=("auto", "lines", "none"))
    exposure: float | None = _look(0.0, "EV", "stops by which balls are brightened; auto, in Python None: as pt render",
                                   read=_stops, rule=(lambda stops: -64.0 <= stops <= 64.0, "from -64 to 64"))

    samples: int | None = _samples(None, "N", f"a pixel; by default {SAMPLES}, and with an error at most {MOST_SAMPLES}",
                                   flag="--spp", read=int,
                                   rule=(lambda count: 1 <= count < 2**32, "at least 1 and below 2^32"))
    error: float | None = _samples(None, "E", "ends when the image's relative error is at or below it: 0.02 or, on the command "
                                   "line, 2%", read=_share,
                                   rule=(lambda share: 0.0 < share < math.inf, "> 0 and finite"))
    denoise: bool = _samples(False, "", "filters the noise away, and states the error of that; takes Open Image Denoise, which "
                             "the extra denoise installs")
    seed: int = _samples(0, "N", "of the random numbers", read=int, rule=(lambda seed: 0 <= seed < 2**64, "at least 0 and below 2^64"))
    max_path_length: int = _python(4, "", "as of RenderSettings")
    device: str | None = _samples(None, "NAME", "what to render on, as of pt render")
    context: Context | None = _python(None, "", "renders in this one, and leaves it with another scene and other settings")
    progress: Progress | None = _python(None, "", "called with the share that is done; returning True ends the samples early")

    def __post_init__(self) -> None:
        for each in fields(self):
            value, known = getattr(self, each.name), each.metadata
            if "choices" in known and value not in known["choices"]:
                raise ValueError(f"{each.name} = {value!r}: must be {', '.join(known['choices'])}")
            holds, words = known.get("rule", (None, ""))
            if holds and value is not None and not holds(value):
                raise ValueError(f"{each.name} = {value}: must be {words}")
        if self.outlines and self.opacity is not None:
            raise ValueError("outlines = True: must be False with opacity, which leaves no edges in front")

    @property
    def reading(self) -> dict[str, Any]:
        return {name: getattr(self, name) for name in ("columns", "format", "topology", "atom_style", "drop_nonfinite")}

    @property
    def bond_rule(self) -> Bonds:
        """None: no bonds are drawn. Models with sticks always have bonds."""
        given = not (self.bonds is None or self.bonds is False)
        return self.bonds if given else "auto" if self.drawn_model != "space-filling" else None

    @property
    def drawn_model(self) -> str:
        if self.model != "auto":
            return self.model
        return "space-filling" if self.bonds is None or self.bonds is False else "ball-and-stick"

    @property
    def most_samples(self) -> int:
        return self.samples or (SAMPLES if self.error is None else MOST_SAMPLES)


def described() -> str:
    return "\n".join(_paragraph(each) for each in fields(Options))


def _paragraph(option: Field[Any]) -> str:
    words = "; ".join(filter(None, (", ".join(option.metadata.get("choices", ())), option.metadata["words"])))
    return textwrap.fill(words, 119, initial_indent=f"    {option.name:<17}", subsequent_indent=21 * " ")
