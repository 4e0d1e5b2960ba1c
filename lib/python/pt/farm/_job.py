"""What is rendered: all that a worker has to know, besides which part is its own."""

from __future__ import annotations

import hashlib
import pickle
import zlib
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from pt._camera import Camera, RenderSettings
from pt._enums import Estimator, Sampler
from pt._scene import Material, Plane, Scene, Sphere


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


def job_of(description: Mapping[str, Any], device: str | None) -> Job:
    """Of what `pt render --describe` says."""
    camera, render = description["camera"], description["render"]
    materials = [Material(tuple(m[0:3]), tuple(m[3:6]), tuple(m[6:9]), m[9]) for m in description["materials"]]
    spheres = [Sphere(tuple(s[0:3]), s[3], s[7], tuple(s[4:7])) for s in description["spheres"]]
    planes = [Plane(tuple(p[0:3]), p[3], p[4]) for p in description["planes"]]
    numbers: dict[str, Any] = {**render, "estimator": Estimator(render["estimator"]),
                               "sampler": Sampler(render["sampler"])}
    shutter_open, shutter_close = camera["shutter"]
    view = Camera(tuple(camera["position"]), tuple(camera["target"]), tuple(camera["up"]), camera["vertical_fov"],
                  (shutter_open, shutter_close), camera["vertical_extent"])
    return Job(Scene(spheres, planes, materials=materials), view, RenderSettings(**numbers), device,
               description["environment"])
