from __future__ import annotations

import functools
import json
import math
import re
import textwrap
from collections.abc import Callable, Mapping, Sequence
from dataclasses import Field, dataclass, field, fields
from typing import Any, Final, TypeAlias

import numpy.typing as npt

from pt._callbacks import Progress
from pt._camera import Camera
from pt._context import Context
from pt._scene import Material
from pt.figures._select import rules

Color: TypeAlias = "str | Mapping[str, str] | Sequence[float] | npt.ArrayLike | None"
Radius: TypeAlias = "float | str | Mapping[str, float] | npt.ArrayLike | None"
Opacity: TypeAlias = "float | str | Mapping[str, float] | npt.ArrayLike | None"
Bonds: TypeAlias = "bool | str | float | npt.ArrayLike | None"
Vectors: TypeAlias = "str | npt.ArrayLike | None"
Labels: TypeAlias = "str | Mapping[str, str] | npt.ArrayLike | None"
Direction: TypeAlias = "str | Sequence[float] | npt.NDArray[Any]"
Columns: TypeAlias = "Mapping[str, str] | str | None"

VIEWS: Final = ("three-quarter", "front", "back", "left", "right", "top", "bottom", "best")
STYLES: Final = ("matte", "glossy", "ambient-occlusion", "molecule", "protein", "crystal", "particles", "point-cloud", "galaxy",
                 "soft", "illustrative", "cover")
MODELS: Final = ("auto", "space-filling", "ball-and-stick", "sticks", "tube")
DPI: Final = 300.0
UNITS: Final = {"in": 1.0, "cm": 2.54, "mm": 25.4, "pt": 72.0}  # per inch
SAMPLES: Final = 128
MOST_SAMPLES: Final = 65536


def _option(group: str, default: Any, metavar: str, words: str, **more: Any) -> Any:
    return field(default=default, metadata={"group": group, "metavar": metavar, "words": words, **more})


def several(count: int, separator: str, kind: type) -> Callable[[str], Any]:
    def read(text: str) -> tuple[Any, ...]:
        words = text.split(separator)
        if len(words) != count:
            raise ValueError(text)
        return tuple(map(kind, words))
    return read


def _read_camera(path: Any) -> Camera:
    try:
        with open(path, encoding="utf-8") as file:
            section = json.load(file)
        return Camera._of_section(section.get("camera", section))
    except (OSError, ValueError, KeyError, TypeError, AttributeError) as error:
        raise ValueError(f"camera = {str(path)!r}: must be a scene file, or its part camera: {error}") from None


def _share(text: str) -> float:
    return float(text.removesuffix("%")) / (100.0 if text.endswith("%") else 1.0)


def _stops(text: str) -> float | None:
    return None if text == "auto" else float(text)


def _pairs(text: str) -> list[tuple[int, int]]:
    return [several(2, "-", int)(pair) for pair in text.split(",")]


_data, _particles, _view, _look, _words, _samples, _python = (
    functools.partial(_option, group) for group in ("data", "particles", "view", "look", "words", "samples", ""))


