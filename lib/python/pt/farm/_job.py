"""What is rendered: all that a worker has to know, besides which part is its own."""

from __future__ import annotations

import base64
import hashlib
import pickle
import zlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt

from pt._camera import Camera, RenderSettings
from pt._enums import Estimator, Sampler
from pt._scene import Material, Plane, Scene, Sphere, SphereArray


@dataclass(frozen=True)
class Job:
    """A picture.

    settings      all rows; first_sample is the first of the samples that are taken
    device        what each worker renders on, as of pt.Context; None: what its variable PT_DEVICE says, else its best
    environment   variables that the driver is to see: those of Mesa that change bits
    """

    scene: Scene
    camera: Camera
    settings: RenderSettings
    device: str | None = None
    environment: Mapping[str, str] = field(default_factory=dict)

    def packed(self) -> bytes:
        return zlib.compress(pickle.dumps(self, protocol=5), 1)


def name_of(packed: bytes) -> str:
    """By which workers know a job again."""
    return hashlib.sha256(packed).hexdigest()[:32]


def _column(text: str, kind: type[np.generic]) -> npt.NDArray[Any]:
    return np.frombuffer(base64.b64decode(text), kind)


def _array(columns: Mapping[str, Any]) -> SphereArray:
    """Of the particles of a file."""
    radius, color = _column(columns["radius"], np.float32), columns["color"]
    return SphereArray(_column(columns["center"], np.float64).reshape(-1, 3),
                       radius if len(radius) != 1 else float(radius[0]), columns["material"],
                       color=_column(color, np.uint8).reshape(-1, 3) if isinstance(color, str)
                       else np.array(color, np.float32))


def _colored(rows: Sequence[Sequence[float]]) -> SphereArray | None:
    """Of spheres with colours of their own: an array as in the program, so that the order of all stays."""
    if not rows or len(rows[0]) == 8:
        return None
    table = np.array(rows, np.float64)
    return SphereArray(table[:, 0:3], table[:, 3], table[:, 7].astype(np.uint32), motion=table[:, 4:7],
                       color=table[:, 8:11].astype(np.float32))


def job_of(description: Mapping[str, Any], device: str | None) -> Job:
    """Of what `pt render --describe` says."""
    camera, render = description["camera"], description["render"]
    materials = [Material(tuple(m[0:3]), tuple(m[3:6]), tuple(m[6:9]), m[9], m[10]) for m in description["materials"]]
    rows = description["spheres"]
    colored = [array for array in (_colored(rows),) if array]
    spheres = [] if colored else [Sphere(tuple(s[0:3]), s[3], s[7], tuple(s[4:7])) for s in rows]
    arrays = colored + [_array(columns) for columns in description["sphere_arrays"]]
    planes = [Plane(tuple(p[0:3]), p[3], p[4]) for p in description["planes"]]
    numbers: dict[str, Any] = {**render, "estimator": Estimator(render["estimator"]),
                               "sampler": Sampler(render["sampler"])}
    shutter_open, shutter_close = camera["shutter"]
    view = Camera(tuple(camera["position"]), tuple(camera["target"]), tuple(camera["up"]), camera["vertical_fov"],
                  (shutter_open, shutter_close), camera["vertical_extent"])
    return Job(Scene(spheres, planes, arrays, materials=materials), view, RenderSettings(**numbers), device,
               description["environment"])
