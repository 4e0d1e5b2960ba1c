"""The picture so far in the image viewer tev: its packets (src/Ipc.cpp of tev), each with its length in front."""

from __future__ import annotations

import socket
import struct

import numpy as np

from pt._film import Film

CREATE, UPDATE = 4, 6  # types of packets: a new image, and pixels of several channels


class Viewer:
    """One that is not there, or leaves, is looked for again each time; nothing waits for it for more than a second."""

    def __init__(self, address: str) -> None:
        host, _, port = (address or "127.0.0.1:14158").rpartition(":")
        self._address = host, int(port)

    def show(self, name: str, film: Film) -> bool:
        pixels = np.ascontiguousarray(film.readback(), np.float32)
        height, width, _ = pixels.shape
        title, channels = name.encode() + b"\0", b"R\0G\0B\0"
        create = struct.pack("<Bb", CREATE, 1) + title + struct.pack("<3i", width, height, 3) + channels
        update = (struct.pack("<Bb", UPDATE, 0) + title + struct.pack("<i", 3) + channels +
                  struct.pack("<4i6q", 0, 0, width, height, 0, 1, 2, 3, 3, 3) + pixels.tobytes())
        try:
            with socket.create_connection(self._address, 1) as connection:
                for packet in (create, update):
                    connection.sendall(struct.pack("<I", len(packet) + 4) + packet)
        except OSError:
            return False
        return True
