import os
import re

from command_line import COURSEWORK, PT, CommandLineTest


class RealDeviceKernels(CommandLineTest):
    program = PT

    # Mesa's cache is off, because it prints messages.
    def render(self, name="a.png", **environment):
        self.expect(0, "render", COURSEWORK, "-o", name, "--size", "32x16", "--spp", "2", "-q",
                    MESA_SHADER_CACHE_DISABLE="true", **environment)
        return self.contents(name)

    def kept(self):
        folder = self.path("cache/pt/kernels")
        return sorted(os.listdir(folder)) if os.path.isdir(folder) else []

    def test_are_kept_in_the_users_cache(self):
        picture = self.render(XDG_CACHE_HOME=self.path("cache"))
        kept = self.kept()
        self.assertGreaterEqual(len(kept), 1)
        for name in kept:
            self.assertTrue(re.fullmatch("[0-9a-f]{32}", name), name)
        self.assertEqual(self.render(XDG_CACHE_HOME=self.path("cache")), picture)
        self.assertEqual(self.kept(), kept)

    def test_damaged_ones_are_built_anew(self):
        picture = self.render(XDG_CACHE_HOME=self.path("cache"))
        for name in self.kept():
            path = "cache/pt/kernels/" + name
            whole = self.contents(path)
            for damaged in (whole[:-1] + bytes([whole[-1] ^ 1]), whole[:40], b"\0" * len(whole)):
                self.write(path, damaged)
                self.assertEqual(self.render(XDG_CACHE_HOME=self.path("cache")), picture)
                self.assertEqual(self.contents(path), whole)

    def test_a_cache_that_cannot_be_does_no_harm(self):
        picture = self.render(XDG_CACHE_HOME=self.path("cache"))
        self.write("file", "")
        self.assertEqual(self.render(XDG_CACHE_HOME=self.path("file")), picture)
        self.assertEqual(self.errors, "")
        self.assertEqual(self.render(XDG_CACHE_HOME="", HOME=""), picture)
        self.assertEqual(self.errors, "")
