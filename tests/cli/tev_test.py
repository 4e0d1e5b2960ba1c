"""Tests of `pt render --tev`, with a viewer that is absent, never reads, reads slowly, leaves in the middle, or reads
all and then looks at every byte as tev's protocol has it (cli/tev/tev_packets.h). Arguments: see command_line.py."""

import os
import pathlib
import socket
import struct
import threading
import time
import zlib

from command_line import COURSEWORK, PATIENCE, PT, SCENES, CommandLineTest, main, parse_exr_header

CREATE_IMAGE, UPDATE_IMAGE_V3 = 4, 6
LARGE = 640, 700  # 5.4 MB, more than the buffers of a connection hold that has a small window


class Reader:
    """The fields of a packet."""

    def __init__(self, packet):
        self.packet, self.position = packet, 0

    def numbers(self, form):
        size = struct.calcsize("<" + form)
        found = struct.unpack_from("<" + form, self.packet, self.position)
        self.position += size
        return found

    def text(self):
        end = self.packet.index(b"\0", self.position)
        found = self.packet[self.position:end].decode()
        self.position = end + 1
        return found


class Image:
    def __init__(self, width, height, channels):
        self.size = width, height
        self.values = {channel: [None] * (width * height) for channel in channels}
        self.tiles = 0

    def rows(self, channels="RGB"):
        width, height = self.size
        planes = [self.values[channel] for channel in channels]
        return [[value for x in range(width) for value in (plane[y * width + x] for plane in planes)]
                for y in range(height)]


def parse(data):
    """The images that a viewer would show after these bytes, by name; all bytes belong to packets that are as they
    should be."""
    images, position = {}, 0
    while position < len(data):
        length, = struct.unpack_from("<I", data, position)
        assert 5 < length <= len(data) - position, (length, position, len(data))
        fields = Reader(data[position + 4:position + length])
        position += length
        kind, focus = fields.numbers("BB")
        assert focus == 0
        name = fields.text()
        if kind == CREATE_IMAGE:
            width, height, count = fields.numbers("3i")
            channels = [fields.text() for _ in range(count)]
            assert len(set(channels)) == count
            images[name] = Image(width, height, channels)
        else:
            assert kind == UPDATE_IMAGE_V3, kind
            update(images[name], fields)
        assert fields.position == len(fields.packet), (fields.position, len(fields.packet))
    return images


def update(image, fields):
    count, = fields.numbers("i")
    channels = [fields.text() for _ in range(count)]
    x, y, width, height = fields.numbers("4i")
    offsets, strides = fields.numbers(f"{count}q"), fields.numbers(f"{count}q")
    assert min(x, y) >= 0 and min(width, height) > 0 and x + width <= image.size[0] and y + height <= image.size[1]
    pixels = width * height
    values = fields.numbers(f"{max(o + (pixels - 1) * s + 1 for o, s in zip(offsets, strides))}f")
    for channel, offset, stride in zip(channels, offsets, strides):
        plane = image.values[channel]
        for row in range(height):
            first = (y + row) * image.size[0] + x
            begin = offset + row * width * stride
            plane[first:first + width] = values[begin:begin + width * stride:stride][:width]
    image.tiles += 1


