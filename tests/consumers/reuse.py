"""A compiler launcher that copies an object file from another build if its sources and its command are the same. Arguments:
a file with the other build's commands (`ninja -t compdb`), the other build, this build's folder of pt, and the compiler's
command."""

import json
import pathlib
import re
import shutil
import subprocess
import sys

commands, other, own = (pathlib.Path(word) for word in sys.argv[1:4])
words = sys.argv[4:]


def plain(text, build, output):
    """Removes what may differ between builds: folders, launchers, warnings, and link-time optimization that -fno-lto
    turns off."""
    text = text.replace(output, "OUT").replace(str(build), "BUILD").replace("\\", "").replace('"', "").replace("'", "")
    before, off, after = text.rpartition(" -fno-lto")
    text = re.sub(r" -f(no-fat-lto-objects|lto(=\S+)?)(?= )", "", f"{before} ") + off + after
    return sorted(word for word in text.split() if not word.startswith("-W") and not word.endswith("ccache"))


def same_sources(source):
    generated = [path.relative_to(own) for path in (own / "lib/shaders").glob("*.h")]
    return generated and all(
        (other / name).exists() and (other / name).read_text().replace(str(other), str(own)) == (own / name).read_text()
        for name in [*generated, pathlib.Path(source).relative_to(own)])


def reused():
    output = words[words.index("-o") + 1] if "-o" in words else ""
    name = output.removeprefix("pt/")
    if not output.startswith("pt/lib/CMakeFiles/pt_core.dir/") or not pathlib.Path(words[-1]).is_relative_to(own):
        return False
    for entry in json.loads(commands.read_text()):
        if entry["output"] == name and (other / name).exists() and same_sources(words[-1]):
            if plain(" ".join(words), own, output) == plain(entry["command"], other, name):
                shutil.copyfile(other / name, output)
                pathlib.Path(words[words.index("-MF") + 1]).write_text(f"{output}:\n")
                return True
    return False


if not reused():
    sys.exit(subprocess.run(words).returncode)
