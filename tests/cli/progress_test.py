import fcntl
import json
import os
import pty
import struct
import subprocess
import termios

from command_line import COURSEWORK, PATIENCE, CommandLineTest


class ProgressOutput(CommandLineTest):
    def test_styles(self):
        arguments = ["render", COURSEWORK, "-o", "a.png", "--spp", "3"]
        self.expect(0, *arguments)
        self.assertEqual(self.errors, "")  # stderr is not a terminal
        self.expect(0, *arguments, "--progress", "json")
        lines = [json.loads(line) for line in self.errors.splitlines()]
        self.assertEqual((lines[-1]["fraction"], lines[-1]["samples_per_pixel"]), (1.0, 3))
        self.expect(0, *arguments, "--progress", "json", "-q")
        self.assertEqual((self.errors, self.output), ("", ""))

    def terminal_output(self, size=None):
        try:
            ours, theirs = pty.openpty()
        except OSError as error:  # a chroot without /dev/pts
            self.skipTest(str(error))
        if size is not None:
            fcntl.ioctl(theirs, termios.TIOCSWINSZ, struct.pack("HHHH", *size, 0, 0))
        process = subprocess.Popen([self.program, "render", COURSEWORK, "-o", self.path("a.png"), "--spp", "3"],
                                   stdout=subprocess.DEVNULL, stderr=theirs)
        os.close(theirs)
        output = b""
        try:
            while block := os.read(ours, 4096):
                output += block
        except OSError:
            pass  # Linux reports a closed terminal by this error
        os.close(ours)
        self.assertEqual(process.wait(timeout=PATIENCE), 0)
        return output

    def test_terminal(self):
        output = self.terminal_output()  # of unknown size
        self.assertRegex(output, rb"100\.0 %  ETA 0:00:00  3/3 spp  \d+\.\d Msamples/s\r")
        self.assertTrue(output.endswith(b"\r\x1b[K"), output)

    def test_narrow_terminals(self):
        self.assertIn(b"100.0 %  ETA 0:00:00\r", self.terminal_output((24, 21)))
