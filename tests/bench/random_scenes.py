"""Makes random scenes of 25 kinds.

    python3 tests/bench/random_scenes.py FOLDER [--first-seed N]   # writes a hundred scene files
"""

import argparse
import json
import math
import pathlib
import random
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import calibration_scenes as fixed
from calibration_scenes import ball, lamp

KINDS = {}


def kind(function):
    KINDS[function.__name__.replace("_", "-")] = function
    return function


def scene(name, seed):
    made = KINDS[name](random.Random(f"{name} {seed}"))
    return made | {"film": {"width": 64, "height": 32}}


def hundred(first_seed):
    for seed in range(first_seed, first_seed + 100 // len(KINDS)):
        for name in KINDS:
            yield f"{name}-{seed}", scene(name, seed)


def between_powers(rng, low, high):
    return math.exp(rng.uniform(math.log(low), math.log(high)))


def place(rng, width=3.0, low=0.3, high=3.0, depth=2.5):
    return [rng.uniform(-width, width), rng.uniform(low, high), rng.uniform(-depth, depth)]


def direction(rng):
    z, turn = rng.uniform(-1, 1), rng.uniform(0, 2 * math.pi)
    return [math.sqrt(1 - z * z) * math.cos(turn), math.sqrt(1 - z * z) * math.sin(turn), z]


def tint(rng):
    return [round(rng.uniform(0.1, 0.95), 3) for _ in range(3)]


def warm(rng, emission):
    return lamp([emission * rng.uniform(*channel) for channel in ((0.8, 1), (0.6, 1), (0.3, 1))])


def opacity(rng, low=0.02, high=0.98):
    return rng.randrange(int(255 * low), int(255 * high) + 1) / 255


def view(rng, distance=8.0, height=1.5, fov=40):
    turn = rng.uniform(-0.6, 0.6)
    return {"position": [distance * math.sin(turn), height + rng.uniform(0, 2), distance * math.cos(turn)],
            "look_at": [0, 1, 0], "vertical_fov": fov * rng.uniform(0.8, 1.2)}


def sunlit(rng):
    return ([ball((rng.uniform(-9, 9), rng.uniform(7, 12), rng.uniform(3, 9)), rng.uniform(0.5, 2), "key"),
             ball((0, 0, 0), 60, "sky")],
            {"key": warm(rng, rng.uniform(10, 60)), "sky": lamp(between_powers(rng, 0.02, 1))})


def on_floor(rng, materials, spheres, camera=None, length=None, capsules=()):
    return {"camera": camera or view(rng), "render": {"max_path_length": length or rng.randint(3, 6)},
            "materials": fixed.BACKGROUND | materials, "spheres": spheres, "capsules": list(capsules),
            "planes": fixed.FLOOR}


def without_floor(made):
    return made | {"planes": []}


def balls(rng, count, radii=(0.3, 0.6), materials=("red", "leaf", "floor")):
    return [ball(place(rng, high=1.5), rng.uniform(*radii), rng.choice(materials)) for _ in range(count)]


def coloured(rng, count, width, radii, **more):
    return [ball(place(rng, width), rng.uniform(*radii), "floor") | {"color": tint(rng)} | more for _ in range(count)]


@kind
def figure(rng):
    lights, materials = sunlit(rng)
    atoms = coloured(rng, rng.randint(120, 300), 3, (0.1, 0.3))
    return on_floor(rng, materials, atoms + lights)


def bonds(rng, atoms, radius, **more):
    return [{"center": a["center"], "end": b["center"], "radius": radius, "material": "floor", "color": tint(rng)} | more
            for a, b in zip(atoms, atoms[1:]) if rng.random() < 0.8]


@kind
def sticks(rng):
    lights, materials = sunlit(rng)
    atoms = coloured(rng, rng.randint(8, 40), 2, (0.12, 0.3))
    return without_floor(on_floor(rng, materials, atoms + lights, capsules=bonds(rng, atoms, rng.uniform(0.05, 0.12))))


@kind
def translucent_figure(rng):
    lights, materials = sunlit(rng)
    seen = {"opacity": opacity(rng, 0.1, 0.9)}
    atoms = coloured(rng, rng.randint(8, 150), 2, (0.15, 0.5), **seen)
    return on_floor(rng, materials, atoms + lights, capsules=bonds(rng, atoms[:30], 0.1, **seen))


@kind
def stars(rng):
    return fixed.stars(rng, rng.randint(20, 400), between_powers(rng, 0.05, 1), rng.random() < 0.5)


@kind
def street(rng):
    radius = between_powers(rng, 0.03, 0.2)
    return fixed.street(rng, rng.randint(5, 40), radius, rng.uniform(1, 3) / radius ** 2)


@kind
def windows(rng):
    made = fixed.windows(rng)
    made["materials"]["lit"] = warm(rng, between_powers(rng, 1, 30))
    return made


@kind
def veils(rng):
    lamps = [ball((x, rng.uniform(0.5, 2), rng.uniform(-2.5, -1.5)), rng.uniform(0.08, 0.2), "lamp")
             for x in (-2, -0.7, 0.7, 2)]
    shells = [ball((0, 1, 0.3 * i), rng.uniform(1, 3), "leaf") | {"opacity": opacity(rng, 0.05, 0.6)}
              for i in range(rng.randint(2, 8))]
    return on_floor(rng, {"lamp": warm(rng, between_powers(rng, 30, 1000))}, lamps + shells + balls(rng, 2))


@kind
def coloured_fog(rng):
    fog = [ball(place(rng), rng.uniform(0.3, 0.9), "white") | {"opacity": opacity(rng, 0.01, 0.1), "color": tint(rng)}
           for _ in range(rng.randint(60, 400))]
    lamps = [ball(place(rng, 2), rng.uniform(0.05, 0.15), "lamp") for _ in range(rng.randint(1, 4))]
    return on_floor(rng, {"white": {"diffuse": 0.9}, "lamp": warm(rng, between_powers(rng, 100, 3000))}, fog + lamps)


@kind
def lamp_in_veil(rng):
    radius = between_powers(rng, 0.03, 0.2)
    center = place(rng, 1.5, 1, 2, 1)
    veil = ball(center, radius * rng.uniform(1.2, 6), "floor") | {"opacity": opacity(rng, 0.3, 0.99)}
    return on_floor(rng, {"lamp": warm(rng, 20 / radius ** 2)}, [ball(center, radius, "lamp"), veil, *balls(rng, 2)])


@kind
def moving_lamps(rng):
    lamps = [ball(place(rng, high=2.5), between_powers(rng, 0.03, 0.15), "lamp")
             | {"motion": [rng.uniform(0.3, 6) * share for share in direction(rng)]} for _ in range(rng.randint(1, 5))]
    return on_floor(rng, {"lamp": warm(rng, between_powers(rng, 100, 3000))}, lamps + balls(rng, 3))


@kind
def motion_blur(rng):
    lights, materials = sunlit(rng)
    flying = [each | {"motion": [rng.uniform(0, 3) * share for share in direction(rng)]}
              for each in balls(rng, rng.randint(2, 12))]
    return on_floor(rng, materials, flying + lights, view(rng) | {"shutter": [0, rng.uniform(0.2, 1)]})


@kind
def out_of_focus(rng):
    gloss = {"diffuse": 0.1, "specular": 0.8, "glossiness": between_powers(rng, 300, 50000)}
    lens = {"aperture": rng.uniform(0.1, 1), "focus": rng.uniform(3, 12)}
    lamps = [ball((4, 6, 6), between_powers(rng, 0.05, 0.3), "lamp"), ball(place(rng), 0.03, "lamp")]
    return on_floor(rng, {"gloss": gloss, "lamp": lamp(between_powers(rng, 300, 5000))},
                    balls(rng, rng.randint(5, 40), (0.1, 0.4), ("gloss", "red")) + lamps, view(rng) | lens)


@kind
def slits(rng):
    lamps = [ball((rng.uniform(-2, 2), rng.uniform(1, 3), -4), between_powers(rng, 0.05, 0.5), "lamp")
             for _ in range(rng.randint(1, 3))]
    gap = rng.uniform(0.44, 0.6)
    grid, bars = [], []
    if rng.random() < 0.5:
        grid = [ball((gap * i - 4, gap * j, -1.5), 0.28, "floor") for i in range(17) for j in range(9)]
    else:
        bars = [{"center": [gap * i - 5, -1, -1.5], "end": [gap * i - 5, 5, -1.5], "radius": 0.2, "material": "floor"}
                for i in range(20)]
    return on_floor(rng, {"lamp": warm(rng, between_powers(rng, 50, 1000))}, lamps + grid + balls(rng, 3), capsules=bars)


@kind
def glossy_chain(rng):
    mirror = {"specular": 0.9, "glossiness": between_powers(rng, 1000, 200000)}
    chain = [ball((-3 + i, 0.5 + 0.2 * i * rng.random(), -0.3 * i), 0.5, "mirror") for i in range(7)]
    lamps = [ball((3, 5, 4), between_powers(rng, 0.05, 0.4), "lamp"), ball((-3, 4, -2), 0.3, "lamp")]
    return on_floor(rng, {"mirror": mirror, "lamp": lamp(between_powers(rng, 300, 10000))}, chain + lamps, length=6)


@kind
def one_bright_pixel(rng):
    spot = ball((rng.uniform(-2, 2), rng.uniform(0.2, 1.8), 0), between_powers(rng, 0.03, 0.1), "lamp")
    return without_floor(on_floor(rng, {"lamp": lamp(between_powers(rng, 10, 10000))}, [spot], length=2))


@kind
def mostly_black(rng):
    lamps = [ball(place(rng), between_powers(rng, 0.03, 0.2), "lamp") for _ in range(rng.randint(1, 3))]
    return without_floor(on_floor(rng, {"lamp": warm(rng, between_powers(rng, 10, 3000))}, lamps + balls(rng, 2)))


@kind
def moving_tree(rng):
    flying = [each | {"motion": [rng.uniform(0, 2) * share for share in direction(rng)], "color": tint(rng)}
              for each in balls(rng, rng.randint(115, 220), (0.05, 0.2), ("floor",))]
    lamps = [ball(place(rng), 0.05, "lamp") | {"motion": direction(rng)} for _ in range(rng.randint(2, 8))]
    return on_floor(rng, {"lamp": warm(rng, between_powers(rng, 100, 2000))}, flying + lamps)


@kind
def lamps_in_a_tree(rng):
    leaves = [ball(place(rng, 2, 0.5, 3, 2), rng.uniform(0.05, 0.25), rng.choice(("leaf", "red")))
              for _ in range(rng.randint(115, 400))]
    lamps = [ball(place(rng, 2), between_powers(rng, 0.02, 0.15), "lamp") for _ in range(rng.randint(3, 30))]
    return on_floor(rng, {"lamp": warm(rng, between_powers(rng, 30, 1000))}, leaves + lamps)


@kind
def tiny_far_lamps(rng):
    count = rng.randint(1, 4)
    suns = []
    for _ in range(count):
        x, y, z = direction(rng)
        suns.append(ball((300 * x, 300 * abs(y) + 30, 300 * z), between_powers(rng, 0.1, 3), "sun"))
    coated = {"diffuse": tint(rng), "specular": 0.05, "glossiness": 500}
    return on_floor(rng, {"sun": warm(rng, between_powers(rng, 3e4, 1e6)), "coated": coated},
                    suns + balls(rng, 6, materials=("coated", "red")))


@kind
def inside_a_ball(rng):
    shine = rng.random()
    shell = {"diffuse": 0.7 * (1 - shine), "specular": 0.9 * shine, "glossiness": between_powers(rng, 30, 3000)}
    spheres = [ball((0, 1, 0), 9, "shell"), ball((2, 2, 2), between_powers(rng, 0.05, 0.5), "lamp"), *balls(rng, 3)]
    return on_floor(rng, {"shell": shell, "lamp": warm(rng, between_powers(rng, 30, 1000))}, spheres, length=6)


@kind
def caustic(rng):
    spheres = [ball((0, 0.4, 0), 4, "brass"),
               ball((rng.uniform(-2.6, -1), 0.9, rng.uniform(-1, 1)), between_powers(rng, 0.05, 0.3), "lamp"),
               *balls(rng, 2)]
    brass = fixed.BRASS | {"glossiness": between_powers(rng, 100, 5000)}
    return on_floor(rng, {"brass": brass, "lamp": lamp(between_powers(rng, 100, 1000))}, spheres,
                    {"position": [0.6, 3.4, 1.4], "look_at": [0.5, 0, -0.3], "vertical_fov": 60})


@kind
def many_lamps(rng):
    bright = {f"lamp {k}": lamp([10.0 ** rng.uniform(0, 4) for _ in range(3)]) for k in range(8)}
    lamps = [ball(place(rng, high=4), between_powers(rng, 0.01, 0.1), rng.choice(list(bright)))
             for _ in range(rng.randint(30, 300))]
    return on_floor(rng, bright, lamps + balls(rng, 5), length=3)


@kind
def planes_only(rng):
    faces = [([0, 1, 0], 0), ([0, 0, 1], 3), ([1, 0, 0], 3), ([-1, 0, 0], 4)]
    planes = [{"normal": normal, "offset": offset, "material": rng.choice(("red", "leaf", "gloss"))}
              for normal, offset in faces]
    planes.append({"normal": [rng.uniform(-0.2, 0.2), -1, 0], "offset": 7, "material": "shine"})
    gloss = {"diffuse": 0.2, "specular": 0.5, "glossiness": 200}
    return on_floor(rng, {"shine": warm(rng, between_powers(rng, 0.2, 20)), "gloss": gloss}, []) | {"planes": planes}


@kind
def orthographic(rng):
    lights, materials = sunlit(rng)
    camera = view(rng)
    del camera["vertical_fov"]
    return on_floor(rng, materials, balls(rng, rng.randint(5, 30), (0.1, 0.6)) + lights,
                    camera | {"projection": "orthographic", "vertical_extent": rng.uniform(3, 6)})


@kind
def hidden_lamps(rng):
    hidden = {"hidden_from_camera": True}
    materials = {"lamp": warm(rng, between_powers(rng, 10, 500)) | hidden, "wall": {"diffuse": 0.7} | hidden,
                 "gloss": {"diffuse": 0.1, "specular": 0.7, "glossiness": 1000}}
    lamps = [ball(place(rng), between_powers(rng, 0.05, 0.4), "lamp") for _ in range(rng.randint(1, 4))]
    return on_floor(rng, materials, lamps + [ball((0, 0, 0), 12, "wall")] + balls(rng, 5, materials=("gloss", "red")))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--first-seed", type=int, default=0)
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    for name, made in hundred(options.first_seed):
        (options.folder / f"{name}.json").write_text(json.dumps(made), encoding="utf-8")


if __name__ == "__main__":
    main()
