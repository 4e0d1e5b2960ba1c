from __future__ import annotations

import json
import math
import pathlib
import re
import struct
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Final

from pt._columns import Array
from pt._enums import Curve, Estimator, Quantity, Sampler, Uncertain
from pt._stats import ErrorEstimate

METHODS: Final[dict[str, Any]] = {"sampler": Sampler, "estimator": Estimator}


@dataclass(frozen=True)
class Frame:
    """pixels   the selected layer, shape (height, width, 3)
    values   layers of samples, for values of single pixels
    spoilt   masks pixels that lost samples; None: no pixel did
    """

    number: int
    state: dict[str, Any]
    pixels: Array | None
    values: tuple[Array, ...] = ()
    spoilt: Array | None = None

    def message(self, pixels: bytes, stops: float) -> bytes:
        state = json.dumps({**self.state, "frame": self.number, "stops": stops, "choices": CHOICES}).encode()
        return struct.pack("<I", len(state)) + state + pixels

    def pixel(self, x: int, y: int, shown: Callable[[Any], Array]) -> dict[str, Any]:
        if not self.values or not (0 <= y < len(self.values[0]) and 0 <= x < len(self.values[0][0])):
            return {}
        radiance, error, samples = (each[y, x].tolist() for each in self.values)
        assert self.pixels is not None
        layer = [number if math.isfinite(number) else None for number in self.pixels[y, x].tolist()]
        return {"x": x, "y": y, "radiance": radiance, "samples": int(samples[0]), "layer": layer,
                "shown": shown(radiance).tolist(), "error": error if all(map(math.isfinite, error)) else None}


def facts_of(estimate: ErrorEstimate) -> dict[str, Any]:
    """JSON has no infinity, so unknown numbers are null."""
    numbers = {"error": estimate.relative_rmse, "low": estimate.relative_rmse_low, "high": estimate.relative_rmse_high}
    return {**{name: number if math.isfinite(number) else None for name, number in numbers.items()},
            "uncertain": [name_of(flag) for flag in Uncertain if flag in estimate.uncertain]}


def name_of(member: Any) -> str:
    name: str = member.name.lower().replace("_", "-")
    return name


LAYERS: Final = {name_of(each).replace("-", " "): each for each in Quantity
                 if each not in (Quantity.OBJECT, Quantity.COVERAGE)}
OF_SAMPLES: Final = 3  # the first layers are of samples, the others of first hits
CHOICES: Final = {"layer": list(LAYERS), "curve": [name_of(each) for each in Curve],
                  **{name: [name_of(each) for each in kinds] for name, kinds in METHODS.items()}}


def faults_of(text: str) -> list[dict[str, Any]]:
    faults = []
    for line in text.splitlines():
        if found := re.match(r"(?:ERROR: |WARNING: )?([^\s:][^:]*):(\d+):(?:\d+:)? *(.*)", line):
            faults.append({"file": pathlib.PurePath(found[1]).name, "line": int(found[2]), "text": found[3] or line})
        elif line.strip():
            faults.append({"file": None, "line": 0, "text": line.strip()})
    return faults
