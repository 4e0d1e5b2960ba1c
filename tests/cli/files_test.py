import json
import os
import subprocess

from command_line import COURSEWORK, PATIENCE, RESULT, CommandLineTest, default_signals

SCENE = '{"film": {"width": 4, "height": 3}, "render": {"spp": 2}}'


class StandardStreams(CommandLineTest):
    def pipe(self, code, text, *arguments):
        done = self.piped(*arguments, input=text, preexec_fn=default_signals, text=True, timeout=PATIENCE)
        self.output, self.errors = done.stdout, done.stderr
        self.assertEqual(done.returncode, code, done.stderr)

    def test_a_scene_is_read_from_standard_input(self):
        self.pipe(0, SCENE, "render", "-", "-o", "a.png", "--stats", "s.json")
        stats = json.loads(self.read("s.json"))
        self.assertEqual((stats["scene"], stats["width"], stats["spp"]), ("standard input", 4, 2))
        self.pipe(3, '{"speres": []}', "render", "-", "-o", "a.png")
        self.assertIn("pt: standard input:1: ", self.errors)
        self.pipe(3, "", "render", "-", "-o", "a.png")
        self.assertIn("pt: standard input:1:1: syntax error", self.errors)
        self.assertEqual(self.files(), ["a.png", "s.json"])

    def test_a_closed_standard_input_is_told(self):
        done = subprocess.run(["sh", "-c", '"$0" render - -o a.png <&-', self.program], cwd=self.folder,
                              capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stderr),
                         (6, "pt: cannot read standard input: Bad file descriptor\n"))

    def test_reports_have_standard_output_to_themselves(self):
        for arguments, line in ((("render", COURSEWORK, "-o", "a.png", "--spp", "2", "--stats", "-"), "wrote a.png: "),
                                (("selftest", "--json", "-"), "device  fake device")):
            with self.subTest(command=arguments[0]):
                self.run_pt(*arguments)
                self.assertEqual(json.loads(self.output)["device"]["name"], "fake device")
                self.assertIn(line, self.errors)
                self.assertTrue(all(text.startswith("pt: ") for text in self.errors.splitlines()), self.errors)
        self.expect(0, "render", COURSEWORK, "-o", "a.png", "--spp", "2", "--stats", "-", "-q")
        self.assertEqual(self.errors, "")
        self.assertEqual(self.files(), ["a.png"])

    def test_a_full_standard_output_is_told(self):
        render = ("render", COURSEWORK, "--spp", "1", "-o")
        for arguments in ("devices",), (*render, "a.png", "--stats", "-"), (*render, "-", "--format", "png"):
            with open("/dev/full", "w", encoding="utf-8") as full:
                done = self.piped(*arguments, stdout=full, text=True)
            self.assertEqual(done.returncode, 6, done.stderr)
            self.assertIn("pt: cannot write to standard output\n", done.stderr)
        done = subprocess.run(["sh", "-c", '"$@" >&-', "sh", self.program, *render, "b.png", "--checkpoint", "c.ptfilm"],
                              cwd=self.folder, capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr), (6, "pt: cannot write to standard output\n"))
        self.assertLessEqual({"b.png", "c.ptfilm"}, set(self.files()))


class SameFiles(CommandLineTest):
    def refuse(self, error, *arguments, command="render"):
        before = {name: self.contents(name) for name in self.files()}
        self.expect(2, command, *arguments, FAKE_PT_FAIL=f"create:{RESULT['NO_DEVICE']}")
        self.assertEqual(self.errors, f"pt: {error}\n")
        self.assertEqual({name: self.contents(name) for name in self.files()}, before)

    def contents(self, name):
        return self.read(name) if os.path.isfile(self.path(name)) else None

    def setUp(self):
        super().setUp()
        self.write("s.png", SCENE)
        os.mkdir(self.path("folder"))

    def test_the_scene_is_kept(self):
        os.symlink("s.png", self.path("soft.png"))
        os.link(self.path("s.png"), self.path("hard.png"))
        os.symlink("..", self.path("folder/up"))
        for name in ("s.png", "./s.png", "folder/../s.png", "folder/up/s.png", self.path("s.png"), "soft.png",
                     "hard.png"):
            with self.subTest(name=name):
                self.refuse(f"-o {name}: is the same file as the scene s.png", "s.png", "-o", name)
                self.refuse(f"--stats {name}: is the same file as the scene soft.png", "soft.png", "-o", "a.png",
                            "--stats", name)
        self.refuse("-o s.png: is the same file as the scene s.png", "s.png", "--watch", "-o", "s.png")
        with open(self.path("s.png"), encoding="utf-8") as scene:
            done = self.piped("render", "-", "-o", "s.png", "--spp", "1", stdin=scene, text=True)
        self.assertEqual((done.returncode, done.stderr), (2, "pt: -o s.png: is the same file as the scene -\n"))
        self.assertEqual(self.read("s.png"), SCENE)

    def test_no_output_is_written_twice(self):
        os.symlink("to-be.exr", self.path("dangling.exr"))
        for first, second in (("a.exr", "a.exr"), ("a.exr", "folder/../a.exr"), ("to-be.exr", "dangling.exr"),
                              ("dangling.exr", "to-be.exr")):
            with self.subTest(first=first, second=second):
                for option in ("-o", "--film", "--stats"):
                    self.refuse(f"{option} {second}: is the same file as -o {first}", "s.png", "-o", first, option,
                                second)
                self.refuse(f"--stats {second}: is the same file as --film {first}", "s.png", "-o", "a.jpg",
                            "--film", first, "--stats", second)

    def test_shaders_are_kept(self):
        os.mkdir(self.path("shaders"))
        self.write("shaders/pathtrace.comp", '#include "folder/part.glsl"\n')
        os.mkdir(self.path("shaders/folder"))
        self.write("shaders/folder/part.glsl", "\n")
        os.link(self.path("shaders/folder/part.glsl"), self.path("hard.json"))
        arguments = ("s.png", "--shader-dir", "shaders", "-o")
        for watch in ((), ("--watch",)):
            self.refuse("--stats hard.json: is the same file as the shader shaders/folder/part.glsl", *arguments,
                        "a.png", "--stats", "hard.json", *watch)
            self.refuse("--stats shaders/pathtrace.comp: is the same file as the shader shaders/pathtrace.comp",
                        *arguments, "a.png", "--stats", "shaders/pathtrace.comp", *watch)
            self.refuse("-o ./shaders/a.png: must not be in the folder shaders of --shader-dir, whose files are inputs",
                        *arguments, "./shaders/a.png", *watch)
        self.expect(0, "render", *arguments, "shaders/folder/a.png")

    def test_distinct_files_are_distinct(self):
        os.mkdir(self.path("a"))
        self.expect(0, "render", "s.png", "-o", "a.png", "-o", "a/a.png", "-o", "A.png", "-o", "a.exr", "--stats",
                    "a.json")
        with open("/dev/null", encoding="utf-8") as null:
            done = self.piped("render", "-", "-o", "-", "--format", "png", stdin=null, text=True)
        self.assertEqual((done.returncode, done.stderr[:25]), (3, "pt: standard input:1:1: s"))

    def test_a_link_leads_to_the_file_that_it_makes(self):
        os.symlink("folder/new.png", self.path("link.png"))
        self.expect(0, "render", "s.png", "-o", "link.png")
        self.assertTrue(os.path.islink(self.path("link.png")))
        self.assertEqual(os.listdir(self.path("folder")), ["new.png"])
        os.symlink("loop.png", self.path("loop.png"))
        self.expect(6, "render", "s.png", "-o", "loop.png", error="cannot write loop.png: Too many levels")
