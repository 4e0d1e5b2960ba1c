"""What a coordinator tells while it goes on."""

from __future__ import annotations

from dataclasses import dataclass, field

from pt._enums import Result


@dataclass
class Progress:
    """Counts so far. A number of parts that were issued is that of those merged, dropped, lost and under way."""

    seconds: float = 0.0
    samples: float = 0.0  # a pixel, the mean of all
    samples_wanted: float = 0.0  # the most, or with a target error those decided so far
    error: float = float("inf")  # relative, and the upper bound of 95%
    error_high: float = float("inf")
    workers: int = 0
    parts: int = 0  # merged
    issued: int = 0
    repeated: int = 0  # tries that began since others were late
    dropped: int = 0  # duplicates that came second
    failed: int = 0  # tries, which were repeated elsewhere
    lost: int = 0  # tries whose worker died
    forgotten: int = 0  # samples of tiles that the coordinator lost by mistakes of its own, and had taken again
    part_bytes: int = 0  # received
    messages: list[str] = field(default_factory=list)  # of workers
    last_result: int = Result.OK  # the library's, of the error that came last
    ended_by: str = ""  # "samples", "error", "limit"; "stopped" where progress() returned True

    def line(self) -> str:
        error = "" if self.error == float("inf") else f", error {self.error:.3%} (to {self.error_high:.3%})"
        return (f"{self.samples:.1f} of {self.samples_wanted:.1f} spp{error}, {self.workers} workers, "
                f"{self.parts} parts, {self.repeated} repeated, {self.dropped} dropped, {self.lost} lost, "
                f"{self.failed} failed, {self.seconds:.0f} s")
