"""Tests the page of pt view in headless Chromium. Started by hand: PYTHONPATH=lib/python PT_LIBRARY=build/lib/libpt.so.0.4 python3
tests/python/view_browser_test.py build/bin/pt [FOLDER for screenshots]"""

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
from chromium import PROGRAM as BROWSER, Chromium  # noqa: E402
from exr import read_exr_channels  # noqa: E402
from png import parse_png  # noqa: E402

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

    def open(self, **options):
        view = View(self.scene, **options)
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
        reference = self.folder / "reference.exr"
        subprocess.run([PROGRAM, "render", self.scene, "-q", "--spp", "32", "-o", reference], check=True)
        channels = [np.array(read_exr_channels(path)[name]) for path in (exr, reference) for name in "RGB"]
        for mine, its in zip(channels[:3], channels[3:]):
            np.testing.assert_array_equal(mine, its)
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
        self.assertEqual(np.float32(pixel["radiance"]).tolist(), [np.float32(each[y, x]) for each in channels[3:]])
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

    def test_tiny_pixels_and_layers(self):
        self.open()
        self.browser.value("[...document.querySelectorAll('#sizes button')].at(-1).click()")
        self.browser.until("document.getElementById('picture').width === 16")
        self.shot("tiny")
        for layer in ("normal", "depth", "albedo", "samples", "standard error"):
            self.browser.value(f"[...document.querySelectorAll('#layers button')].find(b => b.textContent === '{layer}').click()")
            self.browser.until(f"document.querySelector('#layers [aria-pressed=true]').textContent === '{layer}'")
            self.assertGreater(len(np.unique(self.bytes_shown())), 1 if layer != "samples" else 0)

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
        (kernels / "phong.glsl").write_text(text + "// edited\n")
        self.browser.until(f"{verdict}.startsWith('same light as the built-in kernel to ')")
        self.shot("same")
        (kernels / "phong.glsl").write_text(text.replace("vec3 f = material.diffuse;", "vec3 f = 0.97 * material.diffuse;"))
        self.browser.until(f"{verdict}.startsWith('different light: -')")
        self.assertEqual(self.browser.value("document.getElementById('verdict').className"), "differs")
        self.shot("different")


def parse_png_rgba(path):
    _, _, rows = parse_png(path.read_bytes())
    return [row[i:i + 3] for row in rows for i in range(0, len(row), 4)]


if __name__ == "__main__":
    unittest.main()
