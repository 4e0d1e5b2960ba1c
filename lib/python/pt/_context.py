from __future__ import annotations

import ctypes
import warnings
import weakref
from dataclasses import replace
from types import TracebackType
from typing import Any

import numpy as np
import numpy.typing as npt

from pt import _structs as structs
from pt._callbacks import CallbackGuard, Log, Progress, log_function
from pt._camera import Camera, RenderSettings
from pt._denoise import OTHER_SEED, Pixels, denoise_rounds
from pt._enums import CreateFlag, Format, Quantity, Result, Sampling
from pt._errors import BrokenRule, InvalidStateError
from pt._files import Path
from pt._film import Film, bytes_from
from pt._image import Image
from pt._library import broken_rule_of, checked, library
from pt._pixels import Rectangle, image_struct, new_pixels
from pt._scene import Scene, SceneStruct
from pt._stats import DeviceInfo, ErrorEstimate, Stats, device_of, error_estimate_of, stats_of
from pt._text import c_string

MOST_SAMPLES = 2**32 - 1


class Context:
    """A renderer for one scene, camera and settings at a time.

    device                index into devices(), "gpu", "cpu", a UUID, or part of a name; None: the best. "all", or a list
                          with commas, shares the samples among several devices
    log                   called with level and line during any call
    validation            whether the Khronos validation layer reports to log; UnsupportedError if it is missing
    scene_kernels         whether kernels may have a scene's numbers as constants; False suits scenes that often change
    submit_milliseconds   intended length of a submission, in [1, 1000]; calls can stop after each
    shader_dir            GLSL files that replace the library's kernels (pt/shaders.h); ShaderError if one does not compile

    Contexts are independent, and calls release the interpreter's lock. A second concurrent call on a context, also from
    a callback, raises InvalidStateError. A child of os.fork() cannot use its parent's contexts: start processes with
    multiprocessing.get_context("spawn").

    Callbacks run on the calling thread. After an exception in a callback or a signal handler, the call stops at its
    next callback and raises the exception. The context stays usable. Progress functions get the finished fraction.

    A broken rule raises InvalidArgumentError, in scenes InvalidSceneError. Reading an image before the first sample
    raises InvalidStateError.
    """

    def __init__(self, device: str | None = None, *, log: Log | None = None, validation: bool = False,
                 scene_kernels: bool = True, submit_milliseconds: int = 50,
                 shader_dir: Path | None = None) -> None:
        self._library = library()
        self._in_call = False
        self._settings: RenderSettings | None = None
        self._log = log
        # The log may refer to the context, so this reference is weak.
        this = weakref.ref(self)
        self._log_function = log_function(lambda: getattr(this(), "_log", None))
        log_pointer = structs.pt_log_fn(self._log_function)
        flags = CreateFlag.VALIDATION * validation | CreateFlag.NO_SCENE_KERNELS * (not scene_kernels)
        if device == "":
            raise ValueError("device = '': must name a device; None is the best one")
        if not 1 <= submit_milliseconds <= 1000:
            raise ValueError(f"submit_milliseconds = {submit_milliseconds}: must be in [1, 1000]")
        info = structs.pt_create_info(device=c_string(device), flags=flags,
                                      submit_milliseconds=submit_milliseconds,
                                      shader_dir=c_string(shader_dir))
        if log is not None:
            info.log = log_pointer
        handle = ctypes.c_void_p()
        guard = self._guard()
        with guard:
            result = self._library.pt_create(info, handle)
        checked(self._library, result)
        self._handle: ctypes.c_void_p | None = handle
        self._finalizer = weakref.finalize(self, _destroy, self._library, handle, log_pointer)
        guard.raise_caught()

    def close(self) -> None:
        """Raises InvalidStateError if another call is running."""
        if self._handle is None:
            return
        if self._in_call:
            raise InvalidStateError("the context cannot be closed while a call on it is under way")
        self._handle = None
        self._finalizer()

    def __enter__(self) -> Context:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None,
                 traceback: TracebackType | None) -> None:
        self.close()

    def __repr__(self) -> str:
        return "<pt.Context, closed>" if self._handle is None else f"<pt.Context on {self.device.name}>"

    @property
    def device(self) -> DeviceInfo:
        """With several devices, the first one."""
        info = structs.pt_device_info()
        self._call("pt_get_context_device", info)
        return device_of(info)

    def set_scene(self, scene: Scene, progress: Progress | None = None) -> Result:
        """Discards all samples. If progress returns True, returns Result.CANCELLED and changes nothing. An exception
        after progress(1) may come too late to stop the call."""
        guard = self._guard()
        scene_struct = SceneStruct(scene, guard, progress)
        return self._call("pt_set_scene", scene_struct.struct, guard=guard)

    def set_camera(self, camera: Camera) -> None:
        """Discards all samples."""
        self._call("pt_set_camera", camera._struct())

    def set_render(self, settings: RenderSettings) -> None:
        """Discards all samples. Takes 112 bytes of device memory per pixel, 116 with coverage. After UnsupportedError or
        OutOfDeviceMemoryError, render fewer rows at a time."""
        self._call("pt_set_render", settings._struct())
        self._settings = settings

    def reload_shaders(self) -> None:
        """Compiles shader_dir again. Discards the samples if kernels change. Raises InvalidStateError without shader_dir."""
        self._call("pt_reload_shaders")

    def prepare(self) -> None:
        """Builds the kernels of accumulate. Cannot be interrupted."""
        self._call("pt_prepare")

    def accumulate(self, sample_count: int, *, target_error: float = 0.0, time_limit: float = 0.0, sample_limit: int = 0,
                   sampling: Sampling = Sampling.BEST, progress: Progress | None = None) -> Result:
        """Adds samples to every pixel.

        sample_count   >= 1; with a target error, the most to add
        target_error   0: none. Otherwise returns Result.TARGET_REACHED once ErrorEstimate.relative_rmse_high is at most
                       this value (0.01 is 1%) and there are enough samples to hit lamps smaller than a pixel
        time_limit     0: none. Otherwise returns Result.LIMIT_REACHED after this number of seconds, with at least one sample
        sample_limit   with a target error, the most samples of a pixel after this and later calls; 0: after this call
        sampling       by default adaptive with a target error, else uniform
        progress       called about 20 times a second; if it returns True, the call returns Result.CANCELLED and keeps
                       the complete samples
        """
        if not 0 <= sample_count <= MOST_SAMPLES:
            raise ValueError(f"sample_count = {sample_count}: must be in [1, {MOST_SAMPLES}]")
        guard = self._guard()
        info = structs.pt_accumulate_info(sample_count=sample_count, sample_limit=sample_limit, sampling=sampling,
                                          progress=guard.progress(progress), stopping=(target_error, time_limit))
        return self._call("pt_accumulate", info, guard=guard)

    def accumulate_tiles(self, samples: npt.ArrayLike, *, progress: Progress | None = None) -> Result:
        """`samples` has a number for each tile, shape (rows, columns) or flat, for instance by Film.plan. Tiles are 8 x 8
        pixels from the top left of the rendered part, smaller at the right and lower edges."""
        counts = np.ascontiguousarray(samples, dtype=np.uint32).ravel()
        guard = self._guard()
        info = structs.pt_accumulate_info(
            sample_count=int(counts.max(initial=0)), progress=guard.progress(progress),
            tile_samples=counts.ctypes.data_as(ctypes.POINTER(ctypes.c_uint32)), tile_count=len(counts))
        return self._call("pt_accumulate", info, guard=guard)

    def readback(self, quantity: Quantity = Quantity.RADIANCE, *, out: npt.NDArray[Any] | None = None,
                 rectangle: Rectangle | None = None, format: Format = Format.RGB32F) -> npt.NDArray[Any]:
        """Returns the current image, shape (height, width, channels).

        quantity    OBJECT needs the format R32UI
        out         receives the pixels and is returned: float32 with 3 or 4 channels, float16 with 4 or uint32 with 1.
                    Pixels of a row must be adjacent; rows may have any stride. ValueError if the image does not fit
        rectangle   x, y, width, height in pixels, from the top left of the rendered part; None for all
        format      pixel format of a new array
        """
        shape = self._rendered().shape()
        pixels = new_pixels(shape, rectangle, format) if out is None else out
        self._call("pt_readback", image_struct(pixels, quantity, shape, rectangle))
        return pixels

    def stats(self) -> Stats:
        struct = structs.pt_stats()
        self._call("pt_get_stats", struct)
        return stats_of(struct)

    def warning(self) -> BrokenRule | None:
        """Names the surface that rounding moves farthest, if by more than a pixel, with advice."""
        struct = structs.pt_broken_rule()
        self._call("pt_get_warning", struct)
        return broken_rule_of(struct) if struct.subject else None

    def error_estimate(self) -> ErrorEstimate:
        """The first call after new samples examines all pixels."""
        struct = structs.pt_error_estimate()
        self._call("pt_get_error_estimate", struct)
        return error_estimate_of(struct)

    def film(self) -> Film:
        return Film(bytes_from(lambda data, size: self._call("pt_save_film", data, size)))

    def add_film(self, film: Film) -> None:
        """Adds samples of the same scene, camera and settings (first_sample may differ). Raises IncompatibleError for
        another picture or repeated samples."""
        data = film.to_bytes()
        self._call("pt_add_film", data, len(data))

    def image(self) -> Image:
        settings = self._rendered()
        return Image(self.readback(Quantity.RADIANCE), self.readback(Quantity.STANDARD_ERROR),
                     self.readback(Quantity.SAMPLE_COUNT), self.error_estimate(), self.stats(),
                     sampler=settings.sampler, estimator=settings.estimator,
                     coverage=self.readback(Quantity.COVERAGE) if settings.coverage else None)

    def render(self, scene: Scene, camera: Camera, settings: RenderSettings, samples: int, *, target_error: float = 0.0,
               time_limit: float = 0.0, progress: Progress | None = None, denoise: bool = False) -> Image:
        """Returns the image, also after progress returned True. A UserWarning has the text of warning(). `denoise` calls
        pt.denoise for two images, each with half of the samples; target_error then applies to the result."""
        self.set_scene(scene)
        self.set_camera(camera)
        if denoise:
            image = _render_denoised(self, settings, samples, (target_error, time_limit), progress)
        else:
            self.set_render(settings)
            self.accumulate(samples, target_error=target_error, time_limit=time_limit, progress=progress)
            image = self.image()
        if (displaced := self.warning()) is not None:
            warnings.warn(str(displaced), stacklevel=2)
        return image

    def _rendered(self) -> RenderSettings:
        if self._settings is None:
            raise InvalidStateError("there is no image: set_render was not called")
        return self._settings

    def _guard(self) -> CallbackGuard:
        guard = CallbackGuard()
        guard.watch(self._log_function)
        return guard

    def _call(self, function: str, *arguments: Any, guard: CallbackGuard | None = None) -> Result:
        handle, guard = self._handle, guard or self._guard()
        if handle is None:
            raise InvalidStateError("the context is closed")
        # Not a lock: KeyboardInterrupt may come after acquire() and before `try`. It cannot come between this test and `try`. Without a
        # global interpreter lock (PEP 703) the library itself refuses a second call.
        if self._in_call:
            raise InvalidStateError("another call on this context is under way")
        self._in_call = True
        try:
            with guard:
                result = getattr(self._library, function)(handle, *arguments)
            guard.raise_caught()
            return checked(self._library, result, handle)
        finally:
            self._in_call = False


