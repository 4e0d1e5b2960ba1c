import json
import os
import shutil

from command_line import PT, SCENES, CommandLineTest


class Selftest(CommandLineTest):
    def checks(self, **environment):
        self.assertEqual(self.run_pt("selftest", "--json", "s.json", **environment), 1, self.errors)
        self.assertEqual(self.errors, "")
        report = json.loads(self.read("s.json"))
        self.assertFalse(report["passed"])
        failed = sum(not check["passed"] for check in report["checks"])
        self.assertTrue(self.output.endswith(f"\nFAILED: {failed} of {len(report['checks'])} checks\n"), self.output)
        self.assertEqual(sum(line.startswith("FAIL  ") for line in self.output.splitlines()), failed)
        return {check["name"]: check for check in report["checks"]}

    def test_each_other_check_can_fail(self):
        for fault, name, error in (("accuracy_bound", "fake function", 5.0), ("rejected", "samples left out", 3.0 * 11),
                                   ("split", "samples split over calls", None)):
            check = self.checks(FAKE_PT_FAIL=f"{fault}:1")[name]
            self.assertFalse(check["passed"])
            if error is not None:
                self.assertEqual(check["error"], error)


class RealDevice(CommandLineTest):
    program = PT

    def test_selftest(self):
        self.expect(0, "selftest", "--json", "s.json")
        report = json.loads(self.read("s.json"))
        self.assertTrue(report["passed"])
        for text in (report["version"], *(report["device"][key] for key in ("name", "driver", "kind", "uuid"))):
            self.assertIn(text, self.output[:self.output.index("check")])
        for check in report["checks"]:
            self.assertTrue(check["passed"])
            self.assertIn("\npass  " + check["name"], self.output)
        self.assertEqual({check["group"] for check in report["checks"]}, {"function", "scene", "invariance"})
        self.assertIn(f"\npassed: all {len(report['checks'])} checks\n", self.output)

    def failed_directions(self, *faults):
        shutil.rmtree(self.path("shaders"), ignore_errors=True)
        shutil.copytree(os.path.join(SCENES, "..", "..", "shaders"), self.path("shaders"))
        for name, old, new in faults:
            text = self.read(f"shaders/{name}")
            self.assertEqual(text.count(old), 1, old)
            self.write(f"shaders/{name}", text.replace(old, new))
        code = self.run_pt("selftest", "--directions", "--shader-dir", "shaders", "--json", "s.json")
        self.assertEqual(code, 1, self.errors)
        checks = json.loads(self.read("s.json"))["checks"]
        self.assertEqual(len(checks), 22)
        return sorted(check["name"] for check in checks if not check["passed"] and check["name"].startswith(("Phong lobe", "hemisphere", "weights", "samples")))

    def test_directions(self):
        kinds = "Phong lobe, n = 20", "hemisphere, by cosine", "hemisphere, uniform"
        failed = self.failed_directions(
            ("sampling.glsl", "return SphericalAngles(1.0", "u.x = 0.98 * u.x + 0.01;\n    return SphericalAngles(1.0"),
            ("sampling.glsl", "vec2(sqrt(1.0 - u), sqrt(u))", "vec2(sqrt(1.0 - 0.99 * u), sqrt(0.99 * u))"),
            ("sampling.glsl", "sin_cos_turn(angles.azimuth,", "sin_cos_turn(0.95 * angles.azimuth,"),
            ("phong.glsl", "(n + 1.0)));", "(n + 2.0)));"))
        for kind in kinds:
            self.assertLessEqual({f"{kind}: {moment}" for moment in ("cosine", "square")}, set(failed))
            self.assertTrue(any(name.startswith(f"{kind}: side") for name in failed), failed)

    def test_weights(self):
        lamps, path = "power_heuristic(direction_density, lamp_density)", "power_heuristic(arrival_density, density)"
        at_once = "power_heuristic_over_density(lamp_density, direction_density)"
        branches = "power_heuristic_over_density(density, towards.density * float(BRANCH_COUNT))"
        for faults, failing in (((("step.glsl", at_once),), ("chosen lamp", "glow", "lamp")),
                                ((("step.glsl", lamps), ("path.glsl", branches)), ("chosen lamp", "glow", "lamp")),
                                ((("path.glsl", path),), ("glow",))):
            with self.subTest(faults=faults):
                changes = [(file, weight, f"1.02 * {weight}") for file, weight in faults]
                self.assertEqual(self.failed_directions(*changes), [f"weights of a {name}" for name in failing])
