from __future__ import annotations

import struct
import zlib
from typing import Final

import numpy as np
import numpy.typing as npt

EXR_ROWS: Final = 16


def encode_exr(radiance: npt.NDArray[np.float32]) -> bytes:
    """Encodes float32 R, G, B in blocks compressed by zip ("OpenEXR File Layout", openexr.com)."""
    height, width, _ = radiance.shape
    channels = b"".join(name + b"\0" + struct.pack("<iB3xii", 2, 0, 1, 1) for name in (b"B", b"G", b"R")) + b"\0"
    window = struct.pack("<4i", 0, 0, width - 1, height - 1)
    attributes = (("channels", "chlist", channels), ("compression", "compression", b"\3"), ("dataWindow", "box2i", window),
                  ("displayWindow", "box2i", window), ("lineOrder", "lineOrder", b"\0"),
                  ("pixelAspectRatio", "float", struct.pack("<f", 1.0)),
                  ("screenWindowCenter", "v2f", struct.pack("<2f", 0.0, 0.0)),
                  ("screenWindowWidth", "float", struct.pack("<f", 1.0)))
    header = struct.pack("<2i", 20000630, 2) + b"".join(
        name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(data)) + data
        for name, kind, data in attributes) + b"\0"
    blocks = []
    for row in range(0, height, EXR_ROWS):
        planes = np.ascontiguousarray(radiance[row:row + EXR_ROWS, :, ::-1].transpose(0, 2, 1), "<f4")
        data = planes.view(np.uint8).ravel()
        halves = np.concatenate([data[0::2], data[1::2]]).astype(np.int16)
        halves[1:] = halves[1:] - halves[:-1] + 128
        packed = zlib.compress((halves & 255).astype(np.uint8).tobytes(), 4)
        packed = packed if len(packed) < len(data) else data.tobytes()  # readers detect an uncompressed block by its size
        blocks.append(struct.pack("<2i", row, len(packed)) + packed)
    places = len(header) + 8 * len(blocks) + np.cumsum([0, *map(len, blocks[:-1])])
    return header + places.astype("<u8").tobytes() + b"".join(blocks)