def read_exr(path):
    """Rows of R, G, B of an OpenEXR file of these channels as float32, in blocks of 16 rows that zlib has packed:
    openexr.com, "File Layout" and its ZIP_COMPRESSION."""
    with open(path, "rb") as file:
        data = file.read()
    attributes, position = parse_exr_header(data)
    left, top, right, bottom = struct.unpack("<4i", attributes["dataWindow"][1])
    assert attributes["compression"][1] == b"\3" and attributes["channels"][1].count(b"\2\0\0\0") == 3
    width, height = right - left + 1, bottom - top + 1
    rows = []
    for block in range((height + 15) // 16):
        begin, = struct.unpack_from("<Q", data, position + 8 * block)
        size, = struct.unpack_from("<i", data, begin + 4)
        count = min(16, height - 16 * block)
        raw = data[begin + 8:begin + 8 + size]
        if size < count * width * 12:
            sums = list(zlib.decompress(raw))  # each byte is the difference to the one before, plus 128
            for i in range(1, len(sums)):
                sums[i] = (sums[i - 1] + sums[i] - 128) % 256
            raw = bytearray(len(sums))
            half = (len(sums) + 1) // 2
            raw[0::2], raw[1::2] = sums[:half], sums[half:]
        for row in range(count):
            blue, green, red = (struct.unpack_from(f"<{width}f", raw, 4 * width * (3 * row + plane))
                                for plane in range(3))
            rows.append([value for pixel in zip(red, green, blue) for value in pixel])
    return rows


class Viewer:
    """Listens, and does with each connection what `serve` does with it."""

    def __init__(self, test, serve, address=("127.0.0.1", 0)):
        self.listener = socket.create_server(address)
        self.listener.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 1 << 16)  # of its connections
        self.address = "127.0.0.1:%d" % self.listener.getsockname()[1]
        self.serve, self.connections, self.data = serve, 0, b""
        self.thread = threading.Thread(target=self.run, daemon=True)
        self.thread.start()
        test.addCleanup(self.close)

    def run(self):
        while True:
            try:
                connection, _ = self.listener.accept()
            except OSError:
                return
            self.connections += 1
            with connection:
                self.serve(self, connection)

    def close(self):
        if self.listener.fileno() >= 0:
            self.listener.shutdown(socket.SHUT_RDWR)
            self.thread.join()
            self.listener.close()

    def all_data(self):
        self.close()
        return self.data


def read_all(viewer, connection):
    while part := connection.recv(1 << 20):
        viewer.data += part


def read_slowly(viewer, connection):
    """As slowly as to be busy with the first picture, when the rendering is done."""
    while part := connection.recv(1 << 15):
        viewer.data += part
        time.sleep(0.002)


def leave(_, connection):
    connection.recv(100_000, socket.MSG_WAITALL)


def free_address():
    with socket.create_server(("127.0.0.1", 0)) as listener:
        return "127.0.0.1:%d" % listener.getsockname()[1]


