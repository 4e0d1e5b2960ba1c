"""Generates Python's structs and enumerations (pt/_structs.py, pt/_enums.py), the kernels' numbers
(shaders/enumerations.h) and the program's value names (cli/base/enumerations.h) from the C headers.

Usage: python3 lib/python/generate.py [HEADERS [ROOT]]. The generated files are committed, because the package is
installed without headers.
"""

import pathlib
import re
import sys
import textwrap

ENUMERATIONS = (
    ("PT_QUANTITY_", "Quantity", "IntEnum", "What is read of an image."),
    ("PT_FORMAT_", "Format", "IntEnum", "What a pixel is; A is 1."),
    ("PT_MATERIAL_", "MaterialFlag", "IntFlag", "What else a material is."),
    ("PT_PROJECTION_", "Projection", "IntEnum", "What the rays of a camera have in common."),
    ("PT_ESTIMATOR_", "Estimator", "IntEnum", "How light is found. All converge to the same image, with different noise "
                                              "and time."),
    ("PT_SAMPLER_", "Sampler", "IntEnum", "Where a sample's numbers come from. All converge to the same image, at other "
                                          "rates."),
    ("PT_SAMPLING_", "Sampling", "IntEnum", "Where samples go. All converge to the same image."),
    ("PT_TYPE_", "ColumnType", "IntEnum", "What a component of a column is."),
    ("PT_LOG_", "LogLevel", "IntEnum", "Level of a log line."),
    ("PT_CREATE_", "CreateFlag", "IntFlag", "What else a context is to be; see Context."),
    ("PT_DEVICE_", "DeviceKind", "IntEnum", "What a Vulkan device is."),
    ("PT_FEATURE_", "Feature", "IntFlag", "What the kernel contains because the scene needs it."),
    ("PT_LIGHT_", "Light", "IntEnum", "What a comparison of two images comes to."),
    ("PT_UNCERTAIN_", "Uncertain", "IntFlag", "Why an error that is stated may be far off. Its bounds are then wider by a "
                                              "further factor of two."),
    ("PT_", "Result", "IntEnum", "What a call came to. Errors are raised (see Error), so that calls return one of the "
                                 "first four."),
)

# Prefix: name of the program's table, separator of words in value names.
OF_PROGRAM = {"PT_SAMPLER_": ("samplers", "-"), "PT_SAMPLING_": ("samplings", "-"), "PT_ESTIMATOR_": ("estimators", "-"),
              "PT_PROJECTION_": ("projections", "-"), "PT_FEATURE_": ("features", "_"),
              "PT_UNCERTAIN_": ("uncertainties", "_")}
OF_KERNELS = ("PT_ESTIMATOR_", "PT_SAMPLER_", "PT_QUANTITY_", "PT_FORMAT_")

NUMBERS = {"float": "c_float", "double": "c_double", "char": "c_char", "int32_t": "c_int32", "uint32_t": "c_uint32",
           "int64_t": "c_int64", "uint64_t": "c_uint64", "uint8_t": "c_uint8"}
POINTERS = {"char *": "c_char_p", "void *": "c_void_p"}


def without_comments(text):
    return re.sub(r"/\*.*?\*/", " ", text, flags=re.DOTALL)


def python_type(declared, known):
    """Pointers to structs that are not in `known` become c_void_p."""
    kind, bracket, count = declared.removeprefix("const ").partition("[")
    if bracket:
        return f"{NUMBERS[kind.strip()]} * {count[:-1]}"
    if kind.endswith(" *"):
        target = kind[:-2]
        target = NUMBERS.get(target, target if target in known else None)
        return POINTERS.get(kind) or (f"POINTER({target})" if target else "c_void_p")
    return NUMBERS.get(kind, kind)


def members_of(body):
    for declaration in filter(None, (" ".join(part.split()) for part in body.split(";"))):
        kind, name, array = re.fullmatch(r"(.*?)(\w+)((?:\[\d+\])*)", declaration).groups()
        yield name, kind.strip() + array


