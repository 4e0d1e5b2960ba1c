"""Sections of scene files, which the program pt renders."""

from __future__ import annotations

import math
from typing import Any

from pt._camera import Camera


def camera_section(camera: Camera) -> dict[str, Any]:
    section: dict[str, Any] = {"position": list(camera.position), "look_at": list(camera.target), "up": list(camera.up)}
    if camera.vertical_fov is None:
        return {**section, "projection": "orthographic", "vertical_extent": camera.vertical_extent}
    return {**section, "vertical_fov": math.degrees(camera.vertical_fov)}
