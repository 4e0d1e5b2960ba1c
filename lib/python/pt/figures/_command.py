"""pt-figure: a picture of the particles in a file."""

from __future__ import annotations

import argparse
import json
import os
import pathlib
import re
import signal
import sys
import time
from collections.abc import Callable
from typing import Any, NoReturn

from pt._command_line import (CODE_OF_RESULT, FILES, INTERNAL, SCENE, SIGNAL, TARGET_MISSED, USAGE, at_least,
                              numbered)
from pt._context import Context
from pt._errors import Error
from pt.figures._accept import frames as read_frames, load
from pt.figures._colors import SCALES
from pt.figures._figure import Effort, Figure, Look, Staged
from pt.figures._layout import PROJECTIONS
from pt.figures._series import frames, turntable
from pt.figures._stage import STYLES
from pt.figures._view import VIEWS

PICTURES = (".png", ".jpg", ".jpeg", ".exr")
EPILOG = """\
DATA is of a simulation, a molecule or a point cloud. The camera goes as near as it can with all of every ball in the
picture; lengths follow from the data, so that their units do not matter. Bonds are not drawn. All of --frames and
--turntable have one camera and one scale, and names with # signs for their number:
  ffmpeg -framerate 25 -i f-%03d.png -pix_fmt yuv420p f.mp4    (after -o f-###.png)
"""


def refuse(message: str, code: int = USAGE) -> NoReturn:
    print(f"pt-figure: {message}", file=sys.stderr)
    sys.exit(code)


def pair(separator: str, kind: type, rule: str) -> Callable[[str], Any]:
    """Two numbers of a command line."""
    def read(text: str) -> Any:
        try:
            first, second = (kind(each) for each in text.split(separator))
        except ValueError:
            raise argparse.ArgumentTypeError(f"must be {rule}, is {text!r}") from None
        return first, second
    return read


def share(text: str) -> float:
    try:
        value = float(text.rstrip("%")) / (100.0 if text.endswith("%") else 1.0)
    except ValueError:
        value = 0.0
    if not 0.0 < value < float("inf"):
        raise argparse.ArgumentTypeError(f"must be above 0, like 2% or 0.02, is {text!r}")
    return value


def stops(text: str) -> float | None:
    try:
        value = None if text == "auto" else float(text)
    except ValueError:
        value = float("inf")
    if value is not None and not -64.0 <= value <= 64.0:
        raise argparse.ArgumentTypeError(f"must be auto or from -64 to 64, is {text!r}")
    return value


