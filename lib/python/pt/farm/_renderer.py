from __future__ import annotations

import os
from dataclasses import replace
from typing import Protocol

import numpy as np

from pt._context import Context
from pt._enums import DeviceKind
from pt._program import Program
from pt.farm._job import AnyJob, FileJob, Job
from pt.farm._part import Part, grid_shape


class Renderer(Protocol):
    @property
    def is_cpu(self) -> bool:
        """Valid after the first film."""

    def film(self, part: Part) -> bytes:
        """Raises Error if the part cannot be rendered."""

    def close(self) -> None:
        """Frees the device."""


def renderer_of(job: AnyJob) -> Renderer:
    if isinstance(job, FileJob):
        return File(job)
    return Library(job)


def device_of(job: AnyJob) -> str | None:
    return job.device or os.environ.get("PT_DEVICE") or None


class Library:
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


class File:
    def __init__(self, job: FileJob) -> None:
        self._program = Program(job.arguments, job.files, device_of(job))

    @property
    def is_cpu(self) -> bool:
        return self._program.is_cpu

    def film(self, part: Part) -> bytes:
        return self._program.film(part.first, part.end, part.tiles)

    def close(self) -> None:
        self._program.close()
