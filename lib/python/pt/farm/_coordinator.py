"""Hands out parts, adds what comes back, and stops when the picture is done."""

from __future__ import annotations

import queue
import threading
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from pt._enums import Result as Outcome
from pt._enums import Sampling
from pt._errors import IncompatibleError
from pt._film import Film
from pt._files import Path
from pt._library import library
from pt._stats import Stats
from pt.farm import _packing, _task
from pt.farm._checkpoint import read_film, write_film
from pt.farm._job import Job, name_of
from pt.farm._part import Goals, Part, grid_shape, missing_parts
from pt.farm._progress import Progress
from pt.farm._workers import MOST_FAILURES, Member, Try, addresses, now, submit

TICK = 0.25  # seconds between looks at who is late
SLOTS = 2  # parts that a worker has at a time, so that it need not wait for the next
LEAST_TILES = {True: 64, False: 4096}  # that keep a CPU, and a GPU, busy
BATCH = 16  # parts that are added to each other before the film takes them, which looks at all of it


class FarmError(RuntimeError):
    """The picture cannot be made; with what workers said."""


@dataclass(frozen=True)
class Options:
    """How a farm works; the picture does not depend on it.

    part_seconds       how long a part should take
    patience           seconds beyond what is expected until a part is given to another worker too
    most_tries         times that a part may fail, or lose its worker, in all
    checkpoint         file, which is gone on from if it is there; None: none
    checkpoint_every   seconds
    wait_for_workers   seconds without any until that is an error
    """

    part_seconds: float = 5.0
    patience: float = 10.0
    most_tries: int = 5
    checkpoint: Path | None = None
    checkpoint_every: float = 30.0
    wait_for_workers: float = 300.0


@dataclass(frozen=True)
class Result:
    """film: the bytes of one long rendering. progress: the last."""

    film: Film
    progress: Progress


