import os
import subprocess

from command_line import PT, SCENES, CommandLineTest

COURSE = os.path.join(SCENES, "..", "..", "shaders", "coursework")
DIFFERENCES = ("1-emission", "2-directions", "3-throughput", "4-numbers", "5-filter", "6a-cosine", "6b-lamps", "7-motion")
# Maps a difference to the steps that it makes right, if these are not the step of the same name.
STEPS = {"6b-lamps": ("6b", "6c")}

LAMP_RAY = "if (cosine > 0.0 && nearest(Ray(hit.position, direction)).surface == lamp)"
REFLECTED = "ray = Ray(hit.position, direction);"

# Each row has the difference, the right code, the wrong code, and the mistake's name in the verdict.
MISTAKES = (
    ("1-emission", "{ return material.emission; }", "{ return pow(material.emission, vec3(1.0 / 2.2)); }", "gamma twice"),
    ("2-directions", "return dot(direction, normal) < 0.0 ? -direction : direction;",
     "return vec3(direction.xy, abs(direction.z));", "abs(z)"),
    ("2-directions", "length <= MAX_PATH_LENGTH", "length < MAX_PATH_LENGTH", "paths one vertex short"),
    ("2-directions", "const float NEAR = 0.001", "const float NEAR = 0.0", "self-intersection"),
    ("2-directions", "Ray(hit.position, random", "Ray(origin, random", "rays start elsewhere"),
    ("3-throughput", "float density = 1.0 / (2.0 * PI);", "float density = 1.0;", "missing 2 pi"),
    ("3-throughput", "float density = 1.0 / (2.0 * PI);", "float density = 1.0 / (1.98 * PI);", "1.98 pi"),
    ("3-throughput", "(n + 2.0) / (2.0 * PI) * lobe", "(n + 1.0) / (2.0 * PI) * lobe", "n + 1"),
    ("3-throughput", "return max(dot(normal, direction), 0.0);", "return pow(max(dot(normal, direction), 0.0), 2.0);",
     "cosine twice"),
    ("3-throughput", "reflect(ray.direction, hit.normal)", "-ray.direction", "lobe without mirror"),
    ("3-throughput", "throughput *= ", "throughput = ", "throughput of the last surface alone"),
    ("3-throughput", "radiance += throughput * emitted", "radiance += emitted", "no throughput"),
    ("4-numbers", "SAMPLER == SAMPLER_HALTON ? 0.0 : unit_number(of_pixel)", "0.0", "pixel shift missing"),
    ("4-numbers", "digit = 1.0 / float(base)", "digit = float(1u / base)", "integer division"),
    ("4-numbers", "unit_number(of_pixel)", "unit_number(hash(pixel_index))", "one shift for all dimensions"),
    ("4-numbers", "fract(radical_inverse(PRIMES[dimension - 1u], sample_index) + shift)",
     "radical_inverse(PRIMES[dimension - 1u], sample_index) + shift", "no modulo 1"),
    ("4-numbers", "return traced_number(fract(", "return (fract(", "numbers are not traced"),
    ("4-numbers", "SAMPLER == SAMPLER_HALTON ? 0.0", "SAMPLER != SAMPLER_HALTON_CP ? 0.0", "the default sampler has no shift"),
    ("4-numbers", "if (SAMPLER == SAMPLER_RANDOM || dim", "if (dim", "the sampler random is not random"),
    ("4-numbers", "if (SAMPLER == SAMPLER_RANDOM || dim", "if (true || dim", "numbers are still random"),
    ("4-numbers", "SAMPLER == SAMPLER_HALTON ? 0.0 : unit_number(of_pixel)", "unit_number(of_pixel)", "the sampler halton is shifted too"),
    ("4-numbers", "if (SAMPLER == SAMPLER_RANDOM || dim", "if (SAMPLER <= SAMPLER_HALTON || dim", "the sampler halton is still random"),
    ("5-filter", "image_place(frame.camera, pixel, place)", "image_place(frame.camera, pixel, place + 0.5)", "half a pixel off"),
    ("6a-cosine", "max(cosine, 1.0e-6) / PI", "max(cosine, 1.0e-6) / (2.0 * PI)", "2 pi instead of pi"),
    ("6a-cosine", "ESTIMATOR != ESTIMATOR_UNIFORM", "true", "ESTIMATOR is ignored"),
    ("6b-lamps", "rgb * cone.solid_angle * cosine", "rgb * cosine", "no solid angle"),
    ("6b-lamps", "lamp < LAMP_COUNT; ++lamp", "lamp < min(LAMP_COUNT, 1u); ++lamp", "only the first lamp"),
    ("6b-lamps", "|| length == 1u ||", "||", "the camera sees no lamps"),
    ("6b-lamps", "length == 1u || hit.surface >= LAMP_COUNT", "length == 1u", "emission dropped that no cone samples"),
    ("6b-lamps", "if (!ASKS_LAMPS || length == 1u || hit.surface >= LAMP_COUNT)\n", "", "emission counted twice"),
    ("6b-lamps", "surface == lamp)", "surface < 99u)", "no shadows"),
    ("6b-lamps", "const bool ASKS_LAMPS = ", "const bool ASKS_LAMPS = false && ", "too many samples"),
    ("7-motion", "time = next_number();", "time = 0.5;", "one time for all samples"),
    ("7-motion", LAMP_RAY, LAMP_RAY.replace("if (", "float kept = time;\n time = 0.0;\n bool meets = ").replace(" == lamp)", """ == lamp;
        time = kept;
        if (meets)"""), "shadow rays at time 0"),
    ("7-motion", "ball_among(LAMP_COUNT, lamp, time)", "ball_among(LAMP_COUNT, lamp, 0.0)", "cones of lamps at another time"),
    ("7-motion", "normalize(position - sphere.xyz)", "normalize(position - ball_at(i, 0.0).center_radius.xyz)", "normals at another time"),
    ("7-motion", REFLECTED, f"{REFLECTED} time = 0.0;", "reflected rays at time 0"),
    ("7-motion", REFLECTED, f"{REFLECTED} time = next_number();", "a new time for each ray"),
)
# Each row has the step, and is planted in the last kernel, where other code may hide the mistake.
LATE_MISTAKES = (
    ("7", "time = next_number();", "time = place.x;", "time equal to another number"),
    ("7", "time = next_number();", "time = unit_number(hash(pixel_index));", "one time for each pixel"),
    ("7", "time = next_number();", "time = 2.0 * next_number() - 0.5;", "time outside [0, 1)"),
    ("4", "PRIMES[dimension - 1u]", "PRIMES[0]", "equal numbers in all dimensions"),
    ("4", "PRIMES[dimension - 1u]", "dimension + 1u", "bases with a common factor"),
    ("4", "uint[](2u, ", "uint[](1u, ", "a dimension that never changes"),
    ("4", "dimension - 1u], sample_index", "dimension - 1u], sample_index / 2u", "two samples with one point"),
    ("7", REFLECTED, f"{REFLECTED} time = 0.0;", "reflected rays at time 0"),
    ("7", REFLECTED, f"{REFLECTED} time = next_number();", "a new time for each ray"),
)
# None of the course's known mistakes fits this one.
UNKNOWN = ("3-throughput", "material.diffuse / PI +", "material.diffuse.bgr / 2.2 +")


