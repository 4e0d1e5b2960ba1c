"""Reads scene files in Python."""

import json
import pathlib
import re

FOLDER = pathlib.Path(__file__).resolve().parents[2] / "cli/scenes"


def read_scene(path):
    """The JSON of a scene file whose comments have lines of their own, as those of cli/scenes have."""
    text = pathlib.Path(path).read_text(encoding="utf-8")
    return json.loads(re.sub(r"^\s*//.*$", "", text, flags=re.MULTILINE))
