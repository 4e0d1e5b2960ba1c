"""Checks libpt's exported symbols and soname: exported_symbols_test.py LIBRARY ARCHIVE HEADERS LIST C_COMPILER. HEADERS
is a folder."""

import pathlib
import re
import subprocess
import sys
import tempfile

SONAME = "libpt.so.0.4"
SCENE_SONAME, SCENE_HEADER = "libpt-scene.so.0.4", "scene_file.h"


def output(*command):
    return subprocess.run([str(word) for word in command], check=True, capture_output=True, text=True).stdout


def symbols_of(path, *options):
    lines = output("nm", "--defined-only", "--format=posix", *options, path).splitlines()
    return {line.split()[0] for line in lines if len(line.split()) > 2}


def declared_in(headers):
    return {name for header in headers
            for name in re.findall(r"^PT_API\b[^;(]*?\b(pt_\w+)\(", header.read_text(), re.MULTILINE)}


def soname_of(library):
    return re.search(r"\(SONAME\).*\[(.*)\]", output("readelf", "--dynamic", library)).group(1)


def differences(what, found, listed):
    return [f"{what}: {name} is {'not in the list' if name in found else 'missing'}" for name in sorted(found ^ listed)]


def complaints(library, archive, headers, listed, soname=SONAME):
    found = differences("shared library", symbols_of(library, "--dynamic"), listed)
    found += differences("static library", symbols_of(archive, "--extern-only"), listed)
    found += differences("headers", declared_in(headers), listed)
    if soname_of(library) != soname:
        found.append(f"the soname is {soname_of(library)}, not {soname}")
    return found


def build(folder, compiler, source, soname):
    (folder / "f.c").write_text(source)
    for old in folder.glob("*.h"):
        old.unlink()
    for function in re.findall(r"^int (\w+)", source, re.MULTILINE):
        (folder / f"{function}.h").write_text(f"PT_API int {function}(void);\n")
    output(compiler, "-fPIC", "-c", folder / "f.c", "-o", folder / "f.o")
    output(compiler, "-shared", f"-Wl,-soname,{soname}", folder / "f.o", "-o", folder / "f.so")
    (folder / "f.a").unlink(missing_ok=True)
    output("ar", "rc", folder / "f.a", folder / "f.o")
    return folder / "f.so", folder / "f.a", list(folder.glob("*.h"))


def check_the_check(compiler):
    """Negative control: symbols are added, missing or renamed."""
    one, two = "int pt_one(void) { return 1; }\n", "int pt_two(void) { return 2; }\n"
    everywhere = ("headers", "shared library", "static library")
    with tempfile.TemporaryDirectory() as name:
        for source, soname, wanted in (
            (one + two, SONAME, []),
            (one, SONAME, [f"{place}: pt_two is missing" for place in everywhere]),
            (one + two + "int pt_new(void) { return 3; }\n", SONAME,
             [f"{place}: pt_new is not in the list" for place in everywhere]),
            (one + two, "libpt.so.0.1", ["the soname is libpt.so.0.1, not libpt.so.0.4"]),
        ):
            found = complaints(*build(pathlib.Path(name), compiler, source, soname), {"pt_one", "pt_two"})
            if sorted(found) != wanted:
                sys.exit(f"the check found {found}, not {wanted}")


def main():
    library, archive, folder, listed, compiler = sys.argv[1:]
    check_the_check(compiler)
    is_scene = "pt-scene" in library
    headers = [path for path in pathlib.Path(folder).glob("*.h") if (path.name == SCENE_HEADER) == is_scene]
    found = complaints(library, archive, headers, set(pathlib.Path(listed).read_text().split()),
                       SCENE_SONAME if is_scene else SONAME)
    if found:
        sys.exit("\n".join(found))


main()
