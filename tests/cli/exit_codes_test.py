import os
import re

from command_line import COURSEWORK, FAKE_PT, PT, RESULT, CommandLineTest

RENDER = ["render", COURSEWORK, "-o", "a.png", "--size", "4x2", "--spp", "4"]
ENDLESS = ["render", COURSEWORK, "-o", "a.png", "--size", "2x2", "--spp", "1000000", "--time", "0.05"]


def fails(name, result):
    return {"FAKE_PT_FAIL": f"{name}:{RESULT[result]}", "FAKE_PT_MESSAGE": "the reason"}


CASES = [
    *((code, RENDER, fails(function, result), "pt: the reason", []) for function, result, code in (
        ("create", "UNSUPPORTED", 4), ("create", "INVALID_ARGUMENT", 2), ("create", "OUT_OF_HOST_MEMORY", 1),
        ("create", "NO_DEVICE", 4), ("set_render", "OUT_OF_DEVICE_MEMORY", 4), ("set_render", "UNSUPPORTED", 4),
        ("accumulate", "SHADER", 4),
        ("accumulate", "INVALID_ARGUMENT", 2), ("accumulate", "INCOMPATIBLE", 2), ("accumulate", "INTERNAL", 1),
        ("accumulate", "DEVICE_LOST", 5), ("readback", "DEVICE_LOST", 5), ("stats", "INVALID_STATE", 1))),
    (1, RENDER, {"FAKE_PT_FAIL": "create:-99"}, "pt: out of memory\n", []),
    (0, RENDER, {}, "", ["a.png"]),
    (0, ["--version"], {}, "", []),
    (0, ["devices"], {}, "", []),
    (0, ["merge", "first.ptfilm", "second.ptfilm", "--film", "sum.ptfilm"], {}, "", ["sum.ptfilm"]),
    *((1, [*RENDER, "--validation"], {"FAKE_PT_LOG": function}, "pt: validation: a message of the layer", ["a.png"])
      for function in ("set_scene", "accumulate", "destroy")),
    (0, RENDER, {"FAKE_PT_LOG": "set_scene"}, "", ["a.png"]),
    (1, [*RENDER, "--validation"], {"FAKE_PT_LOG": "destroy", "FAKE_PT_SIGNAL": "2:5"}, "pt: stopped by SIGINT", ["a.png"]),
    *((code, ["selftest", "--json", "s.json"], fails(function, result), "pt: the reason", []) for function, result, code in (
        ("create", "NO_DEVICE", 4), ("accuracy", "SHADER", 4), ("accumulate", "DEVICE_LOST", 5), ("readback", "INTERNAL", 1))),
    (6, ["selftest", "--json", "none/s.json"], {}, "pt: cannot write none/s.json", []),
    (1, ["selftest"], {"FAKE_PT_FAIL": "accuracy_bound:1"}, "", []),
    (2, [], {}, "pt: a command is missing: render, tonemap, ", []),
    (2, ["rendr"], {}, 'pt: unknown command "rendr", did you mean "render"? (see pt --help)', []),
    (2, ["render"], {}, "pt: SCENE is required (see pt render --help)", []),
    (2, ["render", COURSEWORK], {}, "pt: -o or --film is missing: there is nothing to write", []),
    (2, [*RENDER, "--gamma", "0"], {}, 'pt: --gamma: must be a number from 0.1 to 10, is 0 (see pt render', []),
    (2, [*RENDER, "--skip-existing"], {}, "pt: --skip-existing requires --frames", []),
    (2, [*RENDER, "--first-sample", "4294967293"], {}, "pt: --first-sample 4294967293: 4 samples from there on would pass", []),
    (3, [*RENDER[:3], "a-#.png", "--frames", "1-2"], {}, f"pt: {COURSEWORK}: has no animation", []),
    (3, ["render", "broken.json", "-o", "a.png"], {}, "pt: broken.json:", []),
    (3, ["render", "empty.json", "-o", "a.png"], fails("set_scene", "INVALID_SCENE"), "pt: empty.json: the reason", []),
    (4, RENDER, fails("set_scene", "UNSUPPORTED"), f"pt: {COURSEWORK}: the reason", []),
    (4, ["devices"], {"FAKE_PT_FAIL": f"devices:{RESULT['NO_DEVICE']}"}, "pt: no Vulkan device", []),
    (5, RENDER, fails("set_camera", "DEVICE_LOST"), f"pt: {COURSEWORK}: the reason", []),
    (6, ["render", "none.json", "-o", "a.png"], {}, "pt: cannot read none.json: ", []),
    (6, ["render", COURSEWORK, "-o", "none/a.png"], {}, "pt: cannot write none/a.png: ", []),
    (6, ["tonemap", "none.exr", "a.png"], {}, "pt: cannot read none.exr: ", []),
    (6, ["merge", "none.ptfilm", "-o", "a.png"], {}, "pt: cannot read none.ptfilm: ", []),
    (7, [*RENDER, "--error", "1e-9"], {}, "", ["a.png"]),
    (7, ["merge", "first.ptfilm", "second.ptfilm", "--film", "sum.ptfilm", "--first-sample", "0", "--spp", "9"], {},
     "pt: ", ["sum.ptfilm"]),
    (8, ["compare", "dark.png", "bright.png", "--max-mse", "0"], {}, "pt: ", []),
    (9, ["compare", "first.ptfilm", "second.ptfilm", "--min-change", "1e-5"], {}, "pt: too few samples to tell", []),
    (75, [*ENDLESS, "--checkpoint", "c.ptfilm"], {"FAKE_PT_SAMPLE_MS": 5}, "", ["a.png", "c.ptfilm"]),
    (129, RENDER, {"FAKE_PT_SIGNAL": "1:5"}, "pt: stopped by SIGHUP after 1 of 4 samples", ["a.png"]),
    (130, RENDER, {"FAKE_PT_SIGNAL": "2:5"}, "pt: stopped by SIGINT after 1 of 4 samples", ["a.png"]),
    (143, RENDER, {"FAKE_PT_SIGNAL": "15:5"}, "pt: stopped by SIGTERM after 1 of 4 samples", ["a.png"]),
    (130, RENDER, {"FAKE_PT_SIGNAL": "2:3"}, "pt: stopped by SIGINT after 0 of 4 samples per pixel; nothing was written\n", []),
    (143, RENDER, {"FAKE_PT_FAIL": "set_camera:-10", "FAKE_PT_SCENE_SIGNAL": "15"},  # the signal precedes the failure
     "pt: stopped by SIGTERM after 0 of 4 samples per pixel; nothing was written\n", []),
]


