from __future__ import annotations

import argparse
import pathlib
import re
import sys
from collections.abc import Callable
from typing import Any, NoReturn

from pt._command_line import USAGE, at_least, misnamed, numbered
from pt._enums import Sampling
from pt._files import PICTURES
from pt._scene_file import Override, scene_schema
from pt._text import tell

FILM_LAYERS = {"mean", "standard-error", "sample-count"}


def refuse(message: str, code: int = USAGE) -> NoReturn:
    tell("pt-farm", message)
    sys.exit(code)


def _share(text: str) -> float:
    try:
        value = float(text.removesuffix("%")) / (100 if text.endswith("%") else 1)
    except ValueError:
        value = 0.0
    if not 0.0 < value < float("inf"):
        raise argparse.ArgumentTypeError(f"must be a number above 0 like 0.005 or 0.5%, is {text!r}")
    return value


def _setting(name: str, path: str, form: str) -> Callable[[str], list[Override]]:
    return lambda text: [Override(f"{path}={form.format(text)}", name)]


def _size(text: str) -> list[Override]:
    found = re.fullmatch(r"(\d+)x(\d+)", text, re.ASCII)
    if not found:
        raise argparse.ArgumentTypeError(f"must be two whole numbers like 1920x1080, is {text!r}")
    return [Override(f"film.{name}={value}", f"--size: {name}") for name, value in zip(("width", "height"), found.groups())]


def _add_scene_options(command: argparse.ArgumentParser) -> None:
    """--set comes first, so that other options replace its values."""
    group = command.add_argument_group("as in pt render")
    settings: dict[str, Any] = {"dest": "overrides", "action": "extend", "default": []}
    group.add_argument("--set", action="extend", default=[], type=lambda text: [Override(text)], metavar="PATH=VALUE")
    group.add_argument("--size", type=_size, metavar="WxH", **settings)
    for section in ("film", "render"):
        for key, schema in scene_schema()["properties"][section]["properties"].items():
            if key not in ("width", "height"):
                name, is_array = f"--{key.replace('_', '-')}", schema.get("type") == "array"
                group.add_argument(name, type=_setting(name, f"{section}.{key}", "[{}]" if is_array else "{}"),
                                   metavar="X,X,X" if is_array else "X", **settings)
    group.add_argument("--error", type=_share, default=0.0, metavar="E")
    group.add_argument("--sampling", choices=[name.lower() for name in Sampling.__members__], default="best")
    group.add_argument("--first-sample", type=at_least(0, int), default=0, metavar="N")


def parser() -> argparse.ArgumentParser:
    root = argparse.ArgumentParser(prog="pt-farm", description="Renders scene files on a Dask cluster.",
                                   allow_abbrev=False)
    command = root.add_subparsers(dest="command", required=True).add_parser(
        "render", allow_abbrev=False, help="render a scene")
    command.add_argument("scene", metavar="SCENE")
    command.add_argument("-o", "--output", action="append", default=[], metavar="IMAGE")
    command.add_argument("--film", metavar="FILM")
    command.add_argument("--layers", metavar="NAMES")
    command.add_argument("--alpha", action="store_true")
    where = command.add_mutually_exclusive_group()
    where.add_argument("--scheduler", metavar="ADDRESS", help="address of a Dask cluster, such as tls://host:8786")
    where.add_argument("--local-workers", type=at_least(1, int), metavar="N",
                       help="processes on this machine (default: 2)")
    command.add_argument("--tls", nargs=3, metavar=("CA", "CERT", "KEY"), help="files, for a tls:// scheduler")
    command.add_argument("--device", help="device of each worker, as in pt render")
    command.add_argument("--checkpoint", metavar="FILM")
    command.add_argument("--checkpoint-every", type=at_least(0.01, float), default=30.0, metavar="SECONDS")
    command.add_argument("--resume", action="store_true")
    command.add_argument("--part-seconds", type=at_least(0.1, float), default=5.0)
    command.add_argument("--patience", type=at_least(0.1, float), default=10.0)
    command.add_argument("--wait", type=at_least(1, float), default=300.0, metavar="SECONDS",
                         help="longest wait for a ready worker (default: 300)")
    command.add_argument("--mixed", action="store_true",
                         help="accept devices and drivers unlike the first worker's")
    command.add_argument("--frames", metavar="A-B")
    command.add_argument("--skip-existing", action="store_true")
    command.add_argument("-q", "--quiet", action="store_true")
    _add_scene_options(command)
    return root


def frames_of(arguments: argparse.Namespace) -> list[int | None]:
    if arguments.frames is None:
        return [None]
    found = re.fullmatch(r"(\d+)(?:-(\d+))?", arguments.frames, re.ASCII)
    first, last = (int(found[1]), int(found[2] or found[1])) if found else (1, 0)
    if last < first:
        refuse(f"--frames {arguments.frames}: must be two whole numbers like 0-23, or one")
    for name in written(arguments):
        if "#" not in name:
            refuse(f"{name}: with --frames the name needs # signs for the frame's number")
    return [frame for frame in range(first, last + 1) if not (arguments.skip_existing and is_done(arguments, frame))]


def check(arguments: argparse.Namespace) -> None:
    if not (arguments.output or arguments.film):
        refuse("-o or --film is missing: there is nothing to write")
    if arguments.resume and not arguments.checkpoint:
        refuse("--resume: needs --checkpoint")
    if arguments.tls and not arguments.scheduler:
        refuse("--tls: needs --scheduler with an address like tls://host:8786")
    if arguments.frames and arguments.checkpoint:
        refuse("--checkpoint: cannot be used with --frames; --skip-existing continues after the finished frames")
    if arguments.checkpoint and not arguments.resume and pathlib.Path(arguments.checkpoint).exists():
        refuse(f"--checkpoint {arguments.checkpoint}: exists; continue from it by --resume")
    check_files(arguments)


def check_files(arguments: argparse.Namespace) -> None:
    wanted: list[tuple[str, tuple[str, ...]]] = [(name, PICTURES) for name in arguments.output]
    wanted += [(name, ()) for name in (arguments.film, arguments.checkpoint) if name]
    if wrong := misnamed(wanted, arguments.scene):
        refuse(*wrong)
    if arguments.alpha:
        for name in arguments.output:
            if not name.lower().endswith((".exr", ".png")):
                refuse(f"--alpha: -o {name}: the format has no alpha; .exr and .png have")
    if arguments.layers:
        if not set(arguments.layers.split(",")) <= FILM_LAYERS:
            refuse(f"--layers {arguments.layers}: must be of {', '.join(sorted(FILM_LAYERS))}, separated by commas")
        if not any(name.lower().endswith(".exr") for name in arguments.output):
            refuse("--layers: needs -o FILE.exr, because no other format has layers")


def written(arguments: argparse.Namespace) -> list[str]:
    return [*arguments.output, *filter(None, (arguments.film,))]


def is_done(arguments: argparse.Namespace, frame: int | None) -> bool:
    return all(pathlib.Path(numbered(name, frame)).exists() for name in written(arguments))
