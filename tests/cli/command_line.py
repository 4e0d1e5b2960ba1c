"""Most cases use fake_library.cpp, which needs no device. Classes named RealDevice use the real libpt."""

import os
import pathlib
import signal
import struct
import subprocess
import sys
import tempfile
import unittest

from exr import read_exr_attributes, read_exr_blocks, read_exr_channels  # for tests
from png import parse_png, png_chunks, read_png  # for tests

PT, FAKE_PT = os.environ["PT_PROGRAM"], os.environ["PT_FAKE_PROGRAM"]
SCENES = str(pathlib.Path(__file__).resolve().parents[2] / "cli/scenes")
COURSEWORK = os.path.join(SCENES, "coursework-diffuse.json")

# A program counts as hung after this time, in seconds.
PATIENCE = 600

RESULT = {"INVALID_ARGUMENT": -1, "INVALID_SCENE": -2, "INVALID_STATE": -3, "UNSUPPORTED": -4, "NO_DEVICE": -5,
          "OUT_OF_HOST_MEMORY": -6, "OUT_OF_DEVICE_MEMORY": -7, "DEVICE_LOST": -8, "SHADER": -9, "INTERNAL": -10,
          "INCOMPATIBLE": -11}


def npy(type_code, shape, numbers, version=1):
    head = f"{{'descr': '{type_code}', 'fortran_order': False, 'shape': {shape}, }}\n".encode()
    size = struct.pack("<H" if version == 1 else "<I", len(head))
    letter = {"<f4": "f", "<f8": "d", "|u1": "B"}[type_code]
    return b"\x93NUMPY" + bytes([version, 0]) + size + head + struct.pack(f"<{len(numbers)}{letter}", *numbers)


def default_signals():
    """Shells start background jobs with SIGINT ignored. The program would inherit this."""
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, signal.SIG_DFL)


class CommandLineTest(unittest.TestCase):
    program = FAKE_PT

    def setUp(self):
        self.folder = self.enterContext(tempfile.TemporaryDirectory())

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, text):
        with open(self.path(name), "wb") as file:
            file.write(text.encode() if isinstance(text, str) else text)

    def read(self, name):
        with open(self.path(name), encoding="utf-8") as file:
            return file.read()

    def contents(self, name):
        with open(self.path(name), "rb") as file:
            return file.read()

    def start(self, *arguments, before=default_signals, stderr=subprocess.PIPE, **environment):
        names = {name: str(value) for name, value in environment.items()}
        process = subprocess.Popen([self.program, *arguments], cwd=self.folder, env={**os.environ, **names}, text=True,
                                   errors="replace", stdout=subprocess.PIPE, stderr=stderr, preexec_fn=before)
        for stream in filter(None, (process.stdout, process.stderr)):
            self.addCleanup(stream.close)
        for undo in process.wait, process.kill:
            self.addCleanup(undo)
        return process

    def piped(self, *arguments, **options):
        return subprocess.run([self.program, *arguments], cwd=self.folder,
                              **{"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, **options})

    def run_pt(self, *arguments, **environment):
        process = self.start(*arguments, **environment)
        self.output, self.errors = process.communicate(timeout=PATIENCE)
        if "LeakSanitizer" in self.errors:
            print(self.errors, file=sys.stderr)
        return process.returncode

    def expect(self, code, *arguments, error=None, **environment):
        self.assertEqual(self.run_pt(*arguments, **environment), code, self.errors)
        if code != 0:
            self.assertNotEqual(self.errors, "")
            for line in self.errors.splitlines():
                self.assertTrue(line.startswith("pt: "), line)
        if error is not None:
            self.assertIn(error, self.errors)

    def expect_refusals(self, command, rows):
        before = self.files()
        for code, arguments, error in rows:
            with self.subTest(arguments=arguments):
                self.expect(code, command, *arguments, error=error)
        self.assertEqual(self.files(), before)

    def files(self):
        return sorted(os.listdir(self.folder))
