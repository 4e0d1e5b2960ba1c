"""Started by hand: PYTHONPATH=lib/python PT_LIBRARY=build/lib/libpt.so.0.4 python3 tests/python/view_browser_test.py
build/bin/pt [FOLDER for screenshots]"""

import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

import numpy as np
import pt
from pt.view import View

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "support"))
from chromium import PROGRAM as BROWSER, Chromium
from exr import read_exr_channels
from png import parse_png

PROGRAM = str(pathlib.Path(sys.argv.pop(1)).resolve())
PICTURES = pathlib.Path(sys.argv.pop(1)) if len(sys.argv) > 1 else None
os.environ["PT_PROGRAM"] = PROGRAM
SAMPLES = "parseInt(document.getElementById('progress').textContent)"
BYTES = """(() => { const c = document.getElementById('picture');
  return [...c.getContext('2d').getImageData(0, 0, c.width, c.height).data]; })()"""


def choose(name, value):
    return f"""(() => {{ const e = document.getElementById('{name}'); e.value = {json.dumps(value)};
      e.dispatchEvent(new Event('input')); e.dispatchEvent(new Event('change')); }})()"""


def click(name):
    return f"document.getElementById('{name}').click()"


@unittest.skipUnless(BROWSER, "there is no Chromium")
class Browser(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        cls.scene = cls.folder / "coursework.json"
        shutil.copy(ROOT / "cli/scenes/coursework.json", cls.scene)
        cls.downloads = cls.folder / "downloads"
        cls.kernels = cls.folder / "kernels"
        shutil.copytree(ROOT / "shaders", cls.kernels)
        cls.browser = Chromium()
        cls.addClassCleanup(cls.browser.close)

    def open(self, what=None, **options):
        view = View(what or self.scene, **options)
        self.addCleanup(view.close)
        self.browser.open(view.address)
        self.browser.until("document.getElementById('picture').dataset.frame > 1")
        self.addCleanup(lambda: self.assertEqual(self.browser.complaints, []))

    def shot(self, name):
        if PICTURES:
            self.browser.screenshot(PICTURES / f"{name}.png")

    def bytes_shown(self):
        data = np.array(self.browser.value(BYTES), np.uint8).reshape(-1, 4)
        return data[:, :3]

    def downloaded(self, element, name):
        self.browser.call("Browser.setDownloadBehavior", behavior="allow", downloadPath=str(self.downloads))
        path = self.downloads / name
        path.unlink(missing_ok=True)
        self.browser.value(click(element))
        for _ in range(200):
            if path.exists():
                break
            time.sleep(0.05)
        return path

    def test_refines_and_stops(self):
        self.open()
        first = self.browser.value(SAMPLES)
        self.browser.until(f"{SAMPLES} > {max(first, 64)}")
        self.browser.until("document.getElementById('error').textContent.startsWith('error 0.')")
        self.browser.until("document.querySelector('#chart .curve')")
        self.shot("refines")
        self.browser.value(click("play"))
        self.browser.until("document.getElementById('play').textContent === 'Go on'")
        stopped = self.browser.value(SAMPLES)
        time.sleep(1.0)
        self.assertEqual(self.browser.value(SAMPLES), stopped)
        self.browser.value(click("play"))
        self.browser.until(f"{SAMPLES} > {stopped}")

    def test_bytes_and_pixels_are_the_program_s(self):
        self.open(samples=32)
        self.browser.until(f"{SAMPLES} === 32")
        exr = self.downloaded("exr", "picture.exr")
        channels = [np.array(read_exr_channels(exr)[name]) for name in "RGB"]
        for curve, exposure, gamma in (("none", 0, ""), ("reinhard", -2.5, "2.2"), ("aces", -3.3, ""), ("agx", -3, ""),
                                       ("agx", -1, "1.8"), ("neutral", -4.15, "")):
            for name, value in (("curve", curve), ("gamma", gamma), ("exposure", str(exposure))):
                self.browser.value(choose(name, value))
            subprocess.run([PROGRAM, "tonemap", "-q", exr, self.folder / "t.png", "--tonemap", curve, "--exposure", str(exposure),
                            *(["--gamma", gamma] if gamma else [])], check=True)
            expected = np.array(parse_png((self.folder / "t.png").read_bytes())[2], np.uint8).reshape(-1, 3)
            np.testing.assert_array_equal(self.bytes_shown(), expected, curve)
        self.browser.value(click("automatic"))
        done = subprocess.run([PROGRAM, "tonemap", exr, self.folder / "t.png"], check=True, capture_output=True, text=True)
        self.assertIn(self.browser.value("document.getElementById('stops').value"), done.stdout)
        box = self.browser.value("(b => [b.left, b.top, b.width, b.height])(document.getElementById('picture').getBoundingClientRect())")
        x, y = 40, 100
        self.browser.mouse("mouseMoved", box[0] + (x + 0.5) * box[2] / 256, box[1] + (y + 0.5) * box[3] / 128)
        pixel = json.loads(self.browser.until("document.getElementById('pixel').dataset.value"))
        self.assertEqual((pixel["x"], pixel["y"]), (x, y))
        self.assertEqual(np.float32(pixel["radiance"]).tolist(), [np.float32(each[y, x]) for each in channels])
        png = self.downloaded("png", "picture.png")
        saved = np.array(parse_png_rgba(png), np.uint8)
        np.testing.assert_array_equal(saved, self.bytes_shown())

    def test_orbits(self):
        self.open()
        line = "document.getElementById('camera').value"
        before = self.browser.value(line)
        self.browser.until(f"{SAMPLES} > 8")
        self.browser.mouse("mousePressed", 500, 400, button="left", buttons=1, clickCount=1)
        for step in range(12):
            self.browser.mouse("mouseMoved", 500 + 10 * step, 400 - 2 * step, button="left", buttons=1)
        self.browser.mouse("mouseReleased", 610, 380, button="left")
        self.browser.until(f"{SAMPLES} > 8 && {line} !== {json.dumps(before)}")
        self.shot("orbited")
        moved = json.loads("{" + self.browser.value(line) + "}")["camera"]
        self.assertAlmostEqual(np.linalg.norm(np.subtract(moved["position"], moved["look_at"])), 12.0, 1)
        self.assertLess(moved["position"][0], -1.0)
        for key in ("ArrowLeft", "+"):
            shown = self.browser.value(line)
            self.browser.call("Input.dispatchKeyEvent", type="keyDown", key=key)
            self.browser.until(f"{line} !== {json.dumps(shown)}")
        self.browser.value(click("back"))
        self.browser.until(f"{line} === {json.dumps(before)}")
        scene = self.downloaded("scene", "coursework.json")
        self.assertEqual(pt.load(scene).settings.width, 256)

    def test_fingers_orbit_and_zoom(self):
        self.open()
        line = "document.getElementById('camera').value"
        self.browser.until(f"{SAMPLES} > 8")
        before = self.browser.value(line)

        def distance():
            camera = json.loads("{" + self.browser.value(line) + "}")["camera"]
            return np.linalg.norm(np.subtract(camera["position"], camera["look_at"])), camera["position"][0]

        def touch(kind, *points):
            self.browser.call("Input.dispatchTouchEvent", type=kind,
                              touchPoints=[{"x": x, "y": 400, "id": i} for i, x in enumerate(points)])

        touch("touchStart", 500)
        for step in range(8):
            touch("touchMove", 500 + 10 * step)
        touch("touchEnd")
        self.browser.until(f"{line} !== {json.dumps(before)}")
        turned, side = distance()
        self.assertLess(side, -0.5)
        touch("touchStart", 450, 550)
        for step in range(8):
            touch("touchMove", 450 - 10 * step, 550 + 10 * step)
        touch("touchEnd")
        self.browser.until(f"{SAMPLES} > 8")
        self.assertAlmostEqual(distance()[0] / turned, 100 / 240, 1)

    def box(self, element):
        return self.browser.value(f"(b => [b.left, b.top, b.width, b.height])(document.getElementById('{element}').getBoundingClientRect())")

    def tap(self, x, y):
        left, top, width, height = self.box("picture")
        at = {"x": left + (x + 0.5) * width / 256, "y": top + (y + 0.5) * height / 128}
        self.browser.call("Input.dispatchTouchEvent", type="touchStart", touchPoints=[at])
        self.browser.call("Input.dispatchTouchEvent", type="touchEnd", touchPoints=[])

    def test_fits_or_shows_pixels(self):
        self.open(samples=4)
        _, _, width, height = self.box("picture")
        _, _, most_wide, most_high = self.box("stage")
        self.assertAlmostEqual(min(most_wide / width, most_high / height), 1.0, 2)
        self.browser.value(click("whole"))
        self.assertEqual(self.box("picture")[2:], [256, 128])
        self.browser.value(click("fit"))
        self.assertEqual(self.box("picture")[2:], [width, height])

    def test_a_tap_holds_a_pixel(self):
        self.open(samples=16)
        self.browser.until(f"{SAMPLES} === 16")
        before = self.browser.value("document.getElementById('camera').value")
        self.tap(200, 90)
        pixel = json.loads(self.browser.until("document.getElementById('pixel').dataset.value"))
        self.assertEqual((pixel["x"], pixel["y"], pixel["samples"]), (200, 90, 16))
        self.assertIn("standard error", self.browser.value("document.getElementById('pixel').textContent"))
        self.assertIn("M200,90h1", self.browser.value("document.getElementById('marks').innerHTML"))
        self.assertEqual(self.browser.value("document.getElementById('camera').value"), before)
        self.assertEqual(self.browser.value(SAMPLES), 16)

    def test_on_a_phone_the_picture_comes_first(self):
        self.browser.call("Emulation.setDeviceMetricsOverride", width=400, height=800, deviceScaleFactor=2, mobile=True)
        self.addCleanup(lambda: self.browser.call("Emulation.setDeviceMetricsOverride", width=1400, height=860, deviceScaleFactor=1,
                                                  mobile=False))
        self.open(samples=64, shader_dir=self.kernels)
        self.browser.until(f"document.querySelector('#text .cm-line') && {SAMPLES} === 64")
        self.tap(100, 100)
        self.browser.until("document.getElementById('pixel').dataset.value")
        tops = [self.box(name)[1] for name in ("stage", "pixel", "name", "editor", "layers")]
        self.assertEqual((tops[0], tops), (0, sorted(tops)))
        self.assertEqual(self.browser.value("document.documentElement.scrollWidth"), 400)
        self.shot("phone")

    def test_light_and_dark_follow_the_system(self):
        ground = "getComputedStyle(document.querySelector('.cm-editor')).backgroundColor"
        self.addCleanup(lambda: self.browser.call("Emulation.setEmulatedMedia", features=[]))
        for scheme, color in (("light", "rgb(255, 255, 255)"), ("dark", "rgb(27, 29, 32)")):
            self.browser.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme}])
            self.open(samples=64, shader_dir=self.kernels)
            self.browser.until(f"document.querySelector('#text .cm-line') && {SAMPLES} === 64")
            self.assertEqual(self.browser.value(ground), color)
            self.shot(scheme)

    def test_refusals_stand_at_their_field(self):
        self.open(samples=4)
        for name, field, value, words in (("width", "size", 0, "0: must be a whole number from 1 to 16777216"),
                                          ("height", "size", 99999999, "must be a whole number from 1 to 16777216"),
                                          ("height", "size", 100000, "256 x 100000: must have at most 16777216 pixels"),
                                          ("max_path_length", "max_path_length", 1025, "1025: must be a whole number from 1 to 1024")):
            place = f"document.querySelector('[data-of={field}]')"
            self.browser.value(choose(name, value))
            self.assertIn(words, self.browser.until(f"{place}.textContent"))
            self.assertGreater(self.browser.value(f"{place}.getBoundingClientRect().height"), 0)
            self.browser.value(choose("width", 256) if name == "width" else choose("height", 128) if name == "height" else choose(name, 3))
            self.browser.until(f"!{place}.textContent")

    def test_a_course(self):
        folder = self.folder / "course"
        subprocess.run([PROGRAM, "course", folder], check=True)
        for difference in ("1-emission", "2-directions", "3-throughput"):
            subprocess.run(["patch", "-s", "-p1", "-d", folder, "-i", ROOT / f"shaders/coursework/{difference}.diff"], check=True)
        kernel = folder / "pathtrace.comp"
        kernel.write_text(kernel.read_text().replace("1.0 / (2.0 * PI)", "1.0"))
        self.open(folder, samples=64)
        self.browser.until("document.getElementById('file').value === 'pathtrace.comp'")
        verdict = "document.querySelector('#course summary').textContent"
        self.assertIn("step 3: geometric term, reflectance, throughput: wrong: missing 2 pi. ",
                      self.browser.until(f"{verdict}.startsWith('step') && {verdict}"))
        self.tap(120, 70)
        self.browser.until("!document.getElementById('trace').hidden")
        self.browser.value(choose("max_path_length", 4))
        self.browser.value(click("trace"))
        self.browser.until("document.querySelectorAll('#vertices li').length === 5")
        self.shot("course")

    def test_traces_a_pixel(self):
        self.open(samples=64, shader_dir=self.kernels)
        self.browser.until(f"{SAMPLES} === 64")
        self.assertEqual(self.browser.value("document.getElementById('trace').hidden"), True)
        self.tap(200, 110)
        self.browser.until("!document.getElementById('trace').hidden")
        self.browser.value(choose("max_path_length", 4))
        self.browser.value(click("trace"))
        self.browser.until("document.querySelectorAll('#vertices li').length > 4 && document.querySelectorAll('#marks circle').length > 2")
        first = self.browser.value("document.querySelector('#vertices li').textContent")
        self.assertRegex(first, r"^1position \S+ \S+ \S+throughput 1 1 1numbers [\d. ]+$")
        x, y = self.browser.value("(c => [+c.getAttribute('cx'), +c.getAttribute('cy')])(document.querySelector('#marks circle'))")
        self.assertEqual((int(x), int(y)), (200, 110))
        self.shot("traced")
        self.browser.value(choose("sample", 7))
        self.browser.until(f"document.querySelector('#vertices li').textContent !== {json.dumps(first)}")
        self.browser.value(choose("sample", -1))
        self.assertIn("-1: must be a whole number", self.browser.until("document.querySelector('[data-of=trace]').textContent"))
        self.browser.value(click("untrace"))
        self.assertEqual(self.browser.value("document.querySelectorAll('#marks circle').length"), 0)

    def test_tiny_pixels_and_layers(self):
        self.open()
        self.browser.value("[...document.querySelectorAll('#sizes button')].at(-1).click()")
        self.browser.until("document.getElementById('picture').width === 16")
        self.shot("tiny")
        for layer in ("normal", "depth", "albedo", "sample count", "standard error"):
            self.browser.value(f"[...document.querySelectorAll('#layers button')].find(b => b.textContent === '{layer}').click()")
            self.browser.until(f"document.querySelector('#layers [aria-pressed=true]').textContent === '{layer}'")
            self.assertGreater(len(np.unique(self.bytes_shown())), 1 if layer != "sample count" else 0)

    def test_edits_an_error_and_its_mend(self):
        self.open(shader_dir=self.kernels)
        self.browser.until("document.querySelector('#text .cm-line') && document.getElementById('file').value === 'phong.glsl'")
        self.browser.until("document.querySelector('#text .cm-content').textContent.includes('Phong')")
        before = self.browser.value(SAMPLES)
        self.browser.value("document.querySelector('#text .cm-content').focus()")
        self.browser.call("Input.insertText", text="strange;\n")
        self.browser.until("document.getElementById('edited').textContent === 'not saved'")
        self.browser.value(click("keep"))
        fault = self.browser.until("document.querySelector('#faults li')?.textContent")
        self.assertRegex(fault, r"^phong\.glsl:[12]: ")
        self.browser.until("document.querySelector('.cm-lint-marker-error')")
        self.shot("error")
        self.browser.until(f"{SAMPLES} > {before}")
        self.browser.call("Input.dispatchKeyEvent", type="keyDown", key="z", code="KeyZ", windowsVirtualKeyCode=90, modifiers=2)
        self.browser.until("document.getElementById('edited').textContent === 'not saved'")
        self.browser.call("Input.dispatchKeyEvent", type="keyDown", key="s", code="KeyS", windowsVirtualKeyCode=83, modifiers=2)
        self.browser.until("!document.querySelector('#faults li') && !document.querySelector('.cm-lint-marker-error')")
        self.assertEqual((self.kernels / "phong.glsl").read_text(), (ROOT / "shaders/phong.glsl").read_text())
        self.shot("mended")
        (self.kernels / "phong.glsl").write_text("// another editor\n" + (ROOT / "shaders/phong.glsl").read_text())
        self.browser.until("document.querySelector('#text .cm-content').textContent.startsWith('// another editor')")

    def test_an_edited_kernel_is_compared_with_the_built_in_one(self):
        kernels = self.folder / "edited"
        shutil.copytree(ROOT / "shaders", kernels)
        verdict = "document.getElementById('verdict').textContent"
        self.open(shader_dir=kernels)
        self.browser.until(f"{SAMPLES} > 64")
        self.assertEqual(self.browser.value(verdict), "")
        text = (kernels / "phong.glsl").read_text()
        (kernels / "phong.glsl").write_text(text.replace("vec3 f = material.diffuse;", "vec3 f = 1.0 * material.diffuse;"))
        self.browser.until(f"{verdict}.startsWith('same light as the built-in kernel to ')")
        self.shot("same")
        (kernels / "phong.glsl").write_text(text.replace("vec3 f = material.diffuse;", "vec3 f = 0.97 * material.diffuse;"))
        self.browser.until(f"{verdict}.startsWith('different light: -')")
        self.assertEqual(self.browser.value("document.getElementById('verdict').className"), "differs")
        self.shot("different")
        text, code = (kernels / "path.glsl").read_text(), "    vec3 radiance = emitted_by(hit.surface);\n"
        (kernels / "path.glsl").write_text(text.replace(code, code + "    if (pixel.x < 8u && pixel.y < 4u)\n"
                                                        "        return vec3(sqrt(-1.0 - radiance.r));\n"))
        note = self.browser.until("document.getElementById('note').textContent")
        self.assertRegex(note, r"^\d+ samples were left out: not finite, negative or too bright. They are in 32 pixels, in magenta.$")
        self.shot("nan")


def parse_png_rgba(path):
    _, _, rows = parse_png(path.read_bytes())
    return [row[i:i + 3] for row in rows for i in range(0, len(row), 4)]


if __name__ == "__main__":
    unittest.main()
