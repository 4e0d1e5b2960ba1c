import os

from command_line import PT, CommandLineTest


class OtherProgram(CommandLineTest):
    program = PT

    def setUp(self):
        super().setUp()
        for folder in "first", "second", "empty":
            os.mkdir(self.path(folder))

    def path(self, *parts):
        return os.path.join(self.folder, *parts)

    def put(self, folder, name, text='#!/bin/sh\necho "$0" "$@"\nexit 42\n', mode=0o755):
        path = self.path(folder, name)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        os.chmod(path, mode)
        return path

    def run_with(self, path, *arguments):
        environment = {**os.environ, "PATH": path}
        if path is None:
            del environment["PATH"]
        return self.piped(*arguments, env=environment, text=True)

    def test_its_arguments_streams_and_exit_code_are_its_own(self):
        program = self.put("first", "pt-hello")
        run = self.run_with(self.path("empty") + ":" + self.path("first"), "hello", "--help", "a b", "")
        self.assertEqual((run.returncode, run.stdout, run.stderr), (42, f"{program} --help a b \n", ""))

    def test_the_first_folder_that_has_it_counts(self):
        self.put("first", "pt-hello", mode=0o644)
        os.mkdir(self.path("empty", "pt-hello"))
        program = self.put("second", "pt-hello")
        folders = [self.path(each) for each in ("missing", "first", "empty", "second")]
        self.assertEqual(self.run_with(":".join(folders), "hello").stdout, program + "\n")

    def test_nothing_of_the_current_folder_runs(self):
        self.put("first", "pt-hello")
        self.put("", "pt-hello")
        for path in "", ":", ".", "first", "./first", "::first:", self.path("empty") + ":", None:
            with self.subTest(path=path):
                run = self.run_with(path, "hello")
                self.assertEqual((run.returncode, run.stdout), (2, ""))
                self.assertIn('pt: unknown command "hello", known: render', run.stderr)

    def test_own_commands_come_first(self):
        self.put("first", "pt-devices")
        self.put("first", "pt-schema")
        self.assertEqual(self.run_with(self.path("first"), "schema").returncode, 0)

    def test_a_path_or_an_option_is_no_name(self):
        self.put("first", "pt-..")
        os.mkdir(self.path("first", "pt-a"))
        self.put(os.path.join("first", "pt-a"), "b")
        for name in "..", "a/b", "--hello", "scene.json":
            with self.subTest(name=name):
                run = self.run_with(self.path("first"), name)
                self.assertEqual((run.returncode, run.stdout), (2, ""), run.stderr)

    def test_what_is_missing_says_how_to_install_it(self):
        for name, package in (("figure", "'./lib/python[figure]'"), ("farm", "'./lib/python[farm]'"), ("view", "'./lib/python[figure,view]'"),
                              ("tachyon", "./lib/python")):
            run = self.run_with(self.path("empty"), name, "data.xyz")
            self.assertEqual(run.returncode, 2)
            self.assertEqual(run.stderr, f"pt: there is no pt-{name} in the PATH; it comes with the Python package: "
                                         f"pip install {package}\n")

    def test_one_that_does_not_start_is_a_file_that_cannot_be_read(self):
        program = self.put("first", "pt-hello", "#!/nowhere/interpreter\n")
        run = self.run_with(self.path("first"), "hello")
        self.assertEqual((run.returncode, run.stderr),
                         (6, f"pt: {program}: cannot be run: No such file or directory\n"))
