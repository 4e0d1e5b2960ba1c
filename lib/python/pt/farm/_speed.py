"""How fast workers are, and how much each is given."""

from __future__ import annotations

FIRST_GUESS = 2000.0  # samples of tiles a second: a slow core
LEAST_SECONDS = 0.1  # for a part: the smallest one of 1920x1080 takes a worker 0.03 s
REMEMBERED = 5.0  # seconds of earlier parts that count: as long as a part should take
BUSY_SHARE = 0.5  # of a coordinator's time that adding films may take


class Speed:
    """The speed of one worker, in samples of tiles a second."""

    def __init__(self) -> None:
        self.value = FIRST_GUESS
        self._work = self._seconds = 0.0

    def measure(self, work: int, seconds: float) -> None:
        """Updates the speed, a mean over the last parts weighted by their seconds, since most of a small part's time is
        overhead."""
        kept = min(REMEMBERED / self._seconds, 1.0) if self._seconds else 0.0
        self._work = kept * self._work + work
        self._seconds = kept * self._seconds + max(seconds, 1e-6)
        self.value = self._work / self._seconds

    def seconds(self, work: int) -> float:
        return work / self.value

    def share(self, part_seconds: float, least_seconds: float, remaining: int, all_speeds: float) -> int:
        """How much work to give a worker: part_seconds of it; towards the end, half of what would let all workers end
        together (guided self-scheduling: Polychronopoulos and Kuck 1987), but at least least_seconds."""
        together = 0.5 * remaining / all_speeds
        return max(int(self.value * max(min(part_seconds, together), least_seconds)), 1)


def least_seconds(workers: int, adding_seconds: float) -> float:
    """How long parts must take so that the coordinator, which needs adding_seconds to add each, keeps up with so many
    workers."""
    return max(workers * adding_seconds / BUSY_SHARE, LEAST_SECONDS)
