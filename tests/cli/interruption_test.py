import fcntl
import os
import pty
import re
import signal
import subprocess
import termios

from command_line import COURSEWORK, PATIENCE, CommandLineTest, default_signals, read_png


class Interruption(CommandLineTest):
    def interrupt(self, submission, *options, **environment):
        return self.run_pt("render", COURSEWORK, "-o", "a.png", "--spp", "200", "--size", "2x2", *options,
                           FAKE_PT_SIGNAL=f"{int(signal.SIGINT)}:{submission}", **environment)

    def test_a_terminal_that_goes_away(self):
        """A terminal that closes sends SIGHUP to its foreground processes. Later writes to the terminal fail."""
        try:
            ours, theirs = pty.openpty()
        except OSError as error:  # a chroot without /dev/pts
            self.skipTest(str(error))

        def take_terminal():
            default_signals()
            os.setsid()
            fcntl.ioctl(theirs, termios.TIOCSCTTY, 0)

        process = subprocess.Popen([self.program, "render", COURSEWORK, "-o", self.path("a.png"), "--spp", "200",
                                    "--progress", "json", "--size", "2x2"], stdin=theirs, stdout=theirs, stderr=theirs,
                                   preexec_fn=take_terminal, env={**os.environ, "FAKE_PT_SAMPLE_MS": "100"})
        os.close(theirs)
        output = b""
        while not re.search(rb'"samples_per_pixel":[1-9]', output):
            output += os.read(ours, 4096)
        os.close(ours)
        self.assertEqual(process.wait(timeout=PATIENCE), 129)
        self.assertEqual(read_png(self.path("a.png"))[:2], (2, 2))
        self.assertEqual(self.files(), ["a.png"])

    def test_nohup_is_respected(self):
        process = self.start("render", COURSEWORK, "-o", "a.png", "--spp", "20", "--progress", "json", "--size", "2x2",
                             FAKE_PT_SAMPLE_MS=50, before=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))
        process.stderr.readline()
        process.send_signal(signal.SIGHUP)
        self.assertEqual(process.wait(timeout=PATIENCE), 0)
        process.communicate()

    def test_nothing_is_touched_before_the_first_sample(self):
        self.write("a.png", "old")
        self.assertEqual(self.interrupt(3), 130)
        self.assertIn("after 0 of 200 samples per pixel; nothing was written", self.errors)
        self.assertEqual(self.read("a.png"), "old")
        self.assertEqual(self.files(), ["a.png"])

    def test_a_scene_that_is_being_taken_over(self):
        self.write("a.png", "old")
        code = self.run_pt("render", COURSEWORK, "-o", "a.png", "--spp", "200", FAKE_PT_FAIL="set_camera:-10",
                           FAKE_PT_SCENE_SIGNAL=int(signal.SIGTERM))  # If the signal does not stop the program, this call fails.
        self.assertEqual(code, 143)
        self.assertEqual(self.errors, "pt: stopped by SIGTERM after 0 of 200 samples per pixel; nothing was written\n")
        self.assertEqual(self.read("a.png"), "old")

    def test_validation_messages_weigh_more(self):
        self.assertEqual(self.interrupt(5, "--validation", FAKE_PT_LOG="destroy"), 1)
