"""A file keeps the port and the token of a view, so that its address works again after a restart."""

from __future__ import annotations

import json
import os
import pathlib
import re
import secrets
import stat
from dataclasses import asdict, dataclass

from pt._files import regular


@dataclass(frozen=True)
class Address:
    port: int
    token: str


def new_token() -> str:
    return secrets.token_urlsafe(18)


def kept_address(file: pathlib.Path) -> Address | None:
    """Returns None for files that another user owns or can read, and for links."""
    try:
        with open(file, "rb", opener=lambda path, flags: regular(path, flags | getattr(os, "O_NOFOLLOW", 0))) as opened:
            facts = os.fstat(opened.fileno())
            if hasattr(os, "geteuid") and (facts.st_uid != os.geteuid() or stat.S_IMODE(facts.st_mode) & 0o077):
                return None
            kept = json.loads(opened.read(1000))
        address = Address(kept["port"], kept["token"])
        return address if address.port in range(1, 2**16) and re.fullmatch(r"[\w-]{20,}", address.token) else None
    except (OSError, ValueError, TypeError, KeyError):
        return None


def keep_address(file: pathlib.Path, address: Address) -> None:
    file.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
    beside = file.with_name(f".{file.name}.{new_token()}")
    try:
        with open(beside, "x", opener=lambda path, flags: os.open(path, flags, 0o600)) as opened:
            json.dump(asdict(address), opened)
        beside.replace(file)
    finally:
        beside.unlink(missing_ok=True)
