"""Checks that rooms include only earlier rooms: arrows_test.py ROOT."""

import pathlib
import re
import sys

ORDERS = {"cli": ("base", "image", "film", "scene", "render", "merge", "denoise", "tonemap", "compare", "selftest",
                  "course"),
          "lib": ("platform", "base", "scene", "tree", "points", "view", "film", "denoise", "display", "vulkan",
                  "glsl_module", "code", "kernel", "render", "api", "scene_file")}


def arrows(part, includes):
    order = ORDERS[part]
    found = set()
    for room, text in includes:
        for target in re.findall(rf'^#include "{part}/(\w+)/', text, re.MULTILINE):
            if order.index(target) > order.index(room):
                found.add((room, target))
    return found


def check_the_check():
    text = '#include "cli/base/a.h"\n#include "cli/render/b.h"\n#include "cli/scene/c.h"\n'
    if arrows("cli", [("scene", text)]) != {("scene", "render")} or arrows("cli", [("render", text)]):
        sys.exit("an arrow that turns back is not told from one that does not")


def main():
    root = pathlib.Path(sys.argv[1])
    check_the_check()
    for part, order in ORDERS.items():
        files = [path for path in sorted((root / part).glob("*/*"))
                 if path.suffix in (".h", ".cpp") and path.parent.name != "examples"]
        rooms = {path.parent.name for path in files}
        if rooms != set(order):
            sys.exit(f"{part}: the rooms are {sorted(rooms)}, the order has {sorted(order)}")
        found = arrows(part, [(path.parent.name, path.read_text(encoding="utf-8")) for path in files])
        if found:
            sys.exit(f"{part}: includes turn back: {sorted(found)}")


main()
