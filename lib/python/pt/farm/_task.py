from __future__ import annotations

import os
import socket
import threading
import time
import zlib
from dataclasses import dataclass

import numpy as np

from pt import _zstd
from pt._enums import Result
from pt._errors import BrokenRule, Error, IncompatibleError, InvalidArgumentError, InvalidSceneError
from pt.farm._job import Job, name_of, unpacked
from pt.farm._part import Part
from pt.farm._renderer import Renderer

CLOCKS = 1.01  # largest assumed ratio of the clock rates of two machines
PERMANENT = (InvalidSceneError, InvalidArgumentError, IncompatibleError)


@dataclass(frozen=True)
class Outcome:
    data: bytes = b""
    seconds: float = 0.0
    is_cpu: bool = False
    error: str = ""
    may_help_elsewhere: bool = True
    result: int = Result.OK
    broken_rules: tuple[BrokenRule, ...] = ()


def fault_of(value: object, seconds: float) -> str:
    """Returns "" for a good value; a worker may send anything. `seconds` is the time since submission."""
    if not isinstance(value, Outcome):
        return f"a value of type {type(value).__name__}"
    for name, kind in (("data", bytes), ("seconds", float), ("is_cpu", bool), ("error", str),
                       ("may_help_elsewhere", bool), ("result", int), ("broken_rules", tuple)):
        if not isinstance(getattr(value, name, None), kind):
            return f"{name} of type {type(getattr(value, name, None)).__name__}"
    if not 0.0 <= value.seconds <= CLOCKS * seconds:
        return f"seconds = {value.seconds}: must be from 0 to {seconds:.3g}, the time since the request"
    if not all(isinstance(rule, BrokenRule) for rule in value.broken_rules):
        return "broken_rules of another type"
    return "" if value.result in set(Result) else f"result = {value.result}"


def first_part(job: Job) -> Part:
    first = job.settings.first_sample
    return Part(first, first + 1, np.zeros(1, np.uint32))


@dataclass
class _Ready:
    name: str
    job: Job
    renderer: Renderer
    has_failed: bool = False


_lock = threading.Lock()  # all threads of a worker share one renderer
_ready: _Ready | None = None


def _failed(error: Exception) -> Outcome:
    return Outcome(error=f"{socket.gethostname()}, process {os.getpid()}: {type(error).__name__}: {error}",
                   may_help_elsewhere=not isinstance(error, PERMANENT),
                   result=error.result if isinstance(error, Error) else Result.ERROR_INTERNAL,
                   broken_rules=error.broken_rules if isinstance(error, Error) else ())


def introduce(data: bytes, codecs: frozenset[str]) -> Outcome:
    global _ready
    with _lock:
        try:
            if _ready is None or _ready.name != name_of(data):
                if _ready is not None:
                    _ready.renderer.close()
                    _ready = None
                job = unpacked(data)
                _ready = _Ready(name_of(data), job, Renderer(job))
        except Exception as error:
            return _failed(error)
    return render_part(_ready.name, first_part(_ready.job), codecs)


def render_part(name: str, part: Part, codecs: frozenset[str]) -> Outcome:
    with _lock:
        try:
            if _ready is None or _ready.name != name:
                raise RuntimeError("this worker has another job")
            if _ready.has_failed:  # a lost device needs a new context or process
                _ready.renderer.close()
                _ready.renderer, _ready.has_failed = Renderer(_ready.job), False
            start = time.monotonic()
            data = pack(_ready.renderer.film(part), codecs)
            return Outcome(data, time.monotonic() - start, _ready.renderer.is_cpu)
        except Exception as error:
            if _ready is not None:
                _ready.has_failed = True
            return _failed(error)


def codecs() -> frozenset[str]:
    return frozenset({"zstd"} if _zstd.module() else ())


def pack(data: bytes, theirs: frozenset[str]) -> bytes:
    module = _zstd.module() if "zstd" in theirs else None
    return bytes(module.compress(data)) if module else zlib.compress(data, 1)


def unpack(data: bytes) -> bytes:
    try:
        return bytes(_zstd.module().decompress(data)) if data.startswith(_zstd.MAGIC) else zlib.decompress(data)
    except Exception as error:
        raise ValueError(f"a part's bytes are damaged: {error}") from error
