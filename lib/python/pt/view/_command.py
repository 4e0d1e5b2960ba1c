from __future__ import annotations

import argparse
import hashlib
import os
import pathlib
import shutil
import signal
import sys
import tempfile
import threading
import webbrowser
from dataclasses import fields
from typing import IO, NoReturn

from pt._command_line import CODE_OF_RESULT, FILES, INTERNAL, SCENE, USAGE, at_least, choose_vector_width
from pt._errors import Error
from pt._text import tell
from pt.figures._command import add_option, joined, typed
from pt.figures._options import Options, several
from pt.view._trace import kernels

EPILOG = """\
The server listens only on 127.0.0.1. Everybody who has its address can control it. From another machine use
ssh -L PORT:127.0.0.1:PORT HOST with the port of the address. Ctrl-C ends the server. Only the page's save buttons write files.
"""


def refuse(message: str, code: int = USAGE) -> NoReturn:
    tell("pt-view", message)
    sys.exit(code)


def parser() -> argparse.ArgumentParser:
    command = argparse.ArgumentParser(
        prog="pt-view", description="Shows a scene, particles or a film in the browser while the picture refines.",
        epilog=EPILOG, allow_abbrev=False, formatter_class=argparse.RawDescriptionHelpFormatter)
    add = command.add_argument
    add("what", metavar="SCENE|DATA|FILM|COURSE", help="a scene (.json), a film (.ptfilm), data for pt figure, or a folder of pt course")
    add("--size", type=typed(several(2, "x", int), "WxH"), metavar="WxH", help="pixels; by default the scene's")
    add("--spp", type=at_least(1, int), default=65536, metavar="N", help="most samples of a pixel (default: 65536)")
    add("--device", metavar="NAME", help="device, as in pt render")
    add("--shader-dir", metavar="DIR", help="folder of kernels that replace the library's; the page edits them and the scene")
    add("--edit", action="store_true", help="like --shader-dir pt-shaders; if missing, this folder becomes a copy of the kernels")
    add("--port", type=at_least(0, int), default=0, metavar="N", help="port; by default a free one")
    add("--no-browser", action="store_true", help="only prints the address")
    groups = {name: command.add_argument_group(f"{name} of DATA, as in pt figure") for name in ("data", "particles", "view", "look")}
    for each in fields(Options):
        if each.metadata["group"] in groups and each.name != "size":
            add_option(groups[each.metadata["group"]], each)
    return command


def is_of_another(path: pathlib.Path) -> bool:
    """Whether another user, who could replace the contents, owns the folder or a link to it."""
    return hasattr(os, "geteuid") and any(status.st_uid != os.geteuid() for status in (path.lstat(), path.stat()))


def shader_dir(given: argparse.Namespace) -> pathlib.Path | None:
    if given.shader_dir:
        return pathlib.Path(given.shader_dir)
    if not given.edit:
        return None
    folder, source = pathlib.Path("pt-shaders"), kernels()
    if folder.is_symlink() or folder.exists():
        if is_of_another(folder):
            refuse(f"--edit: {folder} belongs to another user: use another folder", FILES)
    else:
        if source is None:
            refuse("--edit: the kernels are not installed; --shader-dir DIR names a copy of shaders/", FILES)
        shutil.copytree(source, folder, ignore=lambda _, names: {name for name in names if name.endswith(".md")})
    tell("pt-view", f"the kernels are in {folder}")
    return folder


def user_cache() -> pathlib.Path:
    return pathlib.Path(os.environ.get("XDG_CACHE_HOME") or pathlib.Path.home() / ".cache", "pt")


def address_file(what: str) -> pathlib.Path:
    name = hashlib.sha256(os.fsencode(os.path.realpath(what))).hexdigest()[:32]
    return user_cache() / "view" / f"{name}.json"


def open_browser(address: str) -> IO[str]:
    """Passes the address in a file that only its user can read, because all users see arguments of processes."""
    user_cache().mkdir(parents=True, exist_ok=True)
    file = tempfile.NamedTemporaryFile("w", suffix=".html", dir=user_cache())
    file.write(f'<meta http-equiv="refresh" content="0; url={address}">')
    file.flush()
    webbrowser.open(pathlib.Path(file.name).as_uri())
    return file


def main() -> None:
    given = parser().parse_args(joined(sys.argv[1:]))
    if not os.access(given.what, os.R_OK):
        refuse(f"{given.what}: does not exist or cannot be read", FILES)
    if given.shader_dir and not os.path.isdir(given.shader_dir):
        refuse(f"--shader-dir {given.shader_dir}: is no folder", FILES)
    is_scene = given.what.endswith(".json")
    choose_vector_width(given.what if is_scene else "list" if os.path.isdir(given.what) else "tree", given.device)
    try:
        from pt.view._view import View
    except ImportError as error:
        refuse(f"needs aiohttp: pip install './lib/python[view]' ({error})", INTERNAL)
    try:
        options = Options(**{name: value for name, value in vars(given).items()
                             if name in Options.__annotations__ and name not in ("size", "device")})
        view = View(given.what, size=given.size, samples=given.spp, device=given.device, shader_dir=shader_dir(given),
                    port=given.port, options=options, address_file=address_file(given.what))
    except Error as error:
        refuse(str(error), CODE_OF_RESULT.get(error.result, INTERNAL))
    except OSError as error:
        refuse(str(error), FILES)
    except (ValueError, TypeError) as error:
        refuse(str(error), SCENE)
    ended = threading.Event()
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda *_: ended.set())
    print(view.address, flush=True)
    way = None if given.no_browser else open_browser(view.address)
    ended.wait()
    view.close()
    if way:
        way.close()


if __name__ == "__main__":
    main()
