"""Tests that cli/README.md says what the program does. Arguments: see command_line.py."""

import os
import re

from command_line import PT, SCENES, CommandLineTest, main, read_png

with open(os.path.join(os.path.dirname(SCENES), "README.md"), encoding="utf-8") as file:
    MANUAL = file.read()


def table_keys(section):
    """The names in the first column of the table below "**`section`**"."""
    table = re.search(rf"\*\*`{section}`\*\*.*?\n\|[- |]+\|\n((?:\|[^\n]*\n)+)", MANUAL, re.DOTALL)[1]
    return [name for row in table.splitlines() for name in re.findall(r"`(\w+)`", row.split("|")[1])]


class SceneFile(CommandLineTest):
    def known_keys(self, text):
        """What the program says of the key "zzzzzzzzz"."""
        self.write("s.json", text)
        self.expect(3, "render", "s.json", "-o", "a.png", error='unknown key "zzzzzzzzz", known: ')
        return self.errors.strip().split("known: ")[1].split(", ")

    def test_every_key_is_described(self):
        unknown = '"zzzzzzzzz": 1'
        sections = {"camera": "{%s}", "film": "{%s}", "render": "{%s}", "materials": '{"a": {%s}}', "spheres": "[{%s}]",
                    "planes": "[{%s}]"}
        self.assertEqual(sorted(self.known_keys("{%s}" % unknown)), sorted(sections))
        for section, value in sections.items():
            known = self.known_keys('{"%s": %s}' % (section, value % unknown))
            self.assertEqual(sorted(known), sorted(table_keys(section)), section)

    def test_names_are_all_of_them(self):
        for section, key, kind in (("film", "tonemap", "tone map"), ("render", "sampler", "sampler"),
                                   ("render", "estimator", "estimator")):
            self.write("s.json", '{"%s": {"%s": "zzzzzzzzz"}}' % (section, key))
            self.expect(3, "render", "s.json", "-o", "a.png", error=f'unknown {kind} "zzzzzzzzz", known: ')
            row = re.search(rf"\n\| `{key}` \|.*\n", MANUAL)[0]
            self.assertEqual(re.findall(r"`([\w-]+)`", row.split("|")[3]),
                             self.errors.strip().split("known: ")[1].split(", "))


class RealDevice(CommandLineTest):
    program = PT

    def test_examples(self):
        examples = re.findall(r"```json\n(.*?)```", MANUAL, re.DOTALL)
        self.assertGreater(len(examples), 0)
        for example in examples:
            self.write("s.json", example)
            self.expect(0, "render", "s.json", "-o", "a.png", "--spp", "4")
            self.assertEqual(self.errors, "")
            width, height, lines = read_png(self.path("a.png"))
            self.assertEqual((width, height), (320, 180))
            self.assertGreater(len({value for line in lines for value in line}), 100)  # it shows something

    def test_exit_codes(self):
        self.expect(0, "--help")
        told = re.findall(r"^  (\d+) +(.*)$", self.output.split("Exit codes:\n")[1], re.MULTILINE)
        table = re.findall(r"^\| (\d+) \| (.*) \|$", MANUAL, re.MULTILINE)
        self.assertEqual([(code, text.replace("`", "").replace(" (--error)", "")) for code, text in table], told)

    def test_commands(self):
        for command in re.findall(r"\n\| `pt (\w+)", MANUAL):
            self.expect(0, command, "--help")


if __name__ == "__main__":
    main()
