import contextlib
import os
import shutil
import signal
import socket
import subprocess
import sys
import unittest
from contextlib import closing
from unittest import mock

from pictures import SCENE_FILE
from pt.view import View
from view_page import SHADERS, SceneTest, text_of


class Addresses(SceneTest):
    def setUp(self):
        super().setUp()
        self.file = self.folder / "cache" / "view.json"

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


class Command(SceneTest):
    def setUp(self):
        super().setUp()
        self.enterContext(mock.patch.dict(os.environ, XDG_CACHE_HOME=str(self.folder / "cache"), LP_NATIVE_VECTOR_WIDTH="256",
                                          PYTHONPATH=os.pathsep.join(sys.path)))

    def command(self, *arguments):
        return [sys.executable, "-m", "pt.view._command", *map(str, arguments), "--no-browser"]

    def refused(self, code, said, *arguments):
        done = subprocess.run(self.command(*arguments), cwd=self.folder, text=True, capture_output=True, timeout=600)
        self.assertEqual(done.returncode, code)
        self.assertIn(said, done.stderr)

    def test_it_prints_its_address_answers_garbage_without_a_word_and_ends(self):
        with subprocess.Popen(self.command(self.scene), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
            address = process.stdout.readline()
            self.assertRegex(address, r"^http://127\.0\.0\.1:\d+/[\w-]{20,}/\n$")
            host, _, port = address.split("/")[2].partition(":")
            for garbage in (b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03", b"\0" * 300, b"GET\r\n\r\n", b"GET / HTTP/9.9\r\n\r\n",
                            b"GET /\x1b[2J HTTP/1.1\r\nHost:\r\n\r\n", b"GET / HTTP/1.1\r\n" + b"a" * 10000 + b"\r\n\r\n",
                            b"POST / HTTP/1.1\r\nContent-Length: -1\r\n\r\n"):
                with socket.create_connection((host, int(port))) as connection:
                    connection.sendall(garbage)
                    connection.shutdown(socket.SHUT_WR)
                    with contextlib.suppress(ConnectionError):
                        while connection.recv(4096):
                            pass
            process.send_signal(signal.SIGTERM)
            self.assertEqual((process.communicate(timeout=600)[1], process.returncode), ("", 0))
        kept, = (self.folder / "cache" / "pt" / "view").iterdir()
        self.assertEqual(kept.stat().st_mode & 0o777, 0o600)

    def test_wrong_files_are_refused(self):
        self.refused(6, "absent.json", "absent.json")
        self.scene.write_text(text_of({**SCENE_FILE, "lights": []}))
        self.refused(3, "lights", self.scene)

    @unittest.skipUnless(hasattr(os, "geteuid") and os.geteuid() == 0, "needs root, for a second user")
    def test_another_users_kernels_are_not_edited(self):
        link, target = self.folder / "pt-shaders", self.folder / "kernels"
        shutil.copytree(SHADERS, target)
        link.symlink_to(target)
        for path in link, target:
            os.lchown(path, 65534, 0)
            self.refused(6, "pt-view: --edit: pt-shaders belongs to another user: use another folder\n", self.scene, "--edit")
            os.lchown(path, 0, 0)
