"""Started by hand: PYTHONPATH=lib/python PT_LIBRARY=build/lib/libpt.so.0.4 python3 tests/python/view_browser_test.py
build/bin/pt"""

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
from pt.view import View

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "support"))
from chromium import PROGRAM as BROWSER, Chromium
from png import parse_png

PROGRAM = str(pathlib.Path(sys.argv.pop(1)).resolve())
os.environ["PT_PROGRAM"] = PROGRAM
SAMPLES = "parseInt(document.getElementById('progress').textContent)"
CAMERA = "document.getElementById('camera').value"
PIXEL = "document.getElementById('pixel').dataset.value"
VERTICES = "document.querySelectorAll('#vertices li')"
CIRCLES = "document.querySelectorAll('#marks circle')"
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

    def bytes_shown(self):
        data = np.array(self.browser.value(BYTES), np.uint8).reshape(-1, 4)
        return data[:, :3]

    def downloaded(self, element, name):
        downloads = self.folder / "downloads"
        self.browser.call("Browser.setDownloadBehavior", behavior="allow", downloadPath=str(downloads))
        self.browser.value(click(element))
        for _ in range(200):
            if (downloads / name).exists():
                break
            time.sleep(0.05)
        return downloads / name

    def box(self, element):
        return self.browser.value(f"(b => [b.left, b.top, b.width, b.height])(document.getElementById('{element}').getBoundingClientRect())")

    def touch(self, kind, *points):
        self.browser.call("Input.dispatchTouchEvent", type=kind, touchPoints=[{"x": x, "y": y, "id": i} for i, (x, y) in enumerate(points)])

    def tap(self, x, y):
        left, top, width, height = self.box("picture")
        self.touch("touchStart", (left + (x + 0.5) * width / 256, top + (y + 0.5) * height / 128))
        self.touch("touchEnd")

    def test_refines_stops_and_shows_the_bytes_of_the_program(self):
        self.open()
        self.browser.until("document.getElementById('error').textContent.startsWith('error 0.')")
        self.browser.until("document.querySelector('#chart .curve')")
        self.browser.value(click("play"))
        self.browser.until("document.getElementById('play').textContent === 'Go on'")
        stopped = self.browser.value(SAMPLES)
        time.sleep(1.0)
        self.assertEqual(self.browser.value(SAMPLES), stopped)
        exr = self.downloaded("exr", "picture.exr")
        for name, value in (("curve", "agx"), ("gamma", "1.8"), ("exposure", "-1")):
            self.browser.value(choose(name, value))
        subprocess.run([PROGRAM, "tonemap", "-q", exr, self.folder / "t.png", "--tonemap", "agx", "--exposure", "-1",
                        "--gamma", "1.8"], check=True)
        expected = np.array(parse_png((self.folder / "t.png").read_bytes())[2], np.uint8).reshape(-1, 3)
        np.testing.assert_array_equal(self.bytes_shown(), expected)
        self.browser.value(click("play"))
        self.browser.until(f"{SAMPLES} > {stopped}")

    def test_mouse_keys_and_fingers_move_the_camera(self):
        self.open()
        self.browser.until(f"{SAMPLES} > 8")
        before = self.browser.value(CAMERA)

        def seen_from():
            camera = json.loads("{" + self.browser.value(CAMERA) + "}")["camera"]
            return np.linalg.norm(np.subtract(camera["position"], camera["look_at"])), camera["position"][0]

        self.browser.mouse("mousePressed", 500, 400, button="left", buttons=1, clickCount=1)
        for step in range(12):
            self.browser.mouse("mouseMoved", 500 + 10 * step, 400 - 2 * step, button="left", buttons=1)
        self.browser.mouse("mouseReleased", 610, 380, button="left")
        self.browser.until(f"{SAMPLES} > 8 && {CAMERA} !== {json.dumps(before)}")
        distance, side = seen_from()
        self.assertAlmostEqual(distance, 12.0, 1)
        self.assertLess(side, -1.0)
        self.touch("touchStart", (450, 400), (550, 400))
        for step in range(8):
            self.touch("touchMove", (450 - 10 * step, 400), (550 + 10 * step, 400))
        self.touch("touchEnd")
        self.browser.until(f"{SAMPLES} > 8")
        self.assertAlmostEqual(seen_from()[0] / distance, 100 / 240, 1)
        for key in ("ArrowLeft", "+"):
            shown = self.browser.value(CAMERA)
            self.browser.call("Input.dispatchKeyEvent", type="keyDown", key=key)
            self.browser.until(f"{CAMERA} !== {json.dumps(shown)}")
        self.browser.value(click("back"))
        self.browser.until(f"{CAMERA} === {json.dumps(before)}")

    def test_a_course_has_a_verdict_and_paths_of_tapped_pixels(self):
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
        pixel = json.loads(self.browser.until(PIXEL))
        self.assertEqual((pixel["x"], pixel["y"]), (120, 70))
        self.assertIn("M120,70h1", self.browser.value("document.getElementById('marks').innerHTML"))
        self.browser.value(choose("max_path_length", 4))
        self.browser.value(click("trace"))
        self.browser.until(f"{VERTICES}.length === 5 && {CIRCLES}.length")
        self.assertRegex(self.browser.value(f"{VERTICES}[1].textContent"), r"^2position \S+ \S+ \S+throughput .*numbers [\d.]+ [\d.]+$")
        x, y = self.browser.value(f"(c => [+c.getAttribute('cx'), +c.getAttribute('cy')])({CIRCLES}[0])")
        self.assertEqual((int(x), int(y)), (120, 70))
        self.browser.value(click("untrace"))
        self.assertEqual(self.browser.value(f"{CIRCLES}.length"), 0)

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
        self.browser.until(f"{SAMPLES} > {before}")
        self.browser.call("Input.dispatchKeyEvent", type="keyDown", key="z", code="KeyZ", windowsVirtualKeyCode=90, modifiers=2)
        self.browser.until("document.getElementById('edited').textContent === 'not saved'")
        self.browser.call("Input.dispatchKeyEvent", type="keyDown", key="s", code="KeyS", windowsVirtualKeyCode=83, modifiers=2)
        self.browser.until("!document.querySelector('#faults li') && !document.querySelector('.cm-lint-marker-error')")
        text = (ROOT / "shaders/phong.glsl").read_text()
        self.assertEqual((self.kernels / "phong.glsl").read_text(), text)
        darker = "// another editor\n" + text.replace("vec3 f = material.diffuse;", "vec3 f = 0.97 * material.diffuse;")
        (self.kernels / "phong.glsl").write_text(darker)
        self.browser.until("document.querySelector('#text .cm-content').textContent.startsWith('// another editor')")
        self.browser.until("document.getElementById('verdict').textContent.startsWith('different light: -')")


if __name__ == "__main__":
    unittest.main()
