import hashlib
import json
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/support"))
from scene_file import FOLDER, read_scene

SIZE = (128, 64)
SAMPLES = [16, 64, 256]
FEWER_SAMPLES = {"thousand-spheres": [4, 16, 64]}
REFERENCES = ROOT / "tests/reference/bench"

# Estimators that check the references: bsdf where lamps are large enough to be found by chance, otherwise light.
CHECKS = {
    "coursework": "bsdf",
    "coursework-motion": "bsdf",
    "open-sky": "light",
    "closed-room": "bsdf",
    "inside-a-ball": "bsdf",
    "glossy-ladder": "light",
    "large-lamp": "bsdf",
    "tiny-lamp": "light",
    "many-lamps": "light",
    "caged-lamp": "light",
    "dim-room": "light",
    "mirror-wall": "bsdf",
    "caustic": "bsdf",
    "thousand-spheres": "light",
}
NAMES = list(CHECKS)


def scene_path(name):
    return FOLDER / f"{name}.json"


def load_scene(name):
    return read_scene(scene_path(name))


def digest(scene):
    text = json.dumps({key: value for key, value in scene.items() if key != "film"}, sort_keys=True)
    return hashlib.sha256(text.encode()).hexdigest()[:16]


def sample_counts(name):
    return FEWER_SAMPLES.get(name, SAMPLES)


def read_reference_table(folder=REFERENCES):
    return json.loads((pathlib.Path(folder) / "references.json").read_text(encoding="utf-8"))
