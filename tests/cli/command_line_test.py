import glob
import json
import os
import resource
import signal
import struct

from command_line import (COURSEWORK, PT, RESULT, CommandLineTest, default_signals, read_exr_attributes, read_png)


class Usage(CommandLineTest):
    def test_wrong_values(self):
        self.expect_refusals("render", [(2, (COURSEWORK, "-o", "a.jpg", option, value), error) for option, value, error in (
                ("--size", "12", "--size"), ("--size", "1e9x1", "--size"), ("--size", "-1x5", "--size"), ("--size", "", "--size"),
                ("--spp", "many", "--spp"), ("--sampler", "sobl", "--sampler"), ("--exposure", "nan", "--exposure"),
                ("--exposure", "Auto", "--exposure"), ("--progress", "loud", "--progress"), ("--gamma", "-3", ", is -3 (see"),
                ("--gamma", "0.05", ", is 0.05 (see"), ("--spp", "-3", ", is -3 (see"), ("--exposure", "100", ", is 100 (see"),
                ("--size", "65501x1", "65500"), ("--sampling", "adaptive", "pt: --sampling adaptive: needs --error"))])

    def test_misspelt_names_get_a_suggestion(self):
        render = ["render", COURSEWORK, "-o", "a.png"]
        for arguments, error in ((["scene"], 'command "scene", known: render, tonemap, compare, merge, denoise, '
                                             'selftest, course, schema, devices'),
                                 (["a.json"], 'unknown command "a.json", did you mean "pt render a.json"? (see pt --help)'),
                                 (["a.ptfilm"], 'did you mean "pt merge a.ptfilm"?'),
                                 (["a.exr"], 'did you mean "pt tonemap a.exr"?'),
                                 (["render", COURSEWORK, "--outptu", "a.png"],
                                  'unknown option "--outptu", did you mean "--output"? (see pt render --help)'),
                                 ([*render, "--expsure=-3"], 'unknown option "--expsure",'),
                                 (["selftest", "--devcie", "0"], 'mean "--device"? (see pt selftest --help)'),
                                 (["render", "a.json", "-o"], "pt: --output: its IMAGE is missing (see"),
                                 ([*render, "--spp", "4", "--spp", "5"], "pt: --spp: is given 2 times, must be given once (see"),
                                 (["--quiet", *render], "pt: --quiet: must come after the command"),
                                 ([*render, "-Z"], 'unknown option "-Z" (see'),
                                 (["render", "b.json", *render[1:]], 'unexpected argument "')):
            with self.subTest(arguments=arguments):
                self.expect(2, *arguments, error=error)
        self.assertEqual(self.files(), [])


class Start(CommandLineTest):
    def test_image_libraries_are_loaded_for_other_formats_than_png(self):
        def loads_the_module(name):
            self.expect(0, "render", COURSEWORK, "-o", name, "--spp", "1", "--size", "2x2", LD_DEBUG="files",
                        LD_DEBUG_OUTPUT=self.path("loaded"))
            log, = glob.glob(self.path("loaded.*"))
            with open(log, encoding="utf-8", errors="replace") as file:
                found = "libpt-image-file.so" in file.read()
            os.remove(log)
            return found

        self.assertFalse(loads_the_module("a.png"))
        self.assertTrue(loads_the_module("a.exr"))


class SceneErrors(CommandLineTest):
    def test_of_a_megabyte_the_ends_are_told(self):
        for text, error in (('{"film": {"width": ' + "1" * 1000000 + "}}", "1 is too large"),
                            ('{"' + "ü" * 500000 + '": 1}', 'unknown key "ü'),
                            ('{"film": ' + "x" * 1000000, "s.json:1:10: syntax error")):
            self.write("s.json", text)
            self.expect(3, "render", "s.json", "-o", "a.png", error=error)
            self.assertLess(len(self.errors), 2100)


class Devices(CommandLineTest):
    def test_they_are_listed(self):
        self.expect(0, "devices")
        self.assertIn("fake device", self.output)
        self.expect(0, "devices", "--json")
        device, = json.loads(self.output)
        self.assertEqual((device["index"], device["kind"], device["suitable"]), (0, "CPU", True))
        self.assertEqual(device["uuid"], "00112233-4455-6677-8899-aabbccddeeff")
        self.assertEqual(self.run_pt("devices", FAKE_PT_FAIL="suitable:-1"), 4)
        self.assertIn("no: it is not real", self.output)


