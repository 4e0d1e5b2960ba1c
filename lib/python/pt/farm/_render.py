from __future__ import annotations

import importlib
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from pt._enums import Result as Outcome
from pt._enums import Sampling
from pt._film import Film
from pt._library import library
from pt.farm._coordinator import Coordinator
from pt.farm._job import Job
from pt.farm._options import FarmError, Options, Progress, Result
from pt.farm._part import Goals, grid_shape

FIRST_LOOK = 16


def render(client: Any, job: Job, samples: int, *, target_error: float = 0.0, sampling: Sampling = Sampling.BEST,
           options: Options = Options(), progress: Callable[[Progress, Film | None], object] = lambda *_: None
           ) -> Result:
    """Renders on the workers of a Dask cluster.

    client         a distributed.Client
    samples        samples of a pixel; with a target error, the most
    target_error   relative; 0: none. Tiles get the same samples as in Context.accumulate
    progress       called several times a second; must not change the film; ends the rendering by returning True

    Raises FarmError if no worker can render.
    """
    if options.mixed:
        try:
            importlib.import_module("xxhash")
        except ImportError as error:
            raise FarmError("mixed: needs the Python module xxhash, which marks films as mixed") from error
    coordinator = Coordinator(client, job, options, progress, 0 if target_error else samples)
    try:
        if target_error:
            return _to_error(coordinator, job, samples, target_error, sampling)
        return _to_samples(coordinator, job, samples)
    finally:
        coordinator.close()


def _to_samples(coordinator: Coordinator, job: Job, samples: int) -> Result:
    shape = grid_shape(job.settings.width, job.settings.height)
    steps = [np.full(shape, count, np.uint32) for count in _counts_to(samples)]
    ended = True
    while steps and ended:
        ended = coordinator.run(steps.pop(0), lambda: steps.pop(0) if steps else None)
    coordinator.look()
    return coordinator.finish("samples" if ended else "stopped")


def _counts_to(samples: int) -> Iterator[int]:
    count = FIRST_LOOK
    while count < samples:
        yield count
        count *= 4
    yield samples


def _to_error(coordinator: Coordinator, job: Job, samples: int, target_error: float, sampling: Sampling) -> Result:
    def further() -> Goals | None:
        """Plans returned tiles while others run, because a tile's plan depends only on its own samples (lib/film/adaptive_rule.h)."""
        result, planned = coordinator.film.plan(target_error, samples)
        return planned if result == Outcome.PENDING else None

    goals = np.full(grid_shape(job.settings.width, job.settings.height), min(FIRST_LOOK, samples), np.uint32)
    ended = coordinator.run(goals)
    while ended:
        if sampling == Sampling.UNIFORM:
            error = coordinator.look()
            count = int(goals.max())
            if error.relative_rmse_high <= target_error and count >= coordinator.film.info.lamp_sample_count:
                return coordinator.finish("error")
            if count >= samples:
                return coordinator.finish("limit")
            goals = np.full(goals.shape, min(library().pt_next_check(count), samples), np.uint32)
            ended = coordinator.run(goals)
            continue
        result, goals = coordinator.film.plan(target_error, samples)
        if result != Outcome.PENDING:
            coordinator.look()
            return coordinator.finish("error" if result == Outcome.TARGET_REACHED else "limit")
        ended = coordinator.run(goals, further)
    coordinator.look()
    return coordinator.finish("stopped")
