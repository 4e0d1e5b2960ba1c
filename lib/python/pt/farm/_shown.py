from __future__ import annotations

import signal
import sys

from pt._film import Film
from pt._command_line import SIGNAL
from pt._text import tell
from pt.farm._options import Progress
from pt.farm._workers import now

SHOWN_EVERY = 1.0


class Signals:
    """SIGINT, SIGTERM and SIGHUP end a rendering with the samples so far. A second signal ends the process."""

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
    def __init__(self, is_quiet: bool, signals: Signals) -> None:
        self._is_quiet, self._time, self._told, self._signals = is_quiet, 0.0, 0, signals

    def __call__(self, progress: Progress, _: Film | None) -> bool:
        for message in progress.messages[self._told:]:
            print(file=sys.stderr)
            tell("pt-farm", message)
        self._told = len(progress.messages)
        if not self._is_quiet and (now() - self._time >= SHOWN_EVERY or progress.ended_by):
            self._time = now()
            print(f"\r{progress.line()}", end="\n" if progress.ended_by else "", file=sys.stderr, flush=True)
        return bool(self._signals.number)