class Outputs(CommandLineTest):
    def test_all_formats(self):
        self.expect(0, "render", COURSEWORK, "-o", "a.exr", "-o", "b.png", "--output", "c.jpg", "--size", "4x3",
                    "--spp", "5", "--seed", "18446744073709551615", "--stats", "s.json")
        self.assertEqual(self.files(), ["a.exr", "b.png", "c.jpg", "s.json"])
        self.assertEqual(self.errors, "")
        self.assertRegex(self.output, r"^wrote a.exr, b.png, c.jpg: 4x3, 5 spp in [\d.]+ s on fake device\n"
                                     r"exposure -?[\d.]+ EV \(auto\)\n"
                                     r"error unknown with fewer than 16 samples\n$")

        attributes = read_exr_attributes(self.path("a.exr"))
        self.assertFalse({"pt.toneMap", "pt.exposure", "pt.encoding", "pt.relativeError"} & set(attributes))
        self.assertEqual(attributes["samplesPerPixel"], ("int", struct.pack("<i", 5)))
        self.assertEqual(attributes["pt.seed"], ("string", b"18446744073709551615"))
        self.assertTrue(attributes["software"][1].startswith(b"pt "))
        channels = attributes["channels"][1]
        self.assertEqual([channels.index(name + b"\0\2\0\0\0") for name in (b"B", b"G", b"R")], [0, 18, 36])

        stats = json.loads(self.read("s.json"))
        self.assertEqual((stats["width"], stats["height"], stats["spp"], stats["seed"]), (4, 3, 5, 2**64 - 1))
        self.assertEqual(stats["features"], ["lamps", "motion"])
        self.assertEqual(sorted(stats["seconds"]), ["accumulate", "create", "device", "total"])

    def test_tone_mapping_reaches_the_pixels(self):
        # The fake library's picture: red is 0, 0.5 and 1 from left to right, green is 0 to 1 from top to bottom, and blue is 2.
        def pixels(*options):
            exposure = [] if "--exposure" in options else ["--exposure", "0"]
            self.expect(0, "render", COURSEWORK, "-o", "a.png", "--size", "3x2", "--spp", "1", *exposure, *options)
            return read_png(self.path("a.png"))

        self.assertEqual(pixels(), (3, 2, [[0, 0, 255, 188, 0, 255, 255, 0, 255],
                                           [0, 255, 255, 188, 255, 255, 255, 255, 255]]))
        self.assertEqual(pixels("--gamma", "1")[2][0], [0, 0, 255, 128, 0, 255, 255, 0, 255])
        self.assertEqual(pixels("--gamma", "1", "--exposure", "-2")[2][0], [0, 0, 128, 32, 0, 128, 64, 0, 128])
        self.assertNotEqual(pixels("--gamma", "1", "--exposure", "-2", "--white", "1,1,2")[2][0],
                            [0, 0, 128, 32, 0, 128, 64, 0, 128])
        # (0, 0, 2) has the luminance 0.1444, so blue is 2 / 1.1444, which is clipped. (0.5, 0, 2) has 0.2507, so red is 0.5 / 1.2507.
        self.assertEqual(pixels("--gamma", "1", "--tonemap", "reinhard")[2][0][:6], [0, 0, 255, 102, 0, 255])

    def test_the_exposure_that_is_shown_gives_the_same_picture(self):
        arguments = ["render", COURSEWORK, "-o", "a.png", "--size", "3x2", "--spp", "1", "--stats", "s.json", "--gamma", "2"]
        self.expect(0, *arguments)
        automatic, picture = json.loads(self.read("s.json"))["tone_map"], read_png(self.path("a.png"))
        self.assertEqual([automatic[key] for key in ("curve", "automatic_exposure", "gamma")], ["none", True, 2])
        shown = f"{automatic['exposure']:.2f}"
        self.assertIn(f"\nexposure {shown} EV (auto)\n", self.output)
        self.expect(0, *arguments, "--exposure", shown)
        self.assertNotIn("exposure", self.output)
        self.assertEqual(json.loads(self.read("s.json"))["tone_map"], {**automatic, "automatic_exposure": False})
        self.assertEqual(read_png(self.path("a.png")), picture)
        self.expect(0, *arguments, "--exposure", "0")
        self.assertNotEqual(read_png(self.path("a.png")), picture)
        self.expect(0, "render", COURSEWORK, "-o", "a.exr", "--spp", "1", "--stats", "s.json")
        self.assertIsNone(json.loads(self.read("s.json"))["tone_map"])

    def test_files_that_cannot_be_written_are_found_before_rendering(self):
        os.mkdir(self.path("folder.png"))
        os.mkfifo(self.path("pipe.png"))
        for name in ("folder.png", "pipe.png", "/proc/a.png"):
            with self.subTest(name=name):
                for arguments in (["-o", name], *(["-o", "good.exr", option, name] for option in ("-o", "--stats", "--film"))):
                    self.expect(6, "render", COURSEWORK, *arguments, error="cannot write " + name,
                                FAKE_PT_FAIL=f"accumulate:{RESULT['INTERNAL']}")
        self.assertEqual(self.files(), ["folder.png", "pipe.png"])

    def test_a_failed_write_leaves_the_old_file_and_the_others_are_written(self):
        self.write("big.exr", "old")

        def full_disk():
            default_signals()
            signal.signal(signal.SIGXFSZ, signal.SIG_DFL)
            resource.setrlimit(resource.RLIMIT_FSIZE, (7500, 7500))

        done = self.piped("render", COURSEWORK, "-o", "big.exr", "-o", "small.png", "--spp", "1", preexec_fn=full_disk, text=True)
        self.assertEqual(done.returncode, 6, done.stderr)
        self.assertIn("pt: cannot write big.exr: File too large", done.stderr)
        self.assertEqual(self.read("big.exr"), "old")
        self.assertEqual(read_png(self.path("small.png"))[:2], (256, 128))
        self.assertEqual(self.files(), ["big.exr", "small.png"])

    def test_names_that_are_not_utf_8_cost_no_figures(self):
        scene = b"sc\xe8ne.json"  # Latin-1
        with open(os.path.join(os.fsencode(self.folder), scene), "w", encoding="utf-8") as file:
            file.write("{}")
        bad_device = {"FAKE_PT_FAIL": "name:1"}
        self.expect(0, "render", scene, "-o", "a.png", "--spp", "3", "--size", "2x2", "--stats", "s.json", **bad_device)
        stats = json.loads(self.read("s.json"))
        self.assertEqual((stats["scene"], stats["device"]["name"], stats["spp"]), ("sc\ufffdne.json", "d\ufffdvice", 3))

        self.run_pt("selftest", "--json", "t.json", **bad_device)
        self.assertEqual(json.loads(self.read("t.json"))["device"]["name"], "d\ufffdvice")
        self.expect(0, "devices", "--json", **bad_device)
        self.assertEqual(json.loads(self.output)[0]["name"], "d\ufffdvice")


