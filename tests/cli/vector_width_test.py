import json
import os
import platform
import unittest

from command_line import COURSEWORK, PT, CommandLineTest, read_exr_attributes, read_exr_blocks

FEATURES = {"avx512f", "avx512bw", "avx512dq", "avx512vl"}
CHOICES = ("LP_NATIVE_VECTOR_WIDTH", "MESA_SHADER_CACHE_DIR", "MESA_SHADER_CACHE_DISABLE", "MESA_GLSL_CACHE_DIR",
           "MESA_GLSL_CACHE_DISABLE")


def has_wide_vectors():
    if platform.machine() != "x86_64" or not os.path.exists("/proc/cpuinfo"):
        return False
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        return any(FEATURES <= set(line.split()) for line in file if line.startswith("flags"))


@unittest.skipUnless(has_wide_vectors(), "this processor has no AVX-512")
class RealDeviceWidth(CommandLineTest):
    program = PT

    def setUp(self):
        super().setUp()
        saved = {name: os.environ.pop(name) for name in CHOICES if name in os.environ}
        self.addCleanup(os.environ.update, saved)
        self.expect(0, "devices", "--json", XDG_CACHE_HOME=self.path("cache"))
        self.device = next((device["uuid"] for device in json.loads(self.output)
                            if device["name"].startswith("llvmpipe")), None)
        if self.device is None:
            self.skipTest("there is no llvmpipe")

    def render(self, name, **environment):
        self.expect(0, "render", COURSEWORK, "-o", name, "--size", "64x32", "--spp", "4", "--max-path-length", "6",
                    "--device", self.device, XDG_CACHE_HOME=self.path("cache"), **environment)
        return read_exr_attributes(self.path(name))["pt.device"][1].decode()

    def test_wide_unless_the_user_has_chosen(self):
        self.assertIn("512 bits", self.render("a.exr"))
        self.assertTrue(os.listdir(self.path("cache/pt/shaders-512")))

    def test_a_checkpoint_goes_on_wherever_caches_can_be(self):
        self.write("file", "")
        picture = ("render", COURSEWORK, "--size", "16x8", "--device", self.device, "--checkpoint", "c.ptfilm", "--spp")
        self.expect(0, *picture, "8", "-o", "a.png", XDG_CACHE_HOME=self.path("cache"))
        for spp, folders in (("16", {"HOME": "", "XDG_CACHE_HOME": ""}), ("24", {"XDG_CACHE_HOME": self.path("file")}),
                             ("32", {"MESA_SHADER_CACHE_DISABLE": "true"})):
            self.expect(0, *picture, spp, "-o", "a.png", "--resume", **folders)
        self.expect(2, *picture, "40", "-o", "a.png", "--resume", LP_NATIVE_VECTOR_WIDTH=256,
                    error="choose that model of device by --device, or on a CPU the width of its vectors by "
                    "LP_NATIVE_VECTOR_WIDTH, or begin anew")

    def test_the_picture_is_the_same(self):
        for width in 256, 512:
            name = self.render(f"{width}.exr", LP_NATIVE_VECTOR_WIDTH=width, MESA_SHADER_CACHE_DISABLE="true")
            self.assertIn(f"{width} bits", name)
        self.assertEqual(read_exr_blocks(self.path("256.exr")), read_exr_blocks(self.path("512.exr")))
