from __future__ import annotations

import hashlib
import pickle
import zlib
from dataclasses import dataclass

from pt._camera import Camera, RenderSettings
from pt._scene import Scene


@dataclass(frozen=True)
class Job:
    """settings   of all rows
    device     device of each worker, as in pt.Context; None: PT_DEVICE in its environment, else the best
    """

    scene: Scene
    camera: Camera
    settings: RenderSettings
    device: str | None = None


def packed(job: Job) -> bytes:
    return zlib.compress(pickle.dumps(job, protocol=5), 1)


def unpacked(data: bytes) -> Job:
    job: Job = pickle.loads(zlib.decompress(data))
    return job


def name_of(data: bytes) -> str:
    return hashlib.sha256(data).hexdigest()[:32]
