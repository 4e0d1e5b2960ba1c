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
        folder = self.path("cache")
        picture = self.render(XDG_CACHE_HOME=folder)
        kept = self.kept()
        self.assertGreaterEqual(len(kept), 1)
        for name in kept:
            self.assertTrue(re.fullmatch("[0-9a-f]{32}", name), name)
        path = "cache/pt/kernels/" + kept[0]
        whole = self.contents(path)
        for found in whole, whole[:-1] + bytes([whole[-1] ^ 1]), whole[:40], b"\0" * len(whole):  # all but the first are damaged
            self.write(path, found)
            self.assertEqual(self.render(XDG_CACHE_HOME=folder), picture)
            self.assertEqual((self.contents(path), self.kept()), (whole, kept))
        self.write("file", "")
        for place in {"XDG_CACHE_HOME": self.path("file")}, {"XDG_CACHE_HOME": "", "HOME": ""}:
            self.assertEqual((self.render(**place), self.errors), (picture, ""))