class _Coordinator:
    def __init__(self, client: Any, job: Job, options: Options, show: Callable[[Progress, Film | None], object]) -> None:
        self._client, self._job, self._options, self._show = client, job, options, show
        self._packed = job.packed()
        self._name = name_of(self._packed)
        self._events: queue.Queue[tuple[Any, Any]] = queue.Queue()
        self._members: dict[str, Member] = {}
        self._device: str | None = None
        self._waiting: deque[tuple[int | None, Part]] = deque()  # with its number, once it has been given out
        self._open: set[int] = set()  # numbers of parts that were given out and are not merged
        self._tries: dict[int, int] = {}  # that came to nothing, by number
        self._next_number = 0
        self._batch: list[bytes] = []
        self._film: Film | None = read_film(options.checkpoint) if options.checkpoint else None
        self._progress = Progress()
        self._start = self._checkpoint_time = self._worker_time = now()
        self._stopped = False

    # ---- the picture ----

    def run(self, goals: Goals) -> bool:
        """Until the film has these samples by tile; False if progress() asked to stop."""
        missing = missing_parts(self._film, self._job.settings.first_sample, goals)
        self._waiting.extend((None, part) for part in missing)
        self._progress.samples_wanted = float(goals.mean())
        while (self._waiting or self._open) and not self._stopped:
            self._look_after_workers()
            self._hand_out()
            self._take_in()
        self._merge_batch()
        return not self._stopped

    @property
    def film(self) -> Film:
        if self._film is None:
            raise FarmError("stopped before the first part came back")
        return self._film

    def finish(self, ended_by: str) -> Result:
        for member in self._members.values():
            for each in member.tries.values():
                each.future.cancel()
        self._progress.ended_by = ended_by
        self._keep()
        self._tell()
        return Result(self.film, self._progress)

    def _keep(self) -> None:
        self._checkpoint_time = now()
        if self._options.checkpoint and self._film is not None:
            write_film(self._film, self._options.checkpoint)

    def _merge_batch(self) -> None:
        if not self._batch:
            return
        sums = [Film(data) for data in self._batch]
        self._batch.clear()
        while len(sums) > 1:
            pairs = [sums[i:i + 2] for i in range(0, len(sums), 2)]
            sums = [pair[0] if len(pair) == 1 else _added(pair[0], pair[1]) for pair in pairs]
        try:
            self._film = sums[0] if self._film is None else _added(self._film, sums[0])
        except IncompatibleError as error:
            raise FarmError(f"a part does not belong to the film so far: {error}") from error
        if now() - self._checkpoint_time > self._options.checkpoint_every:
            self._keep()

    # ---- workers ----

    def _look_after_workers(self) -> None:
        there = addresses(self._client)
        for address in there - set(self._members):
            member = self._members[address] = Member(address)
            member.introduction = submit(self._client, address, self._fetch, _task.introduce, self._packed)
        for address in set(self._members) - there:
            for lost in self._members.pop(address).tries.values():
                self._progress.lost += 1
                self._again(lost, "its worker died")
        usable = [member for member in self._members.values() if not member.is_banned]
        self._progress.workers = sum(member.facts is not None for member in usable)
        if usable:
            self._worker_time = now()
        elif self._members:
            raise FarmError("every worker has failed: " + "; ".join(self._progress.messages[-4:]))
        elif now() - self._worker_time > self._options.wait_for_workers:
            raise FarmError("there is no worker")
        for member in self._members.values():
            for each in list(member.tries.values()):
                if self._is_late(each):
                    member.is_late = True
                    if each.number in self._open and self._tries_under_way(each.number) < 2:
                        self._waiting.appendleft((each.number, each.part))

    def _tries_under_way(self, number: int) -> int:
        waiting = sum(each == number for each, _ in self._waiting)
        return waiting + sum(each.number == number for m in self._members.values() for each in m.tries.values())

    def _is_late(self, each: Try) -> bool:
        return now() - each.issued > 3 * each.expected + self._options.patience

    def _again(self, each: Try, reason: str) -> None:
        """After a try that came to nothing."""
        if each.number not in self._open:
            return
        self._tries[each.number] = self._tries.get(each.number, 0) + 1
        if self._tries[each.number] >= self._options.most_tries:
            raise FarmError(f"a part came to nothing {self._options.most_tries} times, at last since {reason}")
        if self._tries_under_way(each.number) == 0:
            self._waiting.appendleft((each.number, each.part))

    def _hand_out(self) -> None:
        free = [member for member in self._members.values() if member.can_take(SLOTS)]
        remaining = sum(part.work for _, part in self._waiting)
        speeds = sum(member.speed.value for member in self._members.values() if member.facts) or 1.0
        for slot in range(SLOTS):
            for member in free:
                if not self._waiting or len(member.tries) > slot:
                    continue
                number, part = self._waiting.popleft()
                if number is None:
                    share = member.speed.share(self._options.part_seconds, remaining, speeds)
                    assert member.facts is not None
                    part, rest = part.split(share, LEAST_TILES[member.facts.is_cpu])
                    self._waiting.extendleft((None, each) for each in rest)
                    number, self._next_number = self._next_number, self._next_number + 1
                    self._open.add(number)
                    remaining -= part.work
                elif number not in self._open:
                    continue
                elif any(each.number == number for each in member.tries.values()):
                    self._waiting.appendleft((number, part))
                    continue
                self._give(member, number, part)

    def _give(self, member: Member, number: int, part: Part) -> None:
        future = submit(self._client, member.address, self._fetch, _task.render_part, self._name, part,
                        _packing.codecs())
        before = sum(each.part.work for each in member.tries.values())
        member.tries[future.key] = Try(number, part, member.address, future, now(),
                                       member.speed.seconds(before + part.work))
        self._progress.issued += 1

    # ---- what comes back ----

    def _fetch(self, future: Any) -> None:
        """Called by Dask when a task has ended. Its result comes from the worker itself, in a thread of its own, as the
        worker may have been stopped meanwhile."""
        if future.status == "finished":
            threading.Thread(target=self._gather, args=(future,), daemon=True).start()
        else:
            self._events.put((future, None))

    def _gather(self, future: Any) -> None:
        try:
            outcome = self._client.gather([future], direct=True)[0]
        except Exception:
            outcome = None  # the worker has gone
        self._events.put((future, outcome))

    def _take_in(self) -> None:
        event = self._next_event(TICK)
        while event is not None:
            self._take(*event)
            event = self._next_event(0.0)
        if self._batch and (len(self._batch) >= BATCH or not self._waiting):
            self._merge_batch()
        self._tell()

    def _next_event(self, timeout: float) -> tuple[Any, Any] | None:
        try:
            return self._events.get(timeout=timeout) if timeout else self._events.get_nowait()
        except queue.Empty:
            return None

    def _take(self, future: Any, outcome: Any) -> None:
        for member in self._members.values():
            if member.introduction is not None and member.introduction.key == future.key:
                self._meet(member, outcome)
                return
            each = member.tries.pop(future.key, None)
            if each is not None:
                self._take_part(member, each, outcome)
                return
        # else of a worker that was taken for dead: the part has been given out again

    def _meet(self, member: Member, outcome: Any) -> None:
        member.introduction = None
        if outcome is None:
            member.is_banned = True  # if it has died, it will be gone at the next look
            return
        if outcome.error:
            self._refuse(member, outcome)
            return
        facts = outcome.worker
        if self._device is None:
            self._device = facts.device
        if facts.device != self._device:
            member.is_banned = True
            self._progress.messages.append(
                f"{facts.host}: refused, since it has {facts.device} and the others {self._device}: films of different "
                "devices do not add up to the bits of one")
            return
        member.facts = facts

    def _refuse(self, member: Member, outcome: _task.Outcome) -> None:
        self._progress.failed += 1
        self._progress.messages.append(outcome.error)
        if not outcome.may_help_elsewhere:
            raise FarmError(outcome.error)
        member.failures += 1
        member.is_banned = member.failures >= MOST_FAILURES or member.facts is None

    def _take_part(self, member: Member, each: Try, outcome: Any) -> None:
        if outcome is None:
            self._progress.lost += 1
            self._again(each, "its worker died")
            return
        member.is_late = False
        if outcome.error:
            self._refuse(member, outcome)
            self._again(each, outcome.error)
            return
        member.failures = 0
        member.speed.measure(each.part.work, outcome.seconds)
        if each.number not in self._open:
            self._progress.dropped += 1
            return
        try:
            self._batch.append(_packing.unpack(outcome.data))
        except ValueError as error:
            self._again(each, str(error))
            return
        self._open.remove(each.number)
        self._progress.parts += 1
        self._progress.part_bytes += len(outcome.data)

    def _tell(self) -> None:
        self._progress.seconds = now() - self._start
        if self._show(self._progress, self._film):
            self._stopped = True

    def look(self) -> Stats:
        """At the film's error."""
        stats = self.film.stats()
        self._progress.samples = stats.mean_sample_count
        self._progress.error, self._progress.error_high = stats.relative_rmse, stats.relative_rmse_high
        return stats


