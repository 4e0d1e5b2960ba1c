import fcntl
import os
import pty
import re
import signal
import struct
import subprocess
import termios

from command_line import COURSEWORK, PATIENCE, CommandLineTest, default_signals, read_png

RENDER = ["render", COURSEWORK, "-o", "a.png", "--size", "2x2", "--spp"]


class Terminal(CommandLineTest):
    def on_terminal(self, *more, size=None, before=default_signals, **environment):
        try:
            ours, theirs = pty.openpty()
        except OSError as error:  # a chroot without /dev/pts
            self.skipTest(str(error))
        if size is not None:
            fcntl.ioctl(theirs, termios.TIOCSWINSZ, struct.pack("HHHH", *size, 0, 0))
        process = subprocess.Popen([self.program, *RENDER, *more], cwd=self.folder, stdin=theirs, stdout=subprocess.DEVNULL,
                                   stderr=theirs, preexec_fn=before, env={**os.environ, **environment})
        os.close(theirs)
        return process, ours

    def test_it_goes_away(self):
        """A closing terminal sends SIGHUP to its foreground process group. Later writes to the terminal fail."""
        def take_terminal():
            default_signals()
            os.setsid()
            fcntl.ioctl(0, termios.TIOCSCTTY, 0)

        process, ours = self.on_terminal("200", "--progress", "json", before=take_terminal, FAKE_PT_SAMPLE_MS="100")
        output = b""
        while not re.search(rb'"samples_per_pixel":[1-9]', output):
            output += os.read(ours, 4096)
        os.close(ours)
        self.assertEqual(process.wait(timeout=PATIENCE), 129)
        self.assertEqual(read_png(self.path("a.png"))[:2], (2, 2))
        self.assertEqual(self.files(), ["a.png"])

    def test_nohup_is_respected(self):
        process = self.start(*RENDER, "20", "--progress", "json", FAKE_PT_SAMPLE_MS=50,
                             before=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))
        process.stderr.readline()
        process.send_signal(signal.SIGHUP)
        self.assertEqual(process.wait(timeout=PATIENCE), 0)

    def test_progress_fits_it(self):
        for size, end in ((None, rb"100\.0 %  ETA 0:00:00  3/3 spp  \d+\.\d Msamples/s"), ((24, 21), rb"100\.0 %  ETA 0:00:00")):
            process, ours = self.on_terminal("3", size=size)
            output = b""
            try:
                while block := os.read(ours, 4096):
                    output += block
            except OSError:
                pass  # Linux reports a closed terminal by this error
            os.close(ours)
            self.assertEqual(process.wait(timeout=PATIENCE), 0)
            self.assertRegex(output, end + rb"\r\x1b\[K\Z")

    def test_quiet_runs_say_nothing(self):
        self.expect(0, *RENDER, "3", "--progress", "json", "-q")
        self.assertEqual((self.errors, self.output), ("", ""))