def parser() -> argparse.ArgumentParser:
    command = argparse.ArgumentParser(
        prog="pt-figure", description="Makes a picture of the particles in a data file.", epilog=EPILOG,
        allow_abbrev=False, formatter_class=argparse.RawDescriptionHelpFormatter)
    command.add_argument("data", metavar="DATA", help="file of particles; - is standard input")
    add = command.add_argument_group("output").add_argument
    add("-o", "--output", action="append", default=[], metavar="IMAGE",
        help="may be given again: .png, .jpg are the figure; .exr is the linear radiance of its scene; - is standard "
        "output")
    add("--format", choices=("exr", "png", "jpg", "jpeg"), help="of an image to standard output")
    add("--legend", metavar="FILE", help="what the colours say, as .svg, .pdf or .png")
    add("--write-scene", metavar="SCENE", help="scene file for `pt render`, with NPY files beside it")
    add("--turntable", type=at_least(2, int), metavar="N", help="N pictures once round; -o f-###.png")
    add("--frames", type=pair("-", int, "two frames like 0-99"), metavar="A-B",
        help="a picture of each frame; -o f-###.png")
    add = command.add_argument_group("data").add_argument
    add("--frame", type=int, help="0 is the first, -1 the last (default)")
    add("--data-format", help="by default the file's first bytes or its name say it")
    add("--columns", metavar="x=NAME,...", help="where positions and others are")
    add("--where", action="append", default=[], metavar="CONDITION",
        help='show particles for which this holds, like "z < 5"; may be given again')
    add("--wrap", action="store_true", help="bring particles that have left a periodic cell back into it")
    add("--drop-nonfinite", action="store_true", help="leave out particles whose position is no number")
    add = command.add_argument_group("particles").add_argument
    add("--color", metavar="COLUMN|COLOUR|...",
        help="column of numbers or words; |v| or |vx,vy,vz|, a magnitude; red,green,blue; a colour for all; or of types, "
        "O=red,H=#ffffff (default: of elements or types, else the data's, else grey)")
    add("--colormap", metavar="MAP", help="of matplotlib, like magma or viridis_r (default: viridis, or coolwarm)")
    add("--color-range", type=pair(",", float, "two numbers like -1,2.5"), metavar="LO,HI",
        help="of the first and the last colour (default: all there are; of skewed data 1%% to 99%%)")
    add("--color-scale", choices=SCALES, default="linear", help="symmetric: about 0")
    add("--categories", action="store_true", help="numbers of the column name categories")
    add("--nan-color", default="#bfbfbf", metavar="COLOUR", help="of particles without a number")
    add("--title", help="of the legend, with the unit (default: the column)")
    add("--colorbar", action="store_true", help="put the legend into the picture, at the right")
    add("--radius", metavar="R|COLUMN|covalent|van-der-waals|TYPE=R,...",
        help="also with a factor, 0.5*diameter (default: the column radius, else covalent, else half of what most "
        "neighbours are apart)")
    add = command.add_argument_group("view").add_argument
    add("--size", type=pair("x", int, "WxH, like 800x600"), metavar="WxH",
        help="pixels (default: 1024x768 in the shape of the data)")
    add("--view", default=VIEWS[0], metavar="SIDE|X,Y,Z", help=f"{', '.join(VIEWS)}, or the direction to the camera")
    add("--up", default="z", metavar="AXIS|X,Y,Z", help="x, y, z, -x, -y or -z, or a direction (default: z)")
    add("--projection", choices=PROJECTIONS, default=PROJECTIONS[0])
    add = command.add_argument_group("look").add_argument
    add("--style", choices=STYLES, default=STYLES[0])
    add("--outlines", action="store_true", help="dark lines round the balls")
    add("--floor", action="store_true", help="a floor that shows the shadows alone")
    add("--background", default="white", metavar="COLOUR", help="or transparent")
    add("--box", choices=("lines", "none"), default="lines", help="the cell, where the file has one")
    add("--exposure", type=stops, default=0.0, metavar="EV", help="brightens the balls; auto: as pt render")
    add("--png-bits", type=int, choices=(8, 16), default=8)
    add = command.add_argument_group("samples").add_argument
    add("--spp", type=at_least(1, int), metavar="N", help="samples a pixel (default: 128), the most with --error")
    add("--error", type=share, metavar="E", help="end at this relative error, like 2%%")
    add("--seed", type=at_least(0, int), default=0, metavar="N")
    add("--device", help="what to render on, as of pt render")
    add("--progress", choices=("auto", "json", "none"), default="auto")
    add("-q", "--quiet", action="store_true", help="print errors only")
    return command


def joined(words: list[str]) -> list[str]:
    """With "--up -z" as "--up=-z", which argparse takes for an option else."""
    result: list[str] = []
    for word in words:
        if result and re.fullmatch(r"--[a-z-]+", result[-1]) and re.fullmatch(r"-([xyz]|[\d.][\d.,eE+%-]*)", word):
            result[-1] += f"={word}"
        else:
            result.append(word)
    return result


def check(options: argparse.Namespace) -> None:
    """Names and what contradicts itself: now rather than after minutes."""
    series = options.turntable or options.frames
    if not (options.output or options.legend or options.write_scene):
        refuse("-o, --write-scene or --legend is missing: there is nothing to write")
    if options.turntable and options.frames:
        refuse("--turntable: not with --frames")
    if options.frames and options.data == "-":
        refuse("--frames: read the file twice, which standard input cannot be")
    if options.data != "-" and not os.access(options.data, os.R_OK):
        refuse(f"{options.data}: is not there or cannot be read", FILES)
    names: list[str] = []
    for option, path, endings in (*(("-o", path, PICTURES) for path in options.output),
                                  ("--legend", options.legend, (".svg", ".pdf", ".png")),
                                  ("--write-scene", options.write_scene, (".json",))):
        if path is None:
            continue
        if path == "-" and option == "-o":
            if not options.format or series:
                refuse("-o -: needs --format" if not series else "-o -: a series needs files")
            continue
        place = pathlib.Path(path)
        if place.suffix.lower() not in endings:
            refuse(f"{option} {path}: must end in {', '.join(endings)}")
        if not os.access(place.parent, os.W_OK | os.X_OK):
            refuse(f"{option} {path}: its folder {place.parent} is not there or cannot be written to", FILES)
        if series and option == "-o" and "#" not in place.name:
            refuse(f"-o {path}: of a series the name must have # signs, for the number")
        if options.background == "transparent" and place.suffix.lower() in (".jpg", ".jpeg"):
            refuse(f"--background transparent: -o {path}: JPEG has no alpha; .png has")
        names.append(os.path.realpath(path))
    if len(set(names)) < len(names) or os.path.realpath(options.data) in names:
        refuse("an output is named twice, or is the data")


