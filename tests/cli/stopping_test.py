import json
import os
import signal
import subprocess

from command_line import COURSEWORK, PATIENCE, PT, CommandLineTest, read_png

ENDLESS = ("--spp", "1000000", "--time", "0.05")
SLOW = {"FAKE_PT_SAMPLE_MS": 5}


class ExitCodes(CommandLineTest):
    def test_every_combination(self):
        kept = ("--checkpoint", "c.ptfilm")
        not_kept = ("--checkpoint", "none/c.ptfilm")
        table = [
            # Rows: options, exit code, reason for the end.
            (("--spp", "20"), 0, "samples"),
            (("--spp", "20", *kept), 0, "samples"),
            (("--spp", "20", *not_kept), 0, "samples"),
            (("--spp", "20", "--time", "1e6", *kept), 0, "samples"),
            (("--error", "0.1"), 0, "error"),
            (("--error", "0.1", *kept), 0, "error"),
            (("--spp", "20", "--error", "0.001"), 7, "samples"),
            (("--spp", "20", "--error", "0.001", "--time", "1e6", *kept), 7, "samples"),
            (ENDLESS, 0, "time"),
            ((*ENDLESS, *kept), 75, "time"),
            ((*ENDLESS, *not_kept), 0, "time"),
            ((*ENDLESS, "--error", "1e-9"), 7, "time"),
            ((*ENDLESS, "--error", "1e-9", *kept), 75, "time"),
            ((*ENDLESS, "--error", "1e-9", *not_kept), 7, "time"),
        ]
        for options, code, ended_by in table:
            with self.subTest(options=options):
                environment = SLOW if ended_by == "time" else {}
                found = self.run_pt("render", COURSEWORK, "-o", "a.png", "--size", "2x2", "--stats", "s.json", *options,
                                    **environment)
                self.assertEqual(found, code, self.errors)
                self.assertEqual(json.loads(self.read("s.json"))["ended_by"], ended_by)
                self.assertEqual(os.path.exists(self.path("c.ptfilm")), "c.ptfilm" in options)
                self.assertEqual(self.errors.count("no checkpoint: "), options.count("none/c.ptfilm"), self.errors)
                for name in self.files():
                    os.remove(self.path(name))

    def test_a_signal_that_comes_twice_at_once_is_one(self):
        process = self.start("render", COURSEWORK, "-o", "a.png", "--spp", "1000000", "--size", "2x2", "--progress",
                             "json", "--checkpoint", "c.ptfilm", FAKE_PT_SAMPLE_MS=200)
        while json.loads(process.stderr.readline())["samples_per_pixel"] == 0:
            pass
        for _ in range(3):
            process.send_signal(signal.SIGTERM)
        self.assertIn("; --resume continues from c.ptfilm\n", process.communicate(timeout=PATIENCE)[1])
        self.assertEqual(process.returncode, 143)
        self.assertEqual(self.files(), ["a.png", "c.ptfilm"])

    def test_another_signal_later_ends_it_at_once(self):
        """A sample takes an hour. The program suspends itself during the first one, so both signals come within it."""
        process = self.start("render", COURSEWORK, "-o", "a.png", "--spp", "2", "--size", "2x2",
                             FAKE_PT_SAMPLE_MS=3_600_000, FAKE_PT_SIGNAL=f"{int(signal.SIGSTOP)}:1")
        state = os.waitid(os.P_PID, process.pid, os.WSTOPPED | os.WEXITED | os.WNOWAIT)
        self.assertEqual((state.si_code, state.si_status), (os.CLD_STOPPED, signal.SIGSTOP))
        process.send_signal(signal.SIGCONT)
        for _ in range(PATIENCE):
            process.send_signal(signal.SIGINT)
            try:
                process.wait(timeout=1)
                break
            except subprocess.TimeoutExpired:
                pass
        self.assertEqual(process.returncode, -signal.SIGINT)

    def test_what_does_not_go_together(self):
        render = (COURSEWORK, "-o", "a.png", "--size", "4x4")
        self.expect_refusals("render", [(2, (*render, *options), error) for options, error in (
                (("--resume",), "--resume: needs --checkpoint"),
                (("--checkpoint-every", "5"), "--checkpoint-every: needs --checkpoint"),
                (("--watch", "--checkpoint", "c"), "--checkpoint: cannot be used with --watch"),
                (("--watch", "--film", "c"), "--film: cannot be used with --watch"),
                (("--checkpoint", "-"), "--checkpoint -: "), (("--film", "-"), "--film -: "),
                (("--checkpoint", "a.png"), "is the same file as"), (("--film", COURSEWORK), "is the same file as"),
                (("--piece-rows", "1", "--film", "f"), "--film: needs the whole image on the device"),
                (("--piece-rows", "1", "--checkpoint", "f"), "--checkpoint: needs the whole image on the device"),
                (("--time", "0"), "--time"), (("--time", "nan"), "--time"), (("--time", "-1"), "--time"))])

    def test_every_piece_has_its_share_of_the_time(self):
        self.expect(0, "render", COURSEWORK, "-o", "a.png", "--size", "2x4", "--piece-rows", "1", "--time", "0.4",
                    "--stats", "s.json", "--spp", "1000000", FAKE_PT_SAMPLE_MS=1)
        self.assertGreater(json.loads(self.read("s.json"))["spp"], 0)
        self.assertEqual(self.errors.count("black"), 0)


