"""How fast workers are, and how much each is given."""

from __future__ import annotations

FIRST_GUESS = 2000.0  # samples of tiles a second: a slow core
LEAST_SECONDS = 0.1  # of a part: below that, sending it takes longer


class Speed:
    """Of one worker, in samples of tiles a second."""

    def __init__(self) -> None:
        self.value = FIRST_GUESS
        self._measured = False

    def measure(self, work: int, seconds: float) -> None:
        """The mean of the last few parts; the first counts alone."""
        speed = work / max(seconds, 1e-6)
        self.value = 0.5 * (self.value + speed) if self._measured else speed
        self._measured = True

    def seconds(self, work: int) -> float:
        return work / self.value

    def share(self, part_seconds: float, remaining: int, all_speeds: float) -> int:
        """How much work to give: what takes part_seconds, and towards the end half of what would let all end together
        (guided self-scheduling: Polychronopoulos and Kuck 1987)."""
        together = 0.5 * remaining / all_speeds
        return max(int(self.value * min(part_seconds, max(together, LEAST_SECONDS))), 1)
