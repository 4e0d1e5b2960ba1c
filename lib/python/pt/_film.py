from __future__ import annotations

import ctypes
import threading
import weakref
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from pt import _structs as structs
from pt import _zstd
from pt._callbacks import CallbackGuard
from pt._enums import Estimator, Format, Quantity, RenderFlag, Result, Sampler
from pt._errors import IncompatibleError
from pt._files import Path, regular, write_atomically
from pt._image import Image
from pt._library import checked, library
from pt._pixels import Rectangle, image_struct, new_pixels
from pt._stats import ErrorEstimate, Stats, error_estimate_of, stats_of

TILE_SIDE = 8


@dataclass(frozen=True)
class FilmInfo:
    width: int
    height: int
    x: int  # left edge of the smallest rectangle around the film's pixels
    y: int
    columns: int
    rows: int
    max_path_length: int
    seed: int
    estimator: Estimator
    sampler: Sampler
    lamp_sample_count: int  # samples that a pixel needs to hit all lamps smaller than a pixel; 0 without such lamps
    device: str  # models and drivers
    coverage: bool


@dataclass(frozen=True)
class FilmTile:
    """A rectangle of pixels with the same sample indices."""

    x: int
    y: int
    width: int
    height: int
    samples: tuple[range, ...]  # ranges of indices, ascending and not adjacent