class RealDevice(CommandLineTest):
    program = PT

    def test_the_librarys_rules(self):
        self.expect(2, "render", COURSEWORK, "-o", "a.png", "--size", "0x0",
                    error="pt: --size: width: must be a whole number from 1 to 4294967295, is 0\n")
        self.expect(2, "render", COURSEWORK, "-o", "a.png", "--submit-ms", "1001",
                    error="pt: --submit-ms = 1001: must be <= 1000\n")
        self.expect(4, "render", COURSEWORK, "-o", "a.png", "--device", "no such device", error="no device fits")
        self.expect(2, "render", COURSEWORK, "-o", "a.png", "--set", "spheres[0].radius=-1",
                    error="pt: --set spheres[0].radius=-1: spheres[0].radius = -1: must be > 0\n")
        self.write("s.json", '{"materials": {"gold": {"glossiness": -1}},\n'
                             ' "spheres": [\n{"center": [0, 0, 0], "radius": -1, "material": "gold"}]}')
        self.expect(3, "render", "s.json", "-o", "a.png", error="pt: s.json:3: spheres[0].radius = -1: must be > 0\n")
        self.assertIn("pt: s.json:1: materials.gold.glossiness = -1: must be >= 0\n", self.errors)
        self.expect(2, "render", "s.json", "-o", "a.png", "--set", "spheres[0].radius=-2",
                    error="glossiness = -1: must be >= 0\npt: --set spheres[0].radius=-2: spheres[0].radius = -2: must be > 0\n")
        self.write("s.json", '{"camera": {"position": [1, 1, 1], "look_at": [1, 1, 1]}}')
        self.expect(3, "render", "s.json", "-o", "a.png", error="s.json:1: camera.look_at")
        self.assertEqual(self.files(), ["s.json"])


class Warnings(CommandLineTest):
    def warnings(self, *options, scene="s.json", **environment):
        """Returns the warnings. With --stats, stderr has each warning once. With -q stderr is empty."""
        arguments = ["render", scene, "-o", "a.png", "--size", "8x4", "--stats", "stats.json", *options]
        self.expect(0, *arguments, **environment)
        told = json.loads(self.read("stats.json"))["warnings"]
        self.assertEqual(self.errors, "".join(f"pt: warning: {warning}\n" for warning in told))
        self.expect(0, *arguments, "-q", **environment)
        self.assertEqual((self.errors, self.output), ("", ""))
        self.assertEqual(json.loads(self.read("stats.json"))["warnings"], told)
        return told

    def test_each(self):
        self.write("s.json", "{}")
        self.assertEqual(self.warnings(), ["s.json: no surface emits light: the picture is black"])
        self.assertEqual(self.warnings(scene=COURSEWORK), [])
        self.assertEqual(self.warnings("--error", "2", "--spp", "16", scene=COURSEWORK, FAKE_PT_FAIL="rejected:-1"),
                         ["--error: the target is 200%; two percent are written 2% or 0.02",
                          "3 samples (0.586%) were left out: not finite, negative or too bright"])
