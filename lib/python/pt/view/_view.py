from __future__ import annotations

import os
import pathlib
from collections.abc import Callable

from pt._errors import Error
from pt._film import Film
from pt._files import Path
from pt.figures._options import Options
from pt.view._address import keep_address, kept_address
from pt.view._code import SHADERS
from pt.view._renderer import Renderer
from pt.view._server import Server
from pt.view._source import source_of
from pt.view._still import Still


class View:
    """Shows a scene file, particles, or a film in a browser page until it is closed.

    what         name of a file, or a Film, or the name of a folder of `pt course`, whose kernel the program pt (from
                 PT_PROGRAM or the PATH) judges after each save
    size         width and height in pixels; None: the scene's
    samples      most samples of a pixel
    device       as in Context
    shader_dir   kernels that replace the library's, with an editor in the page
    port         0 for a free port
    options      as in pt.figure, for particles
    address_file keeps the address for the next start, readable for its user alone

    The server listens only on 127.0.0.1. Everybody who knows `address` has full control. A notebook shows the view if
    the browser reaches that port. Raises Error, ValueError or OSError.
    """

    def __init__(self, what: Path | Film, *, size: tuple[int, int] | None = None, samples: int = 65536,
                 device: str | None = None, shader_dir: Path | None = None, port: int = 0,
                 options: Options | None = None, address_file: Path | None = None) -> None:
        folder = None if shader_dir is None else pathlib.Path(shader_dir).resolve()
        is_course = False
        if not isinstance(what, Film) and os.path.isdir(what):
            folder, is_course = pathlib.Path(what).resolve(), True
            what = folder / "scenes" / "coursework.json"
            if not what.exists():
                raise ValueError(f"{folder}: is no folder of `pt course`")
        source = what if isinstance(what, Film) else source_of(pathlib.Path(what), options or Options())
        scene = None if isinstance(source, Film) else source.path

        def files() -> dict[str, pathlib.Path]:
            if folder is None:
                return {}
            found = {scene.name: scene} if scene and scene.suffix == ".json" else {}
            return found | {path.name: path for path in sorted(folder.iterdir())
                            if path.suffix in SHADERS and path.is_file() and not path.is_symlink()}

        self._server = served(files, port, None if address_file is None else pathlib.Path(address_file))
        try:
            self._show: Still | Renderer
            if isinstance(source, Film):
                name = "film" if isinstance(what, Film) else pathlib.Path(what).name
                self._show = Still(source, name, self._server.published)
            else:
                self._show = Renderer(source, self._server.published, shader_dir=folder, device=device, most=samples,
                                      size=size, is_course=is_course)
        except (Error, ValueError, OSError):
            self._server.close()
            raise
        self._server.start(self._show)
        self.address = self._server.address

    def close(self) -> None:
        self._show.close()
        self._server.close()

    def _repr_html_(self) -> str:
        return f'<iframe src="{self.address}" style="width: 100%; height: 640px; border: 0"></iframe>'


def served(files: Callable[[], dict[str, pathlib.Path]], port: int, address_file: pathlib.Path | None) -> Server:
    """If another running view has the kept port, the address is new, and the file is unchanged."""
    kept = address_file and kept_address(address_file)
    if not kept:
        server = Server(files, port)
    else:
        try:
            server = Server(files, port or kept.port, kept.token)
        except OSError:
            if port:
                raise
            return Server(files)
    if address_file:
        keep_address(address_file, server.kept)
    return server
