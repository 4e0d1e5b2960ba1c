import csv
import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGES = [path for folder in (".", "cli", "lib", "shaders", "tests") for path in (ROOT / folder).glob("*.md")]
PAGES += [*(ROOT / "tests").glob("*/**/*.md"), *(ROOT / "lib").glob("*/*.md")]
CURRENT = [page for page in PAGES if page.name not in ("CHANGELOG.md", "NOTEBOOK.md")]
CODE = re.compile(r"\.(h|c|cpp|glsl|comp|diff|py|json|csv|cmake|sh)$|^CMakeLists\.txt$")

MOST_WORDS = {"README.md": 1220, "CONTRIBUTING.md": 1350, "cli/README.md": 4500, "shaders/README.md": 5800,
              "shaders/COURSEWORK.md": 1200, "tests/bench/README.md": 1200}
MOST_WORDS_IN_ALL = 22_000

# Each row has a pattern for pages, a file, and a pattern for this file. The groups of both patterns must be equal.
NUMBERS = (
    (r"(?:[Ff]rom|scenes of) (\d+) spheres\s+o[nr]\b", "lib/tree/tree_choice.h", r"default_tree_from = (\d+);"),
    (r"[Uu]p to (\d+) (?:spheres )?that reach\s+(\d+) times as far", "lib/tree/tree_choice.cpp",
     r"most_outlying = (\d+);[^@]*much_farther = (\d+)\.0;"),
    (r"[Ff]rom (\d+) lamps\s+on", "lib/view/lamp_tree_words.h", r"least_tree_lamps = (\d+);"),
    (r"at most (\d+), `EVERY_LAMP_LIMIT`", "shaders/gpu_layout.h", r"EVERY_LAMP_LIMIT = (\d+);"),
    (r"K\\ge(\d+)\$ \(`ROULETTE_MIN_LENGTH`", "shaders/gpu_layout.h", r"ROULETTE_MIN_LENGTH = (\d+);"),
    (r"gathers up to (\d+) samples", "shaders/gpu_layout.h", r"FILM_MAX_GATHERED = (\d+);"),
    (r"with (\d+) bits of fraction", "shaders/gpu_layout.h", r"FILM_FRACTION_BITS = (\d+);"),
    (r"sequences have (\d+) dimensions", "lib/points/point_sequence.h", r"sequence_dimensions = (\d+);"),
    (r"\\max\(q, ([\d.]+)\)", "shaders/phong.glsl", r"LAST_SPECULAR_PROBABILITY = ([\d.]+);"),
    (r"fewer than (\d+) pixels", "lib/film/error_estimate.h", r"few_pixels = (\d+)\.0;"),
    (r"[Ff]rom (\d+) samples on", "lib/film/error_estimate.h", r"min_estimate_samples = (\d+);"),
    (r"up to 2\^(\d+) spheres", "lib/scene/sphere_array_rules.h", r"max_sphere_count = std::uint64_t\{1\} << (\d+);"),
    (r"`libpt\.so\.(\d+)\.(\d+)`", "CMakeLists.txt", r"VERSION (\d+)\.(\d+)\.\d+"),
)


def anchors(text):
    """Makes the anchors that repository hosts make from headings: lower case, hyphens for blanks, no punctuation."""
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


def code_files():
    return [path for folder in ("cli", "cmake", "lib", "shaders", "tests") for path in (ROOT / folder).rglob("*")
            if CODE.search(path.name)]


def names_of_code(text):
    """Returns the code spans that are identifiers with an underscore, and the code spans that name source files or
    folders."""
    spans = re.findall(r"`([\w./]+)(?:\(\))?`", re.sub(r"```.*?```", "", text, flags=re.DOTALL))
    others = {span for span in spans if re.search(r"/|\.(h|c|cpp|glsl|comp|py|json|md|sh|exr|png)$", span)}
    identifiers = {word for span in spans if span not in others for word in span.split(".") if "_" in word}
    source = r"\w\.(h|cpp|glsl|comp)$|^(cli|cmake|lib|shaders|tests)/"
    return identifiers, {span for span in others if re.search(source, span)}


def missing_files(page, names, files):
    folders = [ROOT, page.parent, ROOT / "lib/include", ROOT / "lib/include/pt"]
    return [name for name in names if name not in files and not any((folder / name).exists() for folder in folders)]


def commands_without_source(text):
    wrong = []
    for block in re.findall(r"```sh\n(.*?)```", text, re.DOTALL):
        for line in block.replace("\\\n", " ").splitlines():
            script = re.search(r"[\w/]+/\w+\.py\b", line)
            if script is None:
                continue
            path = ROOT / script[0]
            source = "".join(each.read_text(encoding="utf-8") for each in path.parent.glob("*.py"))
            options = re.findall(r"(?<!\S)--[\w-]+", line.split("#")[0])
            wrong += [script[0]] * (not path.exists()) + [name for name in options if f'"{name}"' not in source]
    return wrong


