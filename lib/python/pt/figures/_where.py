from __future__ import annotations

import operator
import re
from typing import Final

import numpy as np
import numpy.typing as npt

from pt.figures._particles import Particles
from pt.figures._radii import column

COMPARISONS: Final = {"<=": operator.le, ">=": operator.ge, "==": operator.eq, "!=": operator.ne, "<": operator.lt,
                      ">": operator.gt}
CONDITION: Final = re.compile(r"\s*([^<>=!]+?)\s*(<=|>=|==|!=|<|>)\s*([^<>=!\s]+)\s*")


def holds(particles: Particles, condition: str) -> npt.NDArray[np.bool_]:
    found = CONDITION.fullmatch(condition)
    if found is None:
        raise ValueError(f"where = {condition!r}: must be a column, one of {', '.join(COMPARISONS)}, and a number or, "
                         "after == and !=, a word, like \"z < 5\"")
    name, sign, limit = found.groups()
    values = np.asarray(column(particles, name))
    if values.dtype.kind in "fiub":
        try:
            number = float(limit)
        except ValueError:
            raise ValueError(f"where = {condition!r}: {name} has numbers, and {limit!r} is none") from None
        return np.asarray(COMPARISONS[sign](values, number), np.bool_)
    if sign not in ("==", "!="):
        raise ValueError(f"where = {condition!r}: {name} has words: must be == or !=")
    return np.asarray(COMPARISONS[sign](values.astype(str), limit), np.bool_)
