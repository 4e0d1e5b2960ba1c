import json
import resource
import signal

from command_line import COURSEWORK, PT, PATIENCE, CommandLineTest, default_signals, read_png

SIZE = ("--size", "40x33")


class Pieces(CommandLineTest):
    def pixels(self, *options, **environment):
        self.expect(0, "render", COURSEWORK, *SIZE, "--spp", "2", "-o", "a.png", *options, **environment)
        return read_png(self.path("a.png"))

    def test_rows_are_in_their_places(self):
        whole = self.pixels()
        self.assertEqual(self.errors, "")
        for rows, count in ((1, 33), (10, 4), (32, 2)):
            with self.subTest(rows=rows):
                self.assertEqual(self.pixels("--piece-rows", str(rows)), whole)
                self.assertIn(f"{count} pieces of up to {rows} rows: 4.0 KiB on the device, 15.5 KiB for the image",
                              self.errors)
        self.assertEqual(self.pixels("--piece-rows", "34"), whole)
        self.assertEqual(self.errors, "")

    def test_a_device_that_is_too_small_gets_pieces(self):
        whole = self.pixels()
        self.assertEqual(self.pixels(FAKE_PT_MAX_ROWS=9), whole)
        self.assertIn("4 pieces of up to 9 rows: ", self.errors)  # halved from 33 rows to 17 and 9
        self.expect(2, "render", COURSEWORK, *SIZE, "-o", "a.png", FAKE_PT_MAX_ROWS=0,
                    error="pt: --size: width * rows = 40 * 33: more than the device has\n")

    def test_statistics_are_those_of_all_pieces(self):
        self.pixels("--stats", "s.json", "--piece-rows", "10", FAKE_PT_FAIL="rejected:1")
        stats = json.loads(self.read("s.json"))
        self.assertEqual((stats["height"], stats["spp"], stats["rejected_samples"]), (33, 2, 4 * 3))

    def test_what_is_left_of_an_interruption_is_black(self):
        submission = 4 * 4 + 6  # in the second piece; a piece has four samples of four submissions each
        code = self.run_pt("render", COURSEWORK, *SIZE, "--spp", "4", "--progress", "json", "-o", "a.png",
                           "--piece-rows", "11", FAKE_PT_SAMPLE_MS=120,
                           FAKE_PT_SIGNAL=f"{int(signal.SIGINT)}:{submission}")
        self.assertEqual(code, 130)
        shares = [json.loads(line)["fraction"] for line in self.errors.splitlines() if line.startswith("{")]
        self.assertGreaterEqual(len(shares), 22 // 4)  # a submission takes 30 ms or more, and lines are 100 ms apart
        self.assertEqual(shares, sorted(shares))
        self.assertIn("stopped by SIGINT after 1 of 4 samples per pixel in 22 of 33 rows; the others are black",
                      self.errors)
        width, height, *_ = read_png(self.path("a.png"))
        self.assertEqual((width, height), (40, 33))


class Steps(CommandLineTest):
    def test_all_samples_are_not_one_call(self):
        def picture(count, **environment):
            self.expect(0, "render", COURSEWORK, *SIZE, "--spp", count, "--exposure", "-4", "-o", "a.png",
                        "--stats", "s.json", **environment)
            self.assertEqual(json.loads(self.read("s.json"))["spp"], int(count))
            return read_png(self.path("a.png"))

        split = {"FAKE_PT_FAIL": "split:1"}
        self.assertEqual(picture("16", **split), picture("1", **split))
        self.assertNotEqual(picture("17", **split), picture("16", **split))
        self.assertEqual(picture("17"), picture("16"))


class HostMemory(CommandLineTest):
    def run_in_little_memory(self, *arguments):
        def little_memory():
            default_signals()
            resource.setrlimit(resource.RLIMIT_AS, (2 << 30, 2 << 30))

        return self.piped(*arguments, preexec_fn=little_memory, text=True, timeout=PATIENCE)

    def refusal(self, code, *arguments):
        done = self.run_in_little_memory(*arguments)
        self.assertEqual(done.returncode, code, done.stderr)
        return done.stderr

    def test_an_image_that_is_too_large_is_refused_before_it_is_rendered(self):
        if self.run_in_little_memory("--version").returncode != 0:
            self.skipTest("sanitizers need terabytes of addresses")
        large = ("--size", "16384x16384", "--spp", "1")
        self.assertEqual(self.refusal(2, "render", COURSEWORK, "-o", "a.exr", *large),
                         "pt: --size 16384x16384: the image takes 3.0 GiB of memory, more than the 2.0 GiB that this "
                         "process can have\n")
        self.assertIn("--size 16384x8192: 2 images take 3.0 GiB",
                      self.refusal(2, "render", COURSEWORK, "-o", "a.exr", "--layers", "standard-error",
                                   "--size", "16384x8192", "--spp", "1"))
        self.write("s.json", '{"film": {"width": 16384, "height": 16384}}')
        self.assertIn("s.json: film of 16384x16384: the image takes 3.0 GiB",
                      self.refusal(3, "render", "s.json", "-o", "a.exr", "--spp", "1"))
        self.assertEqual(self.files(), ["s.json"])


class RealDevice(CommandLineTest):
    program = PT

    def pixels(self, *options, samples=17):
        self.expect(0, "render", COURSEWORK, *SIZE, "--spp", str(samples), "-q", "-o", "a.png", *options)
        return read_png(self.path("a.png"))

    def test_neither_pieces_nor_devices_change_a_bit(self):
        whole = self.pixels()
        for option in ("--piece-rows", "10"), ("--device", "all"):
            self.assertEqual(self.pixels(*option), whole)
        self.assertNotEqual(self.pixels(samples=16), whole)

    def test_errors_of_pieces_are_joined(self):
        def stats(*options):
            self.pixels("--stats", "s.json", *options)
            return json.loads(self.read("s.json"))

        whole, pieces = stats(), stats("--piece-rows", "8")
        self.assertLess(pieces["device_bytes"], whole["device_bytes"])
        # A piece has fewer pixels than the picture, so its error has a larger margin.
        for key in ("rmse", "relative_rmse"):
            self.assertAlmostEqual(pieces[key], whole[key], delta=0.25 * whole[key])
