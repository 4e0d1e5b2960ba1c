"""Tests of what the project's pages say of itself: links lead somewhere, and the library's page names every function.
Arguments: the project's folder."""

import pathlib
import re
import sys
import unittest

ROOT = pathlib.Path(sys.argv[1])
PAGES = [path for folder in (".", "cli", "lib", "shaders", "tests") for path in (ROOT / folder).glob("*.md")]
PAGES += [*(ROOT / "tests").glob("*/*.md"), *(ROOT / "lib").glob("*/*.md")]


def anchors(text):
    """Names that the host of a repository gives to headings: lower case, without punctuation, blanks as hyphens."""
    headings = re.findall(r"^#+ (.*)$", re.sub(r"```.*?```", "", text, flags=re.DOTALL), re.MULTILINE)
    names = re.findall(r'<a name="([^"]+)">', text)
    return {re.sub(r"[^\w -]", "", heading.lower()).replace(" ", "-") for heading in headings} | set(names)


def broken_links(page, text):
    broken = []
    for link in re.findall(r"\]\(([^()\s]+)\)", text):
        target, _, anchor = link.partition("#")
        path = page.parent / target if target else page
        if re.match(r"https?:", link):
            continue
        if not path.exists() or (anchor and anchor not in anchors(path.read_text(encoding="utf-8"))):
            broken.append(link)
    return broken


class Documents(unittest.TestCase):
    def test_links_lead_somewhere(self):
        self.assertIn(ROOT / "README.md", PAGES)
        for page in PAGES:
            self.assertEqual(broken_links(page, page.read_text(encoding="utf-8")), [], page)

    def test_a_broken_link_is_found(self):
        page = ROOT / "README.md"
        text = "[a](LICENSE) [b](no-such-file) [c](#two-commands) [d](#no-such-heading) [e](cli/README.md#no-such-heading)"
        self.assertEqual(broken_links(page, text), ["no-such-file", "#no-such-heading", "cli/README.md#no-such-heading"])

    def test_every_function_is_named(self):
        headers = "".join(path.read_text(encoding="utf-8") for path in (ROOT / "lib/include/pt").glob("*.h"))
        declared = re.findall(r"^PT_API [\w *]*?(pt_\w+)\(", headers, re.MULTILINE)
        table = (ROOT / "lib/README.md").read_text(encoding="utf-8").split("## Functions")[1].split("\n## ")[0]
        named = [name for row in re.findall(r"^\| (`pt_.*?) \|", table, re.MULTILINE) for name in re.findall(r"`(\w+)`", row)]
        self.assertGreater(len(declared), 10)
        self.assertEqual(sorted(named), sorted(declared))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
