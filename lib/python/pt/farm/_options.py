"""A farm's options, its progress and its result."""

from __future__ import annotations

from dataclasses import dataclass, field

from pt import _enums as enums
from pt._film import Film
from pt._files import Path


class FarmError(RuntimeError):
    """The picture cannot be made; the message has what workers reported. Films that came back are in the checkpoint.

    result: the library's result for the worker's error that is to blame; ERROR_INTERNAL if there is none."""

    def __init__(self, message: str, result: int = enums.Result.ERROR_INTERNAL) -> None:
        super().__init__(message)
        self.result = enums.Result(result)


@dataclass(frozen=True)
class Options:
    """How a farm works; the picture does not depend on it, unless devices are mixed.

    part_seconds       how long a part should take
    patience           seconds beyond the expected time after which a part is given to another worker, too
    most_tries         how often a part may fail or lose its worker, in all
    checkpoint         name of a file, from which rendering goes on if it exists; None: none
    checkpoint_every   seconds
    wait_for_workers   seconds without a ready worker after which that is an error
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


@dataclass
class Progress:
    """Counts so far. issued is the number of parts merged, dropped, failed, lost and under way."""

    seconds: float = 0.0
    samples: float = 0.0  # mean over all pixels, when the film was last examined
    samples_wanted: float = 0.0  # the mean at the end; with a target error, as far as decided
    error: float = float("inf")  # relative; error_high is its upper bound, with 95% confidence
    error_high: float = float("inf")
    workers: int = 0
    parts: int = 0  # merged
    issued: int = 0
    repeated: int = 0  # tries that began because others were late
    dropped: int = 0  # duplicates that came second
    failed: int = 0  # tries that failed, and were repeated elsewhere
    lost: int = 0  # tries whose worker died
    forgotten: int = 0  # samples of tiles that the coordinator itself lost track of, and had rendered again
    part_bytes: int = 0  # received
    messages: list[str] = field(default_factory=list)  # of workers
    last_result: int = enums.Result.OK  # the library's result for the last error
    ended_by: str = ""  # "samples", "error", "limit"; "stopped" where progress() returned True

    def line(self) -> str:
        error = "" if self.error == float("inf") else f", error {self.error:.3%} (to {self.error_high:.3%})"
        return (f"{self.samples:.1f} of {self.samples_wanted:.1f} spp{error}, {self.workers} workers, "
                f"{self.parts} parts, {self.repeated} repeated, {self.dropped} dropped, {self.lost} lost, "
                f"{self.failed} failed, {self.seconds:.0f} s")


@dataclass(frozen=True)
class Result:
    """film: with the bytes of one long rendering. progress: the last one."""

    film: Film
    progress: Progress

    @property
    def devices(self) -> tuple[str, ...]:
        """Models and drivers that took the samples. With more than one, the picture is as good as one machine's, but
        its bits differ."""
        return tuple(self.film.info.device.split(" and "))
