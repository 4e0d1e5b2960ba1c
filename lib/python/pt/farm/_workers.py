"""The workers of a Dask cluster, as a coordinator sees them."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from pt.farm._part import Part
from pt.farm._speed import Speed
from pt.farm._task import Worker

MOST_FAILURES = 3  # one after the other, until a worker gets nothing more


@dataclass
class Try:
    """A part that a worker has been given."""

    number: int  # of the part; a duplicate has the same
    part: Part
    address: str
    future: Any
    issued: float
    expected: float  # seconds, with what the worker had to do before


@dataclass
class Member:
    """A worker that has joined."""

    address: str
    facts: Worker | None = None  # once it is ready
    speed: Speed = field(default_factory=Speed)
    tries: dict[Any, Try] = field(default_factory=dict)  # by key of the future
    introduction: Any = None
    failures: int = 0
    is_late: bool = False  # it gets nothing until it has given something back
    is_banned: bool = False

    def can_take(self, slots: int) -> bool:
        return self.facts is not None and not self.is_late and not self.is_banned and len(self.tries) < slots


def addresses(client: Any) -> set[str]:
    """Of all workers. Newer versions of Dask tell of five unless they are asked for all."""
    try:
        info = client.scheduler_info(n_workers=-1)
    except TypeError:
        info = client.scheduler_info()
    return set(info["workers"])


def submit(client: Any, address: str, done: Callable[[Any], None], function: Callable[..., Any], *arguments: Any) -> Any:
    """Runs a function on one worker alone, whose result stays there until it is fetched."""
    future = client.submit(function, *arguments, workers=[address], allow_other_workers=False, pure=False, retries=0)
    future.add_done_callback(done)
    return future


def now() -> float:
    return time.monotonic()
