"""Makes a scene file for Tachyon of a dump, by the camera of a view that figures.py wrote, and renders it: a light from
where the view has its lamp, and ambient occlusion.

    figure_tachyon.py DATA VIEW OUT WIDTH HEIGHT PLACES RAYS

PLACES in each pixel, RAYS of ambient occlusion from each of them.
"""

import json
import math
import os
import subprocess
import sys
import tempfile

from figure_data import COLORS, RADIUS, read_dump

ALBEDO = 0.8


def texts(vector):
    return " ".join(f"{value:.9g}" for value in vector)


def write_scene(file, data, view, width, height):
    camera, lamp = view["camera"], view["lamp"]
    forward = [b - a for a, b in zip(camera["position"], camera["look_at"])]
    light = [a - b for a, b in zip(camera["look_at"], lamp["center"])]
    zoom = 0.5 / math.tan(math.radians(camera["vertical_fov"]) / 2)
    file.write(f"BEGIN_SCENE\nRESOLUTION {width} {height}\n"
               f"CAMERA\nZOOM {zoom:.9g}\nASPECTRATIO 1\nANTIALIASING 0\n"
               f"RAYDEPTH 8\nCENTER {texts(camera['position'])}\nVIEWDIR {texts(forward)}\n"
               f"UPDIR {texts(camera['up'])}\n"
               f"END_CAMERA\nDIRECTIONAL_LIGHT DIRECTION {texts(light)} COLOR 1 1 1\nBACKGROUND 1 1 1\n")
    for kind, color in enumerate(COLORS, 1):
        file.write(f"TEXDEF type{kind} AMBIENT 0 DIFFUSE {ALBEDO} SPECULAR 0 OPACITY 1 "
                   f"COLOR {texts(color)} TEXFUNC 0\n")
    types, places = read_dump(data)
    for kind, (x, y, z) in zip(types.tolist(), places.tolist()):
        file.write(f"SPHERE CENTER {x} {y} {z} RAD {RADIUS} type{kind}\n")
    file.write("END_SCENE\n")


def main():
    data, view_path, out, width, height, places, rays = sys.argv[1:]
    with open(view_path, encoding="utf-8") as file:
        view = json.load(file)
    with tempfile.TemporaryDirectory() as folder:
        scene = os.path.join(folder, "scene.dat")
        with open(scene, "w", encoding="ascii") as file:
            write_scene(file, data, view, width, height)
        options = ["-aasamples", str(int(places) - 1), "-auto_skylight", "0.7", "-skylight_samples", rays]
        subprocess.run(["tachyon", scene, *options, "-format", "PNG", "-o", out], check=True, stdout=subprocess.DEVNULL)


if __name__ == "__main__":
    main()
