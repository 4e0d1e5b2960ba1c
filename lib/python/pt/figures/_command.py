from __future__ import annotations

import argparse
import json
import os
import re
import signal
import sys
import time
from collections.abc import Callable
from dataclasses import Field, fields, replace
from typing import Any, NoReturn

from pt._command_line import (CODE_OF_RESULT, FILES, INTERNAL, SCENE, SIGNAL, TARGET_MISSED, USAGE, at_least,
                              choose_vector_width, misnamed, numbered)
from pt._context import Context
from pt._errors import Error
from pt._text import tell
from pt.figures._accept import frames as read_frames
from pt.figures._figure import Figure, Staged
from pt.figures._legend import LEGENDS, save_legend
from pt.figures._movies import MOVIES, check_movie, write_movie
from pt.figures._options import Options, several
from pt.figures._picture import PAGES
from pt.figures._series import Panels, frames, sources_of, turntable

EPILOG = """\
DATA is a simulation, a molecule or a point cloud, in any units. The camera is as close as it can be with all balls in view.
Pictures of --frames and --turntable share one camera and one scale. # signs in their names become the number:
  ffmpeg -framerate 25 -i f-%03d.png -pix_fmt yuv420p f.mp4    (after -o f-###.png)
-o f.gif (by the module Pillow) and -o f.mp4 (by imageio-ffmpeg) hold all pictures of a series.
"""
PICTURES = ("exr", *PAGES)


def refuse(message: str, code: int = USAGE) -> NoReturn:
    tell("pt-figure", message)
    sys.exit(code)


def typed(read: Callable[[str], Any], rule: str) -> Callable[[str], Any]:
    def value(text: str) -> Any:
        try:
            return read(text)
        except ValueError:
            raise argparse.ArgumentTypeError(f"must be {rule}, is {text!r}") from None
    return value


def parser() -> argparse.ArgumentParser:
    command = argparse.ArgumentParser(
        prog="pt-figure", description="Makes a picture of the particles in a data file.", epilog=EPILOG,
        allow_abbrev=False, formatter_class=argparse.RawDescriptionHelpFormatter)
    command.add_argument("data", metavar="DATA", nargs="+", help="file of particles; - is standard input; several files become panels, with "
                         "one camera, scale and range of colors")
    add = command.add_argument_group("output").add_argument
    add("-o", "--output", action="append", default=[], metavar="IMAGE",
        help="may be repeated: .png and .jpg show the figure, .pdf and .svg with words and lines as vectors, .exr has the linear "
        "radiance of its scene; - is standard output")
    add("--format", dest="output_format", choices=PICTURES, help="format of an image on standard output")
    add("--png-bits", type=int, choices=(8, 16), default=8)
    add("--legend", metavar="FILE", help="legend of the colors, as .svg, .pdf or .png")
    add("--write-scene", metavar="SCENE", help="scene file for `pt render`, with NPY files beside it")
    add("--panels", type=lambda text: text.split(","), default=[], metavar="COLUMN,...", help="a panel for each of these colors; all share one range")
    add("--turntable", type=at_least(2, int), metavar="N", help="N pictures of a full turn about the vertical axis; lamps move "
        "with the camera")
    add("--frames", type=typed(several(2, "-", int), "two frames like 0-99"), metavar="A-B", help="a picture of each frame")
    add("--progress", choices=("auto", "json", "none"), default="auto")
    add("-q", "--quiet", action="store_true", help="print errors only")
    groups: dict[str, Any] = {}
    for each in fields(Options):
        if group := each.metadata["group"]:
            groups[group] = groups.get(group) or command.add_argument_group(group)
            add_option(groups[group], each)
    return command


def add_option(group: Any, option: Field[Any]) -> None:
    known, default = option.metadata, option.default
    words = known["words"] + (f" (default: {default})" if isinstance(default, str) else "")
    more: dict[str, Any] = {"action": "store_true"}
    if default is not False:
        more = {"action": "append" if default == () else "store", "metavar": known["metavar"] or None, "choices":
                known.get("choices"), "type": typed(known["read"], known["metavar"]) if "read" in known else None}
    group.add_argument(known.get("flag", "--" + option.name.replace("_", "-")), dest=option.name,
                       default=[] if default == () else default, help=words.replace("%", "%%"), **more)


def joined(words: list[str]) -> list[str]:
    """Joins "--up -z" to "--up=-z", because argparse would take -z for an option."""
    result: list[str] = []
    for word in words:
        if result and re.fullmatch(r"--[a-z-]+", result[-1]) and re.fullmatch(r"-([xyz]|[\d.][\d.,eE+%-]*)", word):
            result[-1] += f"={word}"
        else:
            result.append(word)
    return result


