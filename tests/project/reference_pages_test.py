"""reference_pages_test.py DOXYGEN DOXYFILE HEADERS.

Doxygen's warnings are errors. Each enumerator needs a comment, and each function must state its threads. HEADERS is a folder, and
`headers` maps names to texts.
"""

import pathlib
import re
import subprocess
import sys
import tempfile


def doxygen_complaints(doxygen, settings, headers):
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name) / "pt"
        folder.mkdir()
        for header, text in headers.items():
            (folder / header).write_text(text)
        settings += f"\nINPUT = {folder}\nSTRIP_FROM_PATH = {name}\nSTRIP_FROM_INC_PATH = {name}\nOUTPUT_DIRECTORY = {name}\n"
        done = subprocess.run([doxygen, "-"], input=settings, capture_output=True, text=True)
        return "" if done.returncode == 0 else done.stderr or "no reason was given"


def silent_functions(header):
    functions = re.findall(r"/\*\*((?:(?!\*/).)*)\*/\s*PT_API[^;]*?\b(pt_\w+)\([^;]*\);", header, re.DOTALL)
    return sorted(set(re.findall(r"^PT_API[^;(]*?\b(pt_\w+)\(", header, re.MULTILINE)) -
                  {name for comment, name in functions if "thread" in comment})


def silent_values(header):
    header = re.sub(r"/\*\*<.*?\*/", "@", header, flags=re.DOTALL)
    values = re.findall(r"(\*/\s*)?\b(PT_\w+) = -?\d+,?\s*(@)?", header)
    return [name for before, name, behind in values if not before and not behind]


def check_the_check(doxygen, settings, headers):
    header = headers["pt.h"]
    for old, new, wanted in (
        ("PT_API uint32_t pt_version(void);", "PT_API uint32_t pt_version(void);\nPT_API int pt_new(int x);", "pt_new"),
        ("uint32_t max_path_length;", "uint32_t more; uint32_t max_path_length;", "more"),
        ("/** Makes a context.", "/** @param nothing Makes a context.", "nothing"),
    ):
        if header.count(old) != 1:
            sys.exit(f"{old} is not in pt.h once")
        found = doxygen_complaints(doxygen, settings, {**headers, "pt.h": header.replace(old, new)})
        if wanted not in found:
            sys.exit(f"after {old} -> {new} Doxygen says: {found or 'nothing'}")
    found = silent_functions(header + "/** Something new. */\nPT_API int pt_new(int x);\n")
    if found != ["pt_new"]:
        sys.exit(f"functions without a word on threads: {found}, not pt_new")
    for old in "PT_OK = 0,", "PT_CANCELLED = 1,":
        found = silent_values(header.replace(old, f"PT_NEW = 100,\n    {old}"))
        if found != ["PT_NEW"]:
            sys.exit(f"values without a comment: {found}, not PT_NEW")


def main():
    doxygen, settings = sys.argv[1], pathlib.Path(sys.argv[2]).read_text()
    headers = {path.name: path.read_text() for path in sorted(pathlib.Path(sys.argv[3]).glob("*.h"))}
    check_the_check(doxygen, settings, headers)
    found = doxygen_complaints(doxygen, settings, headers)
    if found:
        sys.exit(found)
    for name, text in headers.items():
        if silent_functions(text) or silent_values(text):
            sys.exit(f"{name}, without their words: {silent_functions(text)}, {silent_values(text)}")


main()
