from __future__ import annotations

import pathlib
import re
from typing import Final

SHADERS: Final = (".comp", ".glsl", ".h")
STRING_OR_COMMENT: Final = re.compile(r'"(?:[^"\\\n]|\\.)*"|//[^\n]*|/\*.*?\*/', re.DOTALL)


def code_of(path: pathlib.Path) -> str | None:
    """Returns GLSL or JSON without comments, indentation and empty lines, or None if it cannot be read."""
    try:
        text = path.read_text(encoding="utf-8", errors="replace").replace("\\\n", "")
    except OSError:
        return None
    bare = STRING_OR_COMMENT.sub(lambda found: found[0] if found[0][0] == '"' else " ", text)
    return "\n".join(line for line in map(str.strip, bare.splitlines()) if line)
