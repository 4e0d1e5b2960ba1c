"""Tests of the manual pages that `pt man` prints: groff, man and mandoc find nothing wrong with them, and no option is
missing. One of these programs that is not installed is told and left out. Arguments: see command_line.py."""

import re
import shutil
import subprocess

from command_line import CommandLineTest, main

CHECKS = {
    "groff": ["groff", "-ww", "-man", "-Tutf8", "-z", "page"],
    "man": ["man", "--warnings=w", "-l", "page"],
    "mandoc": ["mandoc", "-T", "lint", "page"],
}
DATE = {"SOURCE_DATE_EPOCH": "1000000000"}  # mandoc wants a date


class ManualPages(CommandLineTest):
    def commands(self):
        self.expect(0, "--help")
        return re.findall(r"^  (\w+) ", self.output.split("Commands:\n")[1].split("\n\n")[0], re.MULTILINE)

    def page(self, *command):
        self.expect(0, "man", *command, **DATE)
        return self.output

    def complaints(self, check, page):
        self.write("page", page)
        done = subprocess.run(CHECKS[check], cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        return done.stdout + done.stderr if check == "mandoc" else done.stderr

    def check_pages(self, check):
        if shutil.which(check) is None:
            self.skipTest(f"{check} is not installed")
        # An unknown macro is found, and a right page is not taken for a wrong one.
        self.assertIn("ZZ", self.complaints(check, self.page() + ".ZZ\n"))
        for command in [], *([name] for name in self.commands()):
            self.assertEqual(self.complaints(check, self.page(*command)), "", command)

    def test_groff(self):
        self.check_pages("groff")

    def test_man(self):
        self.check_pages("man")

    def test_mandoc(self):
        self.check_pages("mandoc")

    def test_pages_say_what_the_help_says(self):
        """Every word of the help but the forms of its headings, in the same order within an entry."""
        for command in self.commands():
            self.expect(0, command, "--help")
            shown = self.output
            page = self.page(command).replace("\\-", "-")
            for names, value, text in re.findall(
                    r"^  (-\S+)(?: (\S.*?))?(?:\n {20,}|  +)(\S.*(?:\n {20,}\S.*)*)", shown, re.MULTILINE):
                tag = ", ".join(rf"\fB{name}\fR" for name in names.split(","))
                tag += rf" \fI{value}\fR" if value and not value.startswith("[") else ""
                entry = page.split(f".TP\n{tag}\n" if not value.startswith("[") else f".TP\n{tag} [")[1].split("\n.")[0]
                plain = entry.replace("\\&", "").replace("\\(aq", "'").replace("\\(ga", "`").replace("\\(ha", "^")
                if not value.startswith("["):
                    self.assertEqual(plain.split(), text.split(), names)
            for group in re.findall(r"^([A-Z].*):$", shown.split("Usage: ")[1], re.MULTILINE):
                heading = group.upper() if group in ("Arguments", "Options", "Exit codes") else group
                self.assertRegex(page, rf"(?m)^\.S[HS] {re.escape(heading)}$")

    def test_what_is_before_and_after(self):
        page = self.page("render")
        self.assertTrue(page.startswith('.TH PT\\-RENDER 1 "2001-09-09" "pt '), page[:80])
        self.assertIn("\n.SH NAME\npt\\-render \\- render a scene file to images\n.SH SYNOPSIS\n"
                      "\\fBpt render\\fR [OPTIONS] SCENE\n", page)
        names = re.findall(r"^\.BR pt\\-(\w+) \(1\)", page, re.MULTILINE)
        self.assertEqual(names, [name for name in self.commands() if name != "render"])
        self.assertIn(".BR pt (1),\n", page)

    def test_an_unknown_command(self):
        self.expect(2, "man", "rendr", error='pt: COMMAND: unknown command "rendr", did you mean "render"?')


if __name__ == "__main__":
    main()
