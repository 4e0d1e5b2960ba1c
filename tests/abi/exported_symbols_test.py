"""Checks libpt's exported functions, the types in its headers, and its soname: exported_symbols_test.py LIBRARY ARCHIVE
HEADERS LIST C_COMPILER. HEADERS is a folder."""

import ctypes
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
    return {" ".join(declaration.split()) for header in headers
            for declaration in re.findall(r"^(?:PT_API|typedef(?! struct)) ([^;]*);", header.read_text(), re.MULTILINE)}


def soname_of(library):
    return re.search(r"\(SONAME\).*\[(.*)\]", output("readelf", "--dynamic", library)).group(1)


def differences(what, found, listed):
    return [f"{what}: {name} is {'not in the list' if name in found else 'missing'}" for name in sorted(found ^ listed)]


def complaints(library, archive, headers, listed, soname=SONAME):
    names = set(re.findall(r"(pt_\w+)\(", "\n".join(listed)))
    found = differences("shared library", symbols_of(library, "--dynamic"), names)
    found += differences("static library", symbols_of(archive, "--extern-only"), names)
    found += differences("headers", declared_in(headers), listed)
    if soname_of(library) != soname:
        found.append(f"the soname is {soname_of(library)}, not {soname}")
    return found


def unnamed_results(library, header):
    name_of = ctypes.CDLL(library).pt_result_name
    name_of.restype = ctypes.c_char_p
    results = re.findall(r"(PT_\w+) = (-?\d+)", re.search(r"enum \{([^}]*PT_OK = .*?)\};", header.read_text(), re.DOTALL)[1])
    return [f"pt_result_name({number}) is not {name}" for name, number in results if name_of(int(number)).decode() != name]


def build(folder, compiler, source, soname):
    (folder / "f.c").write_text(source)
    (folder / "f.h").write_text(re.sub(r"^(.*) \{.*", r"PT_API \1;", source, flags=re.MULTILINE))
    output(compiler, "-fPIC", "-c", folder / "f.c", "-o", folder / "f.o")
    output(compiler, "-shared", f"-Wl,-soname,{soname}", folder / "f.o", "-o", folder / "f.so")
    (folder / "f.a").unlink(missing_ok=True)
    output("ar", "rc", folder / "f.a", folder / "f.o")
    return folder / "f.so", folder / "f.a", [folder / "f.h"]


def check_the_check(compiler):
    """Negative control: functions are added, missing or of another type, and the soname differs."""
    one, two, new = (f"int pt_{name}(void) {{ return 1; }}\n" for name in ("one", "two", "new"))
    libraries = ("shared library", "static library")
    with tempfile.TemporaryDirectory() as name:
        for source, soname, wanted in (
            (one + two, SONAME, []),
            (one, SONAME, ["headers: int pt_two(void) is missing",
                           *(f"{each}: pt_two is missing" for each in libraries)]),
            (one + two + new, SONAME, ["headers: int pt_new(void) is not in the list",
                                       *(f"{each}: pt_new is not in the list" for each in libraries)]),
            (one + two.replace("void", "int x"), SONAME, ["headers: int pt_two(int x) is not in the list",
                                                          "headers: int pt_two(void) is missing"]),
            (one + two, "libpt.so.0.1", ["the soname is libpt.so.0.1, not libpt.so.0.4"]),
        ):
            listed = {"int pt_one(void)", "int pt_two(void)"}
            found = complaints(*build(pathlib.Path(name), compiler, source, soname), listed)
            if sorted(found) != wanted:
                sys.exit(f"the check found {found}, not {wanted}")


def main():
    library, archive, folder, listed, compiler = sys.argv[1:]
    check_the_check(compiler)
    is_scene = "pt-scene" in library
    headers = [path for path in pathlib.Path(folder).glob("*.h") if (path.name == SCENE_HEADER) == is_scene]
    found = complaints(library, archive, headers, set(pathlib.Path(listed).read_text().splitlines()),
                       SCENE_SONAME if is_scene else SONAME)
    found += [] if is_scene else unnamed_results(library, pathlib.Path(folder, "pt.h"))
    if found:
        sys.exit("\n".join(found))


main()
