"""Cells of a notebook as a script: from a simulation's arrays to pictures and a film.

    python3 particles.py [COUNT [WIDTH]]"""

# %% Particles of a simulation

import pickle
import sys

import numpy as np
import pt

COUNT = int(sys.argv[1]) if len(sys.argv) > 1 else 20_000
WIDTH = int(sys.argv[2]) if len(sys.argv) > 2 else 640
SIZE = (WIDTH, WIDTH * 3 // 4)

random = np.random.default_rng(7)
particles = np.zeros(COUNT, [("position", np.float32, 3), ("radius", np.float32), ("color", np.uint8, 3)])
particles["position"] = random.uniform((-2, 0, -1), (2, 1, 1), (COUNT, 3))
particles["radius"] = 0.6 / np.cbrt(COUNT) * random.uniform(0.5, 1.0, COUNT)
particles["color"] = np.where(particles["position"][:, :1] > 0, (230, 110, 40), (60, 120, 210))

# %% A figure

image = pt.render(particles["position"], particles["radius"], particles["color"], size=SIZE, samples=32, up="y",
                  floor=True)
image.save("particles.png")
print(image)

# %% Linear radiance, its standard error, and sample counts

print(f"mean radiance {image.radiance.mean():.3f}, brightest {image.radiance.max():.3f}, error {image.error:.1%}")

# %% Another light and camera, and a target error of 5%

spheres = pt.SphereArray(particles["position"], particles["radius"],
                         pt.Material(diffuse=0.6, specular=0.3, glossiness=50), color=particles["color"])
scene = pt.Scene(
    spheres=[pt.Sphere((3, 4, 3), 0.5, pt.Material(emission=(60, 52, 40)))],
    planes=[pt.Plane((0, 1, 0), 0.05, pt.Material(diffuse=0.7))],
    sphere_arrays=[spheres])
camera = pt.Camera.around(spheres.center, spheres.radius, direction=(-0.4, 0.3, 1), aspect=SIZE[0] / SIZE[1])

context = pt.Context()
lit = context.render(scene, camera, pt.RenderSettings(*SIZE), samples=256, target_error=0.05,
                     progress=lambda share: print(f"\r{share:4.0%}", end="", file=sys.stderr))
lit.save("lamp.png")
print(f"\n{lit}")

# %% Films of different samples are added

halves = []
for first in 0, 8:
    context.set_render(pt.RenderSettings(*SIZE, first_sample=first))
    context.accumulate(8)
    halves.append(pickle.loads(pickle.dumps(context.film())))
whole = sum(halves)
whole.save("particles.ptfilm")
context.set_render(pt.RenderSettings(*SIZE))
context.accumulate(16)
assert np.array_equal(whole.image(), context.image())
print(whole)

# %% Moving particles, with the same context and arrays

for step in range(3):
    particles["position"][:, 1] *= 0.8
    context.render(scene, camera, pt.RenderSettings(*SIZE), samples=8).save(f"step-{step}.png")
context.close()
