import json
import pathlib
import re

FOLDER = pathlib.Path(__file__).resolve().parents[2] / "cli/scenes"


def read_scene(path):
    """Reads JSON with comments on separate lines, as in cli/scenes."""
    text = pathlib.Path(path).read_text(encoding="utf-8")
    return json.loads(re.sub(r"^\s*//.*$", "", text, flags=re.MULTILINE))
