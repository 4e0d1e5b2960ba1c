"""Tests of the completions that `pt completion` prints: bash, zsh and fish themselves complete lines by them, and no
option is missing. A shell that is not installed is told and left out. Arguments: see command_line.py."""

import os
import pty
import re
import select
import shutil
import subprocess

from command_line import PATIENCE, CommandLineTest, main

# What is typed before the tabulator, and what stands in the line after it, in a folder with the files of FILES.
LINES = {
    "pt ren": "pt render ",
    "pt render --tonem": "pt render --tonemap",  # with the sign that the shell adds for a value
    "pt render --tonemap rein": "pt render --tonemap reinhard ",
    "pt render --tonemap=rein": "pt render --tonemap=reinhard ",
    "pt render --exposure au": "pt render --exposure auto ",
    "pt render --device g": "pt render --device gpu ",
    "pt render --resu": "pt render --resume ",
    "pt render s": "pt render scene.json ",
    "pt render scene.json -o so": "pt render scene.json -o sound.exr ",
    "pt render scene.json --checkpoint s": "pt render scene.json --checkpoint sums.ptfilm ",
    "pt render scene.json --shader-dir ": "pt render scene.json --shader-dir glsl/",
    "pt merge s": "pt merge sums.ptfilm ",
    "pt tonemap s": "pt tonemap sound.exr ",
    "pt completion z": "pt completion zsh ",
    "pt man sel": "pt man selftest ",
}
FILES = "scene.json", "sums.ptfilm", "sound.exr", "song.mp3", "speech.txt"


class Terminal:
    """An interactive shell that has read the file `setup`, by which KEY writes its line to `line` and empties it."""

    KEY = b"\x1bq"  # Alt-q, in which no terminal sees a signal

    def __init__(self, test, command):
        self.test = test
        ours, theirs = pty.openpty()
        environment = {**os.environ, "TERM": "dumb", "PS1": "> ", "HOME": test.folder, "ZDOTDIR": test.folder}
        self.process = subprocess.Popen(command, cwd=test.folder, env=environment, stdin=theirs, stdout=theirs,
                                        stderr=theirs, start_new_session=True)
        os.close(theirs)
        self.terminal = ours
        test.addCleanup(self.process.wait)
        test.addCleanup(self.process.kill)
        test.addCleanup(os.close, ours)
        os.mkfifo(test.path("line"))
        self.line = os.open(test.path("line"), os.O_RDWR)  # to write as well, so that it has no end
        test.addCleanup(os.close, self.line)
        test.assertEqual(self.answer(b". ./setup; echo $? >line\n"), "0")

    def send(self, keys):
        while keys:
            keys = keys[os.write(self.terminal, keys):]

    def answer(self, keys):
        """The line that is written to `line` then. What the shell shows meanwhile is read away by a child."""
        reader = subprocess.Popen(["cat"], stdin=self.terminal, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.send(keys)
        found = b""
        while not found.endswith(b"\n"):
            ready, _, _ = select.select([self.line], [], [], PATIENCE)
            self.test.assertTrue(ready, f"no answer to {keys}")
            found += os.read(self.line, 1000)
        reader.kill()
        reader.wait()
        return found.decode()[:-1]

    def complete(self, typed):
        return self.answer(typed.encode() + b"\t" + self.KEY)


class Completion(CommandLineTest):
    def setUp(self):
        super().setUp()
        for name in FILES:
            self.write(name, "")
        os.mkdir(self.path("glsl"))

    def script(self, shell):
        self.expect(0, "completion", shell)
        return self.output

    def require(self, shell):
        if shutil.which(shell) is None:
            self.skipTest(f"{shell} is not installed")

    def check_lines(self, terminal, endings=()):
        for typed, expected in LINES.items():
            with self.subTest(typed=typed):
                found = terminal.complete(typed)
                self.assertIn(found, [expected, *(expected + ending for ending in endings)])

    def test_bash(self):
        self.require("bash")
        self.write("setup", self.script("bash") +
                   'show() { printf "%s\\n" "$READLINE_LINE" >line; READLINE_LINE=; }\nbind -x \'"\\eq":show\'\n')
        self.check_lines(Terminal(self, ["bash", "--noprofile", "--norc", "-i"]), endings=[" "])

    def test_zsh(self):
        self.require("zsh")
        self.write("_pt", self.script("zsh"))
        self.write("setup", "fpath=($PWD $fpath); autoload -Uz compinit; compinit -u -D\n"
                   "show() { print -r -- $BUFFER >line; BUFFER= }\nzle -N show; bindkey '^[q' show\n")
        self.check_lines(Terminal(self, ["zsh", "-f", "-i"]), endings=["=", " "])

    def test_fish(self):
        self.require("fish")
        self.write("pt.fish", self.script("fish"))
        for typed, expected in LINES.items():
            with self.subTest(typed=typed):
                done = subprocess.run(["fish", "--no-config", "-c", "source pt.fish; complete -C $argv[1]", typed],
                                      cwd=self.folder, stdout=subprocess.PIPE, text=True, check=True,
                                      env={**os.environ, "HOME": self.folder})
                words = [line.split("\t")[0] for line in done.stdout.splitlines()]
                wanted = expected.split(" ")[len(typed.split(" ")) - 1]
                # fish completes all of a name; of two names with one beginning it offers both.
                self.assertIn(words, [[wanted], [wanted, wanted + "-cp"]])

    def test_no_option_and_no_word_is_missing(self):
        self.expect(0, "--help")
        commands = re.findall(r"^  (\w+) ", self.output.split("Commands:\n")[1].split("\n\n")[0], re.MULTILINE)
        options = {}
        for command in commands:
            self.expect(0, command, "--help")
            options[command] = re.findall(r"^  (?:-\w,)?(--[\w-]+)(?: (\S+))?", self.output, re.MULTILINE)
        self.assertIn(("--tonemap", "none|reinhard|aces|agx|neutral"), options["render"])
        for shell, names in (("bash", r"\b{}:{}\b"), ("zsh", r"(?s)\n    {}\)\n(?:(?!;;).)*{}[=\[]"),
                             ("fish", r"seen_subcommand_from {}'.* -l {}\b")):
            script = self.script(shell)
            flat = script.replace("--", "") if shell == "fish" else script
            for command in commands:
                for option, value in options[command]:
                    name = option.strip("-") if shell == "fish" else option
                    pattern = names.format(command, re.escape(name))
                    if shell == "bash" and not value:  # an option without a value stands among the words alone
                        pattern = rf"(?m)^ +{command}:-\*\) .*{re.escape(name)}\b"
                    self.assertRegex(flat, pattern, (shell, command, option))
                    for word in re.findall(r"(?:^|\|)([a-z0-9-]+)(?=\||,\.\.\.|$)", value):
                        self.assertRegex(script, rf"[ (']{re.escape(word)}[ )';\"]", (shell, option, word))

    def test_an_unknown_shell(self):
        self.expect(2, "completion", "tcsh", error='pt: SHELL: unknown shell "tcsh", known: bash, zsh, fish')
        self.expect(2, "completion", error="SHELL is required")


if __name__ == "__main__":
    main()