def _added(film: Film, other: Film) -> Film:
    film += other
    return film


def render(client: Any, job: Job, samples: int, *, target_error: float = 0.0, sampling: Sampling = Sampling.BEST,
           options: Options = Options(), progress: Callable[[Progress, Film | None], object] = lambda *_: None
           ) -> Result:
    """Renders a picture on the workers of a Dask cluster.

    client         a distributed.Client
    samples        of a pixel; with a target error the most
    target_error   0: none. Else relative, as of Context.accumulate, with whose samples in each pixel it ends
    progress       called some times a second with the counts and the film so far, which it must not change; returning
                   True ends the rendering

    FarmError: no worker can do it. Whatever dies meanwhile, but this process, changes no bit; and this process goes on
    from its checkpoint.
    """
    settings = job.settings
    coordinator = _Coordinator(client, job, options, progress)
    shape = grid_shape(settings.width, settings.height)
    if not target_error:
        goal = 16
        while goal < samples and coordinator.run(np.full(shape, goal, np.uint32)):
            goal *= 4
        ended = coordinator.run(np.full(shape, samples, np.uint32))
        coordinator.look()
        return coordinator.finish("samples" if ended else "stopped")
    goals = np.full(shape, min(16, samples), np.uint32)
    while coordinator.run(goals):
        stats = coordinator.look()
        if sampling == Sampling.UNIFORM:
            count = int(goals.max())
            if stats.relative_rmse_high <= target_error:
                return coordinator.finish("error")
            if count >= samples:
                return coordinator.finish("limit")
            goals = np.full(shape, min(library().pt_next_check(count), samples), np.uint32)
            continue
        result, goals = coordinator.film.plan(target_error, samples)
        if result != Outcome.PENDING:
            return coordinator.finish("error" if result == Outcome.TARGET_REACHED else "limit")
    return coordinator.finish("stopped")
