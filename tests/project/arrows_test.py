"""Checks that rooms of C++ and Python include only earlier rooms, and that no Python modules import each other:
arrows_test.py ROOT."""

import ast
import graphlib
import pathlib
import re
import sys

ORDERS = {"cli": ("base", "image", "film", "scene", "devices", "picture", "render", "merge", "denoise", "tonemap", "compare",
                  "selftest", "course"),
          "lib": ("platform", "base", "scene", "tree", "points", "view", "film", "denoise", "display", "vulkan",
                  "glsl_module", "code", "kernel", "render", "api", "scene_file")}
PYTHON = ("core", "tachyon", "figures", "view", "farm", "all")


def arrows(part, includes):
    order = ORDERS[part]
    found = set()
    for room, text in includes:
        for target in re.findall(rf'^#include "{part}/(\w+)/', text, re.MULTILINE):
            if order.index(target) > order.index(room):
                found.add((room, target))
    return found


def room_of(module):
    """Returns the subpackage, "core" for a module pt._*, and "all" for pt, which imports every module."""
    first = module.split(".")[1:2] or ["all"]
    return "core" if first[0].startswith("_") else first[0]


def imports_of(modules):
    """Maps each module to the `modules` that it imports, also for types or in functions. `modules` maps names to texts."""
    found = {}
    for module, text in modules.items():
        names = set()
        for node in ast.walk(ast.parse(text)):
            if isinstance(node, ast.Import):
                names |= {each.name for each in node.names}
            elif isinstance(node, ast.ImportFrom):
                parts = {f"{node.module}.{each.name}" for each in node.names}
                names |= parts if parts <= modules.keys() else parts | {node.module}
        found[module] = (names & modules.keys()) - {module, "pt"}
    return found


def python_faults(modules):
    imports = imports_of(modules)
    faults = [f"{module} imports {other}" for module, others in imports.items() for other in sorted(others)
              if PYTHON.index(room_of(other)) > PYTHON.index(room_of(module))]
    try:
        graphlib.TopologicalSorter(imports).prepare()
    except graphlib.CycleError as error:
        faults.append(f"{' and '.join(error.args[1])} import each other")
    return faults


def python_modules(folder):
    names = {path: ".".join(path.relative_to(folder.parent).with_suffix("").parts).removesuffix(".__init__")
             for path in folder.rglob("*.py")}
    return {name: path.read_text(encoding="utf-8") for path, name in names.items()}


def check_the_check():
    text = '#include "cli/base/a.h"\n#include "cli/render/b.h"\n#include "cli/scene/c.h"\n'
    if arrows("cli", [("scene", text)]) != {("scene", "render")} or arrows("cli", [("render", text)]):
        sys.exit("an arrow that turns back is not told from one that does not")
    one = {"pt": "from pt._a import A", "pt._a": "import numpy", "pt.figures._b": "from pt._a import A"}
    for spoiled in ({"pt._a": "def f():\n    from pt.figures._b import B"}, {"pt._a": "import pt.figures._b"},
                    {"pt.figures._b": "from pt.figures import _c", "pt.figures._c": "import pt.figures._b"}):
        if python_faults(one) or not python_faults(one | spoiled):
            sys.exit(f"{spoiled} is not told from imports in order")


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
    modules = python_modules(root / "lib/python/pt")
    if faults := python_faults(modules):
        sys.exit("\n".join(faults))
    if {room_of(module) for module in modules} != set(PYTHON):
        sys.exit(f"lib/python/pt: the order has {PYTHON}")


main()
