"""A program of somebody else, in Python, with the package: inside a ball that shines, every pixel has the ball's
radiance, exactly. Arguments: the red that is expected."""

import sys

import numpy as np
import pt

BALL = pt.Material(emission=(2, 1, 0.5))
CAMERA = pt.Camera(position=(0, 0, 0), target=(0, 0, -1))


def main():
    expected = np.full((4, 8, 3), (float(sys.argv[1]), 1.0, 0.5), np.float32)
    by_columns = pt.SphereArray(np.zeros((1, 3)), np.float32(3), BALL)
    with pt.Context() as context:
        for scene in pt.Scene([pt.Sphere((0, 0, 0), 3, BALL)]), pt.Scene(sphere_arrays=[by_columns]):
            image = context.render(scene, CAMERA, pt.RenderSettings(8, 4), samples=3)
            if not np.array_equal(image, expected):
                sys.exit(f"the image is {image.radiance}")


main()
