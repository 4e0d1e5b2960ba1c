from __future__ import annotations

import contextlib
import queue
from collections import deque
from collections.abc import Callable
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from pt._errors import IncompatibleError
from pt._film import TILE_SIDE, Film
from pt._stats import ErrorEstimate
from pt.farm import _task
from pt.farm._crew import Crew
from pt.farm._identity import Identity, identity_of
from pt.farm._job import Job, name_of, packed
from pt.farm._options import FarmError, Options, Progress, Result
from pt.farm._part import Cells, Goals, Part, cells_of, further_parts, grid_shape, has_only, is_film_of, missing_parts
from pt.farm._speed import least_seconds
from pt.farm._sum import Sum, read_film, write_film
from pt.farm._workers import MOST_FETCHED, Member, Try, now, submit

TICK = 0.25
SLOTS = 2  # parts per worker: one is rendered while another is transferred

# Tiles that keep a device busy: on a CPU 4 for each of 16 cores, on a GPU 262,144 pixels.
LEAST_TILES = {True: 64, False: 4096}
LEAD = 0.05
LATE = 3.0
LOOK_SHARE = 0.05


class _Opened(NamedTuple):
    film: Film
    size: int
    identity: Identity


class Coordinator:
    """`final` is the final number of samples per pixel, or 0 while this is undecided."""

    def __init__(self, client: Any, job: Job, options: Options,
                 show: Callable[[Progress, Film | None], object], final: int) -> None:
        self._client, self._job, self._options, self._show = client, job, options, show
        data = packed(job)
        self._name = name_of(data)
        self._shape = grid_shape(job.settings.width, job.settings.height)
        self._pixels = np.outer(*(np.minimum(TILE_SIDE, side - TILE_SIDE * np.arange(count)) for side, count in
                                  zip((job.settings.height, job.settings.width), self._shape)))
        self._final = final
        self._events: queue.Queue[tuple[Any, ...]] = queue.Queue(MOST_FETCHED)
        self._closed = False
        self._waiting: deque[tuple[int | None, Part]] = deque()
        self._open: set[int] = set()
        self._tries: dict[int, list[str]] = {}
        self._next_number = 0
        self._progress = Progress()
        self._sum = Sum(read_film(options.checkpoint) if options.checkpoint else None, job.settings.width,
                        job.settings.height, mixed=options.mixed)
        self._crew = Crew(client, data, self._met, self._progress, self._sum.identity, mixed=options.mixed,
                          patience=options.wait_for_workers)
        self._start = self._checkpoint_time = now()
        self._checkpoint_error = ""
        self._look_end = self._look_cost = 0.0
        self._goals: Goals = np.zeros(self._shape, np.uint32)
        self._has_only = self._sum.film is None
        self._cells: Cells | None = None
        self._cells_at = 0
        self._asked_at = -1
        self._ask_end = self._ask_cost = 0.0
        self._stopped = False


    def run(self, goals: Goals, more: Callable[[], Goals | None] = lambda: None) -> bool:
        """Returns False if progress() stopped the work. `more` returns further goals for tiles without running parts, when all parts are
        distributed and some have returned."""
        first_sample, has_worked = self._job.settings.first_sample, False
        self._goals = goals
        while not self._stopped:
            if self._cells is None or self._cells_at != self._progress.parts:
                self._cells, self._cells_at = cells_of(self._sum.film, self._shape), self._progress.parts
            missing = missing_parts(self._cells, first_sample, self._goals)
            if not missing and self._crew.is_there:
                self._has_only = has_only(self._cells, first_sample, self._goals)
                return True
            if has_worked:
                self._forgot(missing)
            self._waiting.extend((None, part) for part in missing)
            self._want()
            self._work(more)
            has_worked = True
        return False

    def _work(self, more: Callable[[], Goals | None]) -> None:
        while (self._waiting or self._open or not self._crew.is_there) and not self._stopped:
            for address, lost in self._crew.look():
                self._lose(address, lost)
            self._look_for_late()
            self._hand_out()
            self._take_in(min(TICK, max(self._seconds_to_ask(), 0.0)))
            if self._seconds_to_ask() <= 0.0:
                self._ask_for(more)
        self._sum.merge()

    def _want(self) -> None:
        wanted = np.maximum(self._goals, self._final).astype(np.float64)
        for samples, tiles in self._cells or ():
            wanted.ravel()[tiles] = np.maximum(wanted.ravel()[tiles], sum(map(len, samples)))
        self._progress.samples_wanted = float((wanted * self._pixels).sum() / self._pixels.sum())

    def _seconds_to_ask(self) -> float:
        """A late call of `more` plans more tiles together, but a worker must not become idle. Calls take at most half of the time."""
        if self._waiting or not self._open or not self._has_only or self._progress.parts == self._asked_at:
            return float("inf")
        idle = min((member.busy_until for member in self._crew if member.can_take(SLOTS)), default=float("inf"))
        return max(idle - LEAD - self._ask_cost, self._ask_end + self._ask_cost) - now()

    def _ask_for(self, more: Callable[[], Goals | None]) -> None:
        start = now()
        goals = more()
        if goals is not None:
            further = further_parts(self._goals, goals, self._job.settings.first_sample)
            self._waiting.extend((None, part) for part in further)
            self._goals = np.maximum(self._goals, goals)
            self._want()
        self._asked_at, self._ask_end = self._progress.parts, now()
        self._ask_cost = self._ask_end - start

    def _forgot(self, missing: list[Part]) -> None:
        work = sum(part.work for part in missing)
        if work:
            self._progress.forgotten += work
            self._progress.messages.append(f"the coordinator has lost {work} samples of tiles, which are taken again")

    @property
    def film(self) -> Film:
        if self._sum.film is None:
            raise FarmError("stopped before the first part came back")
        return self._sum.film

    def look(self) -> ErrorEstimate:
        start = now()
        error = self.film.error_estimate()
        self._look_end, self._look_cost = now(), now() - start
        self._progress.samples = self.film.stats().mean_sample_count
        self._progress.error, self._progress.error_high = error.relative_rmse, error.relative_rmse_high
        return error

    def _glance(self) -> None:
        if now() - self._look_end > self._look_cost / LOOK_SHARE:
            self.look()

    def finish(self, ended_by: str) -> Result:
        self._progress.ended_by = ended_by
        self._keep()
        self._tell()
        return Result(self.film, self._progress)

    def close(self) -> None:
        self._closed = True
        if not self._progress.ended_by:
            self._sum.merge()
            self._keep()
        with contextlib.suppress(Exception):
            for member in self._crew:
                for each in member.tries.values():
                    each.future.cancel()

    def _keep(self) -> None:
        self._checkpoint_time = now()
        if self._options.checkpoint is None or self._sum.film is None:
            return
        try:
            write_film(self._sum.film, self._options.checkpoint)
            self._checkpoint_error = ""
        except OSError as error:
            if str(error) != self._checkpoint_error:
                self._progress.messages.append(f"the checkpoint could not be written; the rendering continues: {error}")
            self._checkpoint_error = str(error)


    def _look_for_late(self) -> None:
        for member in self._crew:
            for each in member.tries.values():
                if now() - each.issued > LATE * each.expected + self._options.patience:
                    member.is_late = True
                    if each.number in self._open and self._under_way(each.number) < 2:
                        self._waiting.appendleft((each.number, each.part))
                        self._progress.repeated += 1

    def _under_way(self, number: int) -> int:
        waiting = sum(each == number for each, _ in self._waiting)
        return waiting + sum(each.number == number for member in self._crew for each in member.tries.values())

    def _lose(self, address: str, each: Try) -> None:
        self._progress.lost += 1
        self._again(address, each, "its worker died")

    def _again(self, address: str, each: Try, reason: str) -> None:
        if each.number not in self._open:
            return
        tries = self._tries.setdefault(each.number, [])
        tries.append(address)
        if len(tries) >= self._options.most_tries:
            raise FarmError(f"a part failed {len(tries)} times, last because {reason}",
                            self._progress.last_result)
        if self._under_way(each.number) == 0:
            self._waiting.appendleft((each.number, each.part))

    def _may_try(self, member: Member, number: int) -> bool:
        """A worker that failed gets the part again only after all others failed."""
        if any(each.number == number for each in member.tries.values()):
            return False
        tried = self._tries.get(number, [])
        return member.address not in tried or all(other.address in tried for other in self._crew if other.is_fit)

    def _hand_out(self) -> None:
        free = [member for member in self._crew if member.can_take(SLOTS)]
        remaining = sum(part.work for _, part in self._waiting)
        speeds = sum(member.speed.value for member in self._crew if member.identity) or 1.0
        adding = self._sum.seconds / max(self._progress.parts, 1)
        least = least_seconds(self._progress.workers, adding)
        for slot in range(SLOTS):
            for member in free:
                if not self._waiting or len(member.tries) > slot:
                    continue
                number, part = self._waiting.popleft()
                if number is None:
                    share = member.speed.share(self._options.part_seconds, least, remaining, speeds)
                    part, rest = part.split(share, LEAST_TILES[member.is_cpu])
                    self._waiting.extendleft((None, each) for each in rest)
                    number, self._next_number = self._next_number, self._next_number + 1
                    self._open.add(number)
                    remaining -= part.work
                elif number not in self._open:
                    continue
                elif not self._may_try(member, number):
                    self._waiting.appendleft((number, part))
                    continue
                self._give(member, number, part)

    def _give(self, member: Member, number: int, part: Part) -> None:
        def done(future: Any, outcome: _task.Outcome | None) -> None:
            self._tell_of(future, *self._opened(part, outcome, member.identity))
        future = submit(self._client, member.address, done, _task.render_part, self._name, part, _task.codecs())
        before = sum(each.part.work for each in member.tries.values())
        member.tries[future.key] = Try(number, part, future, now(), member.speed.seconds(before + part.work))
        self._progress.issued += 1


    def _met(self, future: Any, outcome: _task.Outcome | None) -> None:
        """Runs on other threads."""
        self._tell_of(future, *self._opened(_task.first_part(self._job), outcome, None))

    def _tell_of(self, *event: Any) -> None:
        """Waits while the queue is full, which limits the memory of films."""
        while not self._closed:
            with contextlib.suppress(queue.Full):
                self._events.put(event, timeout=TICK)
                return

    def _opened(self, part: Part, outcome: _task.Outcome | None, identity: Identity | None
                ) -> tuple[_task.Outcome | None, _Opened | None]:
        if outcome is None or outcome.error:
            return outcome, None
        try:
            data = _task.unpack(outcome.data)
            opened = _Opened(Film(data), len(data), identity_of(data))
            if not is_film_of(opened.film, part, self._shape):
                raise ValueError("it has other samples than requested")
            if identity not in (None, opened.identity):
                raise ValueError("it belongs to another picture or device than the earlier films")
            return outcome, opened
        except (ValueError, IncompatibleError) as error:
            return replace(outcome, error=f"its film is refused: {error}"), None

    def _take_in(self, patience: float) -> None:
        event = self._next_event(patience)
        while event is not None:
            self._take(*event)
            event = self._next_event(0.0)
        if self._sum.is_due() or not self._waiting:
            self._sum.merge()
        if now() - self._checkpoint_time > self._options.checkpoint_every:
            self._keep()
        self._tell()

    def _next_event(self, timeout: float) -> tuple[Any, ...] | None:
        try:
            return self._events.get(timeout=timeout) if timeout else self._events.get_nowait()
        except queue.Empty:
            return None

    def _take(self, future: Any, outcome: _task.Outcome | None, opened: _Opened | None) -> None:
        member = self._crew.of_introduction(future)
        if member is not None:
            self._crew.meet(member, outcome, opened.identity if opened else None)
            return
        member = self._crew.of_part(future)
        if member is None:
            return
        each = member.tries.pop(future.key)
        if outcome is None:
            self._lose(member.address, each)
            return
        member.is_late = False
        if opened is None:
            self._crew.blame(member, outcome)
            self._again(member.address, each, outcome.error)
            return
        member.failures = 0
        member.speed.measure(each.part.work, outcome.seconds)
        if each.number not in self._open:
            self._progress.dropped += 1
            return
        self._open.remove(each.number)
        self._sum.add(opened.film, opened.size, opened.identity.models)
        self._progress.parts += 1
        self._progress.part_bytes += len(outcome.data)

    def _tell(self) -> None:
        self._progress.seconds = now() - self._start
        if self._sum.film is not None:
            self._glance()
        if self._show(self._progress, self._sum.film):
            self._stopped = True
