from __future__ import annotations

import ctypes
import uuid
from dataclasses import dataclass
from typing import Any

from pt import _structs as structs
from pt._enums import DeviceKind, Feature, Uncertain
from pt._library import checked, library


@dataclass(frozen=True)
class Stats:
    """Fields that only a context knows are 0 for a film."""

    sample_count: int  # fewest samples of a pixel
    max_sample_count: int  # most samples of a pixel
    mean_sample_count: float
    rejected_samples: int  # NaN, infinite, negative or too bright
    features: Feature
    device_bytes: int  # on all devices of the context
    device_count: int
    device_seconds: float
    submit_count: int  # submissions that took samples


def stats_of(struct: structs.pt_stats) -> Stats:
    values: dict[str, Any] = {name: getattr(struct, name) for name in Stats.__dataclass_fields__}
    values.update(features=Feature(struct.features))
    return Stats(**values)


@dataclass(frozen=True)
class ErrorEstimate:
    """Errors and bounds with 95% confidence, estimated without a reference. rmse is the root mean square of x - r over
    pixels and channels, with the image x and its limit r. relative_rmse uses (x - r) / sqrt(r^2 + 0.01) instead. Below
    16 samples lower bounds are 0 and other values infinite.
    """

    rmse: float  # in units of radiance
    rmse_low: float
    rmse_high: float
    relative_rmse: float
    relative_rmse_low: float
    relative_rmse_high: float
    uncertain: Uncertain


def error_estimate_of(struct: structs.pt_error_estimate) -> ErrorEstimate:
    values: dict[str, Any] = {name: getattr(struct, name) for name in ErrorEstimate.__dataclass_fields__}
    values.update(uncertain=Uncertain(struct.uncertain))
    return ErrorEstimate(**values)


@dataclass(frozen=True)
class DeviceInfo:
    name: str
    kind: DeviceKind
    driver: str
    memory_bytes: int  # largest memory heap that kernels can access quickly
    uuid: uuid.UUID  # same after a reboot; differs between devices of one model
    suitable: bool  # whether a Context can use the device
    reason: str


def device_of(struct: structs.pt_device_info) -> DeviceInfo:
    return DeviceInfo(name=struct.name.decode(errors="replace"), kind=DeviceKind(struct.kind),
                      driver=struct.driver.decode(errors="replace"), memory_bytes=struct.memory_bytes,
                      uuid=uuid.UUID(bytes=bytes(struct.uuid)), suitable=bool(struct.suitable),
                      reason=struct.reason.decode(errors="replace"))


def devices() -> list[DeviceInfo]:
    """Context(device="0") uses the first. Raises NoDeviceError without a device."""
    loaded, count = library(), ctypes.c_uint32()
    checked(loaded, loaded.pt_get_devices(None, count))
    found = (structs.pt_device_info * count.value)()
    checked(loaded, loaded.pt_get_devices(found, count))
    return [device_of(struct) for struct in found[:count.value]]
