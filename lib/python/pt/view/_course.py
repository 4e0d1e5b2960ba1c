from __future__ import annotations

import pathlib
import subprocess
import threading
from collections.abc import Callable
from typing import Any

from pt._command_line import program


class Course:
    """The program judges the kernel in a folder of `pt course`. `state` has title, verdict and measurements of the first wrong step, or
    is None before the verdict."""

    def __init__(self, folder: pathlib.Path, device: str | None, judged: Callable[[], None]) -> None:
        self._command = [program(), "course", "--check", "next", "--shader-dir", str(folder), *(["--device", device] if device else [])]
        self._judged = judged
        self._lock = threading.Lock()
        self._process: subprocess.Popen[str] | None = None
        self._last: threading.Thread | None = None
        self.state: dict[str, Any] | None = None

    def check(self) -> None:
        self.close()
        with self._lock:
            self.state = None
            self._process = process = subprocess.Popen(self._command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
            self._last = threading.Thread(target=self._run, args=(process,), name="pt-view-course", daemon=True)
            self._last.start()

    def close(self) -> None:
        with self._lock:
            process, self._process = self._process, None
            if process:
                process.kill()
        if self._last:
            self._last.join()

    def _run(self, process: subprocess.Popen[str]) -> None:
        output, errors = process.communicate()
        with self._lock:
            if self._process is not process:
                return
            self._process = None
            title, *details = output.strip().splitlines() or [f"not judged: {errors.strip()}"]
            self.state = {"title": title, "verdict": details[-1] if details else "", "measured": "\n".join(details[1:-2])}
        self._judged()
