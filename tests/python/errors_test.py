import contextlib
import ctypes
import io
import os
import pathlib
import re
import tempfile
import unittest

import numpy as np
import pt
from pictures import WHITE, ready, settings
from pt import tachyon
from pt._library import NOT_RESULTS, PARAMETERS, checked
from pt._text import c_string, printable, tell

HEADERS = pathlib.Path(__file__).resolve().parents[2] / "lib/include/pt"


class FailingLibrary:
    def __init__(self, rules=0):
        self.rules = rules

    def pt_last_error(self, context):
        return f"the message of {context}".encode()

    def pt_result_name(self, result):
        return b"unknown result"

    def pt_get_broken_rule(self, context, index, rule):
        if rule is not None:
            rule.index, rule.component, rule.subject, rule.rule = index, -1, b"spheres", b"must be > 0"
        return self.rules


class Results(unittest.TestCase):
    def test_every_error_has_its_class(self):
        classes = set()
        listed = re.findall(r"PT_ERROR_(\w+) = (-\d+)", (HEADERS / "pt.h").read_text())
        self.assertGreater(len(listed), 10)
        for name, number in listed:
            with self.assertRaises(pt.Error) as raised:
                checked(FailingLibrary(), int(number), 7)
            self.assertEqual(raised.exception.result.name, f"ERROR_{name}")
            self.assertEqual(type(raised.exception).__name__.lower(), name.lower().replace("_", "") + "error")
            self.assertEqual(str(raised.exception), "the message of 7")
            classes.add(type(raised.exception))
        self.assertEqual(len(classes), len(listed))

    def test_an_error_of_a_newer_library(self):
        with self.assertRaisesRegex(pt.Error, r"^unknown result \(-99\): the message of 7$"):
            checked(FailingLibrary(), -99, 7)

    def test_of_many_broken_rules_those_that_are_kept(self):
        with self.assertRaises(pt.InvalidSceneError) as raised:
            checked(FailingLibrary(rules=100), -2)
        self.assertEqual([rule.index for rule in raised.exception.broken_rules], list(range(8)))
        self.assertEqual(raised.exception.broken_rules[0], pt.BrokenRule("spheres", 0, "", None, "", "", "must be > 0"))

    def test_python_s_own_classes(self):
        for error, built_in in ((pt.InvalidSceneError, ValueError), (pt.InvalidStateError, RuntimeError),
                                (pt.OutOfDeviceMemoryError, MemoryError), (pt.IncompatibleError, ValueError)):
            self.assertTrue(issubclass(error, built_in) and issubclass(error, pt.Error))


class Functions(unittest.TestCase):
    KINDS = {"uint32_t": ctypes.c_uint32.__name__, "uint64_t": ctypes.c_uint64.__name__, "double": "c_double", "float": "c_float",
             "pt_result": ctypes.c_int32.__name__, "const char *": "c_char_p", "void": "NoneType",
             "pt_take_bytes_fn": "CFunctionType"}

    def test_their_types_are_the_headers(self):
        text = " ".join(" ".join(path.read_text().split()) for path in sorted(HEADERS.glob("*.h")))
        declared = {name: (kind.strip(), [] if parameters == "void" else parameters.split(", "))
                    for kind, name, parameters in re.findall(r"PT_API ([\w ]+?[ *]+)(pt_\w+)\(([^)]*)\);", text)}
        for function, types in PARAMETERS.items():
            result, parameters = declared[function]
            self.assertEqual(len(types), len(parameters), function)
            for kind, parameter in zip(types, parameters):
                if "*" in parameter:  # a handle, bytes, or a pointer to a struct or a number
                    struct = re.sub(r"const |\*+\w+$", "", parameter).strip()
                    allowed = {"c_void_p", "c_char_p", "LP_c_void_p", f"LP_{struct}", f"LP_{self.KINDS.get(struct)}"}
                    self.assertIn(kind.__name__, allowed, f"{function}: {parameter}")
                else:
                    self.assertEqual(kind.__name__, self.KINDS[parameter.split()[0]], f"{function}: {parameter}")
            if result != "pt_result":
                self.assertEqual(getattr(NOT_RESULTS[function], "__name__", "NoneType"), self.KINDS[result], function)
            self.assertEqual(function in NOT_RESULTS, result != "pt_result", function)


