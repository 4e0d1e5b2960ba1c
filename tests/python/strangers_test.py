import contextlib
import io
import os
import pathlib
import tempfile
import unittest

import pt
from pt import tachyon
from pt._text import c_string, printable, tell


class Files(unittest.TestCase):
    def test_only_files_are_read(self):
        with tempfile.TemporaryDirectory() as folder:
            pipe = os.path.join(folder, "pipe")
            os.mkfifo(pipe)
            for read in pt.Film.load, tachyon.read, pt.load:
                for path in pipe, "/dev/zero", folder:
                    with self.subTest(path=path), self.assertRaisesRegex(OSError, "not a regular file|Is a directory"):
                        read(path)

    def test_names_have_no_zero(self):
        for call in (lambda: pt.Context("cpu\0gpu"), lambda: pt.Context(shader_dir="a\0b"),
                     lambda: pt.Context(shader_dir=pathlib.Path("a\0b")), lambda: c_string("\0")):
            with self.assertRaisesRegex(ValueError, "must have no NUL byte"):
                call()
        self.assertEqual((c_string("ä"), c_string(None)), ("ä".encode(), None))


class Texts(unittest.TestCase):
    def test_every_line_has_the_programs_name(self):
        with contextlib.redirect_stderr(io.StringIO()) as stream:
            tell("pt-x", "a\x1b\u2028b\nc\n")
        self.assertEqual(stream.getvalue(), "pt-x: a<U+001B><U+2028>b\npt-x: c\n")

    def test_the_library_shows_the_same_characters(self):
        text = "".join(map(chr, [*range(1, 0x3000), 0xfeff, 0xfffd, 0x1f600]))
        with self.assertRaises(pt.Error) as caught:
            pt.Context(text)
        self.assertTrue(f'"{printable(text)}"' in str(caught.exception))