@dataclass(frozen=True, kw_only=True)
class Options:
    frame: int | None = _data(None, "N", "index of the frame; 0 is the first, -1 the last, the default. Frames without particles do "
                              "not count", read=int)
    model_number: int | None = _data(None, "N", "number of a model in a PDB or mmCIF file. Default: the first model", read=int)
    format: str | None = _data(None, "NAME", "format of the file. Default: detected from its first bytes or its name",
                               flag="--data-format")
    topology: str | None = _data(None, "FILE", "file that describes the atoms of a trajectory (XTC, TRR, DCD, ...)")
    atom_style: str | None = _data(None, "STYLE", "atom style of a LAMMPS data file if its columns are ambiguous: atomic, full, ...")
    columns: Columns = _data(None, "x=NAME,...", "names of the columns for x, y, z, radius, diameter, element, type, red, green, "
                             "blue, instead of the detected ones")
    drop_nonfinite: bool = _data(False, "", "leaves out particles whose position or radius is not finite")
    where: str | Sequence[str] = _data((), "SELECTION", "shows only these particles: values or comparisons of columns, combined by and, "
                                       "or, not, within and parentheses: \"resname XK2 or within 5 of (chain A and z > 3)\", "
                                       "\"not water\", \"resid 10-20\". Hidden particles count for ranges of colors and radii")
    repeat: tuple[int, int, int] | None = _data(
        None, "A,B,C", "how often the cell is repeated along its edges", read=several(3, ",", int),
        rule=(lambda counts: min(counts) >= 1, "at least 1"))
    wrap: bool = _data(False, "", "moves particles outside a periodic cell back into the cell")
    whole: bool = _data(False, "", "makes molecules whole across a periodic cell, by their bonds")

    color: Color = _particles(
        None, "COLUMN|COLOR|...", "a column of numbers or words; a magnitude, \"|velocity|\" or \"|vx,vy,vz|\"; columns of "
        "sRGB, \"red,green,blue\"; one color, \"#ff8000\" or \"orange\"; colors of types and selections, \"O=red,H=#ffffff,chain A=blue\", "
        "which may follow a column; \"chain+element\", a column tinted by elements. In Python also "
        "{\"O\": \"red\"}, and arrays of shape (n,), or (n, 3) of sRGB, floats from 0 to 1 or uint8. Default: Jmol's colors of "
        "elements, with light grey hydrogen; else a palette of types; else the data's colors; else grey")
    colormap: Any = _particles(None, "MAP", "name of a matplotlib colormap; the suffix _r reverses it. In Python also an object. "
                               "Default: viridis, or coolwarm on a symmetric scale")
    range: tuple[float, float] | None = _particles(
        None, "LO,HI", "numbers with the first and the last color. Default: from the least to the largest number or, if this range is "
        "more than 4 times as wide, from 1% to 99% of the numbers, with a note", flag="--color-range", read=several(2, ",", float))
    scale: str = _particles("linear", "", "scale of the colors; symmetric is centered at 0", flag="--color-scale",
                            choices=("linear", "log", "symmetric"))
    categories: bool | Sequence[str] = _particles(False, "", "treats numbers as names of categories with different colors. In "
                                                  "Python also a list of all names, in their order")
    nan_color: str = _particles("#bfbfbf", "COLOR", "color of particles without a number")
    radius: Radius = _particles(
        None, "R|COLUMN|...", "a number in the units of the data; a column; radii of elements in angstroms: covalent, van-der-waals, or "
        "solvent-accessible, which adds 1.4; radii of types and selections, \"O=0.7,H=0.3\", \"covalent,chain A=2\"; any of these times "
        "a factor, \"0.5*diameter\". In Python also {\"O\": 0.7} "
        "and arrays. Default: the data's radii; else covalent radii if distances are in angstroms, up to 3 times as large for "
        "neighbours that are not bonded; else half of the usual distance of neighbours; with vectors a quarter of that")

    opacity: Opacity = _particles(
        None, "A|COLUMN", "probability from 0 to 1 that a ray hits a particle, its bonds and its vector, so n overlapping particles transmit "
        "(1 - A)^n: a number, a column, or numbers for selections, \"chain A=0.3\"; in Python also an array. Default: 1")
    bonds: Bonds = _particles(
        None, "auto|CUTOFF", "auto (in Python also True) bonds atoms whose distance is at most the sum of their covalent radii "
        "(Cordero 2008) and 0.45 angstroms, as in Open Babel; a number bonds all within this distance. In Python also pairs of "
        "indices, shape (k, 2). Default: no bonds")
    wall_bonds: str = _particles("halves", "", "bonds through the walls of a periodic cell", choices=("halves", "none"))
    model: str | Mapping[str, str] = _particles(
        "auto", "MODEL", "auto, space-filling, ball-and-stick, sticks or tube, also for selections, \"space-filling,resname XK2=sticks\". "
        "ball-and-stick halves the radii unless radius is given; sticks (licorice) has no balls. Both have bonds. tube goes through CA of "
        "amino acids and P of nucleotides, by chain; other residues are balls and sticks. auto is ball-and-stick with bonds, otherwise "
        "space-filling")
    bond_radius: float | None = _particles(
        None, "R", "radius of bonds and tubes in the units of the data. Default: 0.07 of the median length of bonds, 0.14 of it for "
        "sticks, and for tubes 0.14 of the median distance of their atoms",
        read=float, rule=(lambda radius: 0.0 < radius < math.inf, "> 0 and finite"))
    vectors: Vectors = _particles(None, "vx,vy,vz", "three columns, or their common name, such as v or velocity; in Python also an array "
                                  "of shape (n, 3). Each vector is an arrow from the particle's center, in the particle's color")
    vector_scale: float | None = _particles(
        None, "S", "drawn length of a vector of length 1. Default: the longest vector is twice as long as the usual distance of neighbours", read=float,
        rule=(lambda scale: 0.0 < scale < math.inf, "> 0 and finite"))

    size: tuple[int, int] | None = _view(None, "WxH", "pixels of the whole picture. Default: as many pixels as 1024x768, in the "
                                         "shape of the data", read=several(2, "x", int))
    width: str | float | None = _view(None, "LENGTH", "width of the whole picture on paper, instead of a size: 8.5cm, 85mm or 3.35in (in "
                                      "Python also a number of inches). The height follows from the data")
    dpi: float | None = _view(None, "N", "pixels per inch, which .png and .jpg state. Default: 300 with a width", read=float,
                              rule=(lambda dpi: 1.0 <= dpi <= 10000.0, "from 1 to 10000"))
    view: Direction = _view(VIEWS[0], "SIDE|X,Y,Z", f"{', '.join(VIEWS)}, or the direction to the camera. best looks along the "
                            "shortest principal axis, with the longest one across")
    up: Direction = _view("z", "AXIS|X,Y,Z", "upward direction of the data and the picture: x, y, z, -x, -y, -z, or a vector")
    projection: str = _view("perspective", "", "projection of the camera", choices=("perspective", "orthographic"))
    frame_all: bool = _view(False, "", "shows all balls. By default far balls, up to 0.5% but at least one, are left out with a note "
                            "if the other balls then appear 4 times as large")
    camera: Any = _view(None, "FILE", "scene file, or its camera alone, in the units of the data, instead of view and projection; in "
                        "Python also a Camera")

    style: str = _look("auto", "", "look; auto chooses molecule, protein, crystal, particles, point-cloud or galaxy by the data. "
                       "particles and matte are the plain look; ambient-occlusion has even light from all sides; soft adds outlines to it; "
                       "illustrative has flat colors, and outlines that are wider at larger steps of depth; cover has gloss, a floor and a "
                       "lens. A style sets only options that are not given", choices=("auto", *STYLES))
    material: Material | None = _python(None, "", "material of the particles, instead of the style's; colors multiply its diffuse")
    outlines: bool = _look(False, "", "dark lines around the balls; with opacity around those that are at least half opaque")
    depth_cue: float = _look(0.0, "SHARE", "by how much the farthest balls fade to the background, from 0 to 1", read=_share,
                             rule=(lambda share: 0.0 <= share <= 1.0, "from 0 to 1"))
    floor: bool = _look(False, "", "a floor of which only the shadows are visible")
    background: Any = _look("white", "COLOR", "a color, or transparent")
    box: str = _look("auto", "", "display of the cell, if the data have one. auto draws lines, except for a protein's crystal, for a "
                     "cell with most particles outside, and for a cell ten times as large as the particles' extent",
                     choices=("auto", "lines", "none"))
    exposure: float | None = _look(0.0, "EV", "brightness of the balls in stops; auto (in Python None) as in pt render",
                                   read=_stops, rule=(lambda stops: -64.0 <= stops <= 64.0, "from -64 to 64"))

    colorbar: bool = _words(False, "", "draws the legend at the right of the picture")
    title: str | None = _words(None, "WORDS", "title of the legend, with the unit; matplotlib's TeX. Default: the column")
    scale_bar: str | float | None = _words(None, "LENGTH", "draws a bar of this length in units of the data, 10 or \"10 nm\". Needs an "
                                           "orthographic projection, because in perspective lengths depend on the depth")
    axes: bool = _words(False, "", "draws the directions of x, y and z, or of the edges a, b and c of a drawn cell")
    labels: Labels = _words(None, "COLUMN|...", "words on particles that nothing hides: a column, or words and columns of selections, "
                            "\"name CA=resid,resname XK2=ligand\"; in Python also an array of shape (n,), with \"\" for none")
    distances: Any = _words(None, "I-J,...", "draws lines between particles, by index from 0, with their lengths in units of the data; in "
                            "Python pairs of indices, shape (k, 2)", read=_pairs)
    font_size: float | None = _words(None, "POINTS", "size of the text at this dpi, 7 or 7pt. Default: a fiftieth of the height",
                                     read=lambda text: float(text.removesuffix("pt")),
                                     rule=(lambda points: 0.0 < points < 1000.0, "> 0 and < 1000"))

    samples: int | None = _samples(None, "N", "samples of a pixel. Default: as many as make the noise of the particles "
                                   "invisible, 1.5 steps of 255 in 2x2 pixels, at most 128; at most 65536 with an error, 128 to "
                                   "denoise. 4 make a quick draft",
                                   flag="--spp", read=int,
                                   rule=(lambda count: 1 <= count < 2**32, "at least 1 and below 2^32"))
    error: float | None = _samples(None, "E", "stops when the image's relative error is at most this: 0.02 or, on the command "
                                   "line, 2%", read=_share,
                                   rule=(lambda share: 0.0 < share < math.inf, "> 0 and finite"))
    denoise: bool = _samples(False, "", "denoises the image and states the error of the result. Needs Open Image Denoise (the extra "
                             "denoise)")
    seed: int = _samples(0, "N", "seed of the random numbers", read=int,
                         rule=(lambda seed: 0 <= seed < 2**64, "at least 0 and below 2^64"))
    max_path_length: int = _python(3, "", "as in RenderSettings")
    device: str | None = _samples(None, "NAME", "device, as in pt render")
    ax: Any = _python(None, "", "axes of matplotlib that get the picture, in their size")
    context: Context | None = _python(None, "", "context for the rendering; its scene and settings are replaced")
    progress: Progress | None = _python(None, "", "called with the finished fraction; returning True ends the sampling early")

    def __post_init__(self) -> None:
        for each in fields(self):
            value, known = getattr(self, each.name), each.metadata
            if "choices" in known and value not in known["choices"]:
                raise ValueError(f"{each.name} = {value!r}: must be {', '.join(known['choices'])}")
            holds, words = known.get("rule", (None, ""))
            if holds and value is not None and not holds(value):
                raise ValueError(f"{each.name} = {value}: must be {words}")
        self._models  # raises ValueError for a wrong model
        if not isinstance(self.camera, (Camera, type(None))):
            object.__setattr__(self, "camera", _read_camera(self.camera))
        if self.pixel_width and self.size:
            raise ValueError("width: must not be given with size")
        if self.scale_bar is not None and (self.projection != "orthographic" if self.camera is None else
                                           self.camera.vertical_extent is None):
            raise ValueError("scale_bar: must have an orthographic projection: in perspective lengths depend on the depth")

    @property
    def inches(self) -> float | None:
        """The given width."""
        if self.width is None:
            return None
        found = re.fullmatch(r"\s*([\d.]+)\s*(cm|mm|in|pt)?\s*", str(self.width))
        inches = float(found[1]) / UNITS[found[2] or "in"] if found else 0.0
        if not 16 <= round(inches * (self.dpi or DPI)) <= 65536:
            raise ValueError(f"width = {self.width!r}: must be like 8.5cm, with 16 to 65536 pixels")
        return inches

    @property
    def pixel_width(self) -> int | None:
        return None if self.inches is None else round(self.inches * (self.dpi or DPI))

    @property
    def printed_dpi(self) -> float | None:
        return self.dpi or (None if self.width is None else DPI)

    @property
    def reading(self) -> dict[str, Any]:
        return {name: getattr(self, name) for name in ("columns", "format", "topology", "atom_style", "drop_nonfinite")}

    @property
    def bond_rule(self) -> Bonds:
        """Models with sticks always have bonds."""
        given = not (self.bonds is None or self.bonds is False)
        drawn = {self.drawn_model, *self.picked_models.values()}
        return self.bonds if given else "auto" if drawn != {"space-filling"} else None

    @functools.cached_property
    def _models(self) -> tuple[str, dict[str, str]]:
        base, others, picks = rules(self.model)
        for model in (base or "auto", *others, *picks.values()):
            if model not in MODELS:
                raise ValueError(f"model = {model!r}: must be {', '.join(MODELS)}")
        return base or "auto", picks

    @property
    def picked_models(self) -> dict[str, str]:
        return self._models[1]

    @property
    def drawn_model(self) -> str:
        if self._models[0] != "auto":
            return self._models[0]
        return "space-filling" if self.bonds is None or self.bonds is False else "ball-and-stick"

    @property
    def most_samples(self) -> int:
        return self.samples or (MOST_SAMPLES if self.error else SAMPLES)

    @property
    def stops_by_noise(self) -> bool:
        return self.samples is None and self.error is None and not self.denoise


def described() -> str:
    return "\n".join(_paragraph(each) for each in fields(Options))


def _paragraph(option: Field[Any]) -> str:
    words = "; ".join(filter(None, (", ".join(option.metadata.get("choices", ())), option.metadata["words"])))
    return textwrap.fill(words, 119, initial_indent=f"    {option.name:<17}", subsequent_indent=21 * " ")
