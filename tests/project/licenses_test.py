"""cmake/licenses/parts.txt must name all code of others: headers, linked libraries, and files with a license beside
them."""

import os
import pathlib
import re
import unittest

ROOT, BUILD = pathlib.Path(__file__).resolve().parents[2], pathlib.Path(os.environ["PT_BUILD"])
LICENSES = ROOT / "cmake/licenses"
ROWS = [line.split("|") for line in (LICENSES / "parts.txt").read_text().splitlines() if not line.startswith("#")]
# Libraries and headers of the system and the compiler. Programs that use them need no notices.
SYSTEM_LIBRARIES = {"libvulkan", "dl", "rt"}
SYSTEM_HEADERS = set("""cpuid dlfcn emmintrin fcntl io mach-o/dyld math psapi pthread signal stdatomic stddef stdint stdio
    stdlib sys/file sys/ioctl sys/resource sys/stat sys/sysctl sys/sysinfo time unistd windows""".split())
FOLDERS = {"lib": "runtime", "lib/glsl_module": "compiler", "cli": "program", "cli/image/image_module.cpp": "image_formats"}
BINARIES = {"lib/libpt.so.": "runtime", "bin/pt:": "program", "lib/pt/libpt-glsl.so:": "compiler",
            "lib/pt/libpt-image-file.so:": "image_formats"}


def parts():
    """Maps (component, header or library or file) to the name of the part."""
    return {(component, each): name for name, _, components, found_as, *_ in ROWS
            for component in components.split() for each in found_as.split()}


def foreign_headers(text):
    """Returns the first folder of each foreign header, or the header's name."""
    included = re.findall(r"^#include <([\w./-]+)\.h(?:pp)?>", text, re.MULTILINE)
    return {name.split("/")[0] if "/" in name else f"{name}.h" for name in included
            if name not in SYSTEM_HEADERS and not name.startswith("pt/")}


def included():
    found = set()
    for path in (path for folder in ("lib", "cli") for path in (ROOT / folder).rglob("*")):
        if path.suffix in (".h", ".cpp") and "examples" not in path.parts:
            name = str(path.relative_to(ROOT))
            folder = max((each for each in FOLDERS if name.startswith(each)), key=len)
            found |= {(FOLDERS[folder], header) for header in foreign_headers(path.read_text(encoding="utf-8"))}
    return found


def linked(rules):
    found = set()
    for output, component in BINARIES.items():
        for words in re.findall(rf"^build {re.escape(output)}.*\n(?:  .*\n)*?  LINK_LIBRARIES = (.*)$", rules, re.MULTILINE):
            for word in words.split():
                library = re.search(r"^/.*/([^/]+?)\.(?:so|a)$|^-l(.*)$", word)
                if library and not {library[1], library[2]} & SYSTEM_LIBRARIES:
                    found.add((component, library[1] or f"lib{library[2]}"))
    return found


def copied():
    return {("python", f"{path.relative_to(ROOT).with_suffix('.js')}") for path in (ROOT / "lib").rglob("*.LICENSE")}


class Licenses(unittest.TestCase):
    def test_what_is_included_linked_or_copied_is_in_the_table(self):
        rules = (BUILD / "build.ninja").read_text()
        found = included() | linked(rules) | copied()
        self.assertGreaterEqual(len(found), 15)
        self.assertEqual(sorted(found - set(parts())), [])
        # Every part must be found.
        names = {parts()[each] for each in found}
        self.assertEqual(names ^ set(parts().values()), set())

    def test_the_check_finds_what_is_missing(self):
        self.assertEqual(foreign_headers("#include <vector>\n#include <math.h>\n#include <fmt/core.h>\n#include <lz4.h>\n"),
                         {"fmt", "lz4.h"})
        rules = "build bin/pt: RULE a.o | b\n  FLAGS = -s\n  LINK_LIBRARIES = -Wl,-x lib/own.a -ldl -lfoo /usr/lib/libbar.so\n"
        self.assertEqual(linked(rules), {("program", "libfoo"), ("program", "libbar")})

    def test_every_license_has_its_text(self):
        named = {license for row in ROWS for license in row[4].split(" and ")} | {"Expat"}
        self.assertEqual(named, {path.stem for path in LICENSES.glob("*.txt")} - {"parts"})
