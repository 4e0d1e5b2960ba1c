from __future__ import annotations

import ctypes
import functools
import json
import os
import pathlib
import sys
from collections.abc import Iterable, Mapping
from ctypes import POINTER, c_char_p, c_int32, c_uint32, c_void_p
from dataclasses import dataclass, field, fields
from typing import Any, Final

import numpy as np

from pt import _structs as structs
from pt._camera import Camera, RenderSettings
from pt._columns import Array
from pt._enums import ColumnType, Curve, Estimator, MaterialFlag, Projection, Sampler, SceneFileFlag
from pt._errors import ERROR_OF_RESULT, BrokenRule, Error, InvalidArgumentError, InvalidSceneError
from pt._files import Path
from pt._library import VERSION, library_path
from pt._scene import Material, Plane, Scene, Sphere, SphereArray
from pt._text import c_string
from pt._vectors import Vector

SONAME: Final = {"win32": "pt-scene.dll", "darwin": f"libpt-scene.{VERSION}.dylib"}.get(
    sys.platform, f"libpt-scene.so.{VERSION}")
CURVES: Final = tuple(each.name.lower() for each in Curve)
TYPES: Final = {ColumnType.FLOAT32: np.float32, ColumnType.FLOAT64: np.float64, ColumnType.UINT32: np.uint32,
                ColumnType.SRGB8: np.uint8}
PARAMETERS: Final[dict[str, list[Any]]] = {
    "pt_open_scene_file": [POINTER(structs.pt_scene_file_info), POINTER(c_void_p)],
    "pt_close_scene_file": [c_void_p],
    "pt_get_scene_file": [c_void_p, POINTER(structs.pt_scene), POINTER(structs.pt_camera), POINTER(structs.pt_render),
                          POINTER(structs.pt_scene_film)],
    "pt_get_column_path": [c_void_p, c_uint32],
    "pt_find_rule_source": [c_void_p, POINTER(structs.pt_broken_rule), POINTER(structs.pt_rule_source)],
    "pt_get_scene_schema": [],
    "pt_last_scene_error": [],
}
NOT_RESULTS: Final[dict[str, Any]] = {"pt_close_scene_file": None, "pt_get_column_path": c_char_p,
                                      "pt_get_scene_schema": c_char_p, "pt_last_scene_error": c_char_p}


@functools.lru_cache(maxsize=1)
def scene_library() -> ctypes.CDLL:
    beside = pathlib.Path(library_path()).with_name(SONAME)
    path = str(beside) if beside.exists() else SONAME
    try:
        loaded = ctypes.CDLL(path)
        for name, parameters in PARAMETERS.items():
            function = getattr(loaded, name)
            function.argtypes = parameters
            function.restype = NOT_RESULTS.get(name, c_int32)
    except (OSError, AttributeError) as error:
        raise ImportError(f"{path} cannot be loaded as libpt-scene: {error}") from error
    return loaded


@dataclass(frozen=True)
class Override:
    """A value that replaces a file's.

    setting   path and value, "camera.vertical_fov=30"
    name      name in messages; None: the setting
    """

    setting: str
    name: str | None = None


@dataclass(frozen=True)
class Display:
    """exposure   stops, or "auto"
    tonemap    curve from radiance to light, one of CURVES
    gamma      encodes with the power 1 / gamma; None: the sRGB curve
    white      R, G, B of light that is shown as grey; None: (1, 1, 1)
    """

    exposure: float | str = "auto"
    tonemap: str = CURVES[0]
    gamma: float | None = None
    white: Vector | None = None

    def fields(self) -> dict[str, Any]:
        """Returns arguments of Image.to_srgb8."""
        given = {name: value for name, value in vars(self).items() if not isinstance(value, (str, type(None)))}
        return {"curve": Curve[str(self.tonemap).upper()], **given}


@dataclass(frozen=True)
class SceneFile:
    """`samples` is the number per pixel; None if the file has none."""

    scene: Scene
    camera: Camera
    settings: RenderSettings
    samples: int | None
    display: Display
    files: tuple[pathlib.Path, ...]
    _handle: _Handle = field(repr=False, compare=False)

    def explained(self, error: Error) -> Error:
        """Returns the error with the file's lines and names: "scene.json:7: materials.gold.glossiness = -1: must be >= 0". A wrong override
        gives an InvalidArgumentError."""
        if not error.broken_rules:
            return error
        sources = [self._handle.source(rule) for rule in error.broken_rules]
        kind = InvalidSceneError if all(index < 0 for _, index in sources) else InvalidArgumentError
        return kind("\n".join(message for message, _ in sources), error.broken_rules)


def load(path: Path, *, text: str | None = None, overrides: Mapping[str, Any] | Iterable[Override] = (),
         frame: int | None = None) -> SceneFile:
    """Reads a scene file and its columns. Arrays are the file's memory and cannot be changed.

    text        contents of the file, which is not read; path then gives its name and the folder of columns
    overrides   values that replace the file's, {"film.width": 640, "spheres[0].center": [0, 1, 0]}; later ones win
    frame       a frame of the file's animation; its number is added to the seed

    Raises InvalidSceneError with the file's line, InvalidArgumentError for a wrong override, and FileError."""
    given = ([Override(f"{name}={json.dumps(value)}", name) for name, value in overrides.items()]
             if isinstance(overrides, Mapping) else list(overrides))
    handle = _Handle(path, text, given, frame)
    scene, camera, render, film = handle.contents()
    return SceneFile(handle.scene_of(scene), _camera(camera), _settings(render), film.sample_count or None,
                     _display(film.display), handle.files(), handle)


