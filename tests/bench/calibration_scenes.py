import math
import random

FLOOR = [{"normal": [0, 1, 0], "offset": 0, "material": "floor"}]
BACKGROUND = {"floor": {"diffuse": 0.5}, "red": {"diffuse": [0.6, 0.15, 0.1]}, "leaf": {"diffuse": [0.2, 0.5, 0.2]}}
BRASS = {"specular": [0.85, 0.65, 0.35], "glossiness": 3000}


def ball(center, radius, material):
    return {"center": list(center), "radius": radius, "material": material}


def lamp(emission):
    return {"emission": emission}


def scene(position, look_at, fov, materials, spheres, planes=(), length=4):
    return {"camera": {"position": position, "look_at": look_at, "vertical_fov": fov},
            "render": {"max_path_length": length}, "materials": BACKGROUND | materials, "spheres": spheres,
            "planes": list(planes)}


def street(rng, pairs, radius, emission):
    spheres = [ball((x, 3, -2 - 3 * i), radius, "lamp") for i in range(pairs) for x in (-3, 3)]
    spheres += [ball((rng.uniform(-2, 2), 0.5, -3 - 4 * i), 0.5, "red") for i in range(8)]
    return scene([0, 1.6, 4], [0, 1.4, -10], 50, {"lamp": lamp([emission, 0.8 * emission, 0.5 * emission])}, spheres,
                 FLOOR)


def windows(rng):
    spheres = [ball((x - 7, 1 + 1.5 * y, -8), 0.45, "lit" if rng.random() < 0.6 else "dark")
               for x in range(15) for y in range(5)]
    return scene([0, 2.5, 8], [0, 3, -8], 45, {"lit": lamp([8, 6, 3]), "dark": {"diffuse": 0.05}}, spheres,
                 FLOOR + [{"normal": [0, 0, 1], "offset": 8, "material": "floor"}])


def stars(rng, count, radius, by_power_law, others=(), materials=None, length=2):
    lamps = {f"star {k}": lamp(10.0 ** (k if by_power_law else 3)) for k in range(6)}
    spheres = []
    for _ in range(count):
        x, y = rng.uniform(-1, 1), rng.uniform(-0.5, 0.5)
        k = min(int(-math.log(rng.random() + 1e-9) * 1.2), 5) if by_power_law else 0
        spheres.append(ball((60 * x, 60 * y, -100), radius, f"star {k}"))
    return scene([0, 0, 0], [0, 0, -1], 32, lamps | (materials or {}), spheres + list(others), length=length)


def fairy_lights(rng, count, radius):
    spheres = [ball((rng.uniform(-3, 3), rng.uniform(0.2, 4), rng.uniform(-1, 1)), radius, "lamp")
               for _ in range(count)]
    spheres += [ball((rng.uniform(-3, 3), 0.4, rng.uniform(-2, 1)), 0.4, "leaf") for _ in range(4)]
    return scene([0, 1.5, 8], [0, 1.5, 0], 40, {"lamp": lamp(2000)}, spheres, FLOOR, 3)


def figures(rng):
    colors = {f"color {k}": {"diffuse": [rng.uniform(0.1, 0.9) for _ in range(3)]} for k in range(6)}
    cloud = [ball((rng.uniform(-3, 3), rng.uniform(0, 3), rng.uniform(-3, 3)), rng.uniform(0.1, 0.3), f"color {i % 6}")
             for i in range(300)]
    lattice = [ball((x - 2, y - 2, z - 2), 0.35, f"color {(x + y + z) % 6}")
               for x in range(5) for y in range(5) for z in range(5)]
    key = ball((10, 14, 8), 2, "key")
    lights = {"sky": lamp(1), "key": lamp(20), "fill": lamp(3), "floor": {"diffuse": 0.9}}
    return {"figure-dome": scene([0, 4, 9], [0, 1.2, 0], 38, colors | lights, cloud + [ball((0, 0, 0), 60, "sky")],
                                 FLOOR),
            "figure-lattice": scene([5, 4, 8], [0, 0, 0], 34, colors | lights,
                                    lattice + [ball((0, 0, 0), 200, "sky"), key], length=3),
            "figure-black": scene([5, 4, 8], [0, 0, 0], 34, colors | lights,
                                  lattice[::3] + [key, ball((-12, 6, 6), 3, "fill")], length=3)}


