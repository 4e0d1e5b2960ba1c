import asyncio
import contextlib
import dataclasses
import http.client
import json
import os
import pathlib
import shutil
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import unittest
from contextlib import closing
from unittest import mock

import numpy as np
import pt
from exr import read_exr_channels
from pictures import CAMERA, SCENE, SCENE_FILE, settings

HAS_COMPILER = os.environ["PT_HAS_COMPILER"] == "1"
SHADERS = pathlib.Path(__file__).resolve().parents[2] / "shaders"
import aiohttp
from pt.view import View, _server
from pt.view._built_in import verdict_of
from pt.view._frame import faults_of
from pt.view._rejected import rejected_samples


def text_of(scene):
    return json.dumps(scene, indent=1)


class Page:
    def __init__(self, view):
        self.address, self.loop, self.state, self.pixels = view.address, asyncio.new_event_loop(), {}, None

    def __enter__(self):
        self.session = self.run(self._session())
        self.socket = self.run(self.session.ws_connect(self.address + "socket", max_msg_size=0))
        return self

    def __exit__(self, *_):
        self.run(self.socket.close())
        self.run(self.session.close())
        self.loop.close()

    async def _session(self):
        return aiohttp.ClientSession()

    def run(self, coroutine):
        return self.loop.run_until_complete(asyncio.wait_for(coroutine, 600))

    def send(self, message):
        self.run(self.socket.send_str(message if isinstance(message, str) else json.dumps(message)))

    def ask(self, message):
        self.send(message)
        while True:
            answer = self.run(self.socket.receive())
            if answer.type == aiohttp.WSMsgType.TEXT:
                return json.loads(answer.data)
            self.take(answer.data)

    def take(self, data):
        length, = struct.unpack("<I", data[:4])
        self.state = json.loads(data[4:4 + length])
        if len(data) > 4 + length:
            self.pixels = np.frombuffer(data, np.uint8, offset=4 + length).reshape(self.state["height"], self.state["width"], 4)

    def radiance(self):
        with tempfile.NamedTemporaryFile(suffix=".exr") as file:
            file.write(self.get("picture.exr")[2])
            file.flush()
            channels = read_exr_channels(pathlib.Path(file.name))
        return np.stack([channels[name] for name in "RGB"], axis=2).astype(np.float32)

    def frame(self, holds=lambda state: True):
        while True:
            self.send({"next": 0})
            self.take(self.run(self.socket.receive()).data)
            if holds(self.state):
                return self.state

    def get(self, name):
        async def body():
            async with self.session.get(self.address + name) as answer:
                return answer.status, dict(answer.headers), await answer.read()
        return self.run(body())


