from __future__ import annotations

import functools
import hashlib
import json
import os
import pathlib
import pickle
import re
import sys
import zlib
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TypeAlias

from pt._camera import Camera, RenderSettings
from pt._files import regular
from pt._scene import Scene


@dataclass(frozen=True)
class Job:
    """A picture of Python objects, rendered by the library on each worker.

    settings   all rows; first_sample is the first sample of the picture
    device     device of each worker, as in pt.Context; None: PT_DEVICE in its environment, else the best
    """

    scene: Scene
    camera: Camera
    settings: RenderSettings
    device: str | None = None


@dataclass(frozen=True)
class FileJob:
    """A picture of a scene file, rendered by the program pt on each worker.

    arguments   arguments of `pt render`, the scene first
    files       contents of the scene and its files, by name relative to the worker's folder
    """

    arguments: tuple[str, ...]
    files: Mapping[str, bytes]
    settings: RenderSettings = RenderSettings(1, 1)
    device: str | None = None


AnyJob: TypeAlias = "Job | FileJob"


def packed(job: AnyJob) -> bytes:
    return zlib.compress(pickle.dumps(job, protocol=5), 1)


def unpacked(data: bytes) -> AnyJob:
    job: AnyJob = pickle.loads(zlib.decompress(data))
    return job


def name_of(data: bytes) -> str:
    return hashlib.sha256(data).hexdigest()[:32]


def read_job(scene: str, options: list[str], device: str | None) -> FileJob:
    """Packs all files whose names are strings in the scene or in --set. Renames files outside the scene's folder. The
    scene "-" is standard input. Raises OSError for an unreadable file."""
    place = pathlib.Path("stdin.json" if scene == "-" else scene)
    with sys.stdin.buffer if scene == "-" else open(place, "rb", opener=regular) as file:
        text = file.read()
    files: dict[str, bytes] = {}

    @functools.cache
    def shipped(name: str) -> str:
        path = place.parent / name
        if not os.path.isfile(path):
            return name
        is_inside = not os.path.isabs(name) and ".." not in pathlib.Path(name).parts
        new = name if is_inside else f"outside-{hashlib.sha256(name.encode()).hexdigest()[:16]}{path.suffix}"
        files[new] = path.read_bytes()
        return new

    def literal(found: re.Match[bytes]) -> bytes:
        try:
            name = json.loads(found.group())
        except ValueError:
            return found.group()
        new = shipped(name)
        return found.group() if new == name else json.dumps(new).encode()

    def option(word: str) -> str:
        value = word.rpartition("=")[2].strip('"')
        return word.replace(value, shipped(value)) if "=" in word and value else word

    text = re.sub(rb'"(?:[^"\\\n]|\\.)+"', literal, text)
    arguments = (place.name, *map(option, options))
    return FileJob(arguments, {**files, place.name: text}, device=device)
