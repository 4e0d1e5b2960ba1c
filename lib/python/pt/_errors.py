from __future__ import annotations

from dataclasses import dataclass
from typing import Final

from pt._enums import Result


@dataclass(frozen=True)
class BrokenRule:
    """For instance `spheres[3].center[0] = nan: must be finite`."""

    subject: str  # "materials", "spheres", "planes", "sphere_arrays", "scene", "camera", "render", ...
    index: int | None  # None outside arrays
    member: str  # "center", or "" for the argument itself
    component: int | None  # None for scalars
    joined_with: str  # "* height" if the rule concerns the product of width and height, else ""
    value: str
    rule: str

    def __str__(self) -> str:
        of = "" if self.index is None else f"[{self.index}]"
        element = "" if self.component is None else f"[{self.component}]"
        member = f".{self.member}" if self.member else ""
        joined = f" {self.joined_with}" if self.joined_with else ""
        return f"{self.subject}{of}{member}{element}{joined} = {self.value}: {self.rule}"


class Error(Exception):
    """A failed call. Nothing has changed, except that a lost device stays lost and accumulate may keep some samples."""

    result: Result
    broken_rules: tuple[BrokenRule, ...]
    """At most eight; empty if the message concerns no field."""

    def __init__(self, message: str, broken_rules: tuple[BrokenRule, ...] = ()) -> None:
        super().__init__(message)
        self.broken_rules = broken_rules


class InvalidArgumentError(Error, ValueError):
    result = Result.ERROR_INVALID_ARGUMENT


class InvalidSceneError(Error, ValueError):
    result = Result.ERROR_INVALID_SCENE


class InvalidStateError(Error, RuntimeError):
    """A setting is missing, or another call is running."""

    result = Result.ERROR_INVALID_STATE


class UnsupportedError(Error, RuntimeError):
    """The request is valid, but beyond this device, driver or library."""

    result = Result.ERROR_UNSUPPORTED


class NoDeviceError(Error, RuntimeError):
    result = Result.ERROR_NO_DEVICE


class OutOfHostMemoryError(Error, MemoryError):
    result = Result.ERROR_OUT_OF_HOST_MEMORY


class OutOfDeviceMemoryError(Error, MemoryError):
    result = Result.ERROR_OUT_OF_DEVICE_MEMORY


class DeviceLostError(Error, RuntimeError):
    """The device failed. The context can only be closed."""

    result = Result.ERROR_DEVICE_LOST


class ShaderError(Error, RuntimeError):
    result = Result.ERROR_SHADER


class InternalError(Error, RuntimeError):
    result = Result.ERROR_INTERNAL


class IncompatibleError(Error, ValueError):
    """The film is damaged, or shows another picture."""

    result = Result.ERROR_INCOMPATIBLE


class FileError(Error, OSError):
    result = Result.ERROR_FILE


ERROR_OF_RESULT: Final[dict[int, type[Error]]] = {
    error.result: error
    for error in (InvalidArgumentError, InvalidSceneError, InvalidStateError, UnsupportedError, NoDeviceError,
                  OutOfHostMemoryError, OutOfDeviceMemoryError, DeviceLostError, ShaderError, InternalError,
                  IncompatibleError, FileError)
}
