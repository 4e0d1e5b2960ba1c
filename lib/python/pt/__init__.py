"""pt: an offscreen path tracer for spheres and planes on any Vulkan device.

    import pt
    image = pt.render(positions, radii, colors)   # NumPy arrays: (n, 3), (n,), (n, 3)
    image.save("picture.png")

A Context takes a Scene, a Camera and RenderSettings. It accumulates samples and returns the image.

Coordinates are right-handed. Lengths are in scene units, angles in radians, times in [0, 1]. Colors are linear RGB
radiance. Row 0 of an image is the top row.

The library comes from PT_LIBRARY, else from the installed package, else from the system (libpt.so.0.4).
"""

import importlib
from typing import TYPE_CHECKING

from pt._callbacks import Log, Progress
from pt._camera import Camera, RenderSettings
from pt._compare import Comparison, Region, assert_same_light, compare
from pt._context import Context
from pt._denoise import denoise
from pt._enums import (NO_OBJECT, Curve, DeviceKind, Estimator, Feature, Format, Light, LogLevel, Projection, Quantity, Result, Sampler,
                       Sampling,
                       Uncertain)
from pt._errors import (BrokenRule, DeviceLostError, Error, FileError, IncompatibleError, InternalError, InvalidArgumentError,
                        InvalidSceneError, InvalidStateError, NoDeviceError, OutOfDeviceMemoryError,
                        OutOfHostMemoryError, ShaderError, UnsupportedError)
from pt._film import Film, FilmInfo, FilmTile
from pt._image import Image
from pt._library import library, version_text
from pt._scene import Material, Plane, Scene, Sphere, SphereArray
from pt._scene_file import Display, Override, SceneFile, load, scene_schema
from pt._stats import DeviceInfo, ErrorEstimate, Stats, devices

if TYPE_CHECKING:  # Figures import slowly.
    from pt.figures import Figure, figure
    from pt.figures._render import render

__all__ = [
    "BrokenRule", "Camera", "Comparison", "Context", "Curve", "DeviceInfo", "DeviceKind", "DeviceLostError", "Display", "Error", "Estimator", "Feature", "Figure",
    "FileError", "Film", "FilmInfo", "FilmTile", "Format", "Image", "IncompatibleError", "InternalError", "InvalidArgumentError",
    "InvalidSceneError", "InvalidStateError", "Light", "Log", "LogLevel", "Material", "NO_OBJECT", "NoDeviceError",
    "OutOfDeviceMemoryError", "OutOfHostMemoryError", "Override", "Plane", "Progress", "Projection", "Quantity", "Region", "RenderSettings",
    "Result", "Sampler", "Sampling", "Scene", "SceneFile", "ShaderError", "Sphere", "SphereArray", "Stats", "Uncertain", "UnsupportedError",
    "assert_same_light", "compare", "denoise", "devices", "figure", "load", "render", "scene_schema", "version",
]

__version__: str


def version() -> str:
    return version_text(library())


if not TYPE_CHECKING:  # A type checker would accept any name.
    def __getattr__(name):
        if name == "__version__":
            return version()
        modules = {"Figure": "pt.figures", "figure": "pt.figures", "render": "pt.figures._render"}
        if name not in modules:
            raise AttributeError(f"module 'pt' has no attribute {name!r}")
        return globals().setdefault(name, getattr(importlib.import_module(modules[name]), name))
