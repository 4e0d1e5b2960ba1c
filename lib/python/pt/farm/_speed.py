"""How fast workers are, and how much each is given."""

from __future__ import annotations

FIRST_GUESS = 2000.0  # samples of tiles a second: a slow core
LEAST_SECONDS = 0.1  # of a part: a worker spends 0.03 s on the smallest of 1920x1080
REMEMBERED = 5.0  # seconds of the parts before the last: as many as a part is to take
BUSY_SHARE = 0.5  # of its time, that a coordinator may spend on adding


class Speed:
    """Of one worker, in samples of tiles a second."""

    def __init__(self) -> None:
        self.value = FIRST_GUESS
        self._work = self._seconds = 0.0

    def measure(self, work: int, seconds: float) -> None:
        """Of the last parts, by their seconds: a small part takes little but what every part takes besides."""
        kept = min(REMEMBERED / self._seconds, 1.0) if self._seconds else 0.0
        self._work = kept * self._work + work
        self._seconds = kept * self._seconds + max(seconds, 1e-6)
        self.value = self._work / self._seconds

    def seconds(self, work: int) -> float:
        return work / self.value

    def share(self, part_seconds: float, least_seconds: float, remaining: int, all_speeds: float) -> int:
        """How much work to give: what takes part_seconds, and towards the end half of what would let all end together
        (guided self-scheduling: Polychronopoulos and Kuck 1987); but what takes least_seconds."""
        together = 0.5 * remaining / all_speeds
        return max(int(self.value * max(min(part_seconds, together), least_seconds)), 1)


def least_seconds(workers: int, adding_seconds: float) -> float:
    """Of a part, that takes its coordinator adding_seconds: so many workers do not swamp it."""
    return max(workers * adding_seconds / BUSY_SHARE, LEAST_SECONDS)
