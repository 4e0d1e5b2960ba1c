"""Tests of what ends a rendering (samples, time, target error, signals), with the exit code of each, and of previews.
Arguments: see command_line.py."""

import json
import os
import signal
import subprocess

from command_line import COURSEWORK, PATIENCE, PT, CommandLineTest, main, read_png

# Samples of 20 ms would take hours, and the first look at the error comes after 16 of them.
ENDLESS = ("--spp", "1000000", "--time", "0.5")
SLOW = {"FAKE_PT_SAMPLE_MS": 20}


class ExitCodes(CommandLineTest):
    def test_every_combination(self):
        kept = ("--checkpoint", "c.ptfilm")
        not_kept = ("--checkpoint", "none/c.ptfilm")  # a folder that is not there
        table = [
            # options, code, what ended it: 1/16 is the error of the stand-in after 16 samples
            (("--spp", "20"), 0, "samples"),
            (("--spp", "20", *kept), 0, "samples"),
            (("--spp", "20", *not_kept), 0, "samples"),
            (("--spp", "20", "--time", "1e6"), 0, "samples"),
            (("--spp", "20", "--time", "1e6", *kept), 0, "samples"),
            (("--error", "0.1"), 0, "error"),
            (("--error", "0.1", *kept), 0, "error"),
            (("--error", "0.1", "--time", "1e6", *kept), 0, "error"),
            (("--spp", "20", "--error", "0.001"), 7, "samples"),
            (("--spp", "20", "--error", "0.001", *kept), 7, "samples"),
            (("--spp", "20", "--error", "0.001", "--time", "1e6", *kept), 7, "samples"),
            (ENDLESS, 0, "time"),
            ((*ENDLESS, *kept), 75, "time"),
            ((*ENDLESS, *not_kept), 0, "time"),
            ((*ENDLESS, "--error", "1e-9"), 7, "time"),
            ((*ENDLESS, "--error", "1e-9", *kept), 75, "time"),
            ((*ENDLESS, "--error", "1e-9", *not_kept), 7, "time"),
        ]
        for options, code, ended_by in table:
            with self.subTest(options=options):
                environment = SLOW if ended_by == "time" else {}
                found = self.run_pt("render", COURSEWORK, "-o", "a.png", "--size", "2x2", "--stats", "s.json", *options,
                                    **environment)
                self.assertEqual(found, code, self.errors)
                self.assertEqual(json.loads(self.read("s.json"))["ended_by"], ended_by)
                self.assertEqual(os.path.exists(self.path("c.ptfilm")), "c.ptfilm" in options)
                self.assertEqual(self.errors.count("no checkpoint: "), options.count("none/c.ptfilm"), self.errors)
                for name in self.files():
                    os.remove(self.path(name))

    def test_signals(self):
        for options in ("--checkpoint", "c.ptfilm"), ("--time", "1e6"):
            with self.subTest(options=options):
                found = self.run_pt("render", COURSEWORK, "-o", "a.png", "--spp", "200", "--size", "2x2", *options,
                                    FAKE_PT_SIGNAL=f"{int(signal.SIGINT)}:9")
                self.assertEqual(found, 130, self.errors)
                self.assertEqual("; --resume goes on from c.ptfilm" in self.errors, options[0] == "--checkpoint")

    def test_a_signal_that_comes_twice_at_once_is_one(self):
        """timeout(1) sends it to the process and to its group."""
        process = self.start("render", COURSEWORK, "-o", "a.png", "--spp", "1000000", "--size", "2x2", "--progress",
                             "json", "--checkpoint", "c.ptfilm", FAKE_PT_SAMPLE_MS=200)
        while json.loads(process.stderr.readline())["samples_per_pixel"] == 0:
            pass
        for _ in range(3):
            process.send_signal(signal.SIGTERM)
        process.communicate(timeout=PATIENCE)
        self.assertEqual(process.returncode, 143)
        self.assertEqual(self.files(), ["a.png", "c.ptfilm"])

    def test_another_signal_later_ends_it_at_once(self):
        """A sample of an hour stands for a driver that hangs."""
        process = self.start("render", COURSEWORK, "-o", "a.png", "--spp", "2", "--size", "2x2", "--progress", "json",
                             FAKE_PT_SAMPLE_MS=3_600_000)
        while process.poll() is None:
            process.send_signal(signal.SIGINT)
            try:
                process.wait(timeout=0.2)
            except subprocess.TimeoutExpired:
                pass
        self.assertEqual(process.returncode, -signal.SIGINT)

    def test_what_does_not_go_together(self):
        for options, error in (
                (("--resume",), "--resume: needs --checkpoint"),
                (("--checkpoint-every", "5"), "--checkpoint-every: needs --checkpoint"),
                (("--watch", "--checkpoint", "c"), "--checkpoint: a picture under --watch has none"),
                (("--watch", "--film", "c"), "--film: a picture under --watch has none"),
                (("--checkpoint", "-"), "--checkpoint -: "), (("--film", "-"), "--film -: "),
                (("--checkpoint", "a.png"), "is the same file as"), (("--film", COURSEWORK), "is the same file as"),
                (("--piece-rows", "1", "--film", "f"), "--film: needs the whole image on the device"),
                (("--piece-rows", "1", "--checkpoint", "f"), "--checkpoint: needs the whole image on the device"),
                (("--time", "0"), "--time"), (("--time", "nan"), "--time"), (("--time", "-1"), "--time")):
            self.expect(2, "render", COURSEWORK, "-o", "a.png", "--size", "4x4", *options, error=error)
        self.expect(2, "render", COURSEWORK, error="-o or --film is missing")
        self.assertEqual(self.files(), [])

    def test_time_takes_one_sample_at_the_least(self):
        self.expect(0, "render", COURSEWORK, "-o", "a.png", "--size", "2x2", "--time", "0.01", "--stats", "s.json",
                    FAKE_PT_SAMPLE_MS=200)
        self.assertEqual(json.loads(self.read("s.json"))["spp"], 1)

    def test_every_piece_has_its_share_of_the_time(self):
        self.expect(0, "render", COURSEWORK, "-o", "a.png", "--size", "2x4", "--piece-rows", "1", "--time", "0.4",
                    "--stats", "s.json", "--spp", "1000000", FAKE_PT_SAMPLE_MS=1)
        self.assertGreater(json.loads(self.read("s.json"))["spp"], 0)  # the least of the pieces
        self.assertEqual(self.errors.count("black"), 0)


