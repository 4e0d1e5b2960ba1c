"""The smallest program in Python: a ball under a lamp, written to smallest.png.

    pip install ./lib/python && python3 smallest.py
"""

import sys

import pt

WIDTH, HEIGHT = 128, 96

WHITE = pt.Material(diffuse=0.8)
RED = pt.Material(diffuse=(0.4, 0.1, 0.1), specular=0.4, glossiness=100)
LAMP = pt.Material(emission=(40, 40, 36))

SCENE = pt.Scene(spheres=[pt.Sphere((0, 1, 0), 1, RED), pt.Sphere((2, 4, 2), 1, LAMP)],
                 planes=[pt.Plane((0, 1, 0), 0, WHITE)])


def show_progress(fraction):
    print(f"\r{fraction:4.0%}", end="", file=sys.stderr, flush=True)


def main():
    with pt.Context() as context:
        image = context.render(SCENE, pt.Camera(position=(0, 1.5, 5), target=(0, 1, 0)),
                               pt.RenderSettings(WIDTH, HEIGHT), samples=64, progress=show_progress)
        print("\rrendered on", context.device.name)
    image.save("smallest.png")


if __name__ == "__main__":
    main()
