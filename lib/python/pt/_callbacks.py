"""Python runs signal handlers while a callback executes, often before its first `try`. ctypes then passes the exception to
sys.unraisablehook instead of the caller. A CallbackGuard catches it there. The library stops at its next callback, and
the guarded call raises the exception.
"""

from __future__ import annotations

import sys
import threading
from collections.abc import Callable
from types import TracebackType
from typing import Any

from pt import _structs as structs
from pt._enums import LogLevel

Progress = Callable[[float], object]
Log = Callable[[LogLevel, str], object]


class CallbackGuard:
    def __init__(self) -> None:
        self.error: BaseException | None = None
        self._functions: list[Callable[..., Any]] = []

    def __enter__(self) -> CallbackGuard:
        _install(self)
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None,
                 traceback: TracebackType | None) -> None:
        _remove(self)

    def raise_caught(self) -> None:
        if self.error is not None:
            raise self.error

    def watch(self, function: Callable[..., Any]) -> None:
        self._functions.append(function)

    def progress(self, function: Progress | None) -> Any:
        def report(_: object, fraction: float) -> int:
            if self.error is not None:
                return 1
            return int(function is not None and function(fraction) is True)

        self.watch(report)
        return structs.pt_progress_fn(report)

    def takes(self, function: object, words: str | None) -> bool:
        """Python 3.13 reports only a text with the function's address."""
        return any(own is function or (words is not None and repr(own) in words) for own in self._functions)


class _Hook:
    def __init__(self, before: Callable[[Any], object]) -> None:
        self.before = before

    def __call__(self, unraisable: Any) -> None:
        for guard in tuple(_guards):
            if guard.takes(unraisable.object, unraisable.err_msg):
                guard.error = guard.error or unraisable.exc_value
                return
        self.before(unraisable)


_guards: list[CallbackGuard] = []
_lock = threading.RLock()


def _install(guard: CallbackGuard) -> None:
    with _lock:
        if not _guards:
            sys.unraisablehook = _Hook(sys.unraisablehook)
        _guards.append(guard)


def _remove(guard: CallbackGuard) -> None:
    with _lock:
        _guards.remove(guard)
        if not _guards and isinstance(sys.unraisablehook, _Hook):  # A hook that has replaced this one may still call it.
            sys.unraisablehook = sys.unraisablehook.before


def log_function(current_log: Callable[[], Log | None]) -> Callable[[object, int, bytes], None]:
    def write(_: object, level: int, line: bytes) -> None:
        log = current_log()
        if log is not None:
            log(LogLevel(level), line.decode(errors="replace"))

    return write
