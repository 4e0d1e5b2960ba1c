import hashlib
import json
import struct
import unittest

from command_line import PT, CommandLineTest, read_exr_attributes, read_exr_channels


def spheres(count, **further):
    """Places are from a linear congruential generator (Numerical Recipes, section 7.1)."""
    state, items = 1, []
    for _ in range(count):
        numbers = []
        for _ in range(4):
            state = (1664525 * state + 1013904223) % 2**32
            numbers.append(state / 2**32)
        x, y, z, size = numbers
        items.append({"center": [6 * x - 3, 4 * y - 2, -6 - 4 * z], "radius": 0.1 + 0.4 * size, "material": "white", **further})
    return items


def scene(items, **camera):
    return json.dumps({"camera": {"position": [0, 0, 2], "look_at": [0, 0, -6], **camera},
                       "materials": {"white": {"diffuse": 0.5}, "lamp": {"emission": 9}},
                       "spheres": items + [{"center": [3, 5, 0], "radius": 1, "material": "lamp"}]})


# Each row ends with the first digits of the alpha channel's SHA-256 on llvmpipe. An independent kernel that only traces
# camera rays gave the same alphas.
RECORDED = (
    ("list, Sobol", scene(spheres(5)), ("--spp", "7"), "3cfc379614fa2483"),
    ("list, motion, lens, Halton", scene(spheres(5, motion=[1.5, -1, 0]), aperture=0.5, focus=8),
     ("--spp", "7", "--sampler", "halton", "--first-sample", "3"), "5ab5c13cd7313827"),
    ("tree, Cranley-Patterson", scene(spheres(200)), ("--spp", "5", "--sampler", "halton-cp"), "95347ff132267170"),
    ("tree, motion, lens, random", scene(spheres(200, motion=[1, 0.5, 0]), aperture=0.5, focus=8),
     ("--spp", "5", "--sampler", "random"), "88e3a2b6e621b475"),
    ("tree, opacity", scene(spheres(200, opacity=0.4)), ("--spp", "9"), "7b186da335d4af7c"),
    ("orthographic", scene(spheres(90), projection="orthographic", vertical_extent=6), ("--spp", "5"), "c0628f15c5a9f265"),
    ("adaptive", scene(spheres(5)), ("--spp", "600", "--error", "0.03", "--sampling", "adaptive"), "8a8617c4c177d920"))
SIZE = ("--size", "61x43", "--max-path-length", "3")


def digest(rows):
    return hashlib.sha256(b"".join(struct.pack(f"<{len(row)}f", *row) for row in rows)).hexdigest()[:16]


class RealDeviceAlpha(CommandLineTest):
    program = PT

    def render(self, *options):
        self.expect(0, "render", "scene.json", *SIZE, *options)

    def test_it_has_the_bits_of_a_second_look(self):
        for name, text, options, expected in RECORDED:
            with self.subTest(name):
                self.write("scene.json", text)
                self.render("-o", "a.exr", "--alpha", *options)
                if not read_exr_attributes(self.path("a.exr"))["pt.device"][1].startswith(b"llvmpipe"):
                    raise unittest.SkipTest("the recorded bits are llvmpipe's")
                found = read_exr_channels(self.path("a.exr"))
                self.assertEqual(digest(found["A"]), expected)
                self.render("-o", "b.exr", *options)
                bare = read_exr_channels(self.path("b.exr"))
                self.assertEqual({channel: found[channel] for channel in bare}, bare)

    def test_films_keep_it(self):
        self.write("scene.json", scene(spheres(5)))
        whole = ("--alpha", "--spp", "9")
        self.render("-o", "whole.exr", "--film", "whole.ptfilm", *whole)
        self.render("--film", "0.ptfilm", "--alpha", "--spp", "3")
        self.render("--film", "3.ptfilm", "--alpha", "--spp", "6", "--first-sample", "3")
        self.render("--film", "bare.ptfilm", "--spp", "6", "--first-sample", "3")
        self.expect(0, "merge", "3.ptfilm", "0.ptfilm", "-o", "sum.exr", "--film", "sum.ptfilm", "--alpha")
        self.assertEqual(read_exr_channels(self.path("whole.exr")), read_exr_channels(self.path("sum.exr")))
        self.assertEqual(self.contents("whole.ptfilm"), self.contents("sum.ptfilm"))
        self.render("-o", "resumed.exr", "--checkpoint", "0.ptfilm", "--resume", *whole)
        self.assertEqual(read_exr_channels(self.path("whole.exr")), read_exr_channels(self.path("resumed.exr")))
        self.expect(2, "merge", "whole.ptfilm", "bare.ptfilm", "-o", "c.exr", error="bare.ptfilm: coverage = nothing: must be 1")
        self.expect(2, "merge", "bare.ptfilm", "-o", "c.exr", "--alpha", error="--alpha: the films have no alpha")
