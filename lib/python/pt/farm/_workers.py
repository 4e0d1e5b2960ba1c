"""The workers of a Dask cluster, as a coordinator sees them."""

from __future__ import annotations

import asyncio
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from pt.farm._part import Part
from pt.farm._speed import Speed
from pt.farm._task import Outcome, Worker

FETCH_SECONDS = 60.0  # for a film, which is 35 MB where it has all of 1920x1080
MOST_FETCHED = 16  # results that are on their way or wait: more would only fill the memory

_fetching = threading.BoundedSemaphore(MOST_FETCHED)

Done = Callable[[Any, "Outcome | None", str], None]  # future, outcome or None, why there is none


@dataclass
class Try:
    """A part that a worker has been given."""

    number: int  # of the part; a duplicate has the same
    part: Part
    future: Any
    issued: float
    expected: float  # seconds, with what the worker had to do before


@dataclass
class Member:
    """A worker that has joined."""

    address: str
    joined: float
    facts: Worker | None = None  # once it is ready
    speed: Speed = field(default_factory=Speed)
    tries: dict[Any, Try] = field(default_factory=dict)  # by key of the future
    introduction: Any = None
    failures: int = 0  # one after the other
    is_late: bool = False  # it gets nothing until it has given something back
    is_banned: bool = False

    @property
    def busy_until(self) -> float:
        """As its speed lets expect."""
        return max((each.issued + each.expected for each in self.tries.values()), default=0.0)

    def can_take(self, slots: int) -> bool:
        return self.facts is not None and not self.is_late and not self.is_banned and len(self.tries) < slots


def addresses(client: Any) -> set[str]:
    """Of all workers, without what else the scheduler knows of each. OSError: the scheduler has gone."""
    if client.status not in ("running", "connecting"):
        raise OSError("the connection to the scheduler has ended")
    return set(client.nthreads())


def submit(client: Any, address: str, done: Done, function: Callable[..., Any], *arguments: Any) -> Any:
    """Runs a function on one worker alone, whose result comes from the worker itself. done is called by threads."""
    future = client.submit(function, *arguments, workers=[address], allow_other_workers=False, pure=False, retries=0)

    # A thread for each that has ended, as a worker may have been stopped since, so that fetching takes for ever.
    def fetch(ended: Any) -> None:
        threading.Thread(target=_fetch, args=(client, ended, done), daemon=True).start()

    future.add_done_callback(fetch)
    return future


async def _gathered(client: Any, future: Any) -> Outcome:
    """Dask fetches five at a time, so that some stopped workers would hold up all others for ever."""
    results = await asyncio.wait_for(client.gather([future], direct=True, asynchronous=True), FETCH_SECONDS)
    return results[0]  # type: ignore[no-any-return]


def _fetch(client: Any, future: Any, done: Done) -> None:
    with _fetching:
        done(future, *_fetched(client, future))


def _fetched(client: Any, future: Any) -> tuple[Outcome | None, str]:
    outcome, reason = None, "its worker died"
    try:
        if future.status == "finished":
            outcome = client.sync(_gathered, client, future)
        elif future.status == "error":  # before the function was entered: it could not be unpickled
            error = future.exception(timeout=10)
            reason = f"{type(error).__name__}: {error}"
    except (Exception, asyncio.CancelledError) as error:  # the worker has gone, in one of many ways
        reason = f"its film could not be fetched: {type(error).__name__}: {error}"
    return outcome, reason


def now() -> float:
    return time.monotonic()