def structs_text(headers):
    lines = ['"""The structs of the headers in lib/include/pt, field by field, as lib/python/generate.py writes them; a field',
             'that is not set is 0, which means its default."""', "", "import ctypes",
             "from ctypes import POINTER, c_char, c_char_p, c_double, c_float, c_int32, c_int64, c_uint8, c_uint32, "
             "c_uint64, c_void_p", "from typing import Any", ""]
    text = without_comments("".join(headers))
    for result, name, parameters in re.findall(r"typedef (\w+) \(\*(pt_\w+)\)\(([^)]*)\);", text):
        types = [python_type(kind.strip(), ()) for kind in re.findall(r"([^,]*?)\w+(?:,|$)", parameters)]
        lines.append(f"{name} = ctypes.CFUNCTYPE({', '.join(['None' if result == 'void' else NUMBERS[result], *types])})")
    lines += ["", "", "class Sized(ctypes.Structure):",
              '    """A struct that begins with its size, as its caller (here: this file) has it."""', "",
              "    def __init__(self, **fields: Any) -> None:",
              "        super().__init__(struct_size=ctypes.sizeof(self), **fields)"]
    known = []
    for name, body in re.findall(r"\bstruct (\w+) \{(.*?)\}", text, re.DOTALL):
        members = [(member, python_type(kind, known)) for member, kind in members_of(body)]
        base = "Sized" if members[0][0] == "struct_size" else "ctypes.Structure"
        fields = ", ".join(f'("{member}",~{kind.replace(" ", "~")})' for member, kind in members)
        fields = textwrap.fill(f"    _fields_ = [{fields}]", 120, subsequent_indent=" " * 16).replace("~", " ")
        lines += ["", "", f"class {name}({base}):", fields]
        known.append(name)
    return "\n".join(lines) + "\n"


def first_words(comment):
    return re.split(r"[:;.](?:\s|$)", " ".join(comment.replace("*", " ").split()))[0]


def enumerators_of(headers):
    for text in headers:
        for body in re.findall(r"\benum \{(.*?)\n\};", text, re.DOTALL):
            for before, name, number, after in re.findall(
                    r"(?:/\*\*((?:(?!\*/).)*)\*/\s*)?\b(PT_\w+) = (-?\d+),?(?:\s*/\*\*<((?:(?!\*/).)*)\*/)?", body, re.DOTALL):
                yield name, number, first_words(before or after)


def enums_text(headers):
    lines = ['"""The numbers of the headers in lib/include/pt, by name, as lib/python/generate.py writes them: PT_QUANTITY_RADIANCE',
             'is Quantity.RADIANCE."""', "", "import enum", "from typing import Final", "",
             "NO_OBJECT: Final = 0xFFFFFFFF  # of Quantity.OBJECT, where a ray meets nothing"]
    left = list(enumerators_of(headers))
    for prefix, name, base, words in ENUMERATIONS:
        members = [each for each in left if each[0].startswith(prefix)]
        left = [each for each in left if each not in members]
        lines += ["", "", f"class {name}(enum.{base}):", f'    """{words}"""', ""]
        for member, number, comment in members:
            line = f"    {member.removeprefix(prefix)} = {number}"
            lines.append(f"{line}  # {comment}" if comment and len(line) + len(comment) < 116 else line)
    return "\n".join(lines) + "\n"


def kernel_text(headers):
    lines = ["// Numbers of the headers in lib/include/pt, as lib/python/generate.py writes them. Part of gpu_layout.h."]
    for prefix in OF_KERNELS:
        members = [(name, number) for name, number, _ in enumerators_of(headers) if name.startswith(prefix)]
        lines += [f"PT_CONSTANT {name.removeprefix('PT_')} = {number};" for name, number in members]
        lines.append(f"PT_CONSTANT LAST_{prefix[3:-1]} = {max(int(number) for _, number in members)};")
    return "\n".join(lines) + "\n"


def program_text(headers):
    lines = ["// Names of the headers' numbers in options, scene files and reports. Generated by lib/python/generate.py.",
             "#pragma once", "", '#include "cli/base/names.h"', "", "#include <pt/pt.h>", "#include <pt/stats.h>", "",
             "namespace cli {", ""]
    for prefix, (table, mark) in OF_PROGRAM.items():
        names = [name for name, _, _ in enumerators_of(headers) if name.startswith(prefix)]
        words = {name: name.removeprefix(prefix).lower().replace("_", mark) for name in names}
        rows = [f'    {{"{words[name]}", {name}}},' for name in names]
        lines += [f"inline constexpr ValueNames {table}({{", *rows, "});", ""]
    return "\n".join([*lines, "} // namespace cli"]) + "\n"


def files_of(headers):
    ordered = [headers["pt.h"], *(text for name, text in sorted(headers.items()) if name not in ("pt.h", "vulkan.h"))]
    return {"lib/python/pt/_structs.py": structs_text(ordered), "lib/python/pt/_enums.py": enums_text(ordered),
            "shaders/enumerations.h": kernel_text(ordered), "cli/base/enumerations.h": program_text(ordered)}


def main():
    here = pathlib.Path(__file__).resolve().parent
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else here.parent / "include" / "pt"
    root = pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else here.parents[1]
    for name, text in files_of({path.name: path.read_text() for path in folder.glob("*.h")}).items():
        (root / name).write_text(text)


if __name__ == "__main__":
    main()