class RealErrors(unittest.TestCase):
    def setUp(self):
        self.context = self.enterContext(pt.Context())

    def test_of_a_scene(self):
        wrong = pt.Scene([pt.Sphere((0, 0, 0), 1, WHITE), pt.Sphere((0, float("nan"), 0), -1, WHITE)])
        with self.assertRaises(pt.InvalidSceneError) as raised:
            self.context.set_scene(wrong)
        self.assertEqual(str(raised.exception).splitlines(), ["spheres[1].center[1] = nan: must be finite",
                                                              "spheres[1].radius = -1: must be > 0"])
        self.assertEqual(raised.exception.broken_rules[0],
                         pt.BrokenRule("spheres", 1, "center", 1, "", "nan", "must be finite"))

    def test_of_values(self):
        ready(self.context)
        for error, message, call in (
                (pt.InvalidArgumentError, "^render.width = 0: must be >= 1$", lambda: self.context.set_render(settings(width=0))),
                (ValueError, "render.seed = ", lambda: self.context.set_render(settings(seed=-1))),
                (ValueError, "render.seed = ", lambda: self.context.set_render(settings(seed=2**64))),
                (ValueError, "render.width = ", lambda: self.context.set_render(settings(width=2**32 + 8))),
                (pt.InvalidArgumentError, "camera", lambda: self.context.set_camera(pt.Camera((1, 2, 3), (1, 2, 3)))),
                (ValueError, "position = .*: must be three numbers", lambda: pt.Camera([[1, 2, 3]], (1, 2, 3))),
                (ValueError, "emission = .*: must be three numbers", lambda: pt.Material(emission=(1, 2))),
                (pt.InvalidArgumentError, "accumulate.sample_count = 0", lambda: self.context.accumulate(0)),
                (ValueError, "sample_count = -1", lambda: self.context.accumulate(-1)),
                (ValueError, f"sample_count = {2**32}", lambda: self.context.accumulate(2**32)),
                (pt.InvalidArgumentError, "stopping.time_limit = -1", lambda: self.context.accumulate(1, time_limit=-1)),
                (pt.NoDeviceError, "no such device", lambda: pt.Context("no such device")),
                (ValueError, "submit_milliseconds = 0", lambda: pt.Context(submit_milliseconds=0))):
            with self.subTest(message), self.assertRaisesRegex(error, message):
                call()
        for grey in 0.5, np.float32(0.5), (0.5, 0.5, 0.5), np.full(3, 0.5), [0.5] * 3:
            self.assertEqual(pt.Material(diffuse=grey).diffuse, (0.5, 0.5, 0.5))

    def test_only_files_are_read(self):
        with tempfile.TemporaryDirectory() as folder:
            pipe = os.path.join(folder, "pipe")
            os.mkfifo(pipe)
            for read in pt.Film.load, tachyon.read, pt.load:
                for path in pipe, "/dev/zero", folder:
                    with self.subTest(path=path), self.assertRaisesRegex(OSError, "not a regular file|Is a directory"):
                        read(path)

    def test_names_have_no_zero(self):
        for call in (lambda: pt.Context("cpu\0gpu"), lambda: pt.Context(shader_dir=pathlib.Path("a\0b")), lambda: c_string("\0")):
            with self.assertRaisesRegex(ValueError, "must have no NUL byte"):
                call()
        self.assertEqual((c_string("ä"), c_string(None)), ("ä".encode(), None))

    def test_control_characters_are_shown_as_the_library_shows_them(self):
        text = "".join(map(chr, [*range(1, 0x3000), 0xfeff, 0xfffd, 0x1f600]))
        with self.assertRaises(pt.Error) as caught:
            pt.Context(text)
        self.assertTrue(f'"{printable(text)}"' in str(caught.exception))
        with contextlib.redirect_stderr(io.StringIO()) as stream:
            tell("pt-x", "a\x1b\u2028b\nc\n")
        self.assertEqual(stream.getvalue(), "pt-x: a<U+001B><U+2028>b\npt-x: c\n")