class Views(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        cls.scene = cls.folder / "a scene.json"
        cls.scene.write_text(text_of(SCENE_FILE))
        cls.view = cls.enterClassContext(closing(View(cls.scene, samples=64)))
        cls.host, cls.token = cls.view.address.split("/")[2:4]

    def request(self, path, method="GET", **headers):
        connection = http.client.HTTPConnection(self.host)
        connection.putrequest(method, path, skip_host="Host" in headers)
        for name, value in headers.items():
            connection.putheader(name.replace("_", "-"), value)
        connection.endheaders()
        answer = connection.getresponse()
        answer.read()
        connection.close()
        return answer.status, answer.headers

    def test_only_who_knows_the_token_from_here(self):
        good = f"/{self.token}/"
        status, headers = self.request(good)
        self.assertEqual((status, headers["X-Content-Type-Options"]), (200, "nosniff"))
        self.assertIn("default-src 'self'", headers["Content-Security-Policy"])
        for path in "/", f"/x{good}", good + "absent", f"/{self.token}/socket":
            status, headers = self.request(path)
            self.assertGreaterEqual(status, 400)
            for name, value in _server.HEADERS.items():
                self.assertEqual(headers[name], value, path)
        for name in ("view.js", "view.css", "codemirror.js"):
            self.assertEqual(self.request(good + name)[0], 200)
        port = self.host.partition(":")[2]
        for host in (f"localhost:{port}", "127.0.0.1:9", "localhost", "[::1]:80"):  # A tunnel's end has another port.
            self.assertEqual(self.request(good, Host=host)[0], 200, host)
            self.assertEqual(self.request(good, Host=host, Origin=f"http://{host}")[0], 200, host)
        for host in ("example.org", f"127.0.0.1.example.org:{port}", f"example.org:{port}", "", "127.0.0.1:1:2", "127.0.0.2"):
            self.assertEqual(self.request(good, Host=host)[0], 403, host)
        for origin in ("http://example.org", "null", f"https://{self.host}", "http://127.0.0.1:9", f"http://{self.host}.example.org"):
            self.assertEqual(self.request(good, Origin=origin)[0], 403, origin)
        for token in ("", "x", self.token[:-1], self.token + "x", self.token.swapcase(), "%00"):
            for name in ("", "socket", "view.js", "picture.exr", "scene"):
                self.assertIn(self.request(f"/{token}/{name}")[0], (403, 404), (token, name))
        for path in ("/", "*", f"/{self.token}", f"//{self.token}/"):
            self.assertGreaterEqual(self.request(path)[0], 400, path)
        for method in ("POST", "PUT", "DELETE", "OPTIONS"):
            self.assertIn(self.request(good, method)[0], (403, 405))

    def test_no_path_leads_to_a_file(self):
        for name in ("../__init__.py", "..%2f__init__.py", "%2e%2e/__init__.py", "/etc/passwd", "%2fetc%2fpasswd", "a%20scene.json",
                     "package.json", ".", "..", "view.js/", "view.js%00", "...", "x" * 3000):
            self.assertIn(self.request(f"/{self.token}/{name}")[0], (403, 404), name)
        with Page(self.view) as page:
            self.assertEqual(page.ask({"list": True}), {"files": []})
            for name in (str(self.scene), "a scene.json", "../x", None, 7, ["a"]):
                self.assertIn("refused", page.ask({"open": name}))
                self.assertIn("refused", page.ask({"save": name, "text": "x"}))
        self.assertEqual(self.scene.read_text(), text_of(SCENE_FILE))

    def test_a_socket_needs_them_too(self):
        upgrade = {"Connection": "Upgrade", "Upgrade": "websocket", "Sec_WebSocket_Version": "13",
                   "Sec_WebSocket_Key": "AAAAAAAAAAAAAAAAAAAAAA=="}
        path = f"/{self.token}/socket"
        self.assertEqual(self.request("/x/socket", **upgrade)[0], 403)
        self.assertEqual(self.request(path, Origin="http://example.org", **upgrade)[0], 403)
        self.assertEqual(self.request(path, Host="example.org", **upgrade)[0], 403)

    def test_nonsense_is_refused_and_leaves_the_rest_alone(self):
        camera = {"position": [0, 1, 5], "look_at": [0, 1, 0]}
        nonsense = ("", "{", "[]", "7", "null", "[" * 5000, {"x": 1}, {"size": [0, 5]}, {"size": [1e9, 1]}, {"size": [2**13, 2**13]},
                    {"size": "ab"}, {"layer": "x"}, {"layer": []}, {"max_path_length": 0}, {"max_path_length": True},
                    {"sampler": "x"}, {"estimator": ["mis"]}, {"camera": 1}, {"camera": {}}, {"pixel": [1]}, {"pixel": [-1, 0]},
                    {"pixel": [0.5, 0]}, {"camera": {**camera, "position": [0, 1]}}, {"camera": {**camera, "vertical_extent": 0}},
                    '{"camera": {"position": [NaN, 0, 0], "look_at": [0, 0, 0]}}',
                    {"camera": {**camera, "position": [10**400, 0, 0]}})
        with Page(self.view) as page:
            for message in nonsense:
                self.assertIn("refused", page.ask(message), message)
            self.assertEqual(page.ask({"pixel": [5000, 0]}), {"pixel": {}})
            before = page.frame()
            self.assertIn("halton-cp", before["choices"]["sampler"])
            self.assertEqual(before["choices"]["estimator"][0], "best")
            page.send({"camera": {**camera, "position": [0, 1, 0]}})
            self.assertIn("position", page.frame(lambda state: state["faults"])["faults"][0]["text"])
            page.send({"camera": before["first_camera"]})
            page.frame(lambda state: not state["faults"] and state["samples"])

    def test_giant_messages_end_their_socket_alone(self):
        with Page(self.view) as page, Page(self.view) as other:
            page.send('{"save": "' + "x" * _server.MOST_BYTES + '"}')
            for _ in range(100):
                answer = page.run(page.socket.receive())
                if answer.type == aiohttp.WSMsgType.CLOSE:
                    break
            self.assertEqual(answer.data, aiohttp.WSCloseCode.MESSAGE_TOO_BIG)
            self.assertTrue(other.frame())

    def test_many_sockets(self):
        async def connect(session, kept):
            try:
                kept.append(await session.ws_connect(self.view.address + "socket"))
            except aiohttp.WSServerHandshakeError as error:
                return error.status
            return 101

        async def all_of_them():
            kept = []
            async with aiohttp.ClientSession(connector=aiohttp.TCPConnector(limit=40)) as session:
                answers = await asyncio.gather(*(connect(session, kept) for _ in range(100)))
                for each in kept:
                    await each.close()
            return answers

        answers = asyncio.run(all_of_them())
        self.assertEqual({101: answers.count(101), 503: answers.count(503)}, {101: 16, 503: 84})
        with Page(self.view) as page:
            self.assertTrue(page.frame())

    def test_frames_are_what_a_context_reads(self):
        with Page(self.view) as page:
            page.send({"playing": True, "camera": page.frame()["first_camera"]})
            state = page.frame(lambda state: state["samples"] == 64)
            with pt.Context() as context:
                image = context.render(SCENE, CAMERA, settings(), 64)
                for name, quantity in (("mean", "RADIANCE"), ("standard error", "STANDARD_ERROR"), ("samples", "SAMPLE_COUNT"),
                                       ("depth", "DEPTH"), ("normal", "NORMAL"), ("albedo", "ALBEDO")):
                    page.send({"layer": name})
                    page.frame(lambda state: state["layer"] == name)
                    values = context.readback(pt.Quantity[quantity])
                    self.assert_shows(page, name, values, image)
                    layer = page.ask({"pixel": [5, 7]})["pixel"]["layer"]
                    self.assertEqual([np.inf if each is None else each for each in layer], values[7, 5].tolist())
            page.send({"layer": "mean"})
            page.frame(lambda state: state["layer"] == "mean")
            self.assertEqual((state["error"], state["low"], state["high"]), (image.error, *image.error_bounds))
            np.testing.assert_array_equal(page.radiance(), image.radiance)
            pixel = page.ask({"pixel": [5, 7]})["pixel"]
            self.assertEqual(pixel, {"x": 5, "y": 7, "radiance": image.radiance[7, 5].tolist(), "samples": 64,
                                     "error": image.standard_error[7, 5].tolist(), "layer": image.radiance[7, 5].tolist(),
                                     "shown": image.to_srgb8()[7, 5].tolist()})
            self.assertNotEqual(pixel["radiance"], image.radiance[5, 7].tolist())

    def assert_shows(self, page, layer, values, image):
        """Numbers from 0 to 1 become 0 to 255. Halves may be rounded up or down."""
        self.assertTrue((page.pixels[:, :, 3] == 255).all())
        shown = page.pixels[:, :, :3]
        if layer == "mean":
            return np.testing.assert_array_equal(shown, image.to_srgb8())
        if layer in ("albedo", "standard error"):
            of_layer = pt.Image(values, values, values, None, None, 0.0 if layer == "albedo" else None)
            return np.testing.assert_array_equal(shown, of_layer.to_srgb8())
        numbers = values.astype(np.float64)
        if layer == "normal":
            numbers = 0.5 + 0.5 * numbers
        elif layer == "samples":
            numbers = np.full(values.shape, 0.5)
        else:
            known = np.isfinite(numbers)
            least, most = numbers[known].min(), numbers[known].max()
            numbers = np.where(known, 1 - 0.9 * (np.where(known, numbers, least) - least) / (most - least), 0.0)
        np.testing.assert_allclose(shown, 255 * np.clip(numbers, 0, 1), rtol=0, atol=0.5001)

    def test_a_page_has_its_own_display(self):
        with Page(self.view) as page, Page(self.view) as other:
            page.frame(lambda state: state["samples"] == 64)
            radiance, automatic = page.radiance(), page.pixels
            image = pt.Image(radiance, radiance, radiance, None, None)
            page.send({"display": {"exposure": -1.5, "tonemap": "agx", "gamma": 1.8}})
            state = page.frame(lambda state: state["stops"] == -1.5)
            expected = image.to_srgb8(-1.5, curve=pt.Curve.AGX, gamma=1.8)
            np.testing.assert_array_equal(page.pixels[:, :, :3], expected)
            self.assertEqual(state["choices"]["curve"], ["none", "reinhard", "aces", "agx", "neutral"])
            self.assertEqual(page.ask({"pixel": [5, 7]})["pixel"]["shown"], expected[7, 5].tolist())
            other.frame(lambda state: state["samples"] == 64)
            np.testing.assert_array_equal(other.pixels, automatic)
            self.assertFalse(np.array_equal(page.pixels, automatic))
            for spoilt in ({"exposure": 65, "tonemap": "none", "gamma": None}, {"exposure": 0, "tonemap": "x", "gamma": None},
                           {"exposure": 0, "tonemap": "none", "gamma": 11}, {"exposure": "bright", "tonemap": "none", "gamma": 1},
                           {"exposure": 0}, 7):
                self.assertIn("refused", page.ask({"display": spoilt}), spoilt)
            page.send({"display": {"exposure": "auto", "tonemap": "none", "gamma": None}})
            page.frame(lambda state: state["stops"] != -1.5)
            np.testing.assert_array_equal(page.pixels, automatic)

    def test_what_the_page_changes(self):
        with Page(self.view) as page:
            page.send({"size": [12, 9], "max_path_length": 2, "sampler": "halton-cp", "estimator": "light",
                       "camera": {"position": [1, 1.5, 4], "look_at": [0, 1, 0], "vertical_fov": 60}})
            page.frame(lambda state: state["samples"] == 64 and state["size"] == [12, 9])
            camera = pt.Camera((1, 1.5, 4), (0, 1, 0), vertical_fov=np.radians(60))
            with pt.Context() as context:
                image = context.render(SCENE, camera, settings(width=12, height=9, max_path_length=2, sampler=pt.Sampler.HALTON_CP,
                                                               estimator=pt.Estimator.LIGHT), 64)
            np.testing.assert_array_equal(page.radiance(), image.radiance)
            status, headers, data = page.get("scene")
            self.assertEqual(headers["Content-Disposition"], "attachment; filename*=UTF-8''a%20scene.json")
            saved = json.loads(data)
            self.assertEqual((saved["camera"]["position"], saved["spheres"]), ([1, 1.5, 4], SCENE_FILE["spheres"]))
            page.send({"size": [24, 16], "max_path_length": 6, "sampler": "best", "estimator": "best",
                       "camera": page.state["first_camera"]})
            page.frame(lambda state: state["size"] == [24, 16])

    def test_stops_and_rests(self):
        with mock.patch.object(_server, "IDLE_SECONDS", 0.0), closing(View(self.scene)) as view:
            renderer = view._show
            with Page(view) as page:
                page.frame(lambda state: state["samples"] > 1)
                page.send({"playing": False})
                stopped = page.frame(lambda state: not state["playing"])
                renderer._thread.join(0.3)
                self.assertEqual(renderer._count, stopped["samples"])
                page.send({"playing": True})
                page.frame(lambda state: state["samples"] > stopped["samples"])
                with Page(view) as other:
                    self.assertEqual(other.frame(lambda state: state["samples"])["size"], [24, 16])
            while renderer._is_watched:
                pass
            renderer._thread.join(0.3)
            count = renderer._count
            renderer._thread.join(0.3)
            self.assertEqual(renderer._count, count)

    def test_a_film(self):
        with pt.Context() as context:
            context.render(SCENE, CAMERA, settings(), 16)
            film = context.film()
        film.save(self.folder / "x.ptfilm")
        with closing(View(self.folder / "x.ptfilm")) as view, Page(view) as page:
            self.assertEqual((page.frame()["samples"], page.state.get("camera")), (16, None))
            np.testing.assert_array_equal(page.radiance(), film.readback())
            mean = page.pixels
            page.send({"layer": "standard error"})
            page.frame()
            self.assertFalse(np.array_equal(page.pixels, mean))
            self.assertEqual(page.ask({"pixel": [5, 7]})["pixel"]["layer"], film.readback(pt.Quantity.STANDARD_ERROR)[7, 5].tolist())
            self.assertEqual(page.get("scene")[0], 404)

    def test_faults_have_lines(self):
        self.assertEqual(faults_of("pathtrace.comp does not compile:\nERROR: /a/b.glsl:7: 'x' : undeclared"),
                         [{"file": None, "line": 0, "text": "pathtrace.comp does not compile:"},
                          {"file": "b.glsl", "line": 7, "text": "'x' : undeclared"}])


@unittest.skipUnless(HAS_COMPILER, "kernels cannot be compiled here")
class Edits(unittest.TestCase):
    def test_an_error_and_its_mend(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name, "kernels")
            shutil.copytree(SHADERS, folder)
            (folder / "outside.glsl").symlink_to(SHADERS / "film.glsl")
            scene = pathlib.Path(name, "s.json")
            scene.write_text(text_of(SCENE_FILE))
            with closing(View(scene, samples=16, shader_dir=folder)) as view, Page(view) as page:
                self.edit_kernel(page, folder)
                self.edit_scene(page, scene)

    def test_edited_kernels_are_compared_with_the_built_in_one(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name, "kernels")
            shutil.copytree(SHADERS, folder)
            text = (folder / "phong.glsl").read_text()
            changed = text.replace("vec3 f = material.diffuse;", "vec3 f = 0.8 * material.diffuse;")
            self.assertNotEqual(changed, text)
            scene = pathlib.Path(name, "s.json")
            scene.write_text(text_of(SCENE_FILE))
            with closing(View(scene, samples=256, shader_dir=folder)) as view, Page(view) as page:
                self.assertEqual(page.frame(lambda state: state["samples"] == 256)["verdict"], "")
                page.send({"save": "phong.glsl", "text": changed})
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
        with tempfile.TemporaryDirectory() as name:
            with self.assertRaisesRegex(ValueError, "is no folder of `pt course`"):
                View(name)
            folder = pathlib.Path(name, "course")
            subprocess.run([os.environ["PT_PROGRAM"], "course", folder], check=True)
            with closing(View(folder, samples=4)) as view, Page(view) as page:
                self.assertEqual(page.ask({"list": True})["files"][0], "coursework.json")
                course = page.frame(lambda state: state["course"])["course"]
                self.assertEqual(course["title"], "step 1: emission")
                self.assertTrue(course["verdict"].startswith("wrong: the start. "), course)
                self.assertIn("its disc's fraction of the picture", course["measured"])
                subprocess.run(["patch", "-s", "-p1", "-d", folder, "-i", SHADERS / "coursework/1-emission.diff"], check=True)
                course = page.frame(lambda state: state["course"] and state["course"]["title"].startswith("step 2"))["course"]
                self.assertTrue(course["verdict"].startswith("wrong: no bounces. "), course)

    def test_a_save_of_comments_keeps_the_samples(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name, "kernels")
            shutil.copytree(SHADERS, folder)
            text = (folder / "phong.glsl").read_text()
            scene = pathlib.Path(name, "s.json")
            scene.write_text(text_of(SCENE_FILE))
            with closing(View(scene, samples=16, shader_dir=folder)) as view, Page(view) as page:
                seconds = page.frame(lambda state: state["samples"] == 16)["seconds"]
                for file, changed in (("phong.glsl", "// A \\\nlong /* comment\n" + text + "  /* another\n one */\n"),
                                      ("s.json", "// a comment\n" + text_of(SCENE_FILE))):
                    revision = page.state["revision"]
                    page.send({"save": file, "text": changed})
                    state = page.frame(lambda state, before=revision: state["revision"] > before)
                    self.assertEqual((state["samples"], state["seconds"], state["verdict"], state["faults"]), (16, seconds, "", []))
                page.send({"save": "phong.glsl", "text": text.replace("vec3 f = material.diffuse;", "vec3 f = 1.0 * material.diffuse;")})
                page.frame(lambda state: state["samples"] == 16 and state["verdict"] == "same bits as the built-in kernel")

    def test_pixels_that_lose_samples_are_counted(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name, "kernels")
            shutil.copytree(SHADERS, folder)
            path = folder / "path.glsl"
            code = "    vec3 radiance = emitted_by(hit.surface);\n"
            path.write_text(path.read_text().replace(
                code, code + "    if (pixel.x < 3u && pixel.y == 15u)\n        return vec3(sqrt(-1.0 - radiance.r));\n"))
            scene = pathlib.Path(name, "s.json")
            scene.write_text(text_of(SCENE_FILE))
            with closing(View(scene, samples=16, shader_dir=folder)) as view, Page(view) as page:
                state = page.frame(lambda state: state["samples"] == 16)
                self.assertEqual((state["rejected"], state["spoilt"]), (48, 3))
                glaring = (page.pixels[:, :, :3] == [255, 0, 255]).all(axis=2)
                self.assertTrue(glaring[15, :3].all() and glaring.sum() == 3)
            self.films(folder)

    def films(self, folder):
        with pt.Context(shader_dir=folder) as context:
            context.set_scene(SCENE)
            context.set_camera(CAMERA)
            for first, samples in ((0, [[5, 0, 8], [16, 3, 1]]), (3, [[5, 13, 9], [16, 64, 1]])):
                context.set_render(dataclasses.replace(settings(), first_sample=first))
                context.accumulate_tiles(samples)
                expected = np.zeros((16, 24), int)
                expected[15, :3] = samples[1][0]
                np.testing.assert_array_equal(rejected_samples(context.film()), expected)
            film = context.film()
        with closing(View(film)) as view, Page(view) as page:
            self.assertEqual((page.frame()["rejected"], page.state["spoilt"]), (48, 3))
            self.assertEqual((page.pixels[:, :, :3] == [255, 0, 255]).all(axis=2).sum(), 3)

    def test_verdicts(self):
        for light, smallest, words in (
                (pt.Light.EQUAL_BITS, 0.004, "same bits as the built-in kernel"),
                (pt.Light.SAME, 0.00512, "same light as the built-in kernel to 0.51%"),
                (pt.Light.DIFFERENT, 0.004, "different light: -3.1% +- 0.4% of the picture in G"),
                (pt.Light.UNDECIDED, 0.031, "not enough samples yet: a change of 3.1% could hide"),
                (pt.Light.UNDECIDED, np.inf, "not enough samples yet: any change could hide")):
            self.assertEqual(verdict_of(pt.Comparison(light, 1, smallest, smallest, 1e-6,
                                                      "different light: -3.1% +- 0.4% of the picture in G", ())), words)

    def edit_kernel(self, page, folder):
        files = page.ask({"list": True})["files"]
        self.assertEqual(files[0], "s.json")
        self.assertIn("pathtrace.comp", files)
        self.assertNotIn("outside.glsl", files)
        page.frame(lambda state: state["samples"] == 16)
        before = page.radiance()
        text = page.ask({"open": "path.glsl"})["text"]
        self.assertEqual(text, (folder / "path.glsl").read_text())
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

    def edit_scene(self, page, scene):
        before = page.radiance()
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
        np.testing.assert_array_equal(page.radiance(), 2 * before)  # Powers of two are exact.


class Addresses(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.scene, self.file = self.folder / "s.json", self.folder / "cache" / "view.json"
        self.scene.write_text(text_of(SCENE_FILE))

    def address(self, **options):
        with closing(View(self.scene, samples=1, address_file=self.file, **options)) as view:
            return view.address

    def test_an_address_works_again(self):
        first = self.address()
        self.assertEqual(self.file.stat().st_mode & 0o777, 0o600)
        self.assertEqual(self.address(), first)
        with closing(View(self.scene, samples=1, address_file=self.file)) as view:
            self.assertEqual(view.address, first)
            self.assertNotEqual(self.address().split("/")[3], first.split("/")[3])
        self.assertEqual(self.address(), first)
        self.assertEqual([path.name for path in self.file.parent.iterdir()], ["view.json"])

    def test_files_that_others_may_know_are_not_used(self):
        for spoil in (lambda: self.file.chmod(0o640), lambda: self.file.write_text("{"), lambda: self.file.write_text("[1, 2]"),
                      lambda: self.file.write_text('{"port": 1, "token": "short"}'), lambda: self.file.rename(self.folder / "x")):
            before = self.address()
            spoil()
            if not self.file.exists():
                self.file.symlink_to(self.folder / "x")
            self.assertNotEqual(self.address().split("/")[3], before.split("/")[3])
            self.assertEqual((self.file.stat().st_mode & 0o777, self.file.is_symlink()), (0o600, False))


class Command(unittest.TestCase):
    def setUp(self):
        self.cache = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.enterContext(mock.patch.dict(os.environ, XDG_CACHE_HOME=str(self.cache)))

    def command(self, *arguments):
        return [sys.executable, "-m", "pt.view._command", *map(str, arguments)]

    def test_garbage_is_answered_without_a_word(self):
        with tempfile.TemporaryDirectory() as name:
            scene = pathlib.Path(name, "s.json")
            scene.write_text(text_of(SCENE_FILE))
            with subprocess.Popen(self.command(scene, "--no-browser"), stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                  text=True) as process:
                host = process.stdout.readline().split("/")[2]
                where = host.partition(":")[0], int(host.partition(":")[2])
                for garbage in (b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03", b"\0" * 300, b"GET\r\n\r\n", b"GET / HTTP/9.9\r\n\r\n",
                                b"GET /\x1b[2J HTTP/1.1\r\nHost:\r\n\r\n", b"GET / HTTP/1.1\r\n" + b"a" * 10000 + b"\r\n\r\n",
                                b"POST / HTTP/1.1\r\nContent-Length: -1\r\n\r\n"):
                    with socket.create_connection(where) as connection:
                        connection.sendall(garbage)
                        connection.shutdown(socket.SHUT_WR)
                        with contextlib.suppress(ConnectionError):
                            while connection.recv(4096):
                                pass
                process.send_signal(signal.SIGTERM)
                self.assertEqual((process.communicate(timeout=600)[1], process.returncode), ("", 0))

    @unittest.skipUnless(hasattr(os, "geteuid") and os.geteuid() == 0, "needs root, for a second user")
    def test_another_users_kernels_are_not_edited(self):
        with tempfile.TemporaryDirectory() as name:
            scene = pathlib.Path(name, "s.json")
            scene.write_text(text_of(SCENE_FILE))
            folder, target = pathlib.Path(name, "pt-shaders"), pathlib.Path(name, "kernels")
            environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
            for owner_of_link, owner in ((None, 65534), (65534, 0), (0, 65534)):
                shutil.copytree(SHADERS, folder if owner_of_link is None else target)
                if owner_of_link is not None:
                    folder.symlink_to(target)
                    os.lchown(folder, owner_of_link, 0)
                os.chown(folder, owner, 0)
                done = subprocess.run(self.command(scene, "--no-browser", "--edit"), cwd=name, env=environment, text=True,
                                      capture_output=True, timeout=600)
                self.assertEqual((done.returncode, done.stderr),
                                 (6, "pt-view: --edit: pt-shaders is another user's: use another folder\n"))
                (shutil.rmtree if owner_of_link is None else os.remove)(folder)
                shutil.rmtree(target, ignore_errors=True)

    def test_it_prints_its_address_and_ends(self):
        with tempfile.TemporaryDirectory() as name:
            scene = pathlib.Path(name, "s.json")
            scene.write_text(text_of(SCENE_FILE))
            with subprocess.Popen(self.command(scene, "--no-browser"), stdout=subprocess.PIPE, text=True) as process:
                self.assertRegex(process.stdout.readline(), r"^http://127\.0\.0\.1:\d+/[\w-]{20,}/\n$")
                process.send_signal(signal.SIGTERM)
                self.assertEqual(process.wait(600), 0)
            kept, = (self.cache / "pt" / "view").iterdir()
            self.assertEqual(kept.stat().st_mode & 0o777, 0o600)
            scene.write_text(text_of({**SCENE_FILE, "lights": []}))
            done = subprocess.run(self.command(scene, "--no-browser"), capture_output=True, text=True)
            self.assertEqual(done.returncode, 3)
            self.assertIn("lights", done.stderr)
        self.assertEqual(subprocess.run(self.command("absent.json"), capture_output=True).returncode, 6)