class Film:
    """The samples of an image as exact sums, without device and scene. A film takes 112 bytes per pixel.

    Films with other samples or pixels of the same picture can be added by + or sum() in any order. The result has the
    bits of one long rendering.

    Film(data) reads the bytes of another film. Untrusted bytes are safe; damaged ones raise IncompatibleError.
    Concurrent calls wait for one another.
    """

    def __init__(self, data: bytes) -> None:
        self._library = library()
        self._lock = threading.RLock()
        self._handle = ctypes.c_void_p()
        data = _unpacked(bytes(data))
        checked(self._library, self._library.pt_open_film(data, len(data), self._handle))
        weakref.finalize(self, self._library.pt_close_film, self._handle)

    @classmethod
    def load(cls, path: Path) -> Film:
        """Reads a file that save() or pt wrote. Films packed by pt need Python 3.14 or the module zstandard."""
        with open(path, "rb", opener=regular) as file:
            return cls(file.read())

    def save(self, path: Path) -> None:
        """Writes a file atomically. `pt merge` can read it."""
        write_atomically(path, lambda file: self.stream(file.write))

    def stream(self, write: Callable[[bytes], object]) -> None:
        """Passes to_bytes() to a function in pieces of at most a megabyte, without a copy. Raises its exception."""
        guard = CallbackGuard()

        def take(_: object, data: int, size: int) -> int:
            if guard.error is None:
                write(ctypes.string_at(data, size))
            return int(guard.error is not None)

        guard.watch(take)
        with guard:
            self._call("pt_stream_film", structs.pt_take_bytes_fn(take), None)
        guard.raise_caught()

    def to_bytes(self) -> bytes:
        """Returns the bytes that lib/film/FORMAT.md describes. Equal samples give equal bytes."""
        return bytes_from(lambda data, size: self._call("pt_write_film", data, size))

    @property
    def size(self) -> int:
        size = ctypes.c_uint64()
        self._call("pt_write_film", None, size)
        return size.value

    def __add__(self, other: Film) -> Film:
        if not isinstance(other, Film):
            return NotImplemented
        total = Film(self.to_bytes())
        total += other
        return total

    def __radd__(self, other: int) -> Film:
        if other != 0:
            return NotImplemented
        return self

    def __iadd__(self, other: Film) -> Film:
        """Raises IncompatibleError, with a line for each difference, for another picture or repeated samples."""
        if not isinstance(other, Film):
            return NotImplemented
        data = other.to_bytes()
        self._call("pt_merge_film", data, len(data))
        return self

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Film):
            return NotImplemented
        return self.to_bytes() == other.to_bytes()

    __hash__ = None  # type: ignore[assignment] # += changes the film

    def __reduce__(self) -> tuple[type[Film], tuple[bytes]]:
        return Film, (self.to_bytes(),)

    def __repr__(self) -> str:
        info = self.info
        return f"<pt.Film of {info.columns}x{info.rows} pixels, {self.stats().sample_count} samples or more>"

    @property
    def info(self) -> FilmInfo:
        struct = structs.pt_film_info()
        with self._lock:
            self._call("pt_get_film_info", struct)
            values: dict[str, Any] = {name: getattr(struct, name, None) for name in FilmInfo.__dataclass_fields__}
            values.update(device=struct.device.decode(errors="replace"), estimator=Estimator(struct.estimator),
                          sampler=Sampler(struct.sampler), coverage=bool(struct.flags & RenderFlag.COVERAGE))
            return FilmInfo(**values)

    @property
    def tiles(self) -> list[FilmTile]:
        """Returns a single tile if all pixels have the same samples."""
        with self._lock:
            info = structs.pt_film_info()
            self._call("pt_get_film_info", info)
            return [self._tile(index) for index in range(info.tile_count)]

    def readback(self, quantity: Quantity = Quantity.RADIANCE, *, out: npt.NDArray[Any] | None = None,
                 rectangle: Rectangle | None = None, format: Format = Format.RGB32F) -> npt.NDArray[Any]:
        """Returns the rectangle of FilmInfo, with the bits of Context.readback. Missing pixels are black and have an
        infinite standard error."""
        with self._lock:
            info = self.info
            shape = info.rows, info.columns
            pixels = new_pixels(shape, rectangle, format) if out is None else out
            self._call("pt_read_film", image_struct(pixels, quantity, shape, rectangle))
        return pixels

    def stats(self) -> Stats:
        struct = structs.pt_stats()
        self._call("pt_get_film_stats", struct)
        return stats_of(struct)

    def error_estimate(self) -> ErrorEstimate:
        """Sets Uncertain.UNMET if the estimator hits lamps only by chance, because a film does not have the scene's lamps."""
        struct = structs.pt_error_estimate()
        self._call("pt_get_film_error_estimate", struct)
        return error_estimate_of(struct)

    def image(self) -> Image:
        with self._lock:
            info = self.info
            return Image(self.readback(Quantity.RADIANCE), self.readback(Quantity.STANDARD_ERROR),
                         self.readback(Quantity.SAMPLE_COUNT), self.error_estimate(), self.stats(),
                         sampler=info.sampler, estimator=info.estimator,
                         coverage=self.readback(Quantity.COVERAGE) if info.coverage else None)

    def plan(self, target_error: float, most: int) -> tuple[Result, npt.NDArray[np.uint32]]:
        """Plans the next samples towards a target error, like Context.accumulate.

        target_error   > 0; 0.01 is 1%
        most           most samples of a pixel

        Returns a result and the wanted sample counts of the 8 x 8 pixel tiles, shape (rows, columns), for
        Context.accumulate_tiles. The result is Result.PENDING, Result.TARGET_REACHED, or Result.OK if no tile may have
        more samples. The film keeps its plans. Raises IncompatibleError if pixels of one tile have different samples."""
        with self._lock:
            info, count = self.info, ctypes.c_uint32()
            self._call("pt_plan_film", target_error, most, None, count)
            goals = np.zeros((-(-info.rows // TILE_SIDE), -(-info.columns // TILE_SIDE)), np.uint32)
            pointer = goals.ctypes.data_as(ctypes.POINTER(ctypes.c_uint32))
            return self._call("pt_plan_film", target_error, most, pointer, count), goals

    def _tile(self, index: int) -> FilmTile:
        tile = structs.pt_film_tile()
        self._call("pt_get_film_tile", index, tile)
        count = ctypes.c_uint32(tile.range_count)
        ranges = (structs.pt_sample_range * count.value)()
        self._call("pt_get_film_ranges", index, ranges, count)
        return FilmTile(tile.x, tile.y, tile.width, tile.height, tuple(range(r.first, r.end) for r in ranges))

    def _call(self, function: str, *arguments: Any) -> Result:
        with self._lock:
            return checked(self._library, getattr(self._library, function)(self._handle, *arguments))


def bytes_from(write: Callable[[Any, ctypes.c_uint64], object]) -> bytes:
    """`write` fills the bytes in place, because a film may have hundreds of megabytes."""
    size = ctypes.c_uint64()
    write(None, size)
    allocated = size.value
    data = ctypes.pythonapi.PyBytes_FromStringAndSize
    data.restype, data.argtypes = ctypes.py_object, (ctypes.c_char_p, ctypes.c_ssize_t)
    written: bytes = data(None, allocated)
    write(ctypes.c_char_p(written), size)
    return written if size.value == allocated else written[:size.value]


def _unpacked(data: bytes) -> bytes:
    if not data.startswith(_zstd.MAGIC):
        return data
    module = _zstd.module()
    if module is None:
        raise IncompatibleError("the film is packed: install the Python module zstandard, or unpack it by zstd -d")
    try:
        return bytes(module.decompress(data))
    except Exception as error:
        raise IncompatibleError(f"the film's zstd frame is damaged: {error}") from error
