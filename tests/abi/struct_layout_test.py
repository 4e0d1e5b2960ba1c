"""Checks sizes and offsets of structs, and numbers of enumerators: struct_layout_test.py HEADERS TABLE ROOT C_COMPILER.
With only HEADERS and C_COMPILER it prints the table. Structs may only grow at the end. Numbers must not change. The output of
ROOT/lib/python/generate.py must be current."""

import ctypes
import importlib.util
import pathlib
import re
import subprocess
import sys
import tempfile


def loaded_file(path):
    """Loads a file without its package, because the package needs NumPy and the library."""
    spec = importlib.util.spec_from_file_location(path.stem, path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


generate = loaded_file(pathlib.Path(__file__).resolve().parents[2] / "lib" / "python" / "generate.py")


def struct_bodies(headers):
    return [match for text in headers.values()
            for match in re.findall(r"\bstruct (\w+) \{(.*?)\}", generate.without_comments(text), re.DOTALL)]


def structs_of(headers):
    return [(name, [member for member, _ in generate.members_of(body)]) for name, body in struct_bodies(headers)]


def program_for(structs, includes):
    lines = ["#include <stddef.h>", "#include <stdio.h>", *(f"#include <pt/{name}>" for name in includes),
             "int main(void) {"]
    for struct, members in structs:
        lines.append(f'printf("{struct} %zu\\n", sizeof({struct}));')
        for member in members:
            lines.append(f'printf("{struct}.{member} %zu %zu\\n", offsetof({struct}, {member}), '
                         f"sizeof((({struct} *)0)->{member}));")
    return "\n".join(lines + ["return 0; }"])


def numbers_of(headers):
    """Returns a line with the number of enumerators of each enumeration, then a line for each enumerator."""
    left = [(name, number) for name, number, _ in generate.enumerators_of(headers.values())]
    lines = []
    for prefix, enumeration, *_ in generate.ENUMERATIONS:
        members = [each for each in left if each[0].startswith(prefix)]
        left = [each for each in left if each not in members]
        lines += [f"{enumeration} {len(members)}",
                  *(f"{enumeration}.{name.removeprefix(prefix)} {number}" for name, number in members)]
    return lines


def layout_of(headers, compiler):
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "pt").mkdir()
        for header, text in headers.items():
            (folder / "pt" / header).write_text(text)
        (folder / "layout.c").write_text(program_for(structs_of(headers), headers))
        subprocess.run([compiler, "-std=c99", "-I", folder, folder / "layout.c", "-o", folder / "layout"], check=True)
        done = subprocess.run([folder / "layout"], check=True, capture_output=True, text=True)
    return done.stdout.splitlines() + numbers_of(headers)


def ctypes_structs(module):
    return {name: struct for name, struct in vars(module).items()
            if isinstance(struct, type) and issubclass(struct, ctypes.Structure) and name.startswith("pt_")}


def python_layout(structs):
    lines = []
    for name, struct in structs.items():
        lines.append(f"{name} {ctypes.sizeof(struct)}")
        for member, _ in struct._fields_:
            field = getattr(struct, member)
            lines.append(f"{name}.{member} {field.offset} {field.size}")
    return lines


def packed(layout):
    """Writes each struct or enumeration on one line: its name and size, then its members."""
    return re.sub(r"\n\w+\.", ", ", "\n".join(layout))


def unpacked(text):
    rows = [line.split(", ") for line in text.splitlines()]
    return [line for struct, *members in rows for line in (struct, *(f"{struct.split()[0]}.{each}" for each in members))]


def differences(found, table):
    return [f"{'+' if line in found else '-'} {line}" for line in sorted(set(found) ^ set(table))]


def check_the_check(headers, table, compiler):
    """Negative control: a member is added at the end or in the middle, changes its type or name, or is removed. Each changes
    the generated files too."""
    for old, new, wanted in (
        ("uint32_t row_count;", "uint32_t row_count; uint64_t more;", "+ pt_render.more 48 8"),
        ("double offset;", "double before; double offset;", "+ pt_plane.offset 32 8"),
        ("float glossiness;", "double glossiness;", "+ pt_material.glossiness 40 8"),
        ("double shutter_open;", "double shutter;", "- pt_camera.shutter_open 88 8"),
        ("double rmse_low;", "", "- pt_error_estimate.rmse_low 16 8"),
        ("int64_t index;", "int32_t index;", "- pt_broken_rule.index 8 8"),
        ("PT_PENDING = 3,", "PT_PENDING = 4,", "- Result.PENDING 3"),
    ):
        assert sum(text.count(old) for text in headers.values()) == 1, old
        changed = {name: text.replace(old, new) for name, text in headers.items()}
        found = differences(layout_of(changed, compiler), table)
        if wanted not in found:
            sys.exit(f"after {old} -> {new} the check found {found}")
        if generate.files_of(changed) == generate.files_of(headers):
            sys.exit(f"after {old} -> {new} the generated files are the same")


def main():
    headers = {path.name: path.read_text() for path in sorted(pathlib.Path(sys.argv[1]).glob("*.h"))}
    if len(sys.argv) == 3:
        print(packed(layout_of(headers, sys.argv[2])))
        return
    table = unpacked(pathlib.Path(sys.argv[2]).read_text())
    root, compiler = pathlib.Path(sys.argv[3]), sys.argv[4]
    check_the_check(headers, table, compiler)
    if len(structs_of(headers)) != sum(
            len(re.findall(r"\bstruct\b.*\{$", text, re.MULTILINE)) for text in headers.values()):
        sys.exit("not all structs were found")
    structs = ctypes_structs(loaded_file(root / "lib/python/pt/_structs.py"))
    listed = [line for line in table if re.match(r"\w+", line).group() in structs]
    found = differences(layout_of(headers, compiler), table)
    found += [f"_structs.py: {line}" for line in differences(python_layout(structs), listed)]
    found += [f"{name} is not what lib/python/generate.py writes: run it"
              for name, text in generate.files_of(headers).items() if (root / name).read_text() != text]
    if found or not structs:
        sys.exit("\n".join(found))


main()
