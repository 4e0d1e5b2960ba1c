"""What the tests of `pt render --watch` share: a program that goes on running, and what it says meanwhile."""

import json
import os
import queue
import signal
import threading

from command_line import CommandLineTest

PATIENCE = 100  # seconds; nothing takes so long that comes at all


def scene_text(width, emission=1.0):
    """A ball around the camera: every pixel is its emission, exactly."""
    return json.dumps({"film": {"width": width, "height": 2}, "render": {"spp": 1, "max_path_length": 1},
                       "materials": {"light": {"emission": emission}},
                       "spheres": [{"center": [0, 0, 0], "radius": 9, "material": "light"}]})


class Watching:
    """A running program, whose lines are read as they come."""

    def __init__(self, process):
        self.process = process
        self.lines = queue.Queue()
        self.seen = []
        self.readers = [threading.Thread(target=self.read, args=(stream,), daemon=True)
                        for stream in (process.stdout, process.stderr)]
        for reader in self.readers:
            reader.start()

    def read(self, stream):
        for line in stream:
            self.lines.put(line)

    def line_with(self, text):
        """The next line that contains it; those before it are passed over."""
        while True:
            try:
                self.seen.append(self.lines.get(timeout=PATIENCE))
            except queue.Empty:
                raise AssertionError(f"{text} does not come after\n{''.join(self.seen)}") from None
            if text in self.seen[-1]:
                return self.seen[-1]

    def end(self, number=signal.SIGINT):
        """Sends a signal, and returns the exit code."""
        self.process.send_signal(number)
        code = self.process.wait(timeout=PATIENCE)
        for reader in self.readers:
            reader.join()
        while not self.lines.empty():
            self.seen.append(self.lines.get())
        return code

    def count(self, text):
        """Lines so far that contain it."""
        return sum(text in line for line in self.seen)


class WatchTest(CommandLineTest):
    def watch(self, *arguments, **environment):
        process = self.start("render", "s.json", "--watch", "-o", "a.png", *arguments, **environment)
        self.addCleanup(process.stderr.close)
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return Watching(process)

    def save(self, name, text):
        """As editors do: a new file takes the old one's name."""
        self.write(name + "~", text)
        os.replace(self.path(name + "~"), self.path(name))
