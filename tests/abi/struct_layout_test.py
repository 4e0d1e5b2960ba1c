"""Sizes and offsets of the structs in the headers of a folder, against a table. Called by CTest as
struct_layout_test.py HEADERS TABLE PACKAGE C_COMPILER; with the first and the last argument alone it prints the table.

A struct may grow at its tail, which adds lines to the table and changes the struct's size; whatever else differs breaks
programs that were compiled before. The structs of the Python package in PACKAGE are held by the same table, the types
of their members by the headers, and so are its enumerations: what is added to a header is added there."""

import ctypes
import enum
import importlib.util
import pathlib
import re
import subprocess
import sys
import tempfile


def without_comments(text):
    return re.sub(r"/\*.*?\*/", " ", text, flags=re.DOTALL)


def members_of(body):
    """Names and types of the members that are declared one by line of a struct's body."""
    for declaration in filter(None, (" ".join(part.split()) for part in body.split(";"))):
        kind, name, array = re.fullmatch(r"(.*?)(\w+)((?:\[\d+\])*)", declaration).groups()
        yield name, kind.strip() + array


def struct_bodies(headers):
    return [match for text in headers.values()
            for match in re.findall(r"\bstruct (\w+) \{(.*?)\}", without_comments(text), re.DOTALL)]


def structs_of(headers):
    """Name and member names of each struct that the headers define."""
    return [(name, [member for member, _ in members_of(body)]) for name, body in struct_bodies(headers)]


def types_of(headers):
    """The declared type of each member: "pt_sphere.center" is "double[3]"."""
    return {f"{name}.{member}": kind for name, body in struct_bodies(headers) for member, kind in members_of(body)}


def enumerators_of(headers):
    """The number of each PT_* that an enumeration defines."""
    return {name: int(number) for text in headers.values()
            for body in re.findall(r"\benum \{(.*?)\}", without_comments(text), re.DOTALL)
            for name, number in re.findall(r"\b(PT_\w+) = (-?\d+)", body)}


def program_for(structs, includes):
    """C that prints "struct size" and "struct.member offset size"."""
    lines = ["#include <stddef.h>", "#include <stdio.h>", *(f"#include <pt/{name}>" for name in includes),
             "int main(void) {"]
    for struct, members in structs:
        lines.append(f'printf("{struct} %zu\\n", sizeof({struct}));')
        for member in members:
            lines.append(f'printf("{struct}.{member} %zu %zu\\n", offsetof({struct}, {member}), '
                         f"sizeof((({struct} *)0)->{member}));")
    return "\n".join(lines + ["return 0; }"])


