import array
import random

SEED = 5
EXTENT = (8.0, 4.0, 4.0)
MATERIALS = {"lamp": {"emission": [60, 54, 45]}, "floor": {"diffuse": 0.6}, "white": {"diffuse": 0.6},
             "red": {"diffuse": [0.8, 0.3, 0.2]}, "blue": {"diffuse": [0.2, 0.5, 0.8]}}
COLORS = ("white", "red", "blue")


def surroundings():
    return {"materials": MATERIALS, "spheres": [{"center": [2, 6.5, 6], "radius": 0.6, "material": "lamp"}],
            "planes": [{"normal": [0, 1, 0], "offset": 0, "material": "floor"}],
            "camera": {"position": [0, 2, 6.5], "look_at": [0, 2, 0], "vertical_fov": 40}}


class SphereCloud:
    """The columns of centers and radii are floats. Materials are indices into MATERIALS. The filled fraction of space
    does not depend on the count."""

    def __init__(self, count):
        uniform = random.Random(SEED).uniform
        largest = 0.45 * (EXTENT[0] * EXTENT[1] * EXTENT[2] / count) ** (1 / 3)
        self.count = count
        self.centers, self.radii, self.materials = array.array("f"), array.array("f"), array.array("I")
        first = list(MATERIALS).index(COLORS[0])
        for i in range(count):
            self.centers.extend((uniform(-EXTENT[0] / 2, EXTENT[0] / 2), uniform(0.05, EXTENT[1]),
                                 uniform(-EXTENT[2] / 2, EXTENT[2] / 2)))
            self.radii.append(largest * uniform(0.4, 1))
            self.materials.append(first + i % len(COLORS))

    def surroundings(self):
        return surroundings()
