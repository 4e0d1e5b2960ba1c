from __future__ import annotations

import asyncio
import hmac
import json
import logging
import pathlib
import re
import socket
import threading
import urllib.parse
from collections.abc import Awaitable, Callable
from dataclasses import dataclass, field
from typing import Any, Final, Protocol

from aiohttp import WSMsgType, http_exceptions, web

from pt._camera import Camera
from pt._errors import Error
from pt._exr import encode_exr
from pt._files import regular, write_atomically
from pt._scene_file import Display
from pt.view._address import Address, new_token
from pt.view._frame import LAYERS, METHODS, Frame, name_of
from pt.view._look import Look

PAGE: Final = {path.name: path.read_bytes() for path in pathlib.Path(__file__).with_name("page").iterdir()
               if path.suffix in (".html", ".css", ".js")}
TYPES: Final = {".html": "text/html", ".css": "text/css", ".js": "text/javascript"}
MOST_SOCKETS: Final = 16
MOST_BYTES: Final = 2**20
MOST_PIXELS: Final = 2**24
IDLE_SECONDS: Final = 10.0  # a view is unwatched after this time without a page
NAMES: Final = r"(?:127\.0\.0\.1|localhost|\[::1\])(?::\d{1,5})?"  # host names; a tunnel may change the port
HEADERS: Final = {
    "Content-Security-Policy": "default-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' blob: data:; base-uri 'none'; "
                               "form-action 'none'",
    "X-Content-Type-Options": "nosniff", "Referrer-Policy": "no-referrer", "Cache-Control": "no-store",
    "Cross-Origin-Resource-Policy": "same-origin"}


class Show(Protocol):
    frame: Frame

    def change(self, **changes: Any) -> None: ...

    def watch(self, is_watched: bool) -> None: ...

    def saved(self) -> tuple[str, bytes] | None: ...

    def trace(self, x: int, y: int, sample: int) -> dict[str, Any]: ...


@dataclass
class Page:
    """`wanted` is set when the page asks for a frame."""

    connection: web.WebSocketResponse
    look: Look
    wanted: asyncio.Event = field(default_factory=asyncio.Event)


