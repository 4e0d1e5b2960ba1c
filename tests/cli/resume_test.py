"""Tests of what is refused as a checkpoint: damaged bytes, other pictures, other samples. Arguments: see
command_line.py."""

import json
import os
import random

from command_line import COURSEWORK, PT, SCENES, CommandLineTest, main

DAMAGES = 25  # of the whole file, packed as it is; FilmBytes and the fuzzer damage its contents by thousands


class Resume(CommandLineTest):
    program = PT
    small = ("render", COURSEWORK, "--size", "16x8", "-q")
    made = {}  # images and the checkpoint, which are rendered once

    def setUp(self):
        super().setUp()
        if not self.made:
            self.expect(0, *self.small, "-o", "whole.png", "--spp", "24")
            self.expect(0, *self.small, "-o", "half.png", "--spp", "12", "--checkpoint", "c.ptfilm")
            self.made.update((name, self.contents(name)) for name in self.files())
        for name, data in self.made.items():
            self.write(name, data)
        self.checkpoint = self.made["c.ptfilm"]

    def resume(self, code, *options, error=None):
        count = () if "--spp" in options else ("--spp", "24")
        self.expect(code, *self.small, "-o", "a.png", "--checkpoint", "c.ptfilm", "--resume", *count, *options,
                    error=error)

    def refuse(self, error, *options):
        """Nothing is written, and the checkpoint stays."""
        before = self.contents("c.ptfilm")
        self.resume(2, *options, error=error)
        self.assertEqual(self.contents("c.ptfilm"), before)
        self.assertNotIn("a.png", self.files())

    def test_it_goes_on_to_the_same_bytes(self):
        self.resume(0)
        self.assertEqual(self.contents("a.png"), self.contents("whole.png"))
        self.resume(0)  # nothing is left to be done
        self.assertEqual(self.contents("a.png"), self.contents("whole.png"))

    def test_a_crop_goes_on_too(self):
        """Whole rows are kept, so other columns of them may be shown; other rows are another film."""
        crop = ["--checkpoint", "crop.ptfilm", "--crop"]
        self.expect(0, *self.small, "-o", "half.png", "--spp", "12", *crop, "2,3,5,4")
        for part in "2,3,5,4", "0,3,16,4":
            self.expect(0, *self.small, "-o", "a.exr", "--spp", "24", "--crop", part)
            self.expect(0, *self.small, "-o", "b.exr", "--spp", "24", *crop, part, "--resume")
            self.assertEqual(self.contents("b.exr"), self.contents("a.exr"))
        self.expect(2, *self.small, "-o", "c.exr", "--spp", "24", *crop, "2,2,5,4", "--resume", error="crop.ptfilm: ")
        self.assertNotIn("c.exr", self.files())

    def test_what_differs_is_said(self):
        for options, error in ((("--seed", "7"), "c.ptfilm: seed = 0: must be 7"),
                               (("--max-path-length", "3"), "c.ptfilm: max_path_length = 2: must be 3"),
                               (("--sampler", "random"), "c.ptfilm: sampler = 4: must be 1"),
                               (("--estimator", "light"), "c.ptfilm: estimator = 5: must be 4")):
            self.refuse(error, *options)
        other = os.path.join(SCENES, "two-lamps.json")
        self.expect(2, "render", other, "--size", "16x8", "-o", "a.png", "--checkpoint", "c.ptfilm", "--resume",
                    error="c.ptfilm: was made with another scene")
        self.refuse("c.ptfilm: has the samples [0, 12), which are not the first ones of [0, 8)", "--spp", "8")
        self.refuse("c.ptfilm: has the samples [0, 12), which are not the first ones of [5, 29)", "--first-sample", "5")

    def test_it_is_not_replaced_by_another_rendering(self):
        self.expect(2, *self.small, "-o", "a.png", "--checkpoint", "c.ptfilm",
                    error="--checkpoint c.ptfilm: is there already; go on from it by --resume, or remove it")
        self.assertEqual(self.contents("c.ptfilm"), self.checkpoint)

    def check(self, damaged, is_cut):
        """By pt merge, which needs no device; what passes has to be the same film."""
        self.write("d.ptfilm", damaged)
        code = self.run_pt("merge", "d.ptfilm", "--film", "same.ptfilm", "-q")
        self.assertIn(code, (2,) if is_cut else (0, 2), self.errors)
        if code == 2:
            self.assertRegex(self.errors, r"^pt: d.ptfilm: .*\npt: nothing was written\n$")
            self.assertNotIn("same.ptfilm", self.files())
            return True
        self.assertEqual(self.contents("same.ptfilm"), self.checkpoint)
        os.remove(self.path("same.ptfilm"))
        return False

    def test_cut_short_anywhere(self):
        places = random.Random(1)
        for _ in range(DAMAGES):
            self.check(self.checkpoint[:places.randrange(len(self.checkpoint))], True)
        self.write("c.ptfilm", self.checkpoint[:100])
        self.refuse("c.ptfilm: ")

    def test_flipped_bits(self):
        """In all, a few bits of a zstd frame say nothing about what it holds."""
        places = random.Random(2)
        refused = 0
        for _ in range(DAMAGES):
            bit = places.randrange(8 * len(self.checkpoint))
            damaged = bytearray(self.checkpoint)
            damaged[bit // 8] ^= 1 << bit % 8
            refused += self.check(bytes(damaged), False)
        self.assertGreater(refused, DAMAGES * 0.8)
        damaged = bytearray(self.checkpoint)
        damaged[len(damaged) // 2] ^= 4
        self.write("c.ptfilm", damaged)
        self.refuse("c.ptfilm: ")


if __name__ == "__main__":
    main()
