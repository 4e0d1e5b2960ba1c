"""A view: a renderer, and the server of its page."""

from __future__ import annotations

import pathlib

from pt._errors import Error
from pt._film import Film
from pt._files import Path
from pt.figures._options import Options
from pt.view._renderer import SHADERS, Renderer
from pt.view._server import Server
from pt.view._source import source_of
from pt.view._still import Still


class View:
    """Shows a scene file, data of particles, or a film in a page of the browser, for as long as it is open.

    what         a file's name, or a Film. Scenes are read by the program pt, in the PATH or named by PT_PROGRAM
    size         width and height in pixels; None: the scene's
    samples      the most that a pixel gets
    device       as of Context
    shader_dir   kernels to use instead of the library's; they and the scene open in an editor in the page
    port         0: a free one
    options      of pt.figure, for particles

    It listens on 127.0.0.1 alone; anybody with `address` may see and steer it. A notebook shows it if the browser
    reaches that port. Error, ValueError, OSError: it cannot be shown.
    """

    def __init__(self, what: Path | Film, *, size: tuple[int, int] | None = None, samples: int = 65536,
                 device: str | None = None, shader_dir: Path | None = None, port: int = 0,
                 options: Options | None = None) -> None:
        source = what if isinstance(what, Film) else source_of(pathlib.Path(what), options or Options())
        folder = None if shader_dir is None else pathlib.Path(shader_dir).resolve()
        scene = None if isinstance(source, Film) else source.path

        def files() -> dict[str, pathlib.Path]:
            if folder is None:
                return {}
            found = {scene.name: scene} if scene and scene.suffix == ".json" else {}
            return found | {path.name: path for path in sorted(folder.iterdir())
                            if path.suffix in SHADERS and path.is_file() and not path.is_symlink()}

        self._server = Server(files, port)
        try:
            self._show: Still | Renderer
            if isinstance(source, Film):
                name = "film" if isinstance(what, Film) else pathlib.Path(what).name
                self._show = Still(source, name, self._server.published)
            else:
                self._show = Renderer(source, self._server.published, shader_dir=folder, device=device, most=samples,
                                      size=size)
        except (Error, ValueError, OSError):
            self._server.close()
            raise
        self._server.start(self._show)
        self.address = self._server.address

    def close(self) -> None:
        """Ends it; the page says so. A second call does nothing."""
        self._show.close()
        self._server.close()

    def _repr_html_(self) -> str:
        return f'<iframe src="{self.address}" style="width: 100%; height: 640px; border: 0"></iframe>'