class Documents(unittest.TestCase):
    def test_recipes_name_the_files_of_samplers_and_estimators(self):
        text = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
        generated = {"lib/include/pt/pt.h", "lib/scene_file/enumerations.h", "shaders/enumerations.h"}
        named = set()
        for recipe, constant in (("A sampler", "SAMPLER"), ("An estimator", "ESTIMATOR")):  # The second recipe refers to the first.
            named |= set(re.findall(r"`((?:lib|shaders)/[\w/]+\.\w+)`", text.split(f"**{recipe}.**")[1].split("\n\n")[0]))
            uses = {path.relative_to(ROOT).as_posix() for folder in ("lib", "shaders") for path in (ROOT / folder).rglob("*")
                    if path.suffix in (".cpp", ".h", ".glsl") and path.parent.name != "pt"
                    and re.search(rf"(?<!\w)(?:PT_)?{constant}_(?!BEST)[A-Z]+", path.read_text(encoding="utf-8"))}
            self.assertGreater(len(uses), 5)
            self.assertEqual({name for name in uses - named - generated if re.sub(r"\.h$", ".cpp", name) not in named}, set(), recipe)

    def test_links_lead_somewhere(self):
        self.assertIn(ROOT / "README.md", PAGES)
        for page in PAGES:
            self.assertEqual(broken_links(page, page.read_text(encoding="utf-8")), [], page)
        page = ROOT / "README.md"
        text = "[a](LICENSE) [b](no-such-file) [c](#two-commands) [d](#no-such-heading) [e](cli/README.md#no-such-heading)"
        self.assertEqual(broken_links(page, text), ["no-such-file", "#no-such-heading", "cli/README.md#no-such-heading"])

    def test_names_are_those_of_the_code(self):
        paths = code_files()
        words = set().union(*(re.findall(r"\w+", path.read_text(encoding="utf-8")) for path in paths))
        files = {path.name for path in paths}
        for page in CURRENT:
            identifiers, names = names_of_code(page.read_text(encoding="utf-8"))
            foreign = {word for word in identifiers if word.startswith("dask_")}
            self.assertEqual(sorted(identifiers - foreign - words), [], page)
            self.assertEqual(missing_files(page, names, files), [], page)
        self.assertEqual(names_of_code("`a_b.cd`, `e_f()`, `x/g_h.cpp`, `plain`"), ({"a_b", "e_f"}, {"x/g_h.cpp"}))
        self.assertEqual(missing_files(ROOT / "README.md", ["lib/no.cpp", "pt/pt.h"], files), ["lib/no.cpp"])

    def test_numbers_are_those_of_the_code(self):
        text = "\n".join(page.read_text(encoding="utf-8") for page in CURRENT)
        for told, path, held in NUMBERS:
            numbers = {match.groups() for match in re.finditer(told, text)}
            self.assertEqual(numbers, {re.search(held, (ROOT / path).read_text(encoding="utf-8")).groups()}, told)
        layout = (ROOT / "shaders/gpu_layout.h").read_text(encoding="utf-8")
        parts, words = (int(re.search(rf"FILM_{name} = (\d+);", layout)[1]) for name in ("PARTS", "WORDS"))
        self.assertEqual(set(re.findall(r"(\d+) bytes a pixel", text)), {str(4 * parts * words)})

    def test_commands_have_their_scripts_and_options(self):
        for page in PAGES:
            self.assertEqual(commands_without_source(page.read_text(encoding="utf-8")), [], page)
        text = "```sh\npython3 tests/bench/scale.py --no-such --counts 1\npython3 tests/no/such.py\n```"
        self.assertEqual(commands_without_source(text), ["--no-such", "tests/no/such.py"])

    def test_comments_name_files_that_exist(self):
        files = {path.name for path in ROOT.rglob("*.*") if not path.relative_to(ROOT).parts[0].startswith((".", "build"))}
        files.add("sysexits.h")
        for path in (path for path in code_files() if path.suffix in (".h", ".cpp", ".glsl", ".comp")):
            comments = " ".join(re.findall(r"//[^\n]*|/\*.*?\*/", path.read_text(encoding="utf-8"), re.DOTALL))
            names = re.findall(r"([\w-]+\.(?:h|cpp|glsl|comp|py|md|cmake|sh))\b", comments)
            self.assertEqual(sorted(set(names) - files), [], path)

    def test_promises_have_their_tests(self):
        with open(ROOT / "tests/promises.csv", encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertLessEqual(len(rows), 40)
        self.assertEqual([row["test"] for row in rows if not (ROOT / "tests" / row["test"]).is_file() or not all(row.values())], [])

    def test_pages_are_short(self):
        words = {path: len(path.read_text(encoding="utf-8").split()) for path in PAGES if path.name != "CHANGELOG.md"}
        self.assertLess(sum(words.values()), MOST_WORDS_IN_ALL)
        self.assertEqual({name for name, most in MOST_WORDS.items() if words[ROOT / name] > most}, set())

    def test_examples_have_their_libraries(self):
        build = (ROOT / "lib/examples/CMakeLists.txt").read_text(encoding="utf-8")
        links = re.findall(r"^target_link_libraries\(pt_example_(\w+) PRIVATE (.*)\)", build, re.MULTILINE)
        sentence = next(line for line in (ROOT / "lib/README.md").read_text(encoding="utf-8").splitlines() if "`-lm`" in line)
        of_maths, of_vulkan = (set(re.findall(r"`(\w+)\.c`", part)) for part in sentence.split("`-lm`"))
        self.assertEqual(of_maths, {name for name, libraries in links if "m" in libraries.split()})
        self.assertEqual(of_vulkan, {name for name, libraries in links if "Vulkan::Vulkan" in libraries})

    def test_every_function_is_named(self):
        headers = "".join(path.read_text(encoding="utf-8") for path in (ROOT / "lib/include/pt").glob("*.h"))
        declared = re.findall(r"^PT_API [\w *]*?(pt_\w+)\(", headers, re.MULTILINE)
        table = (ROOT / "lib/README.md").read_text(encoding="utf-8").split("## Functions")[1].split("\n## ")[0]
        named = [name for row in re.findall(r"^\| (`pt_.*?) \|", table, re.MULTILINE) for name in re.findall(r"`(\w+)`", row)]
        self.assertGreater(len(declared), 10)
        self.assertEqual(sorted(named), sorted(declared))