def scene_schema() -> dict[str, Any]:
    text = scene_library().pt_get_scene_schema()
    if text is None:
        raise MemoryError
    schema: dict[str, Any] = json.loads(text)
    return schema


class _Handle:
    def __init__(self, path: Path, text: str | None, overrides: list[Override], frame: int | None) -> None:
        self._pointer = c_void_p()
        self._library = scene_library()
        data = None if text is None else text.encode()
        listed = (structs.pt_scene_override * len(overrides))(
            *(structs.pt_scene_override(c_string(each.setting), c_string(each.name)) for each in overrides))
        info = structs.pt_scene_file_info(
            path=c_string(path), text=data, text_bytes=len(data or b""), overrides=listed if overrides else None,
            override_count=len(overrides), flags=0 if frame is None else SceneFileFlag.FRAME, frame=frame or 0)
        self._checked(self._library.pt_open_scene_file(info, self._pointer))

    def __del__(self) -> None:
        if self._pointer:
            self._library.pt_close_scene_file(self._pointer)

    def _checked(self, result: int) -> None:
        if result < 0:
            raise ERROR_OF_RESULT[result](self._library.pt_last_scene_error().decode(errors="replace"))

    def contents(self) -> tuple[structs.pt_scene, structs.pt_camera, structs.pt_render, structs.pt_scene_film]:
        read = (structs.pt_scene(), structs.pt_camera(), structs.pt_render(), structs.pt_scene_film())
        self._checked(self._library.pt_get_scene_file(self._pointer, *read))
        return read

    def files(self) -> tuple[pathlib.Path, ...]:
        found: list[pathlib.Path] = []
        while (path := self._library.pt_get_column_path(self._pointer, len(found))) is not None:
            found.append(pathlib.Path(os.fsdecode(path)))
        return tuple(found)

    def source(self, rule: BrokenRule) -> tuple[str, int]:
        broken = structs.pt_broken_rule(
            component=-1 if rule.component is None else rule.component, index=-1 if rule.index is None else rule.index,
            subject=rule.subject.encode(), member=rule.member.encode(), value=rule.value.encode(), rule=rule.rule.encode(),
            **{"with": rule.joined_with.encode()})
        source = structs.pt_rule_source()
        self._checked(self._library.pt_find_rule_source(self._pointer, broken, source))
        return source.message.decode(errors="replace"), source.override_index

    def scene_of(self, scene: structs.pt_scene) -> Scene:
        spheres = [Sphere(tuple(each.center), each.radius, each.material, tuple(each.motion))
                   for each in scene.spheres[:scene.sphere_count]]
        planes = [Plane(tuple(each.normal), each.offset, each.material) for each in scene.planes[:scene.plane_count]]
        return Scene(spheres, planes, [self._array(each) for each in scene.sphere_arrays[:scene.sphere_array_count]],
                     materials=[_material(each) for each in scene.materials[:scene.material_count]])

    def _array(self, array: structs.pt_sphere_array) -> SphereArray:
        columns = {name: self._column(getattr(array, name), array.count, length)
                   for name, (length, _) in structs.SPHERE_COLUMNS.items()}
        return SphereArray(**{name: column for name, column in columns.items() if column is not None})

    def _column(self, column: structs.pt_column, count: int, length: int) -> Array | None:
        """Returns a view of the file's memory, which keeps this object alive."""
        if not column.data:
            return None
        dtype = np.dtype(TYPES[ColumnType(column.type)])
        row = length * dtype.itemsize
        buffer: Any = (ctypes.c_char * ((count - 1) * column.stride_bytes + row if count else 0)).from_address(column.data)
        buffer.owner = self
        shape, strides = ((count,), (column.stride_bytes,)) if length == 1 else (
            (count, length), (column.stride_bytes, dtype.itemsize))
        view: Array = np.ndarray(shape, dtype, buffer, 0, strides)
        view.flags.writeable = False
        return view


def _material(read: structs.pt_material) -> Material:
    return Material(tuple(read.diffuse), tuple(read.specular), tuple(read.emission), read.glossiness,
                    bool(read.flags & MaterialFlag.HIDDEN_FROM_CAMERA))


def _camera(read: structs.pt_camera) -> Camera:
    return Camera(tuple(read.position), tuple(read.target), tuple(read.up) if any(read.up) else (0.0, 1.0, 0.0),
                  vertical_fov=read.vertical_fov or None, shutter=(read.shutter_open, read.shutter_close),
                  vertical_extent=read.vertical_extent or None, aperture=read.aperture, focus=read.focus,
                  projection=Projection(read.projection))


def _display(read: structs.pt_display_info) -> Display:
    others: dict[str, Any] = {each.name: getattr(read, each.name) for each in fields(Display)[2:]}
    given: dict[str, Any] = {name: value if isinstance(value, float) else tuple(value)
                             for name, value in others.items() if np.any(value)}
    return Display("auto" if read.automatic_exposure else read.exposure, CURVES[read.curve], **given)


def _settings(read: structs.pt_render) -> RenderSettings:
    return RenderSettings(read.width, read.height, read.max_path_length, read.seed, estimator=Estimator(read.estimator),
                          sampler=Sampler(read.sampler))
