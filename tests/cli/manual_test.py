import json
import os
import re
import shlex
import shutil
import unittest

from command_line import PT, SCENES, CommandLineTest

with open(os.path.join(os.path.dirname(SCENES), "README.md"), encoding="utf-8") as file:
    MANUAL = file.read()

SECTIONS = {"camera": "{%s}", "film": "{%s}", "render": "{%s}", "materials": '{"a": {%s}}',
            "spheres": "[{%s}]", "capsules": "[{%s}]", "planes": "[{%s}]"}
# Keys that examples need in addition to the tested key.
REQUIRED = {"camera": {"position": [0, 0, 1], "look_at": [0, 0, 0]},
            "spheres": {"center": [0, 0, -5], "radius": 1, "material": "red"},
            "capsules": {"center": [0, 0, -5], "end": [1, 0, -5], "radius": 1, "material": "red"},
            "planes": {"normal": [0, 1, 0], "offset": 0, "material": "red"}}
# Keys that exclude each other. Examples contain neither.
EITHER = {"camera": (["vertical_fov", "aperture", "focus"], ["projection", "vertical_extent"])}


def rows_after(heading):
    table = re.search(rf"{re.escape(heading)}.*?\n\|[-| ]+\|\n((?:\|[^\n]*\n)+)", MANUAL, re.DOTALL)[1]
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in table.splitlines()]


def names_in(cell):
    return re.findall(r"`([\w-]+)`", cell)


def section_rows(section):
    return rows_after(f"\n**`{section}`**")


def number_of(text):
    base, _, minus = text.replace("2^64", str(2**64)).partition(" - ")
    number = float(base) if re.search(r"[.e]", base) else int(base)
    return number - int(minus or 0)


def range_of(cell):
    """Returns (0.1, 10) for "from 0.1 to 10", or None for other cells."""
    found = re.search(r"from (-?[\d.e^-]+) to (-?[\d.e^-]+(?: - 1)?)(?:,|$)", cell)
    return found and (number_of(found[1]), number_of(found[2]))


def beyond(least, largest):
    step = 1 if isinstance(least, int) and isinstance(largest, int) else abs(largest) * 1e-3
    return least - step, largest + step


def commands_of(page):
    return [shlex.split(line.split(" # ")[0]) for block in re.findall(r"```sh\n(.*?)```", page, re.DOTALL)
            for line in block.splitlines() if line.startswith("pt ")]


def scene_with(section, values):
    members = json.dumps({**REQUIRED.get(section, {}), **values})
    others = "" if section == "materials" else ', "materials": {"red": {"diffuse": 0.5}}'
    return '{"%s": %s%s}' % (section, SECTIONS[section] % members[1:-1], others)


class Methods(unittest.TestCase):
    def test_samplers_and_estimators_are_explained(self):
        for kind in "sampler", "estimator":
            chosen, = (row for row in section_rows("render") if names_in(row[0]) == [kind])
            explained = [name for row in rows_after(f"\n| {kind} |") for name in names_in(row[0])]
            self.assertEqual(explained, [name for name in names_in(chosen[2]) if name != "best"])