def layout_of(headers, compiler):
    """The table that headers, text by name, have, line by line, as the compiler lays their structs out."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "pt").mkdir()
        for header, text in headers.items():
            (folder / "pt" / header).write_text(text)
        (folder / "layout.c").write_text(program_for(structs_of(headers), headers))
        subprocess.run([compiler, "-std=c99", "-I", folder, folder / "layout.c", "-o", folder / "layout"], check=True)
        return subprocess.run([folder / "layout"], check=True, capture_output=True, text=True).stdout.splitlines()


def loaded_file(path):
    """A Python file as a module by itself: the package around it needs NumPy, and the library."""
    spec = importlib.util.spec_from_file_location(path.stem, path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def ctypes_structs(module):
    return {name: struct for name, struct in vars(module).items()
            if isinstance(struct, type) and issubclass(struct, ctypes.Structure) and name.startswith("pt_")}


def python_layout(structs):
    """The same table of ctypes structs."""
    lines = []
    for name, struct in structs.items():
        lines.append(f"{name} {ctypes.sizeof(struct)}")
        for member, _ in struct._fields_:
            field = getattr(struct, member)
            lines.append(f"{name}.{member} {field.offset} {field.size}")
    return lines


NUMBERS = {"float": "c_float", "double": "c_double", "char": "c_char", "int32_t": "c_int", "uint32_t": "c_uint",
           "int64_t": "c_long", "uint64_t": "c_ulong", "uint8_t": "c_ubyte"}


def allowed_types(declared):
    """Names of the ctypes types that a declared type may be."""
    kind, bracket, count = declared.partition("[")
    kind = kind.removeprefix("const ")
    if kind == "char *":
        return {"c_char_p"}
    if kind.endswith(" *"):
        return {"c_void_p", f"LP_{NUMBERS.get(kind[:-2], kind[:-2])}"}
    if bracket:
        return {f"{NUMBERS[kind]}_Array_{count[:-1]}"}
    return {NUMBERS.get(kind, "CFunctionType" if kind.endswith("_fn") else kind)}


def wrong_types(structs, declared):
    """Members that are of another type than the header declares; a float of four bytes is no integer of four bytes."""
    return [f"{name}.{member} is {kind.__name__}, not {declared[f'{name}.{member}']}"
            for name, struct in structs.items() for member, kind in struct._fields_
            if f"{name}.{member}" in declared and kind.__name__ not in allowed_types(declared[f"{name}.{member}"])]


PREFIXES = {"Result": "PT_", "ColumnType": "PT_TYPE_", "LogLevel": "PT_LOG_", "CreateFlag": "PT_CREATE_",
            "DeviceKind": "PT_DEVICE_", "MaterialFlag": "PT_MATERIAL_"}  # others: PT_QUANTITY_ of Quantity


def python_enumerators(module):
    return {PREFIXES.get(name, f"PT_{name.upper()}_") + member.name: int(member)
            for name, kind in vars(module).items() if isinstance(kind, type) and issubclass(kind, enum.Enum)
            for member in kind}


def package_complaints(structs, enumerators, headers, table):
    """Where the Python package is not what the headers are."""
    listed = [line for line in table if re.match(r"\w+", line).group() in structs]
    found = [f"_structs.py: {line}" for line in differences(python_layout(structs), listed)]
    found += [f"_structs.py: {line}" for line in wrong_types(structs, types_of(headers))]
    return found + [f"_enums.py: {'-' if pair in enumerators_of(headers).items() else '+'} {pair[0]} = {pair[1]}"
                    for pair in sorted(enumerators.items() ^ enumerators_of(headers).items())]


def differences(found, table):
    return [f"{'+' if line in found else '-'} {line}" for line in sorted(set(found) ^ set(table))]


def check_the_check(headers, table, compiler):
    """What programs would notice is found: a member at the tail, in the middle, of another type, renamed, gone."""
    for old, new, wanted in (
        ("uint32_t row_count;", "uint32_t row_count; uint64_t more;", "+ pt_render.more 48 8"),
        ("double offset;", "double before; double offset;", "+ pt_plane.offset 32 8"),
        ("float glossiness;", "double glossiness;", "+ pt_material.glossiness 40 8"),
        ("double shutter_open;", "double shutter;", "- pt_camera.shutter_open 88 8"),
        ("double rmse_low;", "", "- pt_stats.rmse_low 56 8"),
        ("int64_t index;", "int32_t index;", "- pt_broken_rule.index 8 8"),
    ):
        assert sum(text.count(old) for text in headers.values()) == 1, old
        changed = {name: text.replace(old, new) for name, text in headers.items()}
        found = differences(layout_of(changed, compiler), table)
        if wanted not in found:
            sys.exit(f"after {old} -> {new} the check found {found}")


def check_the_package_check(structs, enumerators, headers, table):
    """What is forgotten in the package is found: a member, a type of equal size, an enumerator, its number."""
    def said(structs=structs, enumerators=enumerators, headers=headers, table=table):
        return package_complaints(structs, enumerators, headers, table)

    class pt_material(ctypes.Structure):
        _fields_ = [*structs["pt_material"]._fields_[:3], ("glossiness", ctypes.c_uint32)]

    class pt_stats(ctypes.Structure):
        _fields_ = structs["pt_stats"]._fields_[:-1]

    fewer = {name: number for name, number in enumerators.items() if name != "PT_QUANTITY_SAMPLE_COUNT"}
    for found, wanted in (
        (said({**structs, "pt_material": pt_material}), "_structs.py: pt_material.glossiness is c_uint, not float"),
        (said({**structs, "pt_stats": pt_stats}), "_structs.py: - pt_stats.mean_sample_count 104 8"),
        (said(enumerators=fewer), "_enums.py: - PT_QUANTITY_SAMPLE_COUNT = 2"),
        (said(enumerators={**enumerators, "PT_OK": 1}), "_enums.py: + PT_OK = 1"),
        (said(table=[*table, "pt_image.more 56 4"]), "_structs.py: - pt_image.more 56 4"),
    ):
        if wanted not in found:
            sys.exit(f"the check of the package found {found}, not {wanted}")


def main():
    headers = {path.name: path.read_text() for path in sorted(pathlib.Path(sys.argv[1]).glob("*.h"))}
    if len(sys.argv) == 3:
        print("\n".join(layout_of(headers, sys.argv[2])))
        return
    table = pathlib.Path(sys.argv[2]).read_text().splitlines()
    package, compiler = pathlib.Path(sys.argv[3]), sys.argv[4]
    check_the_check(headers, table, compiler)
    structs = ctypes_structs(loaded_file(package / "_structs.py"))
    enumerators = python_enumerators(loaded_file(package / "_enums.py"))
    check_the_package_check(structs, enumerators, headers, table)
    if not structs or len(structs_of(headers)) != sum(
            len(re.findall(r"\bstruct\b.*\{$", text, re.MULTILINE)) for text in headers.values()):
        sys.exit("not all structs were found")
    found = differences(layout_of(headers, compiler), table)
    found += package_complaints(structs, enumerators, headers, table)
    if found:
        sys.exit("\n".join(found))


main()
