"""Sections of scene files for the program pt."""

from __future__ import annotations

import math
from typing import Any

from pt._camera import Camera
from pt._scene import Material


def camera_section(camera: Camera) -> dict[str, Any]:
    section: dict[str, Any] = {"position": list(camera.position), "look_at": list(camera.target), "up": list(camera.up)}
    if camera.vertical_fov is None:
        return {**section, "projection": "orthographic", "vertical_extent": camera.vertical_extent}
    lens = {"aperture": camera.aperture, "focus": camera.focus} if camera.aperture else {}
    return {**section, "vertical_fov": math.degrees(camera.vertical_fov), **lens}


def material_section(material: object) -> dict[str, Any]:
    """The section of a material, without default values; a grey is one number."""
    assert isinstance(material, Material)  # not an index
    section: dict[str, Any] = {}
    for name in ("diffuse", "specular", "emission", "glossiness", "hidden_from_camera"):
        value = getattr(material, name)
        if value not in (0.0, False, (0.0, 0.0, 0.0)):
            section[name] = value[0] if isinstance(value, tuple) and len(set(value)) == 1 else value
    return section
