from __future__ import annotations

import os
import re
import sys
from typing import Final, TextIO

CONTROL: Final = re.compile("[\0-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069]")


def printable(text: str) -> str:
    return CONTROL.sub(lambda found: f"<U+{ord(found[0]):04X}>", text)


def tell(program: str, message: str, stream: TextIO | None = None) -> None:
    for line in message.rstrip("\n").split("\n"):
        print(f"{program}: {printable(line)}" if program else printable(line), file=stream or sys.stderr)


def c_string(text: str | os.PathLike[str] | None) -> bytes | None:
    """Raises ValueError for a NUL byte, which would end the string in C."""
    if text is None:
        return None
    data = os.fsencode(text)
    if b"\0" in data:
        raise ValueError(f"{os.fspath(text)!r}: must have no NUL byte")
    return data
