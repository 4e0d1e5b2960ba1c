"""Plays the browser of `pt view` in tests."""

import asyncio
import json
import pathlib
import struct
import tempfile
import unittest

import aiohttp
import numpy as np
from exr import read_exr_channels
from pictures import SCENE_FILE

SHADERS = pathlib.Path(__file__).resolve().parents[2] / "shaders"


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


class SceneTest(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.scene = self.folder / "s.json"
        self.scene.write_text(text_of(SCENE_FILE))
