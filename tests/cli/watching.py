import json
import os
import signal
import subprocess

from command_line import PATIENCE, CommandLineTest


def scene_text(width, emission=1.0):
    """The camera is inside a ball, so every pixel has exactly the ball's emission."""
    return json.dumps({"film": {"width": width, "height": 2, "exposure": 0}, "render": {"spp": 1, "max_path_length": 1},
                       "materials": {"light": {"emission": emission}},
                       "spheres": [{"center": [0, 0, 0], "radius": 9, "material": "light"}]})


class Watching:
    def __init__(self, process):
        self.process = process
        self.seen = []

    def line_with(self, text):
        for line in self.process.stdout:
            self.seen.append(line)
            if text in line:
                return line
        raise AssertionError(f"{text} does not come after\n{''.join(self.seen)}")

    def end(self, number=signal.SIGINT):
        self.process.send_signal(number)
        self.seen += self.process.stdout
        return self.process.wait(timeout=PATIENCE)

    def count(self, text):
        return sum(text in line for line in self.seen)


class WatchTest(CommandLineTest):
    def watch(self, *arguments, **environment):
        return Watching(self.start("render", "s.json", "--watch", "-o", "a.png", *arguments, stderr=subprocess.STDOUT,
                                   **environment))

    def save(self, name, text):
        self.write(name + "~", text)
        os.replace(self.path(name + "~"), self.path(name))
