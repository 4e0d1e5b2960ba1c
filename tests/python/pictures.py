import numpy as np
import pt

LAMP = pt.Material(emission=(4, 3, 2))
WHITE = pt.Material(diffuse=0.8)
GLOSSY = pt.Material(diffuse=(0.4, 0.1, 0.1), specular=0.4, glossiness=100)
SCENE = pt.Scene([pt.Sphere((0, 1, 0), 1, GLOSSY), pt.Sphere((2, 4, 2), 1, LAMP)], [pt.Plane((0, 1, 0), 0, WHITE)])
CAMERA = pt.Camera(position=(0, 1.5, 5), target=(0, 1, 0))
WIDTH, HEIGHT = 24, 16

SCENE_FILE = {
    "camera": {"position": [0, 1.5, 5], "look_at": [0, 1, 0], "vertical_fov": 45},
    "film": {"width": 24, "height": 16},
    "materials": {
        "glossy": {"diffuse": [0.4, 0.1, 0.1], "specular": 0.4, "glossiness": 100},
        "lamp": {"emission": [4, 3, 2]},
        "white": {"diffuse": 0.8}
    },
    "spheres": [{"center": [0, 1, 0], "radius": 1, "material": "glossy"},
                {"center": [2, 4, 2], "radius": 1, "material": "lamp"}],
    "planes": [{"normal": [0, 1, 0], "offset": 0, "material": "white"}]
}


def settings(**fields):
    return pt.RenderSettings(**{"width": WIDTH, "height": HEIGHT, **fields})


def ready(context, scene=SCENE, **fields):
    context.set_scene(scene)
    context.set_camera(CAMERA)
    context.set_render(settings(**fields))
    return context


def radiance(context, scene, samples=4):
    return context.render(scene, CAMERA, settings(), samples).radiance


def cloud(count, seed=1):
    random = np.random.default_rng(seed)
    return (random.normal((0, 1, 0), 0.7, (count, 3)).astype(np.float32),
            random.uniform(0.1, 1, (count, 3)).astype(np.float32))
