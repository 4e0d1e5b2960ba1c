"""The kernel itself, compiled with its hooks (shaders/trace.glsl), traces one sample of a pixel."""

from __future__ import annotations

import math
import pathlib
import tempfile
import threading
from dataclasses import dataclass, field, replace
from typing import Any, Final

import numpy as np
import numpy.typing as npt

from pt._camera import Camera, RenderSettings
from pt._columns import Array
from pt._context import Context
from pt._library import library_path
from pt._scene import Scene
from pt.view._code import SHADERS

HOOKS: Final = "trace.glsl"
HEADER, NUMBER, WORDS, VERTEX, THROUGHPUT, RADIANCE = 1, 2, 3, 4, 5, 6  # as in trace.glsl
FARTHEST: Final = 1e30  # farther vertices belong to rays that hit nothing
Doubles = npt.NDArray[np.float64]


@dataclass
class TracedVertex:
    """number       counts the path's vertices from 1; vertices of different branches may have the same number
    position     in world coordinates; for parallel rays relative to the plane where they start
    numbers      random numbers drawn since the previous vertex
    """

    number: int
    position: Doubles
    throughput: Doubles
    numbers: list[float]


@dataclass
class Trace:
    """radiance   of the sample
    numbers    random numbers drawn after the last vertex
    is_whole   False if the picture has too few pixels for all records
    """

    radiance: Doubles = field(default_factory=lambda: np.full(3, np.nan))
    vertices: list[TracedVertex] = field(default_factory=list)
    numbers: list[float] = field(default_factory=list)
    is_whole: bool = True


def kernels() -> pathlib.Path | None:
    here = pathlib.Path(__file__).resolve()
    places = (here.parents[1] / "shaders", pathlib.Path(library_path()).resolve().parents[1] / "share/pt/shaders",
              here.parents[4] / "shaders")
    return next((place for place in places if (place / "pathtrace.comp").exists()), None)


class Tracer:
    """Thread-safe."""

    def __init__(self, device: str | None, shader_dir: pathlib.Path | None) -> None:
        self._device, self._shader_dir = device, shader_dir
        self._lock = threading.Lock()
        self._folder: tempfile.TemporaryDirectory[str] | None = None
        self._context: Context | None = None
        self._scene: Scene | None = None

    def trace(self, scene: Scene, camera: Camera, settings: RenderSettings, x: int, y: int, sample: int) -> Trace:
        """Raises Error or ValueError."""
        if not (0 <= x < settings.width and 0 <= y < settings.height):
            raise ValueError(f"({x}, {y}): is no pixel of the picture")
        with self._lock:
            context = self._prepared(settings.width * y + x)
            if self._scene is not scene:
                context.set_scene(scene)
                self._scene = scene
            context.set_camera(camera)
            context.set_render(replace(settings, first_sample=sample, first_row=0, row_count=0, coverage=False))
            context.accumulate(1)
            return trace_of(context.readback(), camera)

    def close(self) -> None:
        with self._lock:
            if self._context:
                self._context.close()
            if self._folder:
                self._folder.cleanup()
            self._context = self._folder = None

    def _prepared(self, pixel: int) -> Context:
        source = self._shader_dir or kernels()
        if source is None or not (source / HOOKS).exists():
            raise ValueError(f"{source or 'the kernels'}: {HOOKS} is missing")
        self._folder = self._folder or tempfile.TemporaryDirectory()
        folder = pathlib.Path(self._folder.name)
        for path in source.iterdir():
            if path.suffix in SHADERS and path.is_file():
                text = path.read_text(encoding="utf-8", errors="replace")
                define = f"#define TRACE_PIXEL {pixel}u\n#line 1\n" if path.name == HOOKS else ""
                (folder / path.name).write_text(define + text, encoding="utf-8")
        if self._context is None:
            self._context = Context(self._device, shader_dir=folder)
        else:
            self._context.reload_shaders()
        return self._context


def trace_of(film: Array, camera: Camera) -> Trace:
    flat = film.reshape(-1, 3).astype(np.float64)
    unit = flat[0, 0] / 2**23
    pieces = (flat / unit if unit > 0.0 else flat).astype(np.uint64)
    rows = pieces[:len(pieces) // 2 * 2].reshape(-1, 2, 3)
    words = (rows[:, 0] << 8 | rows[:, 1] & 255).astype(np.uint32)
    kinds = rows[:, 1, 0] >> 8
    if not len(rows) or kinds[0] != HEADER or words[0, 0] != 2**31:
        raise ValueError("the kernel does not pass its samples to traced_sample() (trace.glsl)")
    count = int(words[0, 1])
    _, _, back = camera.axes()
    origin = np.array(camera.position) - (0.0 if camera._view_height(0.0) else float(words[0, 2:].view(np.float32)[0])) * back
    with np.errstate(invalid="ignore"):
        floats = words.view(np.float32).astype(np.float64)
    trace = Trace(is_whole=count <= len(rows))
    position = origin
    for kind, number, row, whole in zip(kinds[1:count] & 7, kinds[1:count] >> 3, floats[1:count], words[1:count]):
        if kind == NUMBER:
            trace.numbers.append(float(row[0]))
        elif kind == WORDS:
            trace.numbers.extend(((whole >> 8) / 2**24).tolist()[:number])
        elif kind == VERTEX:
            position = origin + row
        elif kind == THROUGHPUT and not np.abs(position).max() > FARTHEST:
            trace.vertices.append(TracedVertex(int(number), position, row, trace.numbers))
            trace.numbers = []
        elif kind == RADIANCE:
            trace.radiance = unit * row
    return trace


class Projection:
    """Places in the picture go from (0, 0) at the top left to (1, 1)."""

    def __init__(self, camera: Camera, settings: RenderSettings) -> None:
        right, above, back = camera.axes()
        self._camera, self._position = camera, np.array(camera.position)
        self._axes = np.array([right * settings.height / settings.width, -above, -back])

    def line(self, begin: Doubles, end: Doubles) -> list[float] | None:
        """Returns the two ends of the segment's visible part, or None if it is behind the camera."""
        a, b = (self._axes @ (point - self._position) for point in (begin, end))
        if not self._camera._view_height(0.0):
            near = 1e-3 * max(a[2], b[2])
            if not near > 0.0:
                return None
            a, b = (p if p[2] >= near else p + (q - p) * (near - p[2]) / (q[2] - p[2]) for p, q in ((a, b), (b, a)))
        line = [float(0.5 + place) for point in (a, b) for place in point[:2] / self._camera._view_height(point[2])]
        return line if all(map(math.isfinite, line)) else None


def message_of(trace: Trace, camera: Camera, settings: RenderSettings) -> dict[str, Any]:
    projection = Projection(camera, settings)
    last: dict[int, Doubles] = {}
    vertices, lines = [], []
    for vertex in trace.vertices:
        last[vertex.number] = vertex.position
        place = projection.line(vertex.position, vertex.position)
        vertices.append({"number": vertex.number, "position": _finite(vertex.position), "throughput": _finite(vertex.throughput),
                         "numbers": _finite(vertex.numbers), "place": place and place[:2]})
        before = last.get(vertex.number - 1)
        if before is not None and (line := projection.line(before, vertex.position)):
            lines.append(line)
    return {"radiance": _finite(trace.radiance), "vertices": vertices, "lines": lines, "numbers": _finite(trace.numbers),
            "is_whole": trace.is_whole}


def _finite(numbers: npt.ArrayLike) -> list[float | None]:
    return [number if math.isfinite(number) else None for number in np.asarray(numbers, np.float64).tolist()]
