from __future__ import annotations

import math
import time
from collections.abc import Callable
from typing import Final

from pt._camera import Camera, RenderSettings
from pt._compare import Comparison, compare
from pt._context import Context
from pt._enums import Light
from pt._errors import Error
from pt._scene import Scene

SHARE: Final = 0.05  # time for the library's kernel, relative to the edited kernel's
FIRST_LOOK: Final = 16
MIN_CHANGE: Final = 0.01


class BuiltIn:
    """Tests whether an edited kernel shows the same light as the library's. `verdict` is empty before the first test."""

    def __init__(self, device: str | None) -> None:
        self._device = device
        self._context: Context | None = None
        self._picture: tuple[Scene, Camera, RenderSettings] | None = None
        self._count, self._cost, self._owed = 0, 0.0, 0.0
        self._looks, self._looked_at, self._differs = 0, 0, False
        self.verdict = ""

    def begin(self, scene: Scene, camera: Camera, settings: RenderSettings) -> None:
        self._owed, self._looks, self._looked_at, self._differs, self.verdict = 0.0, 0, 0, False, ""
        try:
            if self._context is None:
                self._context, self._picture = Context(self._device, submit_milliseconds=20), None
            shown = self._picture
            if shown and shown[0] is scene and shown[1:] == (camera, settings):
                return
            if not shown or shown[0] is not scene:
                self._context.set_scene(scene)
            self._context.set_camera(camera)
            self._context.set_render(settings)
            self._context.prepare()
            self._picture, self._count, self._cost = (scene, camera, settings), 0, 0.0
        except Error as error:
            self._fail(error)

    def is_behind(self, count: int) -> bool:
        return self._context is not None and self._count < count

    def step(self, edited: Context, count: int, seconds: float, stops: Callable[[float], bool]) -> bool:
        """Compares after each doubling of the samples, and when both kernels have equally many. Returns whether it compared."""
        if self._context is None:
            return False
        self._owed += SHARE * seconds
        try:
            if self.is_behind(count) and self._owed >= self._cost:
                self._accumulate(self._context, count, stops)
            samples = min(count, self._count)
            is_level = self._count == count and samples > self._looked_at
            if samples < FIRST_LOOK or not (is_level or samples >= 2 * self._looked_at):
                return False
            self._looks, self._looked_at = self._looks + 1, samples
            self._take(compare(edited.image(), self._context.image(), min_change=MIN_CHANGE, look=self._looks))
        except Error as error:
            self._fail(error)
        return True

    def close(self) -> None:
        if self._context:
            self._context.close()
        self._context = None

    def _accumulate(self, context: Context, count: int, stops: Callable[[float], bool]) -> None:
        begin = time.monotonic()
        most = int(self._owed / self._cost) if self._cost else 1
        context.accumulate(max(min(most, 2 * self._count, count - self._count), 1), progress=stops)
        taken = context.stats().sample_count - self._count
        elapsed = time.monotonic() - begin
        self._count += taken
        self._owed -= elapsed
        if taken:
            self._cost = elapsed / taken

    def _take(self, found: Comparison) -> None:
        """A difference remains the verdict, because the rate of false alarms holds for all comparisons together."""
        self._differs = self._differs or found.light == Light.DIFFERENT
        if found.light == Light.DIFFERENT or not self._differs:
            self.verdict = verdict_of(found)

    def _fail(self, error: Error) -> None:
        self.close()
        self.verdict = f"not compared with the built-in kernel: {error}"


def verdict_of(found: Comparison) -> str:
    if found.light == Light.DIFFERENT:
        return found.summary
    if found.light == Light.EQUAL_BITS:
        return "same bits as the built-in kernel"
    change = f"{100 * found.smallest_change:.2g}%"
    if found.light == Light.SAME:
        return f"same light as the built-in kernel to {change}"
    hidden = f"a change of {change}" if math.isfinite(found.smallest_change) else "any change"
    return f"not enough samples yet: {hidden} could be hidden"
