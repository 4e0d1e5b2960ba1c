"""What the tests of the program share: running it in an empty folder, and reading what it leaves there.

A test is a script with the arguments PT PT_WITH_FAKE_LIBRARY SCENES [unittest arguments]. Most cases run the program on
a stand-in for the library (fake_library.cpp), which needs no device, fails on demand and takes as long as it is told
to. Classes named RealDevice run the program itself.
"""

import os
import pathlib
import signal
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from png import parse_png, png_chunks, read_png  # noqa: E402, F401

PT, FAKE_PT, SCENES = sys.argv[1:4]
COURSEWORK = os.path.join(SCENES, "coursework-diffuse.json")  # about which there is nothing to warn

# Seconds after which a program is taken to hang. No test passes or fails by the clock: what is waited for is an event
# that comes soon on any machine, or never.
PATIENCE = 600

RESULT = {"INVALID_ARGUMENT": -1, "INVALID_SCENE": -2, "INVALID_STATE": -3, "UNSUPPORTED": -4, "NO_DEVICE": -5,
          "OUT_OF_HOST_MEMORY": -6, "OUT_OF_DEVICE_MEMORY": -7, "DEVICE_LOST": -8, "SHADER": -9, "INTERNAL": -10,
          "INCOMPATIBLE": -11}


def npy(type_code, shape, numbers, version=1):
    """An NPY file, as numpy.save writes it."""
    head = f"{{'descr': '{type_code}', 'fortran_order': False, 'shape': {shape}, }}\n".encode()
    size = struct.pack("<H" if version == 1 else "<I", len(head))
    letter = {"<f4": "f", "<f8": "d", "|u1": "B"}[type_code]
    return b"\x93NUMPY" + bytes([version, 0]) + size + head + struct.pack(f"<{len(numbers)}{letter}", *numbers)


def parse_exr_header(data):
    """Name -> (type, bytes) of an OpenEXR file, and the header's size."""
    assert data[:4] == b"\x76\x2f\x31\x01"
    attributes, position = {}, 8
    while data[position] != 0:
        name_end = data.index(b"\0", position)
        type_end = data.index(b"\0", name_end + 1)
        size, = struct.unpack("<i", data[type_end + 1:type_end + 5])
        body = data[type_end + 5:type_end + 5 + size]
        attributes[data[position:name_end].decode()] = (data[name_end + 1:type_end].decode(), body)
        position = type_end + 5 + size
    return attributes, position + 1


def read_exr_attributes(path):
    with open(path, "rb") as file:
        return parse_exr_header(file.read())[0]


def read_exr_blocks(path):
    """The compressed pixels, without the header and the table of where they are."""
    with open(path, "rb") as file:
        data = file.read()
    table = parse_exr_header(data)[1]
    first_block, = struct.unpack("<Q", data[table:table + 8])
    return data[first_block:]


def read_exr_channels(path):
    """Name of a channel -> rows of its numbers, of an OpenEXR file of scan lines that ZIP compresses ("OpenEXR File
    Layout"): what is written here."""
    with open(path, "rb") as file:
        data = file.read()
    attributes, position = parse_exr_header(data)
    assert attributes["compression"][1] == b"\3" and attributes["lineOrder"][1] == b"\0"
    left, top, right, bottom = struct.unpack("<4i", attributes["dataWindow"][1])
    width, height = right - left + 1, bottom - top + 1
    channels, body = [], attributes["channels"][1]
    while body != b"\0":
        name, body = body.split(b"\0", 1)
        channels.append((name.decode(), {0: "I", 2: "f"}[struct.unpack("<i", body[:4])[0]]))
        body = body[16:]
    rows = {name: [] for name, _ in channels}
    for first in range(0, height, 16):
        offset, = struct.unpack("<Q", data[position + first // 2:position + first // 2 + 8])
        _, size = struct.unpack("<2i", data[offset:offset + 8])
        block = data[offset + 8:offset + 8 + size]
        line_count = min(16, height - first)
        if size < 4 * width * len(channels) * line_count:
            deltas = list(zlib.decompress(block))
            for i in range(1, len(deltas)):
                deltas[i] = (deltas[i - 1] + deltas[i] - 128) % 256
            block = bytearray(len(deltas))
            block[::2], block[1::2] = deltas[:(len(deltas) + 1) // 2], deltas[(len(deltas) + 1) // 2:]
        for line in range(line_count):
            for index, (name, kind) in enumerate(channels):
                begin = 4 * width * (line * len(channels) + index)
                rows[name].append(list(struct.unpack(f"<{width}{kind}", block[begin:begin + 4 * width])))
    return rows


def default_signals():
    """A job in the background of a shell inherits an ignored SIGINT, which the program then respects."""
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, signal.SIG_DFL)


class CommandLineTest(unittest.TestCase):
    program = FAKE_PT

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

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

    def start(self, *arguments, before=default_signals, **environment):
        names = {name: str(value) for name, value in environment.items()}
        process = subprocess.Popen([self.program, *arguments], cwd=self.folder, env={**os.environ, **names}, text=True,
                                   errors="replace", stdout=subprocess.PIPE, stderr=subprocess.PIPE, preexec_fn=before)
        for undo in (process.stdout.close, process.stderr.close, process.wait, process.kill):  # the last comes first
            self.addCleanup(undo)
        return process

    def run_pt(self, *arguments, **environment):
        process = self.start(*arguments, **environment)
        self.output, self.errors = process.communicate(timeout=PATIENCE)
        if "LeakSanitizer" in self.errors:
            print(self.errors, file=sys.stderr)  # for repeat_leak_check.py
        return process.returncode

    def expect(self, code, *arguments, error=None, **environment):
        """Runs the program; every line on stderr of a failure must begin with its name, and `error` be in there."""
        self.assertEqual(self.run_pt(*arguments, **environment), code, self.errors)
        if code != 0:
            self.assertNotEqual(self.errors, "")
            for line in self.errors.splitlines():
                self.assertTrue(line.startswith("pt: "), line)
        if error is not None:
            self.assertIn(error, self.errors)

    def files(self):
        return sorted(os.listdir(self.folder))


def main():
    unittest.main(argv=sys.argv[:1] + sys.argv[4:])
