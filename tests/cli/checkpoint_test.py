"""Tests of checkpoints: a rendering that is killed at any moment and resumed, on whatever machine, ends with the same bytes.
PT_TEST_KILLS says how often one rendering is killed (default: 4). Arguments: see command_line.py."""

import json
import os
import random
import shutil
import signal
import subprocess
import time

from command_line import COURSEWORK, PATIENCE, PT, CommandLineTest, default_signals, main

KILLS = int(os.environ.get("PT_TEST_KILLS", "4"))
MOST_DELAY = 0.7  # seconds until a kill, from the start or from the run's first checkpoint
SAMPLES_A_KILL = 2000  # some tenths of a second, so that few renderings end before they are killed


class KeptRender(CommandLineTest):
    program = PT

    def options(self, spp, size="64x32"):
        return ["render", COURSEWORK, "--spp", str(spp), "--size", size, "-o", "a.png", "--film", "a.ptfilm", "-q"]

    def whole(self, *options):
        """Image and film of a rendering that nothing has ended, which are removed."""
        self.expect(0, *options)
        found = [self.contents(name) for name in ("a.png", "a.ptfilm")]
        for name in "a.png", "a.ptfilm":
            os.remove(self.path(name))
        return found

    def samples_kept(self, name):
        """0 if there is no checkpoint; one that there is has to be whole."""
        if not os.path.exists(self.path(name)):
            return 0
        self.expect(0, "merge", name, "--stats", "-", "-q")
        return json.loads(self.output)["spp"]


class KilledRender(KeptRender):
    def identity(self, name):
        """Changes whenever the file is replaced."""
        return os.stat(self.path(name)).st_ino if os.path.exists(self.path(name)) else None

    def test_killed_at_any_moment(self):
        """Every other run has written a checkpoint before, and so gets on."""
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
            if process.returncode == 0:  # it was ready before
                self.assertEqual([self.contents(file) for file in ("a.png", "a.ptfilm")], expected)
                os.remove(self.path(name))
                kept = 0
                continue
            kills += 1
            now = self.samples_kept(name)
            self.assertGreaterEqual(now, kept)  # nothing that was kept is lost
            steps += now > kept
            kept = now
        print(f"{kills} kills, {steps} of which left a checkpoint of more samples than the one before", flush=True)
        self.assertGreater(steps, 0)
        self.expect(0, *options, *keep)
        self.assertEqual([self.contents(file) for file in ("a.png", "a.ptfilm")], expected)
        self.assertEqual(self.files(), ["a.png", "a.ptfilm", name])

    def test_signals_leave_what_another_run_goes_on_from(self):
        options = self.options(5000)
        expected = self.whole(*options)
        for number, code in (signal.SIGINT, 130), (signal.SIGTERM, 143):
            process = self.start(*options[:-1], "--checkpoint", "c.ptfilm", "--progress", "json")
            self.assertIn('"fraction"', process.stderr.readline())
            process.send_signal(number)
            errors = process.communicate(timeout=PATIENCE)[1]
            if process.returncode == 0:  # it was ready before
                os.remove(self.path("c.ptfilm"))
                continue
            self.assertEqual(process.returncode, code, errors)
            self.assertIn("--resume goes on from c.ptfilm", errors)
            self.assertGreater(self.samples_kept("c.ptfilm"), 0)
            self.expect(0, *options, "--checkpoint", "c.ptfilm", "--resume")
            self.assertEqual([self.contents(file) for file in ("a.png", "a.ptfilm")], expected)
            os.remove(self.path("c.ptfilm"))

    def run_until_done(self, *options):
        code, runs = 75, 0
        while code == 75:
            code = self.run_pt(*options, "--checkpoint", "c.ptfilm", "--time", "0.05", "--resume")
            runs += 1
        self.assertEqual(code, 0, self.errors)
        self.assertGreater(runs, 1)

    def test_a_target_error_is_reached_at_the_same_sample(self):
        options = [*self.options(100000), "--error", "3%", "--sampling", "uniform"]
        expected = self.whole(*options)
        self.expect(0, *self.options(37), "--checkpoint", "c.ptfilm")
        self.expect(0, *options, "--checkpoint", "c.ptfilm", "--resume")
        self.assertEqual([self.contents(file) for file in ("a.png", "a.ptfilm")], expected)

    def test_pixels_with_different_numbers_of_samples_go_on_too(self):
        options = [*self.options(100000), "--error", "4%", "--stats", "a.json"]
        expected = self.whole(*options)
        self.run_until_done(*options)
        self.assertIn('"ended_by": "error"', self.read("a.json"))
        self.assertEqual([self.contents(file) for file in ("a.png", "a.ptfilm")], expected)


