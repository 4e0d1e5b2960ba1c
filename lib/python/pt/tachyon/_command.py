from __future__ import annotations

import argparse
import json
from collections.abc import Iterator
from typing import Any

import numpy as np

from pt._command_line import FILES, SCENE
from pt._scene import Material, SphereArray
from pt._text import tell
from pt.tachyon._reader import TachyonScene, read


def main(arguments: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(
        prog="pt-tachyon", description="Makes a scene file for pt render of a scene of Tachyon, as VMD and OVITO write them.")
    parser.add_argument("input", help="the scene of Tachyon")
    parser.add_argument("-o", "--output", required=True, metavar="SCENE.json", help="scene file to write; - is standard output")
    parser.add_argument("--leave-out-others", action="store_true",
                        help="leave out triangles and other things that cannot be rendered, and count them")
    options = parser.parse_args(arguments)
    try:
        found = read(options.input, leave_out_others=options.leave_out_others)
        text = json.dumps(scene_file(found), indent=1)
        if options.output == "-":
            print(text)
        else:
            with open(options.output, "w", encoding="utf-8") as file:
                file.write(text + "\n")
    except (OSError, ValueError) as error:
        tell("pt-tachyon", str(error))
        return SCENE if isinstance(error, ValueError) else FILES
    for note in found.notes:
        tell("pt-tachyon", f"warning: {note}")
    return 0


def scene_file(found: TachyonScene) -> dict[str, Any]:
    materials: dict[str, Material] = {f"texture {index}": each for index, each in enumerate(found.scene.materials)}
    names = {each: name for name, each in materials.items()}
    spheres: list[dict[str, Any]] = []
    capsules: list[dict[str, Any]] = []
    for array in found.scene.sphere_arrays:
        (spheres if array.end is None else capsules).extend(_items_of(array))
    for sphere in found.scene.spheres:
        assert isinstance(sphere.material, Material)
        name = names.setdefault(sphere.material, f"light {len(names) + 1 - len(found.scene.materials)}")
        materials[name] = sphere.material
        spheres.append({"center": sphere.center, "radius": sphere.radius, "material": name})
    return {"camera": found.camera._section(),
            "film": {"width": found.settings.width, "height": found.settings.height, "exposure": 0, "gamma": 1},
            "materials": {name: each._section() for name, each in materials.items()},
            "spheres": spheres, "capsules": capsules,
            "planes": [{"normal": plane.normal, "offset": plane.offset, "material": f"texture {plane.material}"}
                       for plane in found.scene.planes]}


def _items_of(array: SphereArray) -> Iterator[dict[str, Any]]:
    assert isinstance(array.material, np.ndarray)
    columns = {"center": array.center, "radius": array.radius, "end": array.end}
    for row, index in enumerate(array.material.tolist()):
        yield {"material": f"texture {index}",
               **{name: column[row].tolist() for name, column in columns.items() if column is not None}}
