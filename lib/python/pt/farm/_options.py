from __future__ import annotations

from dataclasses import dataclass, field

from pt import _enums as enums
from pt._errors import BrokenRule
from pt._film import Film
from pt._files import Path


class FarmError(RuntimeError):
    """The message has the workers' reports. The checkpoint has the returned films. `result` is the library's error, or ERROR_INTERNAL."""

    def __init__(self, message: str, result: int = enums.Result.ERROR_INTERNAL,
                 broken_rules: tuple[BrokenRule, ...] = ()) -> None:
        super().__init__(message)
        self.result = enums.Result(result)
        self.broken_rules = broken_rules


@dataclass(frozen=True)
class Options:
    """part_seconds       intended duration of a part
    patience           seconds beyond the expected time until another worker also gets the part
    most_tries         most failures and lost workers of a part
    checkpoint         film file; rendering resumes from it if it exists
    checkpoint_every   seconds
    wait_for_workers   seconds without a ready worker until an error
    mixed              whether workers with other devices and drivers may join; the picture then equals one machine's
                       statistically, but not bit by bit. Needs the module xxhash
    """

    part_seconds: float = 5.0
    patience: float = 10.0
    most_tries: int = 5
    checkpoint: Path | None = None
    checkpoint_every: float = 30.0
    wait_for_workers: float = 300.0
    mixed: bool = False


@dataclass
class Progress:
    """`issued` counts all parts: merged, dropped, failed, lost or running."""

    seconds: float = 0.0
    samples: float = 0.0  # mean over all pixels
    samples_wanted: float = 0.0  # final mean, once it is decided
    error: float = float("inf")
    error_high: float = float("inf")
    workers: int = 0
    parts: int = 0
    issued: int = 0
    repeated: int = 0
    dropped: int = 0
    failed: int = 0
    lost: int = 0
    forgotten: int = 0  # samples that were lost and must be rendered again
    part_bytes: int = 0
    messages: list[str] = field(default_factory=list)
    last_result: int = enums.Result.OK  # the library's result in the last error
    ended_by: str = ""  # "samples", "error" or "limit"; "stopped" if progress() returned True

    def line(self) -> str:
        error = "" if self.error == float("inf") else f", error {self.error:.3%} (to {self.error_high:.3%})"
        return (f"{self.samples:.1f} of {self.samples_wanted:.1f} spp{error}, {self.workers} workers, "
                f"{self.parts} parts, {self.repeated} repeated, {self.dropped} dropped, {self.lost} lost, "
                f"{self.failed} failed, {self.seconds:.0f} s")


@dataclass(frozen=True)
class Result:
    """`film` has the bytes of one long rendering."""

    film: Film
    progress: Progress

    @property
    def devices(self) -> tuple[str, ...]:
        """Models and drivers."""
        return tuple(self.film.info.device.split(" and "))
