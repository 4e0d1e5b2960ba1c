"""Clouds of spheres. centers and radii are columns of floats. materials are indices into the materials of
surroundings(), which returns the rest of the scene."""

import array
import random

SEED = 5
EXTENT = (8.0, 4.0, 4.0)
MATERIALS = {"lamp": {"emission": [60, 54, 45]}, "floor": {"diffuse": 0.6}, "white": {"diffuse": 0.6},
             "red": {"diffuse": [0.8, 0.3, 0.2]}, "blue": {"diffuse": [0.2, 0.5, 0.8]}}
COLORS = ("white", "red", "blue")
CAMERA = {"position": [0, 2, 6.5], "look_at": [0, 2, 0], "vertical_fov": 40}
LAMP = {"center": [2, 6.5, 6], "radius": 0.6, "material": "lamp"}
FLOOR = {"normal": [0, 1, 0], "offset": 0, "material": "floor"}
WALLS = [{"normal": [x, y, z], "offset": offset, "material": material} for x, y, z, offset, material in
         ((0, -1, 0, 8, "white"), (1, 0, 0, 6, "red"), (-1, 0, 0, 6, "blue"), (0, 0, 1, 5, "white"), (0, 0, -1, 8, "white"))]
SKY = {"center": [0, 0, 0], "radius": 60, "material": "sky"}
LAYERS, MANY_LAMPS = 4, 24


class SphereCloud:
    """Largest radii are `fill` times the mean distance of centers. Seeds move spheres. Only SEED keeps the lamp in place."""

    fill = 0.45

    def __init__(self, count, seed=SEED):
        self.count, self.rng = count, random.Random(seed)
        uniform = self.rng.uniform
        largest = self.fill * (EXTENT[0] * EXTENT[1] * EXTENT[2] / count) ** (1 / 3)
        self.centers, self.radii, self.materials = array.array("f"), array.array("f"), array.array("I")
        first = list(MATERIALS).index(COLORS[0])
        for i in range(count):
            self.centers.extend((uniform(-EXTENT[0] / 2, EXTENT[0] / 2), self.height(i), uniform(-EXTENT[2] / 2, EXTENT[2] / 2)))
            self.radii.append(largest * uniform(0.4, 1))
            self.materials.append(first + i % len(COLORS))
        moved = {"center": [uniform(-3, 3), uniform(5.5, 7), uniform(3, 7)]} if seed != SEED else {}
        self.lamp = LAMP | moved

    def height(self, _):
        return self.rng.uniform(0.05, EXTENT[1])

    def surroundings(self):
        return {"materials": MATERIALS, "spheres": [self.lamp], "planes": [FLOOR], "camera": CAMERA}

    def scene(self):
        rest, names = self.surroundings(), list(MATERIALS)
        return rest | {"spheres": rest["spheres"] + [
            {"center": list(self.centers[3 * i:3 * i + 3]), "radius": self.radii[i], "material": names[self.materials[i]]}
            for i in range(self.count)]}


class DenseCloud(SphereCloud):
    fill = 0.8


class SparseCloud(SphereCloud):
    fill = 0.15


class LayeredCloud(SphereCloud):
    def height(self, i):
        return (i % LAYERS + 0.5) * EXTENT[1] / LAYERS


class CloudBehindABall(SphereCloud):
    def surroundings(self):
        ball = {"center": [-0.5, 1.9, 4.8], "radius": 0.5, "material": "white"}
        return super().surroundings() | {"spheres": [self.lamp, ball]}


class CloudWithManyLamps(SphereCloud):
    """The lamps have the total surface of the single lamp in other clouds."""

    def surroundings(self):
        rng = random.Random(self.count)
        lamps = [{"center": [rng.uniform(-4, 4), rng.uniform(4.5, 7), rng.uniform(-2, 6)],
                  "radius": LAMP["radius"] / MANY_LAMPS ** 0.5, "material": "lamp"} for _ in range(MANY_LAMPS)]
        return super().surroundings() | {"spheres": lamps}


class ClosedCloud(SphereCloud):
    def surroundings(self):
        return super().surroundings() | {"planes": [FLOOR, *WALLS]}


class OpenCloud(SphereCloud):
    def surroundings(self):
        materials = MATERIALS | {"sky": {"emission": [0.5, 0.6, 0.8]}}
        return super().surroundings() | {"materials": materials, "spheres": [self.lamp, SKY], "planes": []}


LOW, HIGH = (-8, 0.8, -16), (8, 6, -2)
BRIGHTNESSES = 41
POWER = 60  # emission of one lamp of radius 0.3 with the light of the whole cloud
MATT, DARK = {"diffuse": [0.7, 0.6, 0.5]}, {"diffuse": [0.4, 0.5, 0.6]}


class LampCloud:
    """The total surface of the lamps does not depend on the count. Without `shining` only the first lamp emits, so the
    same rays are traced without a choice among lamps."""

    def __init__(self, count, seed=SEED, shining=True):
        rng = random.Random(seed)
        self.count, self.lamp_count = count, count if shining else 1
        self.radii = array.array("f", [0.3 / count ** 0.5]) * count
        self.centers = array.array("f", (rng.uniform(low, high) for _ in range(count) for low, high in zip(LOW, HIGH)))
        brightness = [i % BRIGHTNESSES if i < self.lamp_count else None for i in range(count)]
        sum_of_lamps = sum(10 ** (0.1 * number) for number in brightness if number is not None)
        self.emissions = [POWER * count / sum_of_lamps * 10 ** (0.1 * number) for number in range(BRIGHTNESSES)]
        names = list(self.surroundings()["materials"])
        self.materials = array.array("I", (names.index("dark" if number is None else f"lamp {number}")
                                           for number in brightness))

    def surroundings(self):
        materials = {"matt": MATT, "dark": DARK}
        materials |= {f"lamp {number}": {"emission": emission} for number, emission in enumerate(self.emissions)}
        balls = [{"center": [-4 + 1.2 * i, -0.4, -7 - i % 3], "radius": 0.6, "material": "dark"} for i in range(8)]
        return {"materials": materials, "spheres": balls,
                "planes": [{"normal": [0, 1, 0], "offset": 1, "material": "matt"}],
                "camera": {"position": [0, 1, 1], "look_at": [0, 0.4, -6], "vertical_fov": 52}}


def dark_lamps(count, seed=SEED):
    return LampCloud(count, seed, shining=False)


KINDS = {"spheres": SphereCloud, "dense": DenseCloud, "sparse": SparseCloud, "layered": LayeredCloud,
         "near-ball": CloudBehindABall, "many-lamps": CloudWithManyLamps, "closed": ClosedCloud, "open": OpenCloud}
CLOUDS = KINDS | {"lamps": LampCloud, "dark-lamps": dark_lamps}
