from __future__ import annotations

import os
from dataclasses import replace

import numpy as np

from pt._context import Context
from pt._enums import DeviceKind
from pt.farm._job import Job
from pt.farm._part import Part, grid_shape


def device_of(job: Job) -> str | None:
    return job.device or os.environ.get("PT_DEVICE") or None


class Renderer:
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
