"""Renders parts of a job on a worker's machine."""

from __future__ import annotations

import json
import os
import pathlib
import struct
import subprocess
import tempfile
from dataclasses import replace
from typing import Any, Protocol

import numpy as np

from pt._command_line import FILES, LOST, NO_DEVICE, SCENE, USAGE
from pt._context import Context
from pt._enums import DeviceKind, Result
from pt._errors import ERROR_OF_RESULT, InternalError, NoDeviceError
from pt.farm._job import AnyJob, FileJob, Job
from pt.farm._part import Part, grid_shape

RESULT_OF_CODE = {USAGE: Result.ERROR_INVALID_ARGUMENT, SCENE: Result.ERROR_INVALID_SCENE,
                  NO_DEVICE: Result.ERROR_NO_DEVICE, LOST: Result.ERROR_DEVICE_LOST}


class Renderer(Protocol):
    is_cpu: bool  # whether the device is a CPU; known after the first film

    def film(self, part: Part) -> bytes:
        """The film of a part, as bytes. Error: it could not be rendered."""

    def close(self) -> None:
        """Frees the device."""


def renderer_of(job: AnyJob) -> Renderer:
    if isinstance(job, FileJob):
        return Program(job)
    return Library(job)


def device_of(job: AnyJob) -> str | None:
    return job.device or os.environ.get("PT_DEVICE") or None


class Library:
    """Renders by a context in this process."""

    def __init__(self, job: Job) -> None:
        self._settings = job.settings
        self._context = Context(device_of(job))
        self._context.set_scene(job.scene)
        self._context.set_camera(job.camera)
        self._context.set_render(job.settings)
        self._context.prepare()
        self.is_cpu = self._context.device.kind == DeviceKind.CPU

    def film(self, part: Part) -> bytes:
        self._context.set_render(replace(self._settings, first_sample=part.first))
        counts = np.zeros(grid_shape(self._settings.width, self._settings.height), np.uint32)
        counts.ravel()[part.tiles] = part.end - part.first
        self._context.accumulate_tiles(counts)
        return self._context.film().to_bytes()

    def close(self) -> None:
        self._context.close()


class Program:
    """Renders by `pt render --parts`; cli/render/render_command.h describes its requests and answers.

    facts: what pt says of the job before it looks for a device."""

    def __init__(self, job: FileJob) -> None:
        self.is_cpu = False
        device = device_of(job)
        command = [program(), "render", *job.arguments, *(("--device", device) if device else ()), "--parts", "-q"]
        self._errors = tempfile.TemporaryFile()
        with tempfile.TemporaryDirectory(prefix="pt-farm-") as folder:  # until pt has read what is in it
            for name, data in job.files.items():
                place = pathlib.Path(folder, name)
                place.parent.mkdir(parents=True, exist_ok=True)
                place.write_bytes(data)
            try:
                self._process = subprocess.Popen(command, cwd=folder, stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                                 stderr=self._errors)
            except OSError as error:
                raise NoDeviceError(f"the program pt is not found (PT_PROGRAM names it): {error}") from error
            line = self._line()
        self.facts: dict[str, Any] = json.loads(line)

    def film(self, part: Part) -> bytes:
        assert self._process.stdin and self._process.stdout
        tiles = np.ascontiguousarray(part.tiles, np.uint32)
        try:
            self._process.stdin.write(struct.pack("=3I", part.first, part.end, len(tiles)) + tiles.tobytes())
            self._process.stdin.flush()
        except OSError:
            pass  # pt has ended, and has said why
        kind, size = map(int, self._line().split())
        self.is_cpu = kind == DeviceKind.CPU
        data = self._process.stdout.read(size)
        if len(data) < size:
            self._fail()
        return data

    def close(self) -> None:
        self._process.kill()
        self._process.communicate()
        self._errors.close()

    def _line(self) -> bytes:
        assert self._process.stdout
        line: bytes = self._process.stdout.readline()
        if not line.endswith(b"\n"):
            self._fail()
        return line

    def _fail(self) -> None:
        code = self._process.wait()
        self._errors.seek(0)
        said = self._errors.read()[-4000:].decode(errors="replace").strip().removeprefix("pt: ")
        if code == FILES:
            raise OSError(said)
        error = ERROR_OF_RESULT[RESULT_OF_CODE[code]] if code in RESULT_OF_CODE else InternalError
        raise error(said or f"{program()} ended with code {code}")


def program() -> str:
    """The path of this machine's program pt."""
    return os.environ.get("PT_PROGRAM") or "pt"
