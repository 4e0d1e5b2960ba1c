"""Makes a picture of a dump with OVITO's Python module, by the camera of a view that figures.py wrote.

    figure_ovito.py DATA VIEW OUT WIDTH HEIGHT RENDERER [KEY=NUMBER...]

RENDERER: TachyonRenderer or OSPRayRenderer, with their defaults but for the keys.
"""

import json
import math
import sys

import ovito.io
import ovito.vis
from figure_data import COLORS, RADIUS


def main():
    data, view_path, out, width, height, renderer, *settings = sys.argv[1:]
    with open(view_path, encoding="utf-8") as file:
        camera = json.load(file)["camera"]
    pipeline = ovito.io.import_file(data)

    def look(_, data_collection):
        for kind, color in enumerate(COLORS, 1):
            types = data_collection.particles_.particle_types_
            types.type_by_id_(kind).color = color
            types.type_by_id_(kind).radius = RADIUS
        data_collection.cell_.vis.enabled = False

    pipeline.modifiers.append(look)
    pipeline.add_to_scene()
    viewport = ovito.vis.Viewport(type=ovito.vis.Viewport.Type.Perspective, fov=math.radians(camera["vertical_fov"]),
                                  camera_pos=camera["position"], camera_up=camera["up"],
                                  camera_dir=[b - a for a, b in zip(camera["position"], camera["look_at"])])
    numbers = {key: int(value) for key, value in (setting.split("=") for setting in settings)}
    viewport.render_image(filename=out, size=(int(width), int(height)), background=(1, 1, 1),
                          renderer=getattr(ovito.vis, renderer)(**numbers))


if __name__ == "__main__":
    main()