class RealDevice(CommandLineTest):
    program = PT
    small = "-o", "a.png", "--size", "4x2", "--spp", "1", "-q"

    def setUp(self):
        super().setUp()
        shutil.copy(os.path.join(SCENES, "first.json"), self.path("scene.json"))

    def test_the_scene_is_the_shipped_one(self):
        example, = re.findall(r"```json\n(.*?)```", MANUAL, re.DOTALL)
        with open(os.path.join(SCENES, "first.json"), encoding="utf-8") as shipped:
            self.assertEqual(example, shipped.read())

    def run_small(self, words, size="32x16"):
        if "--watch" in words:
            return set()
        if "--size" in words:
            words = [size if option == "--size" else word for option, word in zip(["", *words], words)]
        self.expect(0, *words, *(["--size", size] if words[0] == "render" and "--size" not in words else []))
        return {name.replace("##", "47") for option, name in zip(words, words[1:]) if option in ("-o", "--film")}

    def test_commands_of_the_manual_run(self):
        commands = commands_of(MANUAL)
        self.assertGreater(len(commands), 5)
        for command in (each for each in commands if each[1] != "selftest"):  # selftest_test.py runs it
            words = command[1:command.index(">")] if ">" in command else command[1:]
            self.run_small(words + (["--denoise", os.environ["OPEN_IMAGE_DENOISE"]] if command[1] == "denoise" else []))
        self.assertLessEqual({"picture.png", "picture.exr", "figures.json", "darker.jpg"}, set(self.files()))

    def test_recipes_run(self):
        frames, = re.findall(r'```\n( +"animation": .*?)```', MANUAL, re.DOTALL)
        self.write("animated.json", self.read("scene.json").rstrip().removesuffix("}") + ",\n" + frames + "}\n")
        with open(os.path.join(os.path.dirname(SCENES), "RECIPES.md"), encoding="utf-8") as file:
            commands = commands_of(file.read())
        self.assertGreater(len(commands), 8)
        for command in commands:
            written = self.run_small(["47" if option == "--frames" else word for option, word in zip(command, command[1:])])
            self.assertLessEqual(written, set(self.files()))

    def test_the_readme_runs(self):
        root = os.path.realpath(os.path.join(SCENES, "..", ".."))
        with open(os.path.join(root, "README.md"), encoding="utf-8") as file:
            readme = file.read()
        scene, = re.findall(r"```json\n(.*?)```", readme, re.DOTALL)
        self.write("ball.json", scene)
        commands = re.findall(r"^build/bin/pt (render ball.json .*?)(?: +#.*)?$", readme, re.MULTILINE)
        self.assertEqual(len(commands), 3)
        for command in commands:
            self.run_small(command.split())
            self.assertEqual(self.errors, "")
        self.assertRegex(self.output, r"^wrote ball.png: 32x16, .*\nexposure .* \(auto\)\nerror .*; target reached")

        os.symlink(os.path.join(root, "cli"), self.path("cli"))
        rows = re.findall(r"^\| !\[[^]]+\]\((cli/scenes/pictures/([\w-]+\.png))\) \|(.*`build/bin/pt .*)", readme, re.MULTILINE)
        self.assertEqual(len(rows), 5)
        for picture, name, text in rows:
            self.assertTrue(os.path.exists(os.path.join(root, picture)), picture)
            commands = re.findall(r"`build/bin/pt ([^`]+)`", text)
            for command in commands:
                self.run_small(command.split())
                for line in self.errors.splitlines():
                    self.assertRegex(line, "materials.*: diffuse . specular = |there is no checkpoint yet")
            self.assertIn(name, set(commands[-1].split()) & set(self.files()))

    def test_ranges_of_options(self):
        rows = {row[0].strip("`"): row[2] for row in rows_after("\n## `pt render`\n")}
        ranges = {option: ends for option, ends in ((option, range_of(text)) for option, text in rows.items()) if ends}

        def given(option, number):
            return f"{option}={number},{number},{number}" if rows[option].startswith("`R,G,B`") else f"{option}={number}"

        for option, ends in ranges.items():
            for number in beyond(*ends):
                self.expect(2, "render", "scene.json", "-o", "a.png", given(option, number), error=option)
        self.assertEqual(len(ranges), 11)
        ranges["--spp"] = (1, 1)
        for end in 0, 1:
            options = [given(option, ends[end]) for option, ends in ranges.items()]
            self.expect(0, "render", "scene.json", "-o", "a.png", "--size", "4x2", *options)

    def test_reports_have_the_keys_that_are_told(self):
        self.expect(0, "render", "scene.json", *self.small, "--stats", "s.json", "--progress", "json")
        self.expect(0, "render", "scene.json", "-o", "a.png", "--spp", "1", "--size", "4x2", "--progress", "json")
        told = [[name for row in rows_after(heading) for name in names_in(row[0])]
                for heading in ("## Reports", "`--progress json` prints")]
        self.assertEqual(told[0], list(json.loads(self.read("s.json"))))
        self.assertEqual(told[1], list(json.loads(self.errors.splitlines()[0])))

    def test_every_command_and_option_is_described(self):
        self.expect(0, "--help")
        commands = re.findall(r"^  (\w+) ", self.output.split("Commands:\n")[1].split("\n\n")[0], re.MULTILINE)
        self.assertEqual(re.findall(r"\n\| \[`pt (\w+)", MANUAL), commands)
        for command in commands:
            self.expect(0, command, "--help")
            known = re.findall(r"^  (?:(-\w),)?(--[\w-]+)", self.output, re.MULTILINE)
            has_none = re.search(rf"\n## `pt {command}`\n[^#]*It has no options\.", MANUAL)
            rows = [] if has_none else rows_after(f"\n## `pt {command}`\n")
            described = [name for row in rows for name in re.findall(r"`(-[\w-]+)`", row[0])]
            self.assertEqual(sorted(described), sorted(name for names in known for name in names
                                                       if name and names != ("-h", "--help")), command)
            words = r"^  (--[\w-]+) ([a-z0-9-]+(?:\|[a-z0-9-]+)+)(?: |$)"
            for names, value in re.findall(words, self.output, re.MULTILINE):
                row, = (row for row in rows if f"`{names}`" in row[0])
                if not row[1].startswith("as in `pt render`"):
                    self.assertEqual(names_in(row[2]), value.split("|"), names)
