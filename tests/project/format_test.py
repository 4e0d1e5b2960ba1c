"""Checks that C++ sources are formatted by .clang-format: format_test.py CLANG_FORMAT ROOT. Headers in shaders are
also GLSL, and are formatted by hand."""

import pathlib
import subprocess
import sys


def complaints(clang_format, *arguments, text=None):
    done = subprocess.run([clang_format, "--dry-run", "-Werror", "--style=file", *arguments], input=text, text=True,
                          capture_output=True)
    return "" if done.returncode == 0 else done.stderr or "no reason was given"


def check_the_check(clang_format, root):
    """Negative control: one space too many."""
    name = f"--assume-filename={root / 'lib' / 'a.cpp'}"
    if complaints(clang_format, name, text="int a();\n") or not complaints(clang_format, name, text="int  a();\n"):
        sys.exit("clang-format does not tell what is formatted from what is not")


def main():
    clang_format, root = sys.argv[1], pathlib.Path(sys.argv[2])
    check_the_check(clang_format, root)
    sources = [path for folder in ("lib", "cli", "tests") for path in sorted((root / folder).rglob("*"))
               if path.suffix in (".h", ".cpp")]
    if not sources:
        sys.exit(f"no sources in {root}")
    found = complaints(clang_format, *map(str, sources))
    if found:
        sys.exit(found)


main()