class ExitCodes(CommandLineTest):
    def setUp(self):
        super().setUp()
        self.write("broken.json", "{")
        self.write("empty.json", "{}")
        self.program = PT
        small = ["--size", "4x2", "--spp", "4"]
        for name, first in ("first", "0"), ("second", "4"):
            self.expect(0, "render", COURSEWORK, *small, "--first-sample", first, "--film", f"{name}.ptfilm")
        for name, stops in ("dark", "-9"), ("bright", "0"):
            self.expect(0, "render", COURSEWORK, *small, "--exposure", stops, "-o", f"{name}.png")

    def test_every_row_of_the_table(self):
        self.program = PT
        self.expect(0, "--help")
        table = re.findall(r"^  (\d+) ", self.output.split("Exit codes:\n")[1], re.MULTILINE)
        self.assertEqual({case[0] for case in CASES}, set(map(int, table)))
        given = self.files()
        for code, arguments, environment, said, left in CASES:
            with self.subTest(code=code, arguments=arguments):
                for name in set(self.files()) - set(given):
                    os.remove(self.path(name))
                self.write("a.png", "old")
                self.program = PT if arguments[:1] in (["merge"], ["compare"]) else FAKE_PT
                self.assertEqual(self.run_pt(*arguments, **environment), code, self.errors)
                self.assertTrue(self.errors.startswith(said), self.errors)
                if self.contents("a.png") == b"old":
                    os.remove(self.path("a.png"))
                self.assertEqual([name for name in self.files() if name not in given], left)