class Server:
    """A thread that serves from construction until close(). `show` must be set before the first request. `files` are the files that the
    page may read and write, by name."""

    def __init__(self, files: Callable[[], dict[str, pathlib.Path]], port: int = 0, token: str | None = None) -> None:
        self.show: Show | None = None
        self._files = files
        self._token = token or new_token()
        self._sockets: set[web.WebSocketResponse] = set()
        self._socket = socket.create_server(("127.0.0.1", port))
        self.kept = Address(self._socket.getsockname()[1], self._token)
        self.address = f"http://127.0.0.1:{self.kept.port}/{self._token}/"
        self._loop = asyncio.new_event_loop()
        self._news = asyncio.Event()
        self._is_ready = threading.Event()
        self._thread = threading.Thread(target=self._run, name="pt-view-server", daemon=True)

    def start(self, show: Show) -> None:
        self.show = show
        self._thread.start()
        self._is_ready.wait()

    def published(self, _: Frame) -> None:
        if self._thread.is_alive():
            self._loop.call_soon_threadsafe(self._announce)

    def close(self) -> None:
        if self._thread.is_alive():
            self._loop.call_soon_threadsafe(self._loop.stop)
            self._thread.join()
        self._socket.close()

    def _run(self) -> None:
        asyncio.set_event_loop(self._loop)
        application = web.Application(middlewares=[self._checked], client_max_size=1024)
        application.add_routes([web.get("/{token}/", self._page), web.get("/{token}/socket", self._connect),
                                web.get("/{token}/picture.exr", self._exr), web.get("/{token}/scene", self._scene),
                                web.get("/{token}/{name}", self._page)])
        application.on_response_prepare.append(_add_headers)
        runner = web.AppRunner(application, access_log=None, logger=_log())
        self._loop.run_until_complete(runner.setup())
        self._loop.run_until_complete(web.SockSite(runner, self._socket).start())
        self._loop.call_soon(self._is_ready.set)
        self._loop.run_forever()
        for each in tuple(self._sockets):
            self._loop.run_until_complete(each.close(code=1001))
        self._loop.run_until_complete(runner.cleanup())
        self._loop.close()

    @web.middleware
    async def _checked(self, request: web.Request, handler: Callable[[web.Request], Awaitable[web.StreamResponse]]
                       ) -> web.StreamResponse:
        """Refuses requests without the token, and pages of other sites, which have another host name or origin."""
        host, origin = request.headers.get("Host", ""), request.headers.get("Origin")
        if not re.fullmatch(NAMES, host) or origin not in (None, f"http://{host}"):
            raise web.HTTPForbidden(text="pt view: this host or origin is refused\n")
        if not hmac.compare_digest(request.match_info.get("token", "").encode(), self._token.encode()):
            raise web.HTTPForbidden(text="pt view: the address must have the token\n")
        return await handler(request)

    async def _page(self, request: web.Request) -> web.StreamResponse:
        name = request.match_info.get("name", "index.html")
        if name not in PAGE:
            raise web.HTTPNotFound
        return web.Response(body=PAGE[name], content_type=TYPES[pathlib.PurePath(name).suffix], charset="utf-8")

    async def _exr(self, _: web.Request) -> web.StreamResponse:
        assert self.show
        if not self.show.frame.values:
            raise web.HTTPNotFound
        data = await self._loop.run_in_executor(None, encode_exr, self.show.frame.values[0])
        return web.Response(body=data, content_type="image/x-exr")

    async def _scene(self, _: web.Request) -> web.StreamResponse:
        assert self.show
        saved = await self._loop.run_in_executor(None, self.show.saved)
        if saved is None:
            raise web.HTTPNotFound
        return web.Response(body=saved[1], headers={"Content-Disposition": f"attachment; filename*=UTF-8''{urllib.parse.quote(saved[0])}"})

    async def _connect(self, request: web.Request) -> web.StreamResponse:
        if len(self._sockets) >= MOST_SOCKETS:
            raise web.HTTPServiceUnavailable(text=f"pt view: {MOST_SOCKETS} pages are open already\n")
        connection = web.WebSocketResponse(max_msg_size=MOST_BYTES, compress=False, heartbeat=20.0)
        self._sockets.add(connection)
        sender: asyncio.Task[None] | None = None
        try:
            await connection.prepare(request)
            assert self.show
            self.show.watch(True)
            page = Page(connection, Look(Display(**self.show.frame.state["display"])))
            sender = self._loop.create_task(self._send(page))
            async for message in connection:
                if message.type == WSMsgType.TEXT:
                    await self._answer(page, message.data)
        finally:
            if sender:
                sender.cancel()
            self._sockets.discard(connection)
            self._loop.call_later(IDLE_SECONDS, self._rest)
        return connection

    def _rest(self) -> None:
        if not self._sockets and self.show:
            self.show.watch(False)

    def _announce(self) -> None:
        self._news.set()
        self._news = asyncio.Event()

    async def _send(self, page: Page) -> None:
        """Sends the newest frame when the page asks for one, so that a slow connection gets fewer frames, not late ones."""
        assert self.show
        number, pixels = 0, None
        look: Look | None = None
        try:
            while True:
                await page.wanted.wait()
                while self.show.frame.number == number and page.look is look:
                    await self._news.wait()
                frame = self.show.frame
                page.wanted.clear()
                is_new = frame.pixels is not None and (frame.pixels is not pixels or page.look is not look)
                number, pixels, look = frame.number, frame.pixels, page.look
                shown = await self._loop.run_in_executor(None, look.shown, frame) if is_new else b""
                await page.connection.send_bytes(frame.message(shown, look.stops))
        except ConnectionError:
            pass

    async def _answer(self, page: Page, text: str) -> None:
        assert self.show
        connection = page.connection
        message: Any = None
        try:
            message = json.loads(text)
            if not isinstance(message, dict):
                raise ValueError("message: must be an object")
            if "next" in message:
                page.wanted.set()
            elif "display" in message:
                page.look = Look(Display(**{**self.show.frame.state["display"], **message["display"]}), page.look.stops)
                self._announce()
            elif "pixel" in message:
                x, y = (_whole(each, 0, MOST_PIXELS) for each in message["pixel"])
                await connection.send_json({"pixel": self.show.frame.pixel(x, y, page.look.pixels)})
            elif "trace" in message:
                x, y, sample = (_whole(each, 0, 2**32 - 2) for each in message["trace"])
                traced = await self._loop.run_in_executor(None, self.show.trace, x, y, sample)
                await connection.send_json({"trace": traced})
            elif "list" in message:
                await connection.send_json({"files": list(self._files())})
            elif "open" in message:
                path = self._file(message["open"])
                with open(path, encoding="utf-8", errors="replace", opener=regular) as file:
                    text = file.read()
                await connection.send_json({"opened": message["open"], "text": text})
            elif "save" in message:
                path, data = self._file(message["save"]), str(message["text"]).encode()
                write_atomically(path, lambda file: file.write(data))
                self.show.change(files=True)
            else:
                self.show.change(**changes_of(message))
        except (Error, ValueError, TypeError, KeyError, ArithmeticError, OSError, RecursionError) as error:
            text = str(error) if isinstance(error, (Error, ValueError)) else f"{type(error).__name__}: {error}"
            await connection.send_json({"refused": text, "fields": list(message) if isinstance(message, dict) else []})

    def _file(self, name: Any) -> pathlib.Path:
        files = self._files()
        if not isinstance(name, str) or name not in files:
            raise ValueError("the page may not access this file")
        return files[name]


async def _add_headers(_: web.Request, response: web.StreamResponse) -> None:
    response.headers.update(HEADERS)


def _log() -> logging.Logger:
    log = logging.Logger("pt.view", logging.ERROR)
    log.addHandler(logging.StreamHandler())
    log.addFilter(lambda record: not (record.exc_info and isinstance(record.exc_info[1], http_exceptions.HttpProcessingError)))
    return log


def changes_of(message: dict[str, Any]) -> dict[str, Any]:
    """Raises ValueError, TypeError or KeyError for a bad message."""
    changes: dict[str, Any] = {}
    for name, value in message.items():
        if name == "camera":
            changes[name] = Camera._of_section(value)
        elif name == "size":
            width, height = (_whole(each, 1, MOST_PIXELS) for each in value)
            if width * height > MOST_PIXELS:
                raise ValueError(f"{width} x {height}: must have at most {MOST_PIXELS} pixels")
            changes[name] = width, height
        elif name in ("playing", "moving"):
            changes[name] = value is True
        elif name == "layer" and value in LAYERS:
            changes[name] = value
        elif name == "max_path_length":
            changes.setdefault("method", {})[name] = _whole(value, 1, 1024)
        elif name in METHODS:
            changes.setdefault("method", {})[name] = {name_of(each): each for each in METHODS[name]}[value]
        else:
            raise ValueError(f"{name} = {value!r}: cannot be changed to this")
    return changes


def _whole(value: Any, least: int, most: int) -> int:
    if not isinstance(value, int) or isinstance(value, bool) or not least <= value <= most:
        raise ValueError(f"{value!r}: must be a whole number from {least} to {most}")
    return value