def rooms():
    walls = [ball((0, 0, 1e4 + 6), 1e4, "wall"), ball((0, 0, -1e4 - 6), 1e4, "wall"),
             ball((1e4 + 5, 0, 0), 1e4, "red"), ball((-1e4 - 5, 0, 0), 1e4, "leaf"),
             ball((0, 1e4 + 5, 0), 1e4, "wall"), ball((0, -1e4, 0), 1e4, "wall")]
    materials = {"wall": {"diffuse": 0.7}, "shade": {"diffuse": 0.3}}
    shaded = [ball((0, 4.2, -2), 0.2, "lamp"), ball((0, 3.2, -2), 0.7, "shade"), ball((-2, 1, -1), 1, "red")]
    partition = [ball((x - 4.5, y + 0.5, -1), 0.52, "wall") for x in range(10) for y in range(5) if (x, y) != (5, 2)]
    view = ([0, 2, 5.5], [0, 2, 0], 65)
    return {"indirect-room": scene(*view, materials | {"lamp": lamp(100)}, walls + shaded, length=8),
            "two-rooms": scene(*view, materials | {"lamp": lamp(400)},
                               walls + partition + [ball((0, 3, -4.5), 0.3, "lamp")], length=8)}


def caustics(rng):
    bowl = [ball((0, 0.4, 0), 4, "brass"), ball((-2.4, 0.9, -0.2), 0.1, "lamp"), ball((0.6, 0.35, 1), 0.35, "leaf")]
    balls = [ball((-3 + 1.5 * i, 0.6, rng.uniform(-1, 1)), 0.6, "brass") for i in range(5)]
    return {"caustic-small": scene([0.6, 3.4, 1.4], [0.5, 0, -0.3], 60, {"lamp": lamp(800), "brass": BRASS}, bowl,
                                   FLOOR),
            "caustic-balls": scene([0, 3, 7], [0, 0.5, 0], 40,
                                   {"lamp": lamp(400), "brass": BRASS | {"glossiness": 8000}},
                                   balls + [ball((2, 4, 3), 0.25, "lamp")], FLOOR)}


def glossy(rng):
    mirror = {"specular": 0.9, "glossiness": 10000}
    chain = [ball((-3 + i, 0.5 + 0.3 * (i % 2), -0.3 * i), 0.5, "mirror") for i in range(7)]
    wet = {"floor": {"diffuse": 0.05, "specular": 0.4, "glossiness": 500}, "lamp 0": lamp([300, 60, 20]),
           "lamp 1": lamp([60, 300, 80]), "lamp 2": lamp([200, 200, 260])}
    signals = [ball((rng.uniform(-6, 6), rng.uniform(1.5, 3.5), rng.uniform(-20, -2)), 0.08, f"lamp {i % 3}")
               for i in range(30)]
    beads = [ball((rng.uniform(-4, 4), 0.08, rng.uniform(-3, 3)), 0.08, "bead") for _ in range(200)]
    shell = [ball((0, 0, 0), 4, "shell"), ball((1.5, 1.5, -1), 0.15, "lamp"), ball((-1, -1, -1), 0.8, "red")]
    return {"gloss-chain": scene([0, 2, 9], [0, 0.8, 0], 35, {"lamp": lamp(3000), "mirror": mirror},
                                 chain + [ball((3, 5, 4), 0.06, "lamp")], FLOOR, 6),
            "wet-road": scene([0, 1.2, 4], [0, 1, -8], 45, wet, signals, FLOOR, 3),
            "glints": scene([0, 3, 9], [0, 0.5, 0], 40,
                            {"lamp": lamp(20000), "bead": {"specular": 0.8, "diffuse": 0.05, "glossiness": 3000}},
                            beads + [ball((4, 6, 5), 0.05, "lamp")], FLOOR, 3),
            "inside-gloss": scene([0, 0, 2.5], [0, 0, 0], 70,
                                  {"lamp": lamp(50), "shell": {"diffuse": 0.2, "specular": 0.6, "glossiness": 200}},
                                  shell, length=6)}


