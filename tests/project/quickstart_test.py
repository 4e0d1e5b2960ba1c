"""Runs cmake/quickstart.sh with stand-ins for its programs."""

import os
import re
import pathlib
import shutil
import subprocess
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "cmake/quickstart.sh"

STAND_IN = """#!/bin/sh
line="$(basename "$0") $*"
echo "$line" >> "$NOTES"
IFS='|'
for failing in $FAILING; do
    case $line in "${failing%=*}"*) exit "${failing##*=}" ;; esac
done
"""


class Quickstart(unittest.TestCase):
    def setUp(self):
        self.root = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        (self.root / "cmake").mkdir()
        shutil.copy(SCRIPT, self.root / "cmake" / "quickstart.sh")
        for name in "cmake", "ctest", "apt-get", "python3", "build/bin/pt":
            self.stand_in(name, STAND_IN)
        self.stand_in("sudo", '#!/bin/sh\nexec "$@"\n')
        self.stand_in("dpkg-query", '#!/bin/sh\ncase " $INSTALLED " in *" $3 "*) echo install ok installed ;; esac\n')

    def stand_in(self, name, text):
        path = self.root / (name if "/" in name else f"bin/{name}")
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        path.chmod(0o755)

    def run_script(self, command, failing="", installed=""):
        notes = self.root / "notes"
        notes.write_text("")
        done = subprocess.run(["sh", self.root / "cmake" / "quickstart.sh", command], text=True, capture_output=True,
                              env={"PATH": f"{self.root / 'bin'}:{os.environ['PATH']}", "NOTES": str(notes),
                                   "FAILING": failing, "INSTALLED": installed})
        self.lines = notes.read_text().splitlines()
        self.output = done.stdout
        return done.returncode

    def packages(self):
        line, = (line for line in self.lines if line.startswith("apt-get install"))
        return [word for word in line.split()[2:] if not word.startswith("-")]

    def test_a_picture_needs_few_packages(self):
        self.assertEqual(self.run_script("render"), 0)
        self.assertFalse({"libopenimageio-dev", "glslang-dev", "libgtest-dev", "build-essential"} & set(self.packages()))
        packages = set(self.packages())
        self.assertLess({"g++", "libpng-dev", "mesa-vulkan-drivers"}, packages)
        self.assertIn("cmake --preset release -DPT_BUILD_TESTS=OFF -DPT_UNITY=ON", self.lines)
        self.assertTrue(self.lines[-1].startswith("pt render "), self.lines)
        self.assertTrue(self.lines[-1].endswith(" -o coursework.png"), self.lines)
        for command in "build", "test":
            self.assertEqual(self.run_script(command), 0)
            self.assertLess(packages, set(self.packages()))
            packages = set(self.packages())

    def test_what_is_installed_is_left_alone(self):
        self.run_script("render", installed="cmake g++")
        self.assertFalse({"cmake", "g++"} & set(self.packages()))
        everything = " ".join(self.packages())
        self.run_script("render", installed=f"cmake g++ {everything}")
        self.assertFalse([line for line in self.lines if line.startswith("apt-get")])

    def test_all_parts_of_the_tests_run_and_those_that_fail_are_named(self):
        steps = {preset: [f"{step} {preset}" for step in ("cmake --preset", "cmake --build --preset", "ctest --preset")]
                 for preset in ("release", "sanitize", "tidy")}
        del steps["tidy"][2]
        for failing, left_out, failed in (
                ("", [], []),
                ("cmake --preset tidy=3|ctest --preset release=1", ["cmake --build --preset tidy"], ["release", "tidy"]),
                ("cmake --build --preset release=1|ctest --preset sanitize=8", ["ctest --preset release"],
                 ["release", "sanitize"])):
            with self.subTest(failing=failing):
                self.assertEqual(self.run_script("test", failing=failing), 1 if failed else 0)
                ran = [re.split(" -DPT_BUILD_TESTS=| --target ", line)[0] for line in self.lines if not line.startswith(("apt-get", "python3"))]
                self.assertEqual(ran, [step for preset in steps for step in steps[preset] if step not in left_out])
                self.assertEqual(self.output.splitlines()[-1],
                                 "quickstart: " + (f"FAILED: {' '.join(failed)}" if failed else "all passed"))

    def test_modules_that_are_missing_are_installed_for_tests(self):
        self.run_script("test")
        self.assertFalse([line for line in self.lines if "pip install" in line])
        self.run_script("test", failing="python3 -c import chemfiles=1")
        line, = (line for line in self.lines if "pip install" in line)
        self.assertRegex(line, "python3 -m pip install .*--target build/python-modules gemmi==.* chemfiles==")

    def test_nothing_goes_on_after_a_failure(self):
        for command, failing, code, not_run in (
                ("render", "cmake --preset release=3", 3, "pt"), ("render", "apt-get install=100", 100, "cmake"),
                ("test", "python3 -c import chemfiles=1|python3 -m pip=1", 1, "cmake"), ("rendr", "", 2, "")):
            self.assertEqual(self.run_script(command, failing=failing), code)
            self.assertFalse([line for line in self.lines if line.startswith(not_run)])

    def test_scripts_that_no_test_runs_can_be_read(self):
        broken = self.root / "broken.sh"
        broken.write_text("if true; then\n")
        for script in *SCRIPT.parent.glob("*.sh"), broken:
            read = subprocess.run(["sh", "-n", script], stderr=subprocess.DEVNULL)
            self.assertEqual(read.returncode == 0, script != broken, script)