class Coursework(CommandLineTest):
    program = PT

    def setUp(self):
        super().setUp()
        self.expect(0, "course", "kernels")

    def apply(self, difference):
        subprocess.run(["patch", "-s", "--fuzz=0", "-p1", "-d", self.path("kernels"), "-i", os.path.join(COURSE, f"{difference}.diff")],
                       check=True)

    def verdict(self, step):
        """Returns the exit status, the lines after the table of checks, and the messages."""
        done = subprocess.run([PT, "course", "--check", step, "--shader-dir", self.path("kernels")], capture_output=True, text=True)
        lines = done.stdout.splitlines()
        return done.returncode, lines[lines.index("", 2) + 1:] if "" in lines[2:] else lines, done.stderr

    def check_mistake(self, right, step, code, wrong, name):
        with self.subTest(mistake=name or "unknown"):
            self.assertEqual(right.count(code), 1, code)
            self.write("kernels/pathtrace.comp", right.replace(code, wrong))
            status, lines, errors = self.verdict(step)
            self.assertEqual((status, errors), (8, ""))
            self.assertTrue(lines[-1].startswith(f"wrong: {name}. " if name else "wrong: no usual mistake fits"), lines)

    def check(self, difference):
        right = self.read("kernels/pathtrace.comp")
        step = difference.partition("-")[0]
        for each in STEPS.get(difference, [step]):
            with self.subTest(step=each):
                self.assertEqual(self.verdict(each), (0, ["right"], ""))
        for _, *mistake in (mistake for mistake in (*MISTAKES, (*UNKNOWN, "")) if mistake[0] == difference):
            self.check_mistake(right, step, *mistake)
        self.write("kernels/pathtrace.comp", right)

    def test_steps_and_mistakes(self):
        for difference in DIFFERENCES:
            self.apply(difference)
            self.check(difference)
        last = self.read("kernels/pathtrace.comp")
        without_lamps = last.replace("const bool ASKS_LAMPS = ", "const bool ASKS_LAMPS = false && ")
        for step, *mistake in LATE_MISTAKES:
            self.check_mistake(without_lamps if step == "7" else last, step, *mistake)
        self.write("kernels/pathtrace.comp", last.replace("(n + 2.0) / (2.0 * PI) * lobe", "(n + 1.0) / (2.0 * PI) * lobe"))
        status, lines, _ = self.verdict("5")
        self.assertEqual((status, lines[0]), (0, "right"))
        self.assertRegex(lines[1], r"^but step 3 is wrong: n \+ 1\. ")

    def test_the_start_is_in_its_folder_without_answers(self):
        with open(os.path.join(COURSE, "start.comp"), encoding="utf-8") as file:
            self.assertEqual(self.read("kernels/pathtrace.comp"), file.read())
        names = os.listdir(self.path("kernels"))
        self.assertEqual([name for name in names if name.endswith(".diff")] + [name for name in ("phong.glsl", "lights.glsl")
                                                                              if name in names], [])
        self.expect(6, "course", "kernels", error="kernels: must be empty")
        self.expect(2, "course", "--check", "8", "--shader-dir", "kernels", error="--check 8: the steps are 1, 2, 3, ")
        code, lines, _ = self.verdict("next")
        self.assertEqual(code, 8)
        self.assertRegex(lines[0], "^wrong: the start. ")
        self.expect(2, "course", error="DIR or --check is required")

    def test_kernels_are_traced_in_a_temporary_folder(self):
        for difference in DIFFERENCES[:4]:
            self.apply(difference)
        before = self.files()
        check = ("course", "--check", "4", "--shader-dir", "kernels")
        self.expect(6, *check, TMPDIR="/dev/null", error="temporary folder")
        self.assertEqual(self.files(), before)
        os.rename(self.path("kernels/trace.glsl"), self.path("kernels/own.glsl"))
        for name in [name for name in os.listdir(self.path("kernels")) if os.path.isfile(self.path(f"kernels/{name}"))]:
            self.write(f"kernels/{name}", self.read(f"kernels/{name}").replace('"trace.glsl"', '"own.glsl"'))
        os.mkdir(self.path("temporary"))
        self.expect(6, *check, TMPDIR=self.path("temporary"))
        self.assertEqual(os.listdir(self.path("temporary")), [])

    def test_rejected_samples_are_counted(self):
        self.apply("1-emission")
        right = self.read("kernels/pathtrace.comp")
        self.write("kernels/pathtrace.comp", right.replace("return material.emission;", "return sqrt(-material.emission);"))
        self.assertRegex(self.verdict("1")[1][-1], r"^wrong: .* \([1-9]\d* samples were NaN, ")

    def test_grade_gives_points_for_right_steps(self):
        self.apply("1-emission")
        done = subprocess.run([PT, "course", "--grade", self.path("kernels")], capture_output=True, text=True, check=True)
        rows = [line.split() for line in done.stdout.splitlines()]
        self.assertEqual([row[0] for row in rows if row[-1] == "right"], ["1"])
        self.assertIn("wrong: no bounces.", done.stdout)
        self.assertIn("wrong: no filter.", done.stdout)
        self.assertEqual(rows[-1], ["all", "10/100"])
