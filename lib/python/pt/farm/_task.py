"""What runs on workers."""

from __future__ import annotations

import os
import pathlib
import pickle
import socket
import threading
import time
import zlib
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from pt._context import Context
from pt._enums import DeviceKind, Result
from pt._errors import Error, IncompatibleError, InvalidArgumentError, InvalidSceneError
from pt._library import library, version_text
from pt.farm import _packing
from pt.farm._identity import Identity, identity_of
from pt.farm._job import Job, name_of
from pt.farm._part import Part, grid_shape

PERMANENT = (InvalidSceneError, InvalidArgumentError, IncompatibleError, ImportError, TypeError)


@dataclass(frozen=True)
class Worker:
    """What a worker says of itself."""

    host: str
    process: int
    identity: Identity  # of its films
    is_cpu: bool
    version: str  # of the library


@dataclass(frozen=True)
class Outcome:
    """What a task came to: its film, packed, or an error. Errors are values: one that is raised is blamed on workers by
    Dask in ways of its own."""

    data: bytes = b""
    worker: Worker | None = None
    seconds: float = 0.0
    error: str = ""
    may_help_elsewhere: bool = False
    result: int = Result.OK  # of an error, that of the library


@dataclass
class _Ready:
    name: str
    job: Job
    context: Context
    facts: Worker
    has_failed: bool = False


_lock = threading.Lock()  # one context, one call at a time, however many threads a worker has
_ready: _Ready | None = None
_environment: Mapping[str, str] | None = None  # with which this process has loaded the driver


def _failed(error: Exception) -> Outcome:
    return Outcome(error=f"{socket.gethostname()}, process {os.getpid()}: {type(error).__name__}: {error}",
                   may_help_elsewhere=not isinstance(error, PERMANENT),
                   result=error.result if isinstance(error, Error) else Result.ERROR_INTERNAL)


def _set_environment(variables: Mapping[str, str]) -> None:
    """Drivers read theirs once."""
    global _environment
    if _environment is not None and dict(variables) != dict(_environment):
        raise RuntimeError(f"the driver of this process has been loaded with {dict(_environment)}, and cannot be with "
                           f"{dict(variables)}: start workers anew")
    _environment = dict(variables)
    os.environ.update(variables)
    folder = variables.get("MESA_SHADER_CACHE_DIR")
    if folder:
        try:
            pathlib.Path(folder).mkdir(parents=True, exist_ok=True)
        except OSError:
            pass  # Mesa goes without a cache


def introduce(packed: bytes) -> Outcome:
    """Makes a worker ready for a job, in place of the one before, and says what it is."""
    global _ready
    with _lock:
        try:
            if _ready is not None and _ready.name == name_of(packed) and not _ready.has_failed:
                return Outcome(worker=_ready.facts)
            job: Job = pickle.loads(zlib.decompress(packed))
            if _ready is not None:
                _ready.context.close()
                _ready = None
            _set_environment(job.environment)
            context = Context(job.device or os.environ.get("PT_DEVICE"))
            context.set_scene(job.scene)
            context.set_camera(job.camera)
            context.set_render(job.settings)
            context.prepare()
            first = job.settings.first_sample
            identity = identity_of(_film_of(context, job, Part(first, first + 1, np.zeros(1, np.uint32))))
            facts = Worker(socket.gethostname(), os.getpid(), identity, context.device.kind == DeviceKind.CPU,
                           version_text(library()))
            _ready = _Ready(name_of(packed), job, context, facts)
            return Outcome(worker=facts)
        except Exception as error:
            return _failed(error)


def _film_of(context: Context, job: Job, part: Part) -> bytes:
    settings = job.settings
    context.set_render(replace(settings, first_sample=part.first))
    counts = np.zeros(grid_shape(settings.width, settings.height), np.uint32)
    counts.ravel()[part.tiles] = part.end - part.first
    context.accumulate_tiles(counts)
    return context.film().to_bytes()


def render_part(name: str, part: Part, codecs: frozenset[str]) -> Outcome:
    """The film of a part. codecs: of the coordinator."""
    with _lock:
        try:
            if _ready is None or _ready.name != name:
                raise RuntimeError("this worker has another job")
            start = time.monotonic()
            data = _packing.pack(_film_of(_ready.context, _ready.job, part), codecs)
            return Outcome(data=data, seconds=time.monotonic() - start)
        except Exception as error:
            if _ready is not None:
                _ready.has_failed = True  # it begins anew with the next introduction
            return _failed(error)
