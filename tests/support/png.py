"""Reads PNG files (ISO 15948)."""

import struct
import zlib


def png_chunks(data):
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    position = 8
    while position < len(data):
        length, kind = struct.unpack(">I4s", data[position:position + 8])
        assert data[position + 8 + length:][:4] == struct.pack(">I", zlib.crc32(data[position + 4:position + 8 + length]))
        yield kind.decode(), data[position + 8:position + 8 + length]
        position += 12 + length


def parse_png(data):
    pixels = b""
    for kind, body in png_chunks(data):
        if kind == "IHDR":
            width, height, depth, color = struct.unpack(">IIBB", body[:10])
            assert depth == 8 and color in (2, 6)
            step = {2: 3, 6: 4}[color]
        elif kind == "IDAT":
            pixels += body
    lines, stride, above, image = zlib.decompress(pixels), step * width, bytes(step * width), []
    for y in range(height):
        kind, *line = lines[y * (stride + 1):(y + 1) * (stride + 1)]
        for x in range(stride):
            left = line[x - step] if x >= step else 0
            corner = above[x - step] if x >= step else 0
            guesses = (left, above[x], corner)
            paeth = min(guesses, key=lambda g: abs(left + above[x] - corner - g))
            line[x] = (line[x] + (0, left, above[x], (left + above[x]) // 2, paeth)[kind]) % 256
        above = line
        image.append(line)
    return width, height, image


def read_png(path):
    with open(path, "rb") as file:
        return parse_png(file.read())
