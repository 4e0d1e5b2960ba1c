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

FETCH_SECONDS = 60.0  # time limit for a film of up to 35 MB (1920x1080)
MOST_FETCHED = 16

_fetching = threading.BoundedSemaphore(MOST_FETCHED)

Done = Callable[[Any, "Outcome | None"], None]


@dataclass
class Try:
    number: int
    part: Part
    future: Any
    issued: float
    expected: float


@dataclass
class Member:
    address: str
    joined: float
    identity: Identity | None = None
    is_cpu: bool = False
    speed: Speed = field(default_factory=Speed)
    tries: dict[Any, Try] = field(default_factory=dict)
    introduction: Any = None
    failures: int = 0
    is_late: bool = False  # a late worker gets no part until it returns one
    is_banned: bool = False

    @property
    def busy_until(self) -> float:
        return max((each.issued + each.expected for each in self.tries.values()), default=0.0)

    @property
    def is_fit(self) -> bool:
        return self.identity is not None and not self.is_late and not self.is_banned

    def can_take(self, slots: int) -> bool:
        return self.is_fit and len(self.tries) < slots


def addresses(client: Any) -> set[str]:
    if client.status not in ("running", "connecting"):
        raise OSError("the connection to the scheduler has ended")
    return set(client.nthreads())


def submit(client: Any, address: str, done: Done, function: Callable[..., Any], *arguments: Any) -> Any:
    """Fetches the result directly from the worker. Calls `done` in another thread."""
    start = now()
    future = client.submit(function, *arguments, workers=[address], allow_other_workers=False, pure=False, retries=0)

    # Each result has a thread, because fetching from a stopped worker may never end.
    def fetch(ended: Any) -> None:
        threading.Thread(target=fetch_one, args=(ended, now() - start), daemon=True).start()

    def fetch_one(ended: Any, seconds: float) -> None:
        with _fetching:
            done(ended, _fetched(client, ended, seconds))

    future.add_done_callback(fetch)
    return future


async def _gathered(client: Any, future: Any) -> object:
    """Dask fetches only five results at a time, so a few stopped workers would block all without this limit."""
    results = await asyncio.wait_for(client.gather([future], direct=True, asynchronous=True), FETCH_SECONDS)
    return results[0]


def _fetched(client: Any, future: Any, seconds: float) -> Outcome | None:
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
        reason = f"{type(error).__name__}: {error}"
    return Outcome(error=reason, result=Result.ERROR_INTERNAL)


def now() -> float:
    return time.monotonic()