class Surroundings(KeptRender):
    """What costs the checkpoint, or nothing: never the picture."""
    made = []  # image and film without disturbance, which are rendered once

    def setUp(self):
        super().setUp()
        self.small = self.options(200)
        self.made.extend([] if self.made else self.whole(*self.small))
        self.expected = self.made

    def expect_picture(self, *keep, told, **how):
        done = subprocess.run([PT, *self.small[:-1], *keep, "--checkpoint-every", "0.01"], cwd=self.folder, text=True,
                              stderr=subprocess.PIPE, check=False, preexec_fn=default_signals,
                              **{"stdout": subprocess.DEVNULL, **how})
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stderr.count("pt: no checkpoint: "), 1 if told else 0, done.stderr)
        if told:
            self.assertIn(told, done.stderr)
        self.assertEqual([self.contents(name) for name in ("a.png", "a.ptfilm")], self.expected)
        self.assertEqual([name for name in self.files() if name.endswith(".tmp")], [])

    def test_a_folder_that_cannot_be_written(self):
        self.expect_picture("--checkpoint", "/sys/c.ptfilm", told="cannot write /sys/c.ptfilm")
        self.expect_picture("--checkpoint", "none/c.ptfilm", told="No such file or directory")

    def test_a_full_disk(self):
        """A file system of 16 KiB, less than the checkpoint."""
        os.mkdir(self.path("disk"))
        script = 'mount -t tmpfs -o size=16k none disk && "$@"; code=$?; ls -A disk >&2; exit $code'
        probe = subprocess.run(["unshare", "-m", "sh", "-c", script, "sh", "true"], cwd=self.folder,
                               capture_output=True, check=False)
        if probe.returncode != 0:
            self.skipTest("no file system can be mounted here")
        done = subprocess.run(["unshare", "-m", "sh", "-c", script, "sh", PT, *self.small, "--checkpoint",
                               "disk/c.ptfilm", "--checkpoint-every", "0.01"], cwd=self.folder, capture_output=True,
                              text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stderr, "pt: no checkpoint: cannot write disk/c.ptfilm: No space left on device; "
                                      "the rendering goes on\n")
        self.assertEqual([self.contents(name) for name in ("a.png", "a.ptfilm")], self.expected)

    def test_a_closed_standard_output(self):
        done = subprocess.run(["sh", "-c", '"$@" >&-', "sh", PT, *self.small[:-1], "--checkpoint", "c.ptfilm"],
                              cwd=self.folder, stderr=subprocess.PIPE, text=True, check=False)
        self.assertEqual((done.returncode, done.stderr), (6, "pt: cannot write to standard output\n"))
        self.assertEqual([self.contents(name) for name in ("a.png", "a.ptfilm")], self.expected)
        self.assertGreater(self.samples_kept("c.ptfilm"), 0)

    def test_a_decimal_comma(self):
        if not shutil.which("localedef") or subprocess.run(
                ["localedef", "-i", "de_DE", "-f", "UTF-8", self.path("de_DE.UTF-8")], capture_output=True,
                check=False).returncode != 0:
            self.skipTest("no such locale can be made here")
        environment = {**os.environ, "LOCPATH": self.folder, "LC_ALL": "de_DE.UTF-8"}
        shown = subprocess.run(["locale", "decimal_point"], env=environment, capture_output=True, check=False)
        self.assertEqual(shown.stdout, b",\n")
        self.expect_picture("--checkpoint", "c.ptfilm", told=None, env=environment)
        self.expect_picture("--checkpoint", "c.ptfilm", "--resume", told=None, env=environment)


if __name__ == "__main__":
    main()
