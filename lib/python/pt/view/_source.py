from __future__ import annotations

import io
import json
import pathlib
import re
import tempfile
import zipfile
from dataclasses import dataclass
from typing import Protocol

from pt._camera import Camera, RenderSettings
from pt._errors import Error
from pt._files import regular
from pt._film import Film
from pt._scene import Scene
from pt._scene_file import Display, SceneFile
from pt._scene_file import load as load_scene
from pt.figures._accept import load
from pt.figures._figure import Staged
from pt.figures._files import write_scene
from pt.figures._options import Options
from pt.view._code import STRING_OR_COMMENT


@dataclass
class Shown:
    scene: Scene
    camera: Camera
    settings: RenderSettings
    display: Display
    files: list[pathlib.Path]


class Source(Protocol):
    path: pathlib.Path

    def read(self) -> Shown:
        """Raises Error, ValueError or OSError."""

    def explained(self, error: Exception) -> str:
        """Returns the error's message, with names of keys in the file."""

    def saved(self, camera: Camera) -> tuple[str, bytes]:
        """Returns a file's name and contents."""


class SceneSource:
    def __init__(self, path: pathlib.Path) -> None:
        self.path = path.resolve()
        self._file: SceneFile | None = None

    def read(self) -> Shown:
        self._file = file = load_scene(self.path)
        return Shown(file.scene, file.camera, file.settings, file.display, [self.path, *file.files])

    def explained(self, error: Exception) -> str:
        if self._file and isinstance(error, Error):
            error = self._file.explained(error)
        return str(error).replace(f"{self.path.parent}/", "")

    def saved(self, camera: Camera) -> tuple[str, bytes]:
        with open(self.path, encoding="utf-8", opener=regular) as file:
            text = file.read()
        blank = STRING_OR_COMMENT.sub(lambda found: found[0] if found[0][0] == '"' else " " * len(found[0]), text)
        section = f'"camera": {json.dumps(camera._section())}'
        if found := re.search(r'"camera"\s*:\s*\{[^{}]*\}', blank):
            return self.path.name, (text[:found.start()] + section + text[found.end():]).encode()
        begin = blank.index("{") + 1
        comma = "" if blank[begin:].strip() == "}" else ","
        return self.path.name, f"{text[:begin]}\n  {section}{comma}{text[begin:]}".encode()


class FigureSource:
    def __init__(self, path: pathlib.Path, options: Options) -> None:
        self.path, self.options = path.resolve(), options
        self.staged: Staged | None = None

    def read(self) -> Shown:
        options = self.options
        self.staged = Staged.of(load(str(self.path), frame=options.frame, model_number=options.model_number, **options.reading), options)
        settings = RenderSettings(*self.staged.layout.size, max_path_length=options.max_path_length, seed=options.seed)
        display = Display("auto" if options.exposure is None else options.exposure)
        return Shown(self.staged.scene, self.staged.layout.camera, settings, display, [self.path])

    def explained(self, error: Exception) -> str:
        return str(error)

    def saved(self, camera: Camera) -> tuple[str, bytes]:
        assert self.staged
        packed = io.BytesIO()
        with tempfile.TemporaryDirectory() as folder, zipfile.ZipFile(packed, "w") as archive:
            write_scene(pathlib.Path(folder, f"{self.path.stem}.json"), self.staged.scene, camera, self.staged.layout.size,
                        self.options)
            for file in sorted(pathlib.Path(folder).iterdir()):
                archive.write(file, file.name)
        return f"{self.path.stem}.zip", packed.getvalue()


def source_of(path: pathlib.Path, options: Options) -> Source | Film:
    if path.suffix == ".ptfilm":
        return Film.load(path)
    return SceneSource(path) if path.suffix == ".json" else FigureSource(path, options)
