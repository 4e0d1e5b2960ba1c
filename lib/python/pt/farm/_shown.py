"""What a terminal, a viewer and signals see of a rendering."""

from __future__ import annotations

import argparse
import signal
import sys

from pt._film import Film
from pt.farm._arguments import SIGNAL
from pt.farm._progress import Progress
from pt.farm._tev import Viewer
from pt.farm._workers import now

SHOWN_EVERY = 1.0  # seconds


class Signals:
    """SIGINT, SIGTERM and SIGHUP end a rendering with the samples so far; all else, and a second one, at once."""

    def __init__(self) -> None:
        self.number = 0
        self.is_rendering = False
        for each in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            if signal.getsignal(each) != signal.SIG_IGN:
                signal.signal(each, self._note)

    def _note(self, number: int, _: object) -> None:
        if self.number or not self.is_rendering:
            sys.exit(SIGNAL + number)
        self.number = number


class Shown:
    """Progress on stderr, and the picture in a viewer."""

    def __init__(self, arguments: argparse.Namespace, signals: Signals) -> None:
        self._quiet, self._time, self._told = arguments.quiet, 0.0, 0
        self._viewer = Viewer(arguments.tev) if arguments.tev is not None else None
        self._signals = signals
        self.name = arguments.scene

    def __call__(self, progress: Progress, film: Film | None) -> bool:
        for message in progress.messages[self._told:]:
            print(f"\npt-farm: {message}", file=sys.stderr)
        self._told = len(progress.messages)
        if now() - self._time >= SHOWN_EVERY or progress.ended_by:
            self._time = now()
            self._show(progress, film)
        return bool(self._signals.number)

    def _show(self, progress: Progress, film: Film | None) -> None:
        if film is not None:
            stats = film.stats()
            progress.samples = stats.mean_sample_count
            progress.error, progress.error_high = stats.relative_rmse, stats.relative_rmse_high
            if self._viewer:
                self._viewer.show(self.name, film)
        if not self._quiet:
            print(f"\r{progress.line()}", end="\n" if progress.ended_by else "", file=sys.stderr, flush=True)

    def next_picture(self, name: str) -> None:
        self.name, self._told = name, 0
