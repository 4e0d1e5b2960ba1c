from __future__ import annotations

import io
import pathlib
import tempfile
from typing import Any, Final

import numpy as np
import numpy.typing as npt

from pt._files import write_atomically
from pt.figures._errors import module

RATE: Final = 25  # pictures a second
MOVIES: Final = (".gif", ".mp4")


def check_movie(path: str) -> None:
    module("PIL.Image" if path.lower().endswith(".gif") else "imageio_ffmpeg", f"-o {path}")


def write_movie(path: str, pictures: list[npt.NDArray[np.uint8]]) -> None:
    data = _gif(pictures) if path.lower().endswith(".gif") else _mp4(pictures)
    write_atomically(path, lambda file: file.write(data))


def _gif(pictures: list[npt.NDArray[np.uint8]]) -> bytes:
    image = module("PIL.Image", "GIF")
    first, *others = [image.fromarray(np.ascontiguousarray(each[:, :, :3])) for each in pictures]
    buffer = io.BytesIO()
    first.save(buffer, "GIF", save_all=True, append_images=others, duration=1000 // RATE, loop=0)
    return buffer.getvalue()


def _mp4(pictures: list[npt.NDArray[np.uint8]]) -> bytes:
    height, width = (side // 2 * 2 for side in pictures[0].shape[:2])
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder, "movie.mp4")
        writer: Any = module("imageio_ffmpeg", "MP4").write_frames(str(path), (width, height), fps=RATE, quality=8, macro_block_size=2)
        writer.send(None)
        for each in pictures:
            writer.send(np.ascontiguousarray(each[:height, :width, :3]))
        writer.close()
        return path.read_bytes()
