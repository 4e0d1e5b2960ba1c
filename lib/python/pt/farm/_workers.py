"""The workers of a Dask cluster, as a coordinator sees them."""

from __future__ import annotations

import asyncio
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from pt._enums import Result
from pt.farm._identity import Identity
from pt.farm._part import Part
from pt.farm._speed import Speed
from pt.farm._task import Outcome, fault_of

FETCH_SECONDS = 60.0  # for a film, of 35 MB if it has all of 1920x1080
MOST_FETCHED = 16  # results that are on their way or waiting: more would only fill the memory

_fetching = threading.BoundedSemaphore(MOST_FETCHED)

Done = Callable[[Any, "Outcome | None"], None]  # future, and its outcome; None: its worker died


@dataclass
class Try:
    """A part that a worker has been given."""

    number: int  # the part's; a duplicate has the same
    part: Part
    future: Any
    issued: float
    expected: float  # seconds, including the worker's earlier tries


@dataclass
class Member:
    """A worker that has joined."""

    address: str
    joined: float
    identity: Identity | None = None  # the identity of its films, once it is ready
    is_cpu: bool = False
    speed: Speed = field(default_factory=Speed)
    tries: dict[Any, Try] = field(default_factory=dict)  # by key of the future
    introduction: Any = None
    failures: int = 0  # in a row
    is_late: bool = False  # it gets nothing until it has given something back
    is_banned: bool = False

    @property
    def busy_until(self) -> float:
        """The time until which the worker should be busy, by its speed."""
        return max((each.issued + each.expected for each in self.tries.values()), default=0.0)

    @property
    def is_fit(self) -> bool:
        return self.identity is not None and not self.is_late and not self.is_banned

    def can_take(self, slots: int) -> bool:
        return self.is_fit and len(self.tries) < slots


def addresses(client: Any) -> set[str]:
    """The addresses of all workers, without what else the scheduler knows of each. OSError: the scheduler is gone."""
    if client.status not in ("running", "connecting"):
        raise OSError("the connection to the scheduler has ended")
    return set(client.nthreads())


def submit(client: Any, address: str, done: Done, function: Callable[..., Any], *arguments: Any) -> Any:
    """Runs a function on one particular worker and fetches the result from the worker itself. done is called by
    threads."""
    start = now()
    future = client.submit(function, *arguments, workers=[address], allow_other_workers=False, pure=False, retries=0)

    # A thread for each result: its worker may have been stopped since, so that fetching it would take for ever.
    def fetch(ended: Any) -> None:
        threading.Thread(target=fetch_one, args=(ended, now() - start), daemon=True).start()

    def fetch_one(ended: Any, seconds: float) -> None:
        with _fetching:
            done(ended, _fetched(client, ended, seconds))

    future.add_done_callback(fetch)
    return future


async def _gathered(client: Any, future: Any) -> object:
    """Dask fetches five at a time, so that some stopped workers would hold up all others for ever."""
    results = await asyncio.wait_for(client.gather([future], direct=True, asynchronous=True), FETCH_SECONDS)
    return results[0]


def _fetched(client: Any, future: Any, seconds: float) -> Outcome | None:
    """The outcome of a task. Whatever a living worker did wrong becomes an outcome that counts against it."""
    if future.status not in ("finished", "error"):
        return None
    try:
        value = client.sync(_gathered, client, future)
        fault = fault_of(value, seconds)
        if not fault:
            return value  # type: ignore[no-any-return]
        reason = f"it has returned {fault}"
    except (Exception, asyncio.CancelledError) as error:
        if type(error).__name__ == "KilledWorker":
            return None
        reason = f"{type(error).__name__}: {error}"  # raised by the task, or on the way here
    return Outcome(error=reason, result=Result.ERROR_INTERNAL)


def now() -> float:
    return time.monotonic()