class Previews(CommandLineTest):
    def test_pictures_so_far_are_written_and_it_goes_on(self):
        for options in (), ("--preview-every", "0.05"):
            process = self.start("render", COURSEWORK, "-o", "a.png", "--spp", "1000000", "--size", "2x2", "--progress",
                                 "json", *options, FAKE_PT_SAMPLE_MS=20)
            self.assertIn('"fraction"', process.stderr.readline())
            for _ in range(2):
                if not options:
                    self.assertEqual(self.files(), [])
                    process.send_signal(signal.SIGUSR1)
                while not os.path.exists(self.path("a.png")):
                    self.assertIn('"fraction"', process.stderr.readline())
                self.assertEqual(read_png(self.path("a.png"))[:2], (2, 2))
                os.remove(self.path("a.png"))
            process.send_signal(signal.SIGINT)
            process.communicate(timeout=PATIENCE)
            self.assertEqual(process.returncode, 130)
            os.remove(self.path("a.png"))


class RealDevice(CommandLineTest):
    program = PT

    def test_pictures_on_the_way_change_nothing(self):
        options = ("--size", "32x16", "--spp", "400", "-q")
        self.expect(0, "render", COURSEWORK, "-o", "a.png", *options)
        self.expect(0, "render", COURSEWORK, "-o", "b.png", *options, "--preview-every", "0.01", "--checkpoint",
                    "c.ptfilm", "--checkpoint-every", "0.01")
        self.expect(0, "render", COURSEWORK, "-o", "p.png", *options, "--preview-every", "0.01", "--piece-rows", "5")
        self.assertEqual(self.contents("a.png"), self.contents("b.png"))
        self.assertEqual(read_png(self.path("a.png")), read_png(self.path("p.png")))
        self.assertEqual(self.files(), ["a.png", "b.png", "c.ptfilm", "p.png"])


KEYS = [name + end for name in ("rmse", "relative_rmse") for end in ("", "_low", "_high")]


class TargetError(CommandLineTest):
    """The fake library states a relative error of 0.5 / N, and bounds of half and twice this error. The absolute error
    is twice the relative error. Below 16 samples the error is unknown."""

    def render(self, *options, code=0):
        arguments = ["render", COURSEWORK, "-o", "a.png", "--size", "4x3", "--stats", "s.json"]
        self.assertEqual(self.run_pt(*arguments, *options), code, self.errors)
        return json.loads(self.read("s.json"))

    def test_wrong_values(self):
        for value in ("0", "0%", "-1", "-1%", "inf", "nan", "1e999", "%", "", "1 %", "few"):
            with self.subTest(value=value):
                self.expect(2, "render", COURSEWORK, "-o", "a.png", "--error", value, error="--error: must be")
                self.assertIn(f'is "{value}"', self.errors)
        self.assertEqual(self.files(), [])

    def test_reached(self):
        for target in ("2.5%", "0.025"):
            stats = self.render("--error", target, "--progress", "json")
            fractions = [json.loads(line)["fraction"] for line in self.errors.splitlines()]
            self.assertEqual((fractions[-1], fractions.count(1.0)), (1.0, 1))
            self.assertEqual((stats["spp"], stats["spp_requested"]), (40, 65536))
            self.assertEqual((stats["target_error"], stats["target_reached"]), (0.025, True))
            self.assertEqual([stats[key] for key in KEYS], [0.025, 0.0125, 0.05, 0.0125, 0.00625, 0.025])
            self.assertRegex(self.output, r"\nerror 1.25% \(0.625% to 2.5%\); target reached after 40 samples\n$")

    def test_not_reached(self):
        stats = self.render("--error", "2.5%", "--spp", "32", code=7)
        self.assertEqual((self.errors, self.files()), ("", ["a.png", "s.json"]))
        self.assertEqual((stats["spp"], stats["target_reached"]), (32, False))
        self.assertIn("; target not reached: 3.12% is above 2.5% after 32 samples, raise --spp\n", self.output)
        last = self.render("--error", "1e-9", "--first-sample", "4294967280", code=7)
        self.assertEqual(last["spp_requested"], 16)  # indices of samples have 32 bits
        self.render("--error", "2.5%", "--spp", "15", code=7)
        self.assertIn("target not reached: unknown error for 2.5% after 15 samples, raise --spp\n", self.output)

    def test_without_a_target(self):
        stats = self.render("--spp", "16")
        self.assertEqual((stats["spp"], stats["target_error"], stats["target_reached"]), (16, None, False))
        self.assertTrue(self.output.endswith("\nerror 3.12% (1.56% to 6.25%)\n"), self.output)
        self.assertEqual(self.render()["spp"], 64)
        stats = self.render("--spp", "15", "-q")
        self.assertEqual(self.output, "")
        self.assertEqual([stats[key] for key in KEYS], [None, 0.0, None] * 2)
