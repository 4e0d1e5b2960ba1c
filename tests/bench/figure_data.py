"""Droplets of atoms as LAMMPS dumps, of any count from a seed, and what programs read of them besides."""

import json
import math
import random

SEED = 5
SPACING = 1.68  # of a face-centred cubic lattice, its edge: a Lennard-Jones crystal that is about to melt
JITTER = 0.08  # standard deviation
RADIUS = 0.56  # so that neighbours all but touch
COLORS = ((0.0, 0.447, 0.698), (0.902, 0.624, 0.0), (0.0, 0.62, 0.451))  # of the types, sRGB
HEADER = 9  # lines of a dump before its atoms


def write_dump(path, count):
    """The count of sites nearest to the middle, moved at random; the types are layers of the crystal."""
    generator = random.Random(SEED)
    radius = SPACING * (3 * count / (16 * math.pi)) ** (1 / 3)
    reach = int(radius / SPACING) + 2
    sites = []
    for x in range(-2 * reach, 2 * reach + 1):
        for y in range(-2 * reach, 2 * reach + 1):
            for z in range(-2 * reach + (x + y) % 2, 2 * reach + 1, 2):
                square = x * x + y * y + z * z
                if square <= 4 * (radius / SPACING + 1) ** 2:
                    sites.append((square, x, y, z))
    sites.sort()
    side = radius + 2 * SPACING
    with open(path, "w", encoding="ascii") as file:
        file.write(f"ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n{count}\nITEM: BOX BOUNDS ff ff ff\n")
        file.write(f"{-side:.4f} {side:.4f}\n" * 3 + "ITEM: ATOMS id type x y z vx\n")
        for number, (_, *site) in enumerate(sites[:count], 1):
            x, y, z = (SPACING / 2 * i + generator.gauss(0, JITTER) for i in site)
            kind = 1 + (site[2] // 4) % len(COLORS)
            file.write(f"{number} {kind} {x:.4f} {y:.4f} {z:.4f} {generator.gauss(0, 1):.4f}\n")


def view_of_scene(path):
    """The camera and the lamps, one of which is the sky, of a scene file that pt figure wrote."""
    with open(path, encoding="utf-8") as file:
        scene = json.load(file)
    materials = scene["materials"]
    lamps = [{**sphere, "emission": materials[sphere["material"]]["emission"]} for sphere in scene["spheres"]
             if "emission" in materials.get(sphere.get("material"), {})]
    lamp, sky = sorted(lamps, key=lambda sphere: sphere["radius"])
    return {"camera": scene["camera"], "sky": sky, "lamp": lamp,
            "max_path_length": scene["render"]["max_path_length"]}


def linear(color):
    """Of sRGB."""
    return [value / 12.92 if value <= 0.04045 else ((value + 0.055) / 1.055) ** 2.4 for value in color]


def read_dump(path):
    """Types and places, by NumPy, as a user's script would."""
    import numpy
    rows = numpy.loadtxt(path, skiprows=HEADER, usecols=(1, 2, 3, 4))
    return rows[:, 0].astype(int), rows[:, 1:]
