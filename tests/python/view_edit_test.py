import contextlib
import os
import shutil
import subprocess

import numpy as np
import pt
from pictures import SCENE_FILE, ready
from pt.view import View
from pt.view._built_in import verdict_of
from pt.view._rejected import rejected_samples
from view_page import SHADERS, Page, SceneTest, text_of

DIFFUSE = "phong.glsl", "vec3 f = material.diffuse;"

class Edits(SceneTest):
    def setUp(self):
        super().setUp()
        self.kernels = self.folder / "kernels"
        shutil.copytree(SHADERS, self.kernels)

    @contextlib.contextmanager
    def page(self, what=None, samples=16, **options):
        with contextlib.closing(View(what or self.scene, samples=samples, **options)) as view, Page(view) as page:
            yield page

    def edited(self, file, old, new):
        text = (self.kernels / file).read_text()
        self.assertEqual(text.count(old), 1)
        return text.replace(old, new)

    def test_an_error_and_its_mend(self):
        (self.kernels / "outside.glsl").symlink_to(SHADERS / "film.glsl")
        with self.page(shader_dir=self.kernels) as page:
            files = page.ask({"list": True})["files"]
            self.assertEqual(files[0], "s.json")
            self.assertIn("pathtrace.comp", files)
            self.assertNotIn("outside.glsl", files)
            page.frame(lambda state: state["samples"] == 16)
            before = page.radiance()
            text = page.ask({"open": "path.glsl"})["text"]
            self.assertEqual(text, (self.kernels / "path.glsl").read_text())
            sought = "radiance = emitted_by(hit.surface);"
            line = text[:text.index(sought)].count("\n") + 1
            page.send({"save": "path.glsl", "text": text.replace(sought, "radiance = emited_by(hit.surface);")})
            faults = page.frame(lambda state: state["faults"])["faults"]
            self.assertIn(("path.glsl", line), [(fault["file"], fault["line"]) for fault in faults])
            np.testing.assert_array_equal(page.radiance(), before)
            page.send({"save": "path.glsl", "text": text.replace(sought, "radiance = vec3(1.0) + emitted_by(hit.surface);")})
            page.frame(lambda state: not state["faults"] and state["samples"] == 16)
            more = page.radiance() - before  # 1 where the ray hits a surface, apart from rounding
            self.assertTrue(np.isclose(more, 1.0, atol=1e-5).any() and (more > -1e-5).all() and (more < 1.00001).all())
            page.send({"save": "path.glsl", "text": text})
            page.frame(lambda state: state["samples"] == 16 and np.array_equal(page.radiance(), before))
            negative = text_of(SCENE_FILE).replace('"radius": 1', '"radius": -1', 1)
            for spoilt, line, words in (("\n\n{\"sphere\": []}", 3, "sphere"), ("{\n\"spheres\": [,]}", 2, ""),
                                        (negative, negative[:negative.index('"radius": -1')].count("\n") + 1, "must be > 0")):
                page.send({"save": "s.json", "text": spoilt})
                fault, = page.frame(lambda state: [fault["line"] for fault in state["faults"]] == [line])["faults"]
                self.assertEqual(fault["file"], "s.json")
                self.assertIn(words, fault["text"])
                np.testing.assert_array_equal(page.radiance(), before)
            lamps = {**SCENE_FILE["materials"], "lamp": {"emission": [8, 6, 4]}}
            page.send({"save": "s.json", "text": text_of({**SCENE_FILE, "materials": lamps})})
            page.frame(lambda state: not state["faults"] and state["samples"] == 16)
            np.testing.assert_array_equal(page.radiance(), 2 * before)  # powers of two are exact

    def test_edited_kernels_are_compared_with_the_built_in_one(self):
        text = (self.kernels / "phong.glsl").read_text()
        with self.page(samples=256, shader_dir=self.kernels) as page:
            self.assertEqual(page.frame(lambda state: state["samples"] == 256)["verdict"], "")
            page.send({"save": "phong.glsl", "text": self.edited(*DIFFUSE, "vec3 f = 0.8 * material.diffuse;")})
            verdict = page.frame(lambda state: state["verdict"].startswith("different"))["verdict"]
            self.assertRegex(verdict, r"^different light: -\d+% \+- [\d.]+% of .* in [RGB]$")
            page.send({"save": "phong.glsl", "text": text})
            page.frame(lambda state: state["verdict"] == "same bits as the built-in kernel")
            page.send({"camera": {**page.state["first_camera"], "vertical_fov": 50}, "moving": True})
            page.frame(lambda state: abs(state["camera"]["vertical_fov"] - 50) < 1e-9 and
                       state["verdict"] == "same bits as the built-in kernel")
            page.send({"sampler": "halton"})
            page.frame(lambda state: "must not be PT_SAMPLER_HALTON" in state["verdict"])

    def test_a_course_is_judged(self):
        with self.assertRaisesRegex(ValueError, "is no folder of `pt course`"):
            View(self.folder)
        course = self.folder / "course"
        subprocess.run([os.environ["PT_PROGRAM"], "course", course], check=True)
        with self.page(course, samples=4) as page:
            self.assertEqual(page.ask({"list": True})["files"][0], "coursework.json")
            found = page.frame(lambda state: state["course"])["course"]
            self.assertEqual(found["title"], "step 1: emission")
            self.assertTrue(found["verdict"].startswith("wrong: the start. "), found)
            self.assertIn("its disc's fraction of the picture", found["measured"])
            subprocess.run(["patch", "-s", "-p1", "-d", course, "-i", SHADERS / "coursework/1-emission.diff"], check=True)
            found = page.frame(lambda state: state["course"] and state["course"]["title"].startswith("step 2"))["course"]
            self.assertTrue(found["verdict"].startswith("wrong: no bounces. "), found)

    def test_a_save_of_comments_keeps_the_samples(self):
        text = (self.kernels / "phong.glsl").read_text()
        with self.page(shader_dir=self.kernels) as page:
            seconds = page.frame(lambda state: state["samples"] == 16)["seconds"]
            for file, changed in (("phong.glsl", "// A \\\nlong /* comment\n" + text + "  /* another\n one */\n"),
                                  ("s.json", "// a comment\n" + text_of(SCENE_FILE))):
                revision = page.state["revision"]
                page.send({"save": file, "text": changed})
                state = page.frame(lambda state, before=revision: state["revision"] > before)
                self.assertEqual((state["samples"], state["seconds"], state["verdict"], state["faults"]), (16, seconds, "", []))
            page.send({"save": "phong.glsl", "text": self.edited(*DIFFUSE, "vec3 f = 1.0 * material.diffuse;")})
            page.frame(lambda state: state["samples"] == 16 and state["verdict"] == "same bits as the built-in kernel")

    def test_pixels_that_lose_samples_are_counted(self):
        code = "    vec3 radiance = emitted_by(hit.surface);\n"
        (self.kernels / "path.glsl").write_text(self.edited("path.glsl", code, code + "    if (pixel.x < 3u && pixel.y == 15u)\n"
                                                            "        return vec3(sqrt(-1.0 - radiance.r));\n"))
        with self.page(shader_dir=self.kernels) as page:
            state = page.frame(lambda state: state["samples"] == 16)
            self.assertEqual((state["rejected"], state["spoilt"]), (48, 3))
            glaring = (page.pixels[:, :, :3] == [255, 0, 255]).all(axis=2)
            self.assertTrue(glaring[15, :3].all() and glaring.sum() == 3)
        with pt.Context(shader_dir=self.kernels) as context:
            for first, samples in ((0, [[5, 0, 8], [16, 3, 1]]), (3, [[5, 13, 9], [16, 64, 1]])):
                ready(context, first_sample=first).accumulate_tiles(samples)
                expected = np.zeros((16, 24), int)
                expected[15, :3] = samples[1][0]
                np.testing.assert_array_equal(rejected_samples(context.film()), expected)

    def test_verdicts(self):
        for light, smallest, words in (
                (pt.Light.SAME, 0.00512, "same light as the built-in kernel to 0.51%"),
                (pt.Light.UNDECIDED, 0.031, "not enough samples yet: a change of 3.1% could be hidden"),
                (pt.Light.UNDECIDED, np.inf, "not enough samples yet: any change could be hidden")):
            self.assertEqual(verdict_of(pt.Comparison(light, 1, smallest, smallest, 1e-6, "", ())), words)
