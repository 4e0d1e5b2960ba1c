"""PT_TEST_KILLS is the number of kills (default: 4)."""

import json
import os
import random
import time

from command_line import COURSEWORK, PATIENCE, PT, SCENES, CommandLineTest

KILLS = int(os.environ.get("PT_TEST_KILLS", "4"))
MOST_DELAY = 0.3
SAMPLES_A_KILL = 2000


class KilledRender(CommandLineTest):
    program = PT

    def options(self, spp):
        return ["render", COURSEWORK, "--spp", str(spp), "--size", "32x16", "-o", "a.png", "--film", "a.ptfilm", "-q"]

    def whole(self, *options):
        self.expect(0, *options)
        found = [self.contents(name) for name in ("a.png", "a.ptfilm")]
        for name in "a.png", "a.ptfilm":
            os.remove(self.path(name))
        return found

    def samples_kept(self, name):
        """Returns 0 without a checkpoint."""
        if not os.path.exists(self.path(name)):
            return 0
        self.expect(0, "merge", name, "--stats", "-", "-q")
        return json.loads(self.output)["spp"]


    def identity(self, name):
        return os.stat(self.path(name)).st_ino if os.path.exists(self.path(name)) else None

    def test_killed_at_any_moment(self):
        name = "der Prüf punkt é.ptfilm"
        options = self.options(SAMPLES_A_KILL * KILLS)
        expected = self.whole(*options)
        keep = ["--checkpoint", name, "--checkpoint-every", "0.05", "--resume"]
        moments = random.Random(1)
        kept, kills, steps = 0, 0, 0
        while kills < KILLS:
            before = self.identity(name)
            process = self.start(*options, *keep)
            while kills % 2 == 1 and process.poll() is None and self.identity(name) == before:
                time.sleep(0.005)
            time.sleep(moments.uniform(0.0, MOST_DELAY if kills % 2 == 0 else 0.3))
            process.kill()
            process.communicate(timeout=PATIENCE)
            if process.returncode == 0:
                self.assertEqual([self.contents(file) for file in ("a.png", "a.ptfilm")], expected)
                os.remove(self.path(name))
                kept = 0
                continue
            kills += 1
            now = self.samples_kept(name)
            self.assertGreaterEqual(now, kept)
            steps += now > kept
            kept = now
        print(f"{kills} kills, {steps} of which left a checkpoint of more samples than the one before", flush=True)
        self.assertGreater(steps, 0)
        self.expect(0, *options, *keep)
        self.assertEqual([self.contents(file) for file in ("a.png", "a.ptfilm")], expected)
        self.assertEqual(self.files(), ["a.png", "a.ptfilm", name])

    def test_pixels_with_different_numbers_of_samples_go_on_too(self):
        options = [*self.options(100000), "--error", "4%", "--sampling", "adaptive", "--stats", "a.json"]
        expected = self.whole(*options)
        codes = [75]
        while codes[-1] == 75:
            codes.append(self.run_pt(*options, "--checkpoint", "c.ptfilm", "--time", "0.05", "--resume"))
        self.assertEqual(codes[-1], 0, self.errors)
        self.assertGreater(len(codes), 2)
        stats = json.loads(self.read("a.json"))
        self.assertEqual((stats["ended_by"], stats["spp"] < stats["spp_max"]), ("error", True))
        self.assertEqual([self.contents(file) for file in ("a.png", "a.ptfilm")], expected)


class Resume(CommandLineTest):
    program = PT
    small = ("render", COURSEWORK, "--size", "16x8", "-q")
    made = {}

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
        before = self.contents("c.ptfilm")
        self.resume(2, *options, error=error)
        self.assertEqual(self.contents("c.ptfilm"), before)
        self.assertNotIn("a.png", self.files())

    def test_it_goes_on_to_the_same_bytes(self):
        self.resume(0)
        self.assertEqual(self.contents("a.png"), self.contents("whole.png"))
        self.resume(0)
        self.assertEqual(self.contents("a.png"), self.contents("whole.png"))

    def test_a_crop_goes_on_too(self):
        """A checkpoint has whole rows, so it can be resumed with other columns, but not with other rows."""
        crop = ["--checkpoint", "crop.ptfilm", "--crop"]
        self.expect(0, *self.small, "-o", "half.png", "--spp", "12", *crop, "2,3,5,4")
        for part in "2,3,5,4", "0,3,16,4":
            self.expect(0, *self.small, "-o", "a.png", "--spp", "24", "--crop", part)
            self.expect(0, *self.small, "-o", "b.png", "--spp", "24", *crop, part, "--resume")
            self.assertEqual(self.contents("b.png"), self.contents("a.png"))
        self.expect(2, *self.small, "-o", "c.png", "--spp", "24", *crop, "2,2,5,4", "--resume", error="crop.ptfilm: ")
        self.assertNotIn("c.png", self.files())

    def test_what_differs_is_said(self):
        for options, error in ((("--seed", "7"), "c.ptfilm: seed = 0: must be 7"),
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
                    error="--checkpoint c.ptfilm: exists; continue from it by --resume, or remove it")
        self.assertEqual(self.contents("c.ptfilm"), self.checkpoint)

    def test_damaged_ones_are_refused(self):
        flipped = bytearray(self.checkpoint)
        flipped[len(flipped) // 2] ^= 4
        for damaged in self.checkpoint[:100], self.checkpoint[:-1], flipped:
            self.write("c.ptfilm", damaged)
            self.refuse("c.ptfilm: ")
