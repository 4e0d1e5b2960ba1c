from __future__ import annotations

import math
import pathlib
import threading
import time
from collections.abc import Callable
from dataclasses import replace
from typing import Any, Final

from pt._columns import Array
from pt._context import Context
from pt._enums import Quantity, Result
from pt._errors import DeviceLostError, Error, InvalidSceneError
from pt._pixels import Rectangle
from pt._stats import ErrorEstimate
from pt.view._built_in import SHARE, BuiltIn
from pt.view._code import SHADERS, code_of
from pt.view._course import Course
from pt.view._frame import LAYERS, OF_SAMPLES, Frame, facts_of, faults_of, name_of
from pt.view._rejected import rejected_samples
from pt.view._source import Shown, Source
from pt.view._trace import Tracer, message_of

MOVING_SECONDS: Final = 0.03  # time for one sample of all pixels while the camera moves
STILL_SECONDS: Final = 0.25
PUBLISHED_SHARE: Final = 0.03
LOOK_SECONDS: Final = 0.5
CODE: Final = (*SHADERS, ".json")


class Renderer:
    """Calls published() for each frame, on the rendering thread."""

    def __init__(self, source: Source, published: Callable[[Frame], None], *, shader_dir: pathlib.Path | None = None,
                 device: str | None = None, most: int = 65536, size: tuple[int, int] | None = None,
                 is_course: bool = False) -> None:
        self._source, self._published, self._device, self._most = source, published, device, most
        self._shader_dir = shader_dir
        self._built_in: BuiltIn | None = None
        self._tracer = Tracer(device, shader_dir)
        self._course = Course(shader_dir, device, lambda: self.change(judged=True)) if shader_dir and is_course else None
        self._begins = True
        self._context: Context | None = None
        self._faults: dict[str, str] = {}
        self._history: list[list[float]] = []
        self._guides: dict[str, Array] = {}
        self._playing, self._moving, self._layer = True, False, "radiance"
        self._seconds = self._rate = self._next_publish = self._next_look = self._still = 0.0
        self._scale, self._count, self._shape, self._cost = 1, 0, (0, 0), math.inf
        self._revision = 0
        self._condition = threading.Condition()
        self._changes: dict[str, Any] = {}
        self._is_watched = self._is_closed = False
        self.frame = Frame(0, {}, None)
        self._shown = source.read()
        self._camera = self._shown.camera
        self._settings = self._shown.settings
        if size:
            self._settings = replace(self._settings, width=size[0], height=size[1])
        self._signatures = self._look()
        self._code = {path: code_of(path) for path in self._signatures if path.suffix in CODE}
        self._publish()
        if self._course:
            self._course.check()
        self._thread = threading.Thread(target=self._run, name="pt-view", daemon=True)
        self._thread.start()

    def change(self, **changes: Any) -> None:
        """`changes` may have camera, moving, size, layer, playing, method (fields of RenderSettings), and files (True: check now)."""
        with self._condition:
            self._changes.update(changes)
            self._condition.notify()

    def watch(self, is_watched: bool) -> None:
        with self._condition:
            self._is_watched = is_watched
            self._condition.notify()

    def close(self) -> None:
        with self._condition:
            self._is_closed = True
            self._condition.notify()
        self._thread.join()
        self._tracer.close()
        if self._course:
            self._course.close()

    def trace(self, x: int, y: int, sample: int) -> dict[str, Any]:
        camera, settings = self._camera, self._settings
        return message_of(self._tracer.trace(self._shown.scene, camera, settings, x, y, sample), camera, settings)

    def saved(self) -> tuple[str, bytes] | None:
        return self._source.saved(self._camera)

    # The functions below run on the rendering thread.

    def _run(self) -> None:
        while True:
            with self._condition:
                self._condition.wait_for(lambda: self._changes or self._is_closed or self._is_watched and self._runs(),
                                         LOOK_SECONDS if self._is_watched else None)
                changes, self._changes = self._changes, {}
                if self._is_closed:
                    break
            try:
                self._step(changes)
            except DeviceLostError as error:
                self._drop(error)
            except (Error, ValueError, OSError) as error:
                self._faults["rendering"] = (self._source.explained(error) if isinstance(error, InvalidSceneError)
                                             else str(error))
                self._publish()
        for each in (self._context, self._built_in):
            if each:
                each.close()

    def _runs(self) -> bool:
        """A paused picture still gets one sample after a restart."""
        wanted = self._playing or self._moving or not self._count
        is_behind = self._built_in is not None and self._built_in.is_behind(self._count)
        return wanted and (self._count < self._most or is_behind) and "rendering" not in self._faults

    def _stops(self, _: float) -> bool:
        return bool(self._changes) or self._is_closed

    def _drop(self, error: Error) -> None:
        if self._context:
            self._context.close()
        self._context = None
        self._faults["rendering"] = str(error)
        self._publish(with_picture=False)

    def _step(self, changes: dict[str, Any]) -> None:
        now = time.monotonic()
        restarts = self._take(changes)
        if self._moving and now > self._still:
            self._moving, restarts = False, restarts or self._scale > 1
        if "files" in changes or now > self._next_look:
            self._next_look = now + LOOK_SECONDS
            restarts = self._read_again() or restarts
        if self._context is None:
            if not restarts and self._faults:
                return
            self._context = Context(self._device, submit_milliseconds=20, shader_dir=self._shader_dir)
            self._faults.clear()
            self._context.set_scene(self._shown.scene)
            restarts = True
        if restarts:
            self._restart(self._context)
        if self._is_watched and self._runs():
            if self._count < self._most:
                self._accumulate(self._context)
            elif self._compare(self._context, STILL_SECONDS / SHARE) or changes:
                self._publish()
        elif changes:
            self._publish()

    def _take(self, changes: dict[str, Any]) -> bool:
        self._playing = changes.get("playing", self._playing)
        self._layer = changes.get("layer", self._layer)
        width, height = changes.get("size", (self._settings.width, self._settings.height))
        settings = replace(self._settings, width=width, height=height, **changes.get("method", {}))
        restarts = settings != self._settings or "camera" in changes
        if changes.get("moving"):
            self._moving, self._still = True, time.monotonic() + STILL_SECONDS
        self._settings, self._camera = settings, changes.get("camera") or self._camera
        return restarts

    def _restart(self, context: Context) -> None:
        """While the camera moves, pixels are large enough for MOVING_SECONDS."""
        pixels = self._settings.width * self._settings.height
        self._scale = 1
        if self._moving and self._rate:
            self._scale = min(max(math.ceil(math.sqrt(pixels / (self._rate * MOVING_SECONDS))), 1), 16)
        width, height = (max(side // self._scale, 1) for side in (self._settings.width, self._settings.height))
        self._shape = height, width
        self._faults.pop("rendering", None)
        context.set_camera(self._camera)
        context.set_render(replace(self._settings, width=width, height=height))
        self._history, self._seconds, self._count, self._next_publish, self._cost = [], 0.0, 0, 0.0, math.inf
        self._guides.clear()
        self._begins = True

    def _accumulate(self, context: Context) -> None:
        begin = time.monotonic()
        pixels = math.prod(self._shape)
        due = max(self._next_publish - begin, 0.0)
        count = min(max(int(due * self._rate / pixels), 1), self._most - self._count, max(2 * self._count, 1))
        result = context.accumulate(count, progress=self._stops)
        now = time.monotonic()
        self._seconds += now - begin
        taken = context.stats().sample_count - self._count
        self._count += taken
        if result == Result.OK and self._count > taken:
            self._rate = count * pixels / (now - begin)
        elif not self._rate:
            self._rate = pixels / (now - begin)
        self._compare(context, now - begin)
        now = time.monotonic()
        if self._count and (now >= self._next_publish or self._count >= self._most):
            self._publish()
            self._cost = min(time.monotonic() - now, self._cost)
            pause = min(max(self._cost / PUBLISHED_SHARE, min(self._seconds / 10, 2.0)), self._seconds)
            pause = 0.0 if self._moving else max(pause, 0.1)
            self._next_publish = time.monotonic() + pause

    def _compare(self, context: Context, seconds: float) -> bool:
        if self._built_in is None or self._moving:
            return False
        if self._begins:
            self._begins = False
            self._built_in.begin(self._shown.scene, self._camera, self._settings)
        return self._built_in.step(context, self._count, seconds, self._stops)

    def _look(self) -> dict[pathlib.Path, tuple[int, int]]:
        files = [*self._shown.files, *(self._shader_dir.glob("*") if self._shader_dir else ())]
        found = {}
        for path in files:
            try:
                facts = path.stat()
                found[path] = (facts.st_mtime_ns, facts.st_size)
            except OSError:
                found[path] = (0, 0)
        return found

    def _read_again(self) -> bool:
        signatures = self._look()
        changed = {path for path, facts in signatures.items() if self._signatures.get(path) != facts}
        self._signatures = signatures
        self._revision += bool(changed)
        edited = {path for path in changed if self._is_edited(path)}
        if changed and not edited:
            self._publish()
        restarts = False
        if edited.intersection(self._shown.files):
            try:
                shown = self._source.read()
                if self._context:
                    self._context.set_scene(shown.scene)
                self._faults.pop("scene", None)
                self._adopt(shown)
                restarts = True
            except (Error, ValueError, OSError) as error:
                self._faults["scene"] = self._source.explained(error)
                self._publish()
        if any(path.suffix in SHADERS for path in edited.difference(self._shown.files)) and self._context:
            if self._course:
                self._course.check()
            try:
                self._context.reload_shaders()
                self._faults.pop("shaders", None)
                self._built_in = self._built_in or BuiltIn(self._device)
                restarts = True
            except Error as error:
                self._faults["shaders"] = str(error)
                self._publish()
        return restarts or bool(edited and not self._context)

    def _is_edited(self, path: pathlib.Path) -> bool:
        """Ignores changes of comments alone, unless there are faults, whose line numbers may then change."""
        if path.suffix not in CODE:
            return True
        before, self._code[path] = self._code.get(path), code_of(path)
        return bool(self._faults) or before != self._code[path]

    def _adopt(self, shown: Shown) -> None:
        """Keeps settings that the user has changed in the page."""
        if shown.camera != self._shown.camera:
            self._camera = shown.camera
        fields = {name: value for name, value in vars(shown.settings).items()
                  if value != getattr(self._shown.settings, name)}
        self._settings = replace(self._settings, **fields)
        self._shown = shown
        self._signatures = self._look()

    def _publish(self, with_picture: bool = True) -> None:
        pixels, values, spoilt = self.frame.pixels, self.frame.values, self.frame.spoilt
        facts: dict[str, Any] = {}
        context = self._context
        if context and self._count and with_picture:
            values = tuple(context.readback(quantity) for quantity in list(LAYERS.values())[:OF_SAMPLES])
            pixels = self._layer_pixels(context, values)
            rejected = context.stats().rejected_samples
            spoilt = rejected_samples(context.film()) > 0 if rejected else None
            facts = {"rejected": rejected, "spoilt": 0 if spoilt is None else int(spoilt.sum()), "device": context.device.name}
            if not self._moving:
                estimate = context.error_estimate()
                self._remember(estimate)
                facts.update(facts_of(estimate), pivot=self._pivot(context))
        kept = {name: self.frame.state.get(name) for name in
                ("error", "low", "high", "uncertain", "pivot", "rejected", "spoilt", "device")}
        camera = self._camera
        self._emit({**kept, **facts, "name": self._source.path.name, "samples": self._count, "seconds": self._seconds, "playing": self._playing,
                    "moving": self._moving, "layer": self._layer, "history": list(self._history),
                    "size": [self._settings.width, self._settings.height], "camera": camera._section(),
                    "first_camera": self._shown.camera._section(), "display": vars(self._shown.display),
                    "max_path_length": self._settings.max_path_length, "sampler": name_of(self._settings.sampler),
                    "estimator": name_of(self._settings.estimator), "revision": self._revision,
                    "course": self._course.state if self._course else None, "is_course": self._course is not None,
                    "verdict": self._built_in.verdict if self._built_in else "",
                    "faults": [fault for text in self._faults.values() for fault in faults_of(text)]}, pixels, values, spoilt)

    def _emit(self, state: dict[str, Any], pixels: Array | None, values: tuple[Array, ...], spoilt: Array | None) -> None:
        if pixels is not None:
            state["height"], state["width"] = pixels.shape[:2]
        self.frame = Frame(self.frame.number + 1, state, pixels, values, spoilt)
        self._published(self.frame)

    def _layer_pixels(self, context: Context, values: tuple[Array, ...]) -> Array:
        index = list(LAYERS).index(self._layer)
        if index < OF_SAMPLES:
            return values[index]
        if self._layer not in self._guides:
            self._guides[self._layer] = context.readback(LAYERS[self._layer])
        return self._guides[self._layer]

    def _pivot(self, context: Context) -> float | None:
        if "pivot" not in self._guides:
            rows, columns = self._shape
            middle: Rectangle = (columns // 2, rows // 2, 1, 1)
            self._guides["pivot"] = context.readback(Quantity.DEPTH, rectangle=middle)
        depth = float(self._guides["pivot"][0, 0, 0])
        return depth if math.isfinite(depth) else None

    def _remember(self, estimate: ErrorEstimate) -> None:
        if math.isfinite(estimate.relative_rmse_high):
            self._history.append([self._seconds, estimate.relative_rmse, estimate.relative_rmse_low,
                                  estimate.relative_rmse_high])
            if len(self._history) > 128:
                del self._history[1:-1:2]
