"""Reads scene files by the program `pt`, which alone interprets them."""

from __future__ import annotations

import contextlib
import json
import os
import pathlib
import shutil
import struct
import subprocess
import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
import numpy.typing as npt

from pt._camera import Camera, RenderSettings
from pt._columns import Array
from pt._command_line import FILES, LOST, NO_DEVICE, SCENE, USAGE
from pt._enums import ColumnType, DeviceKind, Estimator, Projection, Result, Sampler
from pt._errors import ERROR_OF_RESULT, InternalError, NoDeviceError
from pt._scene import Material, Plane, Scene, Sphere, SphereArray

RESULT_OF_CODE = {USAGE: Result.ERROR_INVALID_ARGUMENT, SCENE: Result.ERROR_INVALID_SCENE,
                  NO_DEVICE: Result.ERROR_NO_DEVICE, LOST: Result.ERROR_DEVICE_LOST}
TYPES: Final = {ColumnType.FLOAT32: np.float32, ColumnType.FLOAT64: np.float64, ColumnType.UINT32: np.uint32,
                ColumnType.SRGB8: np.uint8}


@dataclass(frozen=True)
class ReadScene:
    scene: Scene
    camera: Camera
    settings: RenderSettings
    files: Sequence[str]


class Program:
    """Reads and renders a scene by `pt render --parts` (cli/render/render_command.h).

    files     contents of files to write into the working folder, by relative name
    facts     pt's statement about the job, made before it opens a device
    is_cpu    valid after the first film

    Raises Error if pt refuses the scene or is not installed, OSError if a file cannot be read."""

    def __init__(self, arguments: Sequence[str], files: Mapping[str, bytes] | None = None, device: str | None = None) -> None:
        self.is_cpu = False
        command = [program(), "render", *arguments, *(("--device", device) if device else ()), "--parts", "-q"]
        self._errors = tempfile.TemporaryFile()
        self._folder = tempfile.mkdtemp(prefix="pt-")
        try:
            for name, data in (files or {}).items():
                place = pathlib.Path(self._folder, name)
                place.parent.mkdir(parents=True, exist_ok=True)
                place.write_bytes(data)
            try:
                self._process = subprocess.Popen(command, cwd=self._folder, stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                                 stderr=self._errors)
            except OSError as error:
                self._errors.close()
                raise NoDeviceError(f"the program pt is not found (PT_PROGRAM names it): {error}") from error
            line = self._line()
        finally:
            shutil.rmtree(self._folder, ignore_errors=True)
        self.facts: dict[str, Any] = json.loads(line)

    def film(self, first: int, end: int, tiles: npt.ArrayLike) -> bytes:
        indices = np.ascontiguousarray(tiles, np.uint32)
        self._ask(struct.pack("=3I", first, end, len(indices)) + indices.tobytes())
        kind, size = map(int, self._line().split())
        self.is_cpu = kind == DeviceKind.CPU
        return self._bytes(size)

    def scene(self) -> ReadScene:
        self._ask(struct.pack("=3I", 0, 0, 0))
        read = json.loads(self._line())
        materials = [Material(**each) for each in read["materials"]]
        camera, render = read["camera"], read["render"]
        is_parallel = camera.pop("projection") == Projection.ORTHOGRAPHIC
        for name in ("vertical_fov", "vertical_extent"):
            camera[name] = camera[name] or None
        if is_parallel:
            camera["vertical_fov"] = None
        camera["up"] = camera["up"] if any(camera["up"]) else (0, 1, 0)
        render.update(sampler=Sampler(render["sampler"]), estimator=Estimator(render["estimator"]))
        arrays = [SphereArray(**{name: self._column(name, *each) for name, each in columns.items()})
                  for columns in map(_sized, read["sphere_arrays"])]
        scene = Scene([Sphere(**each) for each in read["spheres"]], [Plane(**each) for each in read["planes"]], arrays,
                      materials=materials)
        return ReadScene(scene, Camera(**camera), RenderSettings(**render), read["files"])

    def _column(self, name: str, kind: int, rows: int, count: int) -> Array:
        length = 1 if name in ("radius", "material", "opacity") else 3
        dtype = np.dtype(TYPES[ColumnType(kind)])
        column = np.frombuffer(self._bytes(rows * length * dtype.itemsize), dtype)
        shaped = column if length == 1 else column.reshape(rows, length)
        return np.broadcast_to(shaped, (count, *shaped.shape[1:]))

    def close(self) -> None:
        self._process.kill()
        self._process.wait()
        with contextlib.suppress(OSError):
            os.rmdir(self._folder)
        for stream in (self._process.stdin, self._process.stdout, self._errors):
            with contextlib.suppress(OSError):
                if stream:
                    stream.close()

    def _ask(self, request: bytes) -> None:
        assert self._process.stdin
        try:
            self._process.stdin.write(request)
            self._process.stdin.flush()
        except OSError:
            pass  # pt has ended with a message.

    def _line(self) -> bytes:
        assert self._process.stdout
        line: bytes = self._process.stdout.readline()
        if not line.endswith(b"\n"):
            self._fail()
        return line

    def _bytes(self, size: int) -> bytes:
        assert self._process.stdout
        data: bytes = self._process.stdout.read(size)
        if len(data) < size:
            self._fail()
        return data

    def _fail(self) -> None:
        code = self._process.wait()
        self._errors.seek(0)
        said = self._errors.read()[-4000:].decode(errors="replace").strip().removeprefix("pt: ")
        self.close()
        if code == FILES:
            raise OSError(said)
        error = ERROR_OF_RESULT[RESULT_OF_CODE[code]] if code in RESULT_OF_CODE else InternalError
        raise error(said or f"{program()} ended with code {code}")


def _sized(columns: dict[str, list[int]]) -> dict[str, tuple[int, int, int]]:
    count = max(rows for _, rows in columns.values())
    return {name: (kind, rows, count) for name, (kind, rows) in columns.items()}


def program() -> str:
    """Returns PT_PROGRAM, else the installed package's program, else pt from the PATH."""
    packaged = pathlib.Path(__file__).with_name("bin") / "pt"
    named = os.environ.get("PT_PROGRAM") or (str(packaged) if packaged.exists() else "pt")
    return os.path.abspath(named) if os.sep in named else named