def check(given: argparse.Namespace) -> None:
    series = given.turntable or given.frames
    pictures = [path for path in given.output if path != "-"]
    files = [(path, ("gif", "mp4") if path.lower().endswith(MOVIES) else PICTURES) for path in pictures] + [
        (path, formats) for path, formats in ((given.legend, LEGENDS), (given.write_scene, ("json",))) if path]
    if not (given.output or files):
        refuse("-o, --write-scene or --legend is missing: there is nothing to write")
    if given.turntable and given.frames:
        refuse("--turntable: not with --frames")
    if (len(given.data) > 1 or given.panels) and (series or given.write_scene):
        refuse("panels: not with --frames, --turntable or --write-scene")
    if given.frames and "-" in given.data:
        refuse("--frames: standard input cannot be read twice")
    for each in given.data:
        if each != "-" and not os.access(each, os.R_OK):
            refuse(f"{each}: does not exist or cannot be read", FILES)
    if "-" in given.output and (series or not given.output_format):
        refuse("-o -: a series needs files" if series else "-o -: needs --format")
    for path in pictures:
        is_movie = path.lower().endswith(MOVIES)
        if is_movie and not series:
            refuse(f"-o {path}: only with --frames or --turntable")
        if is_movie:
            check_movie(path)
        if series and not is_movie and "#" not in os.path.basename(path):
            refuse(f"-o {path}: a series needs # signs in the name, for the number")
        if given.background == "transparent" and path.lower().endswith((".jpg", ".jpeg", *MOVIES)):
            refuse(f"--background transparent: -o {path}: {'this format' if is_movie else 'JPEG'} has no alpha; .png has")
    for each in given.data:
        if wrong := misnamed(files, each):
            refuse(*wrong)


class Shown:
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


def staged(given: argparse.Namespace, options: Options) -> Any:
    if given.frames:
        first, last = given.frames
        return zip(range(first, last + 1), frames(lambda: read_frames(given.data[0], first, last, **options.reading), options))
    sources = sources_of(given.data, given.panels, options)
    if len(sources) > 1:
        return [(None, Panels(sources, options))]
    if given.turntable:
        return enumerate(turntable(sources[0][0], given.turntable, options))
    return [(None, Staged.of(sources[0][0], replace(options, color=sources[0][1] or options.color)))]


def draw(given: argparse.Namespace, options: Options) -> int:
    context: Context | None = None
    told: set[str] = set()
    movies: dict[str, list[Any]] = {path: [] for path in given.output if path.lower().endswith(MOVIES)}
    missed = False
    for number, each in staged(given, options):
        if not given.quiet:
            for note in each.notes:
                if (words := re.sub(r"\d", "", note)) not in told:
                    tell("pt-figure", note)
                    told.add(words)
        if given.legend and not number:
            save_legend(each.legend, given.legend)
        if given.write_scene and not number:
            each.save_scene(given.write_scene)
        if given.output:
            context = context or Context(options.device)
            figure = each.draw(context)
            for pictures in movies.values():
                pictures.append(figure.to_srgb8())
            write(figure, number, given)
            missed = missed or (options.error is not None and figure.error_bounds[1] > options.error)
    for path, pictures in movies.items():
        write_movie(path, pictures)
        if not given.quiet:
            tell("", f"wrote {path}: {len(pictures)} pictures", sys.stdout)
    return TARGET_MISSED if missed else 0


def write(figure: Figure, number: int | None, given: argparse.Namespace) -> None:
    paths = [path for path in given.output if not path.lower().endswith(MOVIES)]
    for path in paths:
        if path == "-":
            sys.stdout.buffer.write(figure.encode(given.output_format, bits=given.png_bits))
            sys.stdout.buffer.flush()
        else:
            figure.save(numbered(path, number), bits=given.png_bits)
    if paths and not given.quiet:
        names = ", ".join(numbered(path, number) for path in paths)
        tell("", f"wrote {names}: {figure!r}", None if "-" in given.output else sys.stdout)


def main() -> None:
    given = parser().parse_args(joined(sys.argv[1:]))
    try:
        options = Options(**{name: value for name, value in vars(given).items() if name in Options.__annotations__
                             and name != "progress"}, progress=Shown("none" if given.quiet else given.progress))
        check(given)
        if given.output:
            choose_vector_width("tree", options.device)
    except ValueError as error:
        refuse(str(error))
    try:
        code = draw(given, options)
    except KeyboardInterrupt:
        refuse("stopped; no more images are written", SIGNAL + signal.SIGINT)
    except Error as error:
        refuse(str(error), CODE_OF_RESULT.get(error.result, INTERNAL))
    except OSError as error:
        refuse(f"{error.filename or given.data[0]}: {error.strerror or error}", FILES)
    except (ValueError, TypeError) as error:
        refuse(str(error), SCENE)
    sys.exit(code)


if __name__ == "__main__":
    main()