def _render_denoised(context: Context, settings: RenderSettings, samples: int, stopping: tuple[float, float],
                    progress: Progress | None) -> Image:
    most = max(samples // 2, 1)
    halves = [settings, replace(settings, seed=settings.seed ^ OTHER_SEED)]
    films: list[Film | None] = [None, None]
    parts: list[tuple[Pixels, Stats, Pixels | None]] = []
    guides: tuple[Pixels, ...] = ()
    done, taken, is_stopped = 0, 0, False

    def add_round(count: int) -> list[Pixels] | None:
        nonlocal parts, guides, done, taken

        def share_of_all(fraction: float) -> bool:
            nonlocal is_stopped
            is_stopped = bool(progress and progress((taken + (count - done) * fraction) / (2 * most)))
            return is_stopped

        added = []
        for index, half in enumerate(halves):
            if is_stopped:
                return None
            context.set_render(half)
            if film := films[index]:
                context.add_film(film)
            if context.accumulate(count - done, progress=share_of_all if progress else None) == Result.CANCELLED:
                return None
            taken += count - done
            films[index] = context.film() if any(stopping) else None
            coverage = context.readback(Quantity.COVERAGE) if settings.coverage else None
            added.append((context.readback(), context.stats(), coverage))
        guides = guides or (context.readback(Quantity.ALBEDO), context.readback(Quantity.NORMAL))
        parts, done = added, count
        return [parts[0][0], parts[1][0], *guides]

    radiance, error = denoise_rounds(add_round, (*settings.shape(), 3), most, stopping)
    if not parts:
        raise InvalidStateError("the samples ended before there were two images to denoise")
    (first, of_first, coverage), (second, of_second, other_coverage) = parts
    if coverage is not None and other_coverage is not None:
        coverage = (coverage + other_coverage) / 2
    summed = ("sample_count", "max_sample_count", "mean_sample_count", "rejected_samples")
    stats = replace(of_second, **{name: getattr(of_first, name) + getattr(of_second, name) for name in summed})
    counts = np.full((*first.shape[:2], 1), stats.sample_count)
    return Image(radiance, np.abs(first - second) / 2, counts, error, stats, raw=(first + second) / 2,
                 sampler=settings.sampler, estimator=settings.estimator, coverage=coverage)


def _destroy(loaded: ctypes.CDLL, handle: ctypes.c_void_p, _log: object) -> None:
    """`_log` keeps the library's callbacks alive until the context is destroyed."""
    loaded.pt_destroy(handle)
