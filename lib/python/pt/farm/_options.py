"""How a farm works, and what it comes to."""

from __future__ import annotations

from dataclasses import dataclass

from pt._film import Film
from pt._files import Path
from pt.farm._progress import Progress


@dataclass(frozen=True)
class Options:
    """How a farm works; the picture does not depend on it, unless devices are mixed.

    part_seconds       how long a part should take
    patience           seconds beyond what is expected until a part is given to another worker too
    most_tries         times that a part may fail, or lose its worker, in all
    checkpoint         file, which is gone on from if it is there; None: none
    checkpoint_every   seconds
    wait_for_workers   seconds without any that is ready until that is an error
    mixed              other devices and drivers than those of the first worker may join: the picture is then
                       statistically, and not bitwise, that of one machine, and its film names all of them. Needs the
                       module xxhash
    """

    part_seconds: float = 5.0
    patience: float = 10.0
    most_tries: int = 5
    checkpoint: Path | None = None
    checkpoint_every: float = 30.0
    wait_for_workers: float = 300.0
    mixed: bool = False


@dataclass(frozen=True)
class Result:
    """film: the bytes of one long rendering. progress: the last."""

    film: Film
    progress: Progress

    @property
    def devices(self) -> tuple[str, ...]:
        """Models and drivers that took the samples. Of more than one the picture is statistically, not bitwise, that of
        one machine."""
        return tuple(self.film.info.device.split(" and "))
