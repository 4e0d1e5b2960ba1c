import http.client
import json
import pathlib
import tempfile
import unittest
from contextlib import ExitStack, closing
from unittest import mock

import aiohttp
import numpy as np
import pt
from pictures import CAMERA, SCENE, SCENE_FILE, settings
from pt.figures._options import Options
from pt.view import View, _server
from view_page import Page, text_of


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
        connection.request(method, path, headers={name.replace("_", "-"): value for name, value in headers.items()})
        answer = connection.getresponse()
        answer.read()
        connection.close()
        return answer.status, answer.headers

    def test_only_who_knows_the_token_from_here(self):
        good = f"/{self.token}/"
        status, headers = self.request(good)
        self.assertEqual((status, headers["X-Content-Type-Options"]), (200, "nosniff"))
        self.assertIn("default-src 'self'", headers["Content-Security-Policy"])
        for path in "/", "*", f"/{self.token}", f"/x{good}", good + "absent", f"/{self.token}/socket":
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
        for token in ("", self.token[:-1], self.token + "x", "%00"):
            for name in ("", "socket", "view.js", "picture.exr", "scene"):
                self.assertIn(self.request(f"/{token}/{name}")[0], (403, 404), (token, name))
        for method in ("POST", "PUT", "DELETE", "OPTIONS"):
            self.assertIn(self.request(good, method)[0], (403, 405))

    def test_no_path_leads_to_a_file(self):
        for name in ("../__init__.py", "%2e%2e/__init__.py", "%2fetc%2fpasswd", "a%20scene.json", "package.json", "view.js%00", "x" * 3000):
            self.assertIn(self.request(f"/{self.token}/{name}")[0], (403, 404), name)
        with Page(self.view) as page:
            self.assertEqual(page.ask({"list": True}), {"files": []})
            for name in (str(self.scene), "a scene.json", "../x", None, 7, ["a"]):
                self.assertIn("refused", page.ask({"open": name}))
                self.assertIn("refused", page.ask({"save": name, "text": "x"}))
        self.assertEqual(self.scene.read_text(), text_of(SCENE_FILE))

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

    def test_sockets(self):
        upgrade = {"Connection": "Upgrade", "Upgrade": "websocket", "Sec_WebSocket_Version": "13",
                   "Sec_WebSocket_Key": "AAAAAAAAAAAAAAAAAAAAAA=="}
        path = f"/{self.token}/socket"
        for refused, headers in (("/x/socket", {}), (path, {"Origin": "http://example.org"}), (path, {"Host": "example.org"})):
            self.assertEqual(self.request(refused, **headers, **upgrade)[0], 403)
        with ExitStack() as pages:
            for _ in range(16):
                page = pages.enter_context(Page(self.view))
            self.assertEqual(self.request(path, **upgrade)[0], 503)
            self.assertTrue(page.frame())

    def test_giant_messages_end_their_socket_alone(self):
        with Page(self.view) as page, Page(self.view) as other:
            page.send('{"save": "' + "x" * _server.MOST_BYTES + '"}')
            for _ in range(100):
                answer = page.run(page.socket.receive())
                if answer.type == aiohttp.WSMsgType.CLOSE:
                    break
            self.assertEqual(answer.data, aiohttp.WSCloseCode.MESSAGE_TOO_BIG)
            self.assertTrue(other.frame())

    def test_frames_are_what_a_context_reads(self):
        with Page(self.view) as page:
            page.send({"playing": True, "camera": page.frame()["first_camera"]})
            state = page.frame(lambda state: state["samples"] == 64)
            with pt.Context() as context:
                image = context.render(SCENE, CAMERA, settings(), 64)
                layers = ("radiance", "standard error", "sample count", "depth", "normal", "albedo")
                self.assertEqual(state["choices"]["layer"], list(layers))
                for name in layers:
                    page.send({"layer": name})
                    page.frame(lambda state: state["layer"] == name)
                    values = context.readback(pt.Quantity[name.upper().replace(" ", "_")])
                    self.assert_shows(page, name, values, image)
                    layer = page.ask({"pixel": [5, 7]})["pixel"]["layer"]
                    self.assertEqual([np.inf if each is None else each for each in layer], values[7, 5].tolist())
            page.send({"layer": "radiance"})
            page.frame(lambda state: state["layer"] == "radiance")
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
        if layer == "radiance":
            return np.testing.assert_array_equal(shown, image.to_srgb8())
        if layer in ("albedo", "standard error"):
            of_layer = pt.Image(values, values, values, None, None, 0.0 if layer == "albedo" else None)
            return np.testing.assert_array_equal(shown, of_layer.to_srgb8())
        numbers = values.astype(np.float64)
        if layer == "normal":
            numbers = 0.5 + 0.5 * numbers
        elif layer == "sample count":
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
            good = {"exposure": 0, "tonemap": "none", "gamma": None}
            for spoilt in {**good, "exposure": 65}, {**good, "tonemap": "x"}, {**good, "gamma": 11}, {"brightness": 1}, 7:
                self.assertIn("refused", page.ask({"display": spoilt}), spoilt)
            page.send({"display": {"exposure": "auto", "tonemap": "none", "gamma": None}})
            page.frame(lambda state: state["stops"] != -1.5)
            np.testing.assert_array_equal(page.pixels, automatic)

    def test_particles_are_a_figure(self):
        path = self.folder / "points.csv"
        path.write_text("x,y,z\n0,0,0\n1,0,0\n0,1,1\n")
        options = {"size": (24, 16), "radius": 0.3, "seed": 5, "exposure": -1.5}
        figure = pt.figure(path, samples=16, **options)
        with closing(View(path, samples=16, options=Options(**options))) as view, Page(view) as page:
            state = page.frame(lambda state: state["samples"] == 16)
            np.testing.assert_array_equal(page.radiance(), figure.radiance)
            self.assertEqual((state["stops"], state["name"]), (-1.5, "points.csv"))

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