def hard_lamps(rng):
    near_far = [ball((-2, 0.5, 2), 0.5, "red"), ball((-2, 1.3, 2.3), 0.01, "bright"), ball((6, 6, -20), 3, "dim"),
                ball((1.5, 0.7, -2), 0.7, "leaf")]
    night = [ball((rng.uniform(-5, 5), rng.uniform(0.5, 4), rng.uniform(-12, 0)), rng.uniform(0.02, 0.2),
                  f"lamp {i % 7}") for i in range(40)]
    grid = [ball((x * 1.02 - 2, 3, z * 1.02 - 2), 0.5, "red") for x in range(5) for z in range(5)]
    leaves = [ball((rng.uniform(-3, 3), 0.5, rng.uniform(-2, 2)), 0.5, "leaf") for _ in range(6)]
    moonlit = [ball((rng.uniform(-4, 4), 0.6, rng.uniform(-2, 2)), 0.6, "red") for _ in range(5)]
    colors = {"r": lamp([500, 0, 0]), "g": lamp([0, 500, 0]), "b": lamp([0, 0, 500])}
    return {"corner-ball": scene([0, 0, 10], [0, 0, 0], 40, {"lamp": lamp(5000)},
                                 [ball((-5.5, 2.6, 0), 0.5, "red"), ball((-3, 3.5, 2), 0.01, "lamp")], length=3),
            "near-far": scene([0, 1.5, 6], [0, 0.8, 0], 45, {"bright": lamp(1e5), "dim": lamp(2)}, near_far, FLOOR),
            "night": scene([0, 2, 6], [0, 1.5, -4], 50, {f"lamp {k}": lamp(10.0 ** k) for k in range(7)}, night, FLOOR),
            "gap": scene([0, 4, 8], [0, 0, 0], 45, {"lamp": lamp(4)}, [ball((0, 9, 0), 3, "lamp")] + grid, FLOOR),
            "hidden-sun": scene([0, 1.6, 7], [0, 0.7, 0], 35, {"sun": lamp(1e6), "sky": lamp([0.02, 0.03, 0.05])},
                                [ball((0, 0, 0), 1000, "sky"), ball((300, 200, 100), 1.5, "sun")] + leaves, FLOOR),
            "moon": scene([0, 1.5, 8], [0, 1, 0], 40, {"moon": lamp(0.02)}, [ball((40, 60, 30), 20, "moon")] + moonlit,
                          FLOOR),
            "halo": scene([0, 1, 8], [0, 1, 0], 30, {"lamp": lamp(1000)},
                          [ball((0, 1, 0), 0.8, "red"), ball((0, 1, -1.5), 0.78, "lamp")], FLOOR),
            "three-colors": scene([0, 3, 8], [0, 0.8, 0], 40, colors,
                                  [ball((-3, 3, 2), 0.1, "r"), ball((0, 4, 2), 0.1, "g"), ball((3, 3, 2), 0.1, "b"),
                                   ball((-1, 0.8, 0), 0.8, "floor"), ball((1.2, 0.6, 0.5), 0.6, "leaf")], FLOOR)}


def scenes():
    rng = random.Random(7)
    planet = [ball((-5, 0, -40), 6, "planet"), ball((80, 40, 20), 5, "sun")]
    return {"street-24": street(rng, 12, 0.15, 60), "street-60": street(rng, 30, 0.05, 600), "windows": windows(rng),
            "stars-100": stars(rng, 100, 0.08, False), "stars-1000": stars(rng, 1000, 0.05, True),
            "stars-planet": stars(rng, 80, 0.3, True, planet, {"planet": {"diffuse": 0.5}, "sun": lamp(3000)}, 3),
            "fairy-1": fairy_lights(rng, 1, 0.003), "fairy-100": fairy_lights(rng, 100, 0.003),
            "fairy-300": fairy_lights(rng, 300, 0.003),
            **figures(rng), **rooms(), **caustics(rng), **glossy(rng), **hard_lamps(rng)}
