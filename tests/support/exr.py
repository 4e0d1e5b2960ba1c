import struct
import zlib


def parse_exr_header(data):
    assert data[:4] == b"\x76\x2f\x31\x01"
    attributes, position = {}, 8
    while data[position] != 0:
        name_end = data.index(b"\0", position)
        type_end = data.index(b"\0", name_end + 1)
        size, = struct.unpack("<i", data[type_end + 1:type_end + 5])
        body = data[type_end + 5:type_end + 5 + size]
        attributes[data[position:name_end].decode()] = (data[name_end + 1:type_end].decode(), body)
        position = type_end + 5 + size
    return attributes, position + 1


def read_exr_attributes(path):
    with open(path, "rb") as file:
        return parse_exr_header(file.read())[0]


def read_exr_blocks(path):
    with open(path, "rb") as file:
        data = file.read()
    table = parse_exr_header(data)[1]
    first_block, = struct.unpack("<Q", data[table:table + 8])
    return data[first_block:]


def read_exr_channels(path):
    """Reads ZIP-compressed scan lines ("OpenEXR File Layout"). Returns a row of numbers for each channel."""
    with open(path, "rb") as file:
        data = file.read()
    attributes, position = parse_exr_header(data)
    assert attributes["compression"][1] == b"\3" and attributes["lineOrder"][1] == b"\0"
    left, top, right, bottom = struct.unpack("<4i", attributes["dataWindow"][1])
    width, height = right - left + 1, bottom - top + 1
    channels, body = [], attributes["channels"][1]
    while body != b"\0":
        name, body = body.split(b"\0", 1)
        channels.append((name.decode(), {0: "I", 2: "f"}[struct.unpack("<i", body[:4])[0]]))
        body = body[16:]
    rows = {name: [] for name, _ in channels}
    for first in range(0, height, 16):
        offset, = struct.unpack("<Q", data[position + first // 2:position + first // 2 + 8])
        _, size = struct.unpack("<2i", data[offset:offset + 8])
        block = data[offset + 8:offset + 8 + size]
        line_count = min(16, height - first)
        if size < 4 * width * len(channels) * line_count:
            deltas = list(zlib.decompress(block))
            for i in range(1, len(deltas)):
                deltas[i] = (deltas[i - 1] + deltas[i] - 128) % 256
            block = bytearray(len(deltas))
            block[::2], block[1::2] = deltas[:(len(deltas) + 1) // 2], deltas[(len(deltas) + 1) // 2:]
        for line in range(line_count):
            for index, (name, kind) in enumerate(channels):
                begin = 4 * width * (line * len(channels) + index)
                rows[name].append(list(struct.unpack(f"<{width}{kind}", block[begin:begin + 4 * width])))
    return rows