class Previews(CommandLineTest):
    def render_until_there_is(self, name, *options):
        process = self.start("render", COURSEWORK, "-o", name, "--spp", "1000000", "--size", "2x2", "--progress", "json",
                             *options, FAKE_PT_SAMPLE_MS=20)
        self.assertIn('"fraction"', process.stderr.readline())
        return process

    def wait_for(self, name, process):
        while not os.path.exists(self.path(name)):
            self.assertIn('"fraction"', process.stderr.readline())
        self.assertEqual(read_png(self.path(name))[:2], (2, 2))

    def end(self, process):
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=PATIENCE)
        self.assertEqual(process.returncode, 130)

    def test_sigusr1_writes_the_picture_so_far_and_goes_on(self):
        process = self.render_until_there_is("a.png")
        for _ in range(2):
            self.assertEqual(self.files(), [])
            process.send_signal(signal.SIGUSR1)
            self.wait_for("a.png", process)
            os.remove(self.path("a.png"))
        self.end(process)

    def test_by_itself(self):
        process = self.render_until_there_is("a.png", "--preview-every", "0.05")
        for _ in range(2):
            self.wait_for("a.png", process)
            os.remove(self.path("a.png"))
        self.end(process)


class RealDevice(CommandLineTest):
    program = PT

    def test_pictures_on_the_way_change_nothing(self):
        options = ("--size", "32x16", "--spp", "400", "-q")
        self.expect(0, "render", COURSEWORK, "-o", "a.png", *options)
        self.expect(0, "render", COURSEWORK, "-o", "b.png", *options, "--preview-every", "0.01", "--checkpoint",
                    "c.ptfilm", "--checkpoint-every", "0.01")
        self.expect(0, "render", COURSEWORK, "-o", "p.png", *options, "--preview-every", "0.01", "--piece-rows", "5")
        with open(self.path("a.png"), "rb") as a, open(self.path("b.png"), "rb") as b:
            self.assertEqual(a.read(), b.read())
        self.assertEqual(read_png(self.path("a.png")), read_png(self.path("p.png")))
        self.assertEqual(self.files(), ["a.png", "b.png", "c.ptfilm", "p.png"])


if __name__ == "__main__":
    main()