class Tev(CommandLineTest):
    slow = {"FAKE_PT_SAMPLE_MS": 40}

    def render(self, *options, size="40x30", code=0, **environment):
        """Returns the bytes of all files."""
        self.expect(code, "render", COURSEWORK, "-o", "a.png", "--size", size, *options, **environment)
        return {name: pathlib.Path(self.path(name)).read_bytes() for name in self.files()}

    def fake_rows(self, width, height):
        """The picture of the stand-in (fake_library.cpp)."""
        single = [struct.unpack("f", struct.pack("f", value))[0]
                  for value in (x / (width - 1) for x in range(width))]
        green = [struct.unpack("f", struct.pack("f", y / (height - 1)))[0] for y in range(height)]
        return [[value for x in range(width) for value in (single[x], green[y], 2.0)] for y in range(height)]

    def test_the_picture_arrives(self):
        viewer = Viewer(self, read_all)
        self.render("--tev", viewer.address, "--spp", "2", size="300x270")
        self.assertEqual(self.errors, "")
        images = parse(viewer.all_data())
        self.assertEqual(list(images), ["pt: a.png"])
        self.assertEqual(images["pt: a.png"].rows(), self.fake_rows(300, 270))
        self.assertEqual(images["pt: a.png"].tiles, 4)
        self.assertEqual(viewer.connections, 1)

    def test_pictures_come_meanwhile(self):
        """The rendering ends only when two pictures and the beginning of a third have come."""
        seen = threading.Event()

        def serve(viewer, connection):
            while part := connection.recv(1 << 16):
                viewer.data += part
                if len(viewer.data) > 2 * 12 * 40 * 30 + 1000:
                    seen.set()

        viewer = Viewer(self, serve)
        process = self.start("render", COURSEWORK, "-o", "a.png", "--size", "40x30", "--spp", "1000000", "--tev",
                             viewer.address, **self.slow)
        self.assertTrue(seen.wait(PATIENCE))
        process.terminate()
        process.communicate()
        self.assertEqual(process.returncode, 143)
        images = parse(viewer.all_data())
        self.assertEqual(images["pt: a.png"].rows(), self.fake_rows(40, 30))
        self.assertGreater(images["pt: a.png"].tiles, 2)

    def test_a_limit_of_time_and_a_checkpoint(self):
        for options in [], ["--resume"]:
            viewer = Viewer(self, read_all)
            code = self.run_pt("render", COURSEWORK, "-o", "a.png", "--size", "40x30", "--tev", viewer.address, "--spp",
                               "1000000", "--time", "0.05", "--checkpoint", "c.ptfilm", *options, FAKE_PT_SAMPLE_MS=5)
            self.assertEqual(code, 75)
            self.assertEqual(parse(viewer.all_data())["pt: a.png"].rows(), self.fake_rows(40, 30))

    def test_a_watched_scene(self):
        """Each picture comes, over one connection."""
        pictures = threading.Semaphore(0)

        def serve(viewer, connection):
            while part := connection.recv(1 << 16):
                viewer.data += part
                if viewer.data.endswith(last_value):
                    pictures.release()

        last_value = struct.pack("<3f", 1, 1, 2)
        viewer = Viewer(self, serve)
        with open(COURSEWORK, encoding="utf-8") as file:
            scene = file.read()
        self.write("s.json", scene)
        process = self.start("render", "s.json", "-o", "a.png", "--size", "4x3", "--watch", "-q", "--tev",
                             viewer.address)
        for number in range(2):
            self.assertTrue(pictures.acquire(timeout=PATIENCE))
            self.write("s.json", scene + "\n" * (number + 1))
        process.terminate()
        _, errors = process.communicate()
        self.assertEqual((process.returncode, errors), (0, ""))
        images = parse(viewer.all_data())
        self.assertEqual(images["pt: a.png"].rows(), self.fake_rows(4, 3))
        self.assertEqual(viewer.connections, 1)

    def test_no_viewer_of_any_kind_changes_or_fails_anything(self):
        wanted = self.render("--spp", "30", size="%dx%d" % LARGE, **self.slow)
        end = threading.Event()
        left = "it has closed the connection|Connection reset by peer|Broken pipe"
        for name, serve, complaint in (("absent", None, "Connection refused"),
                                       ("never reads", lambda *_: end.wait(), "it does not answer"),
                                       ("reads slowly", read_slowly, None), ("leaves", leave, left),
                                       ("reads all", read_all, None)):
            with self.subTest(viewer=name):
                viewer = Viewer(self, serve) if serve else None
                address = viewer.address if viewer else free_address()
                found = self.render("--spp", "30", "--tev", address, size="%dx%d" % LARGE, **self.slow)
                end.set()
                self.assertEqual(found, wanted)
                if serve is read_slowly and self.errors:  # as slowly, on a busy machine, as to be given up
                    complaint = "it does not answer"
                if complaint:
                    self.assertRegex(self.errors, rf"^pt: no pictures for tev at {address}: ({complaint})\n$")
                else:
                    self.assertEqual(self.errors, "")
                    image = parse(viewer.all_data())["pt: a.png"]
                    self.assertEqual(image.rows(), self.fake_rows(*LARGE))
                end.clear()

    def test_a_viewer_that_comes_later_and_one_that_comes_back(self):
        """It is looked for again, quietly, and gets the whole picture."""
        pictures = threading.Semaphore(0)
        size = 12 * 40 * 30

        def serve(viewer, connection):
            viewer.data = connection.recv(size, socket.MSG_WAITALL)  # a picture, and then it leaves
            pictures.release()

        with socket.create_server(("127.0.0.1", 0)) as listener:
            address = "127.0.0.1:%d" % listener.getsockname()[1]
        process = self.start("render", COURSEWORK, "-o", "a.png", "--size", "40x30", "--spp", "1000000", "--tev",
                             address, **self.slow)
        self.assertIn("Connection refused", process.stderr.readline())
        viewer = Viewer(self, serve, ("127.0.0.1", int(address.split(":")[1])))
        for _ in range(2):
            self.assertTrue(pictures.acquire(timeout=PATIENCE))
        process.terminate()
        _, errors = process.communicate()
        self.assertNotIn("tev", errors)
        self.assertGreaterEqual(viewer.connections, 2)
        self.assertEqual(viewer.data[4], CREATE_IMAGE)

    def test_frames_have_names(self):
        self.write("s.json", '{"film": {"width": 4, "height": 4}, "animation": {"camera.vertical_fov": '
                             '[[0, 40], [9, 50]]}, "camera": {"position": [0, 0, 1], '
                             '"look_at": [0, 0, 0]}}')
        viewer = Viewer(self, read_all)
        self.expect(0, "render", "s.json", "--frames", "7-9", "-o", "f-##.png", "--tev", viewer.address, "-q",
                    FAKE_PT_SAMPLE_MS=5)
        images = parse(viewer.all_data())
        self.assertIn("pt: f-09.png", images)  # those before may have been passed over by a busy viewer
        self.assertLessEqual(set(images), {"pt: f-07.png", "pt: f-08.png", "pt: f-09.png"})
        self.assertEqual(images["pt: f-09.png"].rows(), self.fake_rows(4, 4))

    def test_a_crop_is_where_it_is_in_the_picture(self):
        viewer = Viewer(self, read_all)
        self.render("--tev", viewer.address, "--crop", "10,5,20,15", "--piece-rows", "4")
        image = parse(viewer.all_data())["pt: a.png"]
        whole = self.fake_rows(40, 30)
        for y, row in enumerate(image.rows()):
            inside = range(3 * 10, 3 * 30) if 5 <= y < 20 else []
            self.assertEqual(row, [whole[y][x] if x in inside else None for x in range(120)])

    def test_the_default_and_wrong_addresses(self):
        self.render("--tev")  # whether or not anybody listens there
        self.assertRegex(self.errors, r"^$|^pt: no pictures for tev at 127\.0\.0\.1:14158: ")
        for address in "127.0.0.1", "127.0.0.1:", ":14158", "host:0", "host:65536", "host:tev", "a:b:1", "s.json":
            self.render(f"--tev={address}", code=2)
            self.assertIn("--tev: must be HOST:PORT like 127.0.0.1:14158, or stand last or before another option, "
                          f'is "{address}"', self.errors)
        self.render("--tev", "no-such-host.invalid:1")
        self.assertIn("no pictures for tev at no-such-host.invalid:1: ", self.errors)
        self.render("--tev", "[::1]:1")
        self.assertIn("no pictures for tev at [::1]:1: ", self.errors)


class RealDevice(CommandLineTest):
    program = PT

    def test_pixels_are_those_of_the_files(self):
        viewer = Viewer(self, read_all)
        scene = os.path.join(SCENES, "first.json")
        self.expect(0, "render", scene, "--size", "40x30", "--spp", "20", "-o", "a.exr", "--standard-error", "e.exr",
                    "--tev", viewer.address)
        image = parse(viewer.all_data())["pt: a.exr"]
        self.assertEqual(image.size, (40, 30))
        for name, layer in ("a", ""), ("e", "standard_error."):
            channels = [layer + channel for channel in "RGB"]
            self.assertEqual(image.rows(channels), read_exr(self.path(f"{name}.exr")), name)
            self.assertGreater(len(set(image.values[layer + "R"])), 100)


if __name__ == "__main__":
    main()
