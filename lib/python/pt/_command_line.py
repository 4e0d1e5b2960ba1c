from __future__ import annotations

import argparse
import contextlib
import os
import pathlib
import re
import subprocess
from collections.abc import Callable, Sequence
from typing import Any

from pt._enums import Result
from pt._files import format_of

VECTOR_BITS = "LP_NATIVE_VECTOR_WIDTH"
INTERNAL, USAGE, SCENE, NO_DEVICE, LOST, FILES, TARGET_MISSED, SIGNAL = 1, 2, 3, 4, 5, 6, 7, 128
CODE_OF_RESULT = {Result.ERROR_INVALID_ARGUMENT: USAGE, Result.ERROR_INCOMPATIBLE: USAGE,
                  Result.ERROR_INVALID_SCENE: SCENE, Result.ERROR_UNSUPPORTED: NO_DEVICE,
                  Result.ERROR_NO_DEVICE: NO_DEVICE, Result.ERROR_OUT_OF_DEVICE_MEMORY: NO_DEVICE,
                  Result.ERROR_SHADER: NO_DEVICE, Result.ERROR_DEVICE_LOST: LOST,
                  Result.ERROR_FILE: FILES}


def at_least(least: float, kind: type) -> Callable[[str], Any]:
    def read(text: str) -> Any:
        try:
            value = kind(text)
        except ValueError:
            value = None
        if value is None or not least <= value < float("inf"):
            whole = "whole " if kind is int else ""
            raise argparse.ArgumentTypeError(f"must be a {whole}number of {least:g} or more, is {text!r}")
        return value
    return read


def misnamed(files: Sequence[tuple[str, Sequence[str]]], source: str) -> tuple[str, int] | None:
    for name, formats in files:
        place = pathlib.Path(name)
        try:
            if formats:
                format_of(name, formats)
        except ValueError as error:
            return str(error), USAGE
        if not os.access(place.parent, os.W_OK | os.X_OK):
            return f"{name}: its folder {place.parent} does not exist or cannot be written to", FILES
    names = [os.path.realpath(name) for name, _ in files]
    if len(set(names)) < len(names) or os.path.realpath(source) in names:
        return f"an output must not be named twice, nor be {source}", USAGE
    return None


def numbered(pattern: str, number: int | None) -> str:
    if number is None:
        return pattern
    return re.sub(r"#+(?=[^#]*$)", lambda place: str(number).zfill(len(place.group())), pattern)


def program() -> str:
    packaged = pathlib.Path(__file__).parent / "bin" / "pt"
    return os.environ.get("PT_PROGRAM") or (str(packaged) if packaged.exists() else "pt")


def choose_vector_width(kernels: str, device: str | None) -> None:
    """Sets the variables of `pt devices --vector-width`. Must precede the process's first context."""
    command = [program(), "devices", "--vector-width", kernels]
    if VECTOR_BITS not in os.environ:
        with contextlib.suppress(OSError):  # without the program the driver's default stays
            done = subprocess.run(command + (["--device", device] if device else []), capture_output=True, text=True)
            os.environ.update((name, value) for name, _, value in (line.partition("=") for line in done.stdout.splitlines()))
