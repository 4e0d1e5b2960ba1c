import array
import random

SEED = 5
LOW, HIGH = (-8, 0.8, -16), (8, 6, -2)
BRIGHTNESSES = 41
POWER = 60  # emission of one lamp of radius 0.3 with the light of the whole cloud
MATT, DARK = {"diffuse": [0.7, 0.6, 0.5]}, {"diffuse": [0.4, 0.5, 0.6]}


class LampCloud:
    """Has the columns of SphereCloud. The total surface of the lamps does not depend on the count. Without `shining`
    only the first lamp emits, so the same rays are traced without a choice among lamps."""

    def __init__(self, count, shining=True):
        rng = random.Random(SEED)
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