class Shown:
    """Progress on standard error: a line for people, or a JSON object a line."""

    def __init__(self, style: str) -> None:
        self.style = ("line" if sys.stderr.isatty() else "none") if style == "auto" else style
        self.next = 0.0

    def __call__(self, done: float) -> bool:
        now = time.monotonic()
        if self.style != "none" and (now >= self.next or done == 1.0):
            self.next = now + 0.1
            sys.stderr.write(json.dumps({"fraction": done}) + "\n" if self.style == "json" else
                             f"\r\x1b[K{100 * done:5.1f} %" if done < 1.0 else "\r\x1b[K")
            sys.stderr.flush()
        return False


def draw(options: argparse.Namespace) -> int:
    look = Look(color=options.color, radius=options.radius, colormap=options.colormap, range=options.color_range,
                scale=options.color_scale, categories=options.categories, nan_color=options.nan_color,
                title=options.title, where=options.where, wrap=options.wrap, view=options.view, up=options.up,
                projection=options.projection, size=options.size, style=options.style, floor=options.floor,
                outlines=options.outlines, box=options.box == "lines", background=options.background,
                colorbar=options.colorbar)
    effort = Effort(samples=options.spp, error=options.error, seed=options.seed, exposure=options.exposure)
    shown = Shown("none" if options.quiet else options.progress)

    numbers: list[int | None] = [None]
    columns = {"columns": options.columns, "format": options.data_format, "drop_nonfinite": options.drop_nonfinite}
    if options.frames:
        first, last = options.frames
        numbers = [*range(first, last + 1)]
        staged = frames(lambda: read_frames(options.data, first, last, **columns), look)
    else:
        particles = load(options.data, frame=options.frame, **columns)
        if options.turntable:
            numbers = [*range(options.turntable)]
            staged = turntable(particles, options.turntable, look)
        else:
            staged = iter([Staged.of(particles, look)])
    context: Context | None = None
    told: set[str] = set()
    missed = False
    for number, each in zip(numbers, staged):
        for note in each.drawn.notes if not options.quiet else ():
            if note not in told:
                print(f"pt-figure: {note}", file=sys.stderr)
            told.add(note)
        if options.legend and not number:
            each.save_legend(options.legend)
        if options.write_scene and not number:
            each.save_scene(options.write_scene, effort)
        if options.output:
            context = context or Context(options.device)
            figure = each.draw(effort, context, shown)
            write(figure, number, options)
            missed = missed or (options.error is not None and figure.error_bounds[1] > options.error)
    return TARGET_MISSED if missed else 0


def write(figure: Figure, number: int | None, options: argparse.Namespace) -> None:
    for path in options.output:
        if path == "-":
            sys.stdout.buffer.write(figure.encode(options.format, bits=options.png_bits))
            sys.stdout.buffer.flush()
        else:
            figure.save(numbered(path, number), bits=options.png_bits)
    if not options.quiet:
        names = ", ".join(numbered(path, number) for path in options.output)
        print(f"wrote {names}: {figure!r}", file=sys.stderr if "-" in options.output else sys.stdout)


def main() -> None:
    options = parser().parse_args(joined(sys.argv[1:]))
    check(options)
    try:
        code = draw(options)
    except KeyboardInterrupt:
        refuse("stopped; no more images are written", SIGNAL + signal.SIGINT)
    except Error as error:
        refuse(str(error), CODE_OF_RESULT.get(error.result, INTERNAL))
    except OSError as error:
        refuse(f"{error.filename or options.data}: {error.strerror or error}", FILES)
    except (ValueError, TypeError) as error:
        refuse(str(error), SCENE)
    sys.exit(code)


if __name__ == "__main__":
    main()
