from __future__ import annotations

FIRST_GUESS = 2000.0  # tiles per second with one sample per pixel, on a slow core
LEAST_SECONDS = 0.1
REMEMBERED = 5.0
BUSY_SHARE = 0.5


class Speed:
    def __init__(self) -> None:
        self.value = FIRST_GUESS
        self._work = self._seconds = 0.0

    def measure(self, work: int, seconds: float) -> None:
        """Long parts count more, because short ones are mostly overhead."""
        kept = min(REMEMBERED / self._seconds, 1.0) if self._seconds else 0.0
        self._work = kept * self._work + work
        self._seconds = kept * self._seconds + max(seconds, 1e-6)
        self.value = self._work / self._seconds

    def seconds(self, work: int) -> float:
        return work / self.value

    def share(self, part_seconds: float, least_seconds: float, remaining: int, all_speeds: float) -> int:
        """Parts shrink with the remaining work (guided self-scheduling: Polychronopoulos and Kuck 1987)."""
        together = 0.5 * remaining / all_speeds
        return max(int(self.value * max(min(part_seconds, together), least_seconds)), 1)


def least_seconds(workers: int, adding_seconds: float) -> float:
    return max(workers * adding_seconds / BUSY_SHARE, LEAST_SECONDS)
