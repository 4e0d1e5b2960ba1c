import json
import os
import pathlib
import platform
import re
import unittest

from command_line import COURSEWORK, PT, SCENES, CommandLineTest, read_exr_attributes, read_exr_blocks

FEATURES = {"avx512f", "avx512bw", "avx512dq", "avx512vl"}
CHOICES = ("LP_NATIVE_VECTOR_WIDTH", "MESA_SHADER_CACHE_DIR", "MESA_SHADER_CACHE_DISABLE", "MESA_GLSL_CACHE_DIR",
           "MESA_GLSL_CACHE_DISABLE")
TREE = os.path.join(SCENES, "thousand-spheres.json")


def has_wide_vectors():
    if platform.machine() != "x86_64" or not os.path.exists("/proc/cpuinfo"):
        return False
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        return any(FEATURES <= set(line.split()) for line in file if line.startswith("flags"))


class RealDeviceKernels(CommandLineTest):
    program = PT

    # Mesa's cache is off, because it prints messages.
    def render(self, name="a.png", **environment):
        self.expect(0, "render", COURSEWORK, "-o", name, "--size", "32x16", "--spp", "2", "-q",
                    MESA_SHADER_CACHE_DISABLE="true", **environment)
        return self.contents(name)

    def test_are_kept_in_the_users_cache(self):
        folder = self.path("cache")
        picture = self.render(XDG_CACHE_HOME=folder)
        kept = os.listdir(self.path("cache/pt/kernels"))
        self.assertGreaterEqual(len(kept), 1)
        for name in kept:
            self.assertTrue(re.fullmatch("[0-9a-f]{32}", name), name)
        path = "cache/pt/kernels/" + kept[0]
        whole = self.contents(path)
        for found in whole, whole[:-1] + bytes([whole[-1] ^ 1]):  # the second is damaged
            self.write(path, found)
            self.assertEqual(self.render(XDG_CACHE_HOME=folder), picture)
            self.assertEqual(self.contents(path), whole)
            self.assertCountEqual(os.listdir(self.path("cache/pt/kernels")), kept)
        self.write("file", "")
        for place in {"XDG_CACHE_HOME": self.path("file")}, {"XDG_CACHE_HOME": "", "HOME": ""}:
            self.assertEqual((self.render(**place), self.errors), (picture, ""))


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

    def render(self, name, scene=COURSEWORK, **environment):
        self.expect(0, "render", scene, "-o", name, "--size", "64x32", "--spp", "4", "--max-path-length", "6",
                    "--device", self.device, XDG_CACHE_HOME=self.path("cache"), **environment)
        return read_exr_attributes(self.path(name))["pt.device"][1].decode()

    def test_the_width_is_for_the_kernel_that_the_library_builds(self):
        sphere = {"center": [0, 0, 0], "radius": 1, "material": "m"}
        capsule = sphere | {"end": [1, 0, 0]}
        for name, surfaces in {"112": {"spheres": [sphere] * 112}, "113": {"spheres": [sphere] * 113},
                               "23": {"capsules": [capsule] * 23}, "24": {"capsules": [capsule] * 24},
                               "1": {"spheres": [sphere | {"opacity": 0.5}]}}.items():
            surfaces |= {"camera": {"position": [0, 0, 5], "look_at": [0, 0, 0]}, "materials": {"m": {"diffuse": 0.5}}}
            self.write("scene.json", json.dumps(surfaces))
            self.expect(0, "render", "scene.json", "-o", "a.png", "--size", "16x8", "--spp", "1", "--stats", "a.json",
                        "--device", self.device, XDG_CACHE_HOME=self.path("cache"))
            stats = json.loads(self.contents("a.json"))
            bits = 256 if "tree" in stats["features"] else 512
            self.assertIn(f"{bits} bits", stats["device"]["name"], name)

    def test_a_checkpoint_goes_on_wherever_caches_can_be_and_at_each_width(self):
        self.write("file", "")
        picture = ("render", COURSEWORK, "--size", "16x8", "--device", self.device, "--checkpoint", "c.ptfilm", "--spp")
        self.expect(0, *picture, "8", "-o", "a.png", XDG_CACHE_HOME=self.path("cache"))
        for spp, changed in (("16", {"HOME": "", "XDG_CACHE_HOME": ""}), ("24", {"XDG_CACHE_HOME": self.path("file")}),
                             ("32", {"MESA_SHADER_CACHE_DISABLE": "true"}), ("40", {"LP_NATIVE_VECTOR_WIDTH": 256})):
            self.expect(0, *picture, spp, "-o", "a.png", "--resume", **changed)
        self.expect(0, *picture[:-3], "--film", "whole.ptfilm", "--spp", "40", "-o", "whole.png")
        self.assertEqual(self.contents("c.ptfilm"), self.contents("whole.ptfilm"))

    def variables(self, kernels, **environment):
        self.expect(0, "devices", "--vector-width", kernels, "--device", self.device, XDG_CACHE_HOME=self.path("cache"),
                    **environment)
        return dict(line.split("=", 1) for line in self.output.splitlines())

    def test_a_width_is_measured_once_for_each_kind_of_kernel(self):
        for kernels, scene in (("list", COURSEWORK), ("tree", TREE)):
            kept = pathlib.Path(self.path(f"cache/pt/vector-width-{kernels}"))
            self.assertEqual(self.variables(kernels, LP_NATIVE_VECTOR_WIDTH=128), {"LP_NATIVE_VECTOR_WIDTH": "128"})
            self.assertFalse(kept.exists())
            width = self.variables(kernels)["LP_NATIVE_VECTOR_WIDTH"]
            text = kept.read_text()
            self.assertEqual(text.splitlines()[0], width)
            written = kept.stat().st_mtime_ns
            self.assertIn(f"{width} bits", self.render("a.exr", scene))
            picture = read_exr_blocks(self.path("a.exr"))
            other = {"256": "512", "512": "256"}[width]
            kept.write_text(text.replace(width, other, 1))
            self.assertIn(f"{other} bits", self.render("a.exr", scene))
            self.assertEqual(read_exr_blocks(self.path("a.exr")), picture)
            for same in kernels, scene:
                self.assertEqual(self.variables(same)["LP_NATIVE_VECTOR_WIDTH"], other)
            kept.write_text("\n".join([other, *text.splitlines()[1:2], "another driver\n"]))
            self.variables(kernels)
            self.assertEqual(kept.read_text().splitlines()[1:], text.splitlines()[1:])
            self.assertGreater(kept.stat().st_mtime_ns, written)
