import json
import os
import shutil
import signal
import struct
import time

from command_line import COURSEWORK, PT, SCENES, CommandLineTest, npy

SHADERS = os.path.join(SCENES, "..", "..", "shaders")
SMALL = ("-o", "a.png", "--size", "2x2", "--spp", "1")


def sparse(path, start, size):
    with open(path, "wb") as file:
        file.write(start)
        file.truncate(size)


class NoFiles(CommandLineTest):
    def setUp(self):
        super().setUp()
        os.mkfifo(self.path("pipe"))
        os.mkdir(self.path("folder"))
        self.write("c.npy", npy("<f4", (1, 3), [0, 0, -5]))
        for name, target in ("zero", "/dev/zero"), ("pipe", "pipe"), ("folder", "folder"):
            for ending in "json", "npy", "ptfilm", "png", "exr", "glsl":
                os.symlink(target, self.path(f"{name}.{ending}"))

    def column(self, name):
        scene = {"materials": {"a": {}}, "spheres": [{"center": "c.npy", "radius": name, "material": "a"}]}
        self.write("s.json", json.dumps(scene))

    def test_they_are_refused_by_name(self):
        for name, reason in ("zero", "not a regular file"), ("pipe", "not a regular file"), ("folder", "Is a directory"):
            for arguments in (("render", f"{name}.json", *SMALL), ("merge", f"{name}.ptfilm", "-o", "a.png"),
                              ("tonemap", f"{name}.png", "a.png"), ("tonemap", f"{name}.exr", "a.png")):
                with self.subTest(name=name, command=arguments[0]):
                    self.expect(6, *arguments, error=f"cannot read {arguments[1]}: {reason}\n")
            self.column(f"{name}.npy")
            self.expect(6, "render", "s.json", *SMALL,
                        error=f"pt: s.json: spheres[0].radius: cannot read {name}.npy: {reason}\n")

    def test_endless_standard_input_ends_at_its_first_zero(self):
        with open("/dev/zero", "rb") as zero:
            done = self.piped("render", "-", *SMALL, stdin=zero, text=True)
        self.assertEqual((done.returncode, done.stderr),
                         (3, "pt: standard input:1:1: a NUL byte: this is not UTF-8 text\n"))

    def test_a_scene_names_no_standard_input(self):
        self.column("-")
        done = self.piped("render", "s.json", *SMALL, input=npy("<f4", (1,), [1]))
        self.assertEqual(done.returncode, 6)
        self.assertIn(b"cannot read -: No such file", done.stderr)

    def test_the_beginning_is_checked_before_the_rest_is_read(self):
        size = 2**40
        for name, start, error in (("n.npy", b"", "is not an NPY file"),
                                   ("n.npy", npy("<f4", (1,), []), "goes on after its 1 rows"),
                                   ("n.npy", b"\x93NUMPY\2\0" + struct.pack("<I", 2**31), "has a header of 2147483648 bytes")):
            sparse(self.path(name), start, size)
            self.column(name)
            self.expect(3, "render", "s.json", *SMALL, error=error)
        sparse(self.path("s.json"), b"{", size)
        self.expect(3, "render", "s.json", *SMALL, error="s.json:1:2: a NUL byte")
        sparse(self.path("s.png"), b"\x89PNG", size)
        self.expect(6, "tonemap", "s.png", "a.png", error="cannot read s.png: ")
        self.program = PT
        for start in b"", b"PK\3\4", b"\x28\xb5\x2f\xfd":
            sparse(self.path("s.ptfilm"), start, size)
            self.expect(2, "merge", "s.ptfilm", "-o", "a.png", error="pt: s.ptfilm: ")


