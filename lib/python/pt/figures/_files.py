from __future__ import annotations

import functools
import io
import json
import pathlib
from typing import Any

import numpy as np
import numpy.typing as npt

from pt import _structs as structs
from pt._camera import Camera
from pt._files import Path, format_of, write_atomically
from pt._scene import Material, Scene
from pt.figures._errors import module
from pt.figures._options import Options


def encode_jpeg(pixels: npt.NDArray[np.uint8], dpi: float | None = None) -> bytes:
    buffer = io.BytesIO()
    module("PIL.Image", "JPEG").fromarray(pixels).save(buffer, "JPEG", quality=95, subsampling=0,
                                                  **({"dpi": (dpi, dpi)} if dpi else {}))
    return buffer.getvalue()


def write_scene(path: Path, scene: Scene, camera: Camera, size: tuple[int, int], options: Options) -> None:
    format_of(path, ("json",))
    place = pathlib.Path(path)
    items: list[dict[str, Any]] = []
    names: dict[Material, str] = {}
    for number, array in enumerate(scene.sphere_arrays):
        kind = f"capsules-{number}-" if number else ""
        item: dict[str, Any] = {}
        for name, (components, types) in structs.SPHERE_COLUMNS.items():
            column = None if types == "index" else getattr(array, name)
            if column is not None and components == 1 and not column.strides[0]:
                item[name] = float(column[0])
            elif column is not None:
                file = place.with_name(f"{place.stem}-{kind}{name}.npy")
                item[name] = file.name
                write_atomically(file, functools.partial(np.save, arr=np.ascontiguousarray(column), allow_pickle=False))
        assert isinstance(array.material, Material)
        items.append({**item, "material": names.setdefault(array.material, "edges" if names else "particles")})
    document: dict[str, Any] = {
        "camera": camera._section(),
        "film": {"width": size[0], "height": size[1], "exposure": 0, "tonemap": "none"},
        "render": {"max_path_length": options.max_path_length, "spp": options.most_samples},
        "materials": {}, "spheres": [], "planes": []}
    for name, lamp in zip(("surround", "key"), scene.spheres):
        assert isinstance(lamp.material, Material)
        document["materials"][name] = lamp.material._section()
        document["spheres"].append({"center": list(lamp.center), "radius": lamp.radius, "material": name})
    for plane in scene.planes:
        assert isinstance(plane.material, Material)
        document["materials"]["floor"] = plane.material._section()
        document["planes"].append({"normal": list(plane.normal), "offset": plane.offset, "material": "floor"})
    document["materials"].update((name, material._section()) for material, name in names.items())
    document["spheres"].append(items[0])
    if items[1:]:
        document["capsules"] = items[1:]
    text = json.dumps(document, indent=2) + "\n"
    write_atomically(place, lambda file: file.write(text.encode()))