class Texts(CommandLineTest):
    STRANGE = "a\x1b]0;b\x07\x7f\x9b\u202ec\u2066\u2028\nd"
    SHOWN = "a<U+001B>]0;b<U+0007><U+007F><U+009B><U+202E>c<U+2066><U+2028><U+000A>d"

    def expect_harmless(self):
        self.assertNotRegex(self.errors, "[\0-\x09\x0b-\x1f\x7f-\x9f\u2028-\u202e\u2066-\u2069]")

    def test_names_in_scenes(self):
        for scene, shown in (({self.STRANGE: {}}, f'unknown key "{self.SHOWN}"'),
                             ({"render": {"sampler": self.STRANGE}}, f'unknown sampler "{self.SHOWN}"'),
                             ({"a\0b": {}}, 'unknown key "a<U+0000>b"'),
                             ({"spheres": [{"center": [0, 0, 0], "radius": 1, "material": self.STRANGE}]},
                              f'unknown material "{self.SHOWN}"'),
                             ({"materials": {self.STRANGE: {"diffuse": "x"}}}, "<U+202E>"),
                             ({"film": {"gamma": self.STRANGE}}, "<U+202E>")):
            self.write("s.json", json.dumps(scene, ensure_ascii=False))
            self.expect(3, "render", "s.json", *SMALL, error=shown)
            self.expect_harmless()
            self.assertEqual(self.errors.count("\n"), 1)

    def test_names_of_files(self):
        self.write("c.npy", npy("<f4", (1, 3), [0, 0, -5]))
        self.write("a", npy("<f4", (1,), [1]))
        for name, code, shown in (("a\0b.npy", 6, "cannot read a<U+0000>b.npy: the name of a file must not have a NUL byte\n"),
                                  (self.STRANGE, 6, f"cannot read {self.SHOWN}: No such file")):
            self.write("s.json", json.dumps({"materials": {"a": {}},
                                             "spheres": [{"center": "c.npy", "radius": name, "material": "a"}]}))
            self.expect(code, "render", "s.json", *SMALL, error=shown)
            self.expect_harmless()
        self.expect(6, "render", "\x1b[2J.json", *SMALL, error="cannot read <U+001B>[2J.json: ")
        self.expect(0, "render", COURSEWORK, "-o", "\x1b[2J.png", "--size", "2x2", "--spp", "1")
        self.assertIn("wrote <U+001B>[2J.png: ", self.output)

    def test_names_of_devices(self):
        self.expect(0, "devices", FAKE_PT_FAIL="name:2")
        self.assertIn("d<U+001B>vice", self.output)


class Compiler(CommandLineTest):
    program = PT

    def setUp(self):
        super().setUp()
        shutil.copytree(SHADERS, self.path("shaders"))
        self.write("s.json", "{}")
        self.arguments = ("render", "s.json", *SMALL, "--shader-dir", "shaders")

    def include(self, text):
        self.write("shaders/pathtrace.comp", "#version 450\n#extension GL_GOOGLE_include_directive : require\n" + text)

    def test_what_is_included_is_a_file(self):
        os.mkfifo(self.path("shaders/pipe.glsl"))
        for name in "pipe.glsl", "/dev/zero":
            self.include(f'#include "{name}"\n')
            self.expect(3, *self.arguments, error=f"{name}: not a regular file")

    def test_what_it_says_is_printable(self):
        self.include('#include "\x1b]0;title\x07\u202e"\n')
        self.expect(3, *self.arguments, error="shaders/<U+001B>]0;title<U+0007><U+202E>: No such file")
        self.assertNotRegex(self.errors, "[\x07\x1b\u202e]")

    def test_a_signal_ends_it_at_once(self):
        """The shader has 2^60 includes, so reading it never ends."""
        for i in range(60):
            self.write(f"shaders/{i}.glsl", f'#include "{i + 1}.glsl"\n' * 2)
        self.write("shaders/60.glsl", "\n")
        self.include('#include "0.glsl"\n')
        process = self.start(*self.arguments)
        compiling = False
        while not compiling:
            self.assertIsNone(process.poll())
            with open(f"/proc/{process.pid}/maps", encoding="utf-8") as maps:
                compiling = "libpt-glsl.so" in maps.read()
            time.sleep(0.01)
        process.send_signal(signal.SIGTERM)
        process.communicate(timeout=600)
        self.assertEqual(process.returncode, -signal.SIGTERM)
        self.assertEqual(self.files(), ["s.json", "shaders"])
