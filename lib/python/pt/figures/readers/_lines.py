from __future__ import annotations

import bz2
import gzip
import lzma
import shutil
import sys
import tempfile
import zlib
from collections.abc import Callable
from pathlib import Path
from typing import IO, Any, Final, cast

import numpy as np
import numpy.typing as npt

from pt.figures._errors import DataError, module

STANDARD_INPUT: Final = "-"
PACKED_ENDINGS: Final = (".gz", ".zst", ".xz", ".bz2")
BLOCK_BYTES: Final = 1 << 20
LONGEST_LINE: Final = 1 << 24  # bytes; a file with a longer line is not text


def _open_zstd(file: IO[bytes]) -> Any:
    zstandard = module("zstandard", "a file that is packed by zstd")
    return zstandard.ZstdDecompressor().stream_reader(file, read_across_frames=True)


_UNPACK: Final[dict[bytes, Callable[[IO[bytes]], Any]]] = {
    b"\x1f\x8b": lambda file: gzip.GzipFile(fileobj=file), b"\x28\xb5\x2f\xfd": _open_zstd,
    b"\xfd7zXZ\0": lzma.LZMAFile, b"BZh": bz2.BZ2File}


class Lines:
    """A file, unpacked while it is read. `number` is the number of the last line read."""

    def __init__(self, path: str) -> None:
        self.path = path
        self.name = "standard input" if path == STANDARD_INPUT else path
        try:
            self._raw: IO[bytes] = sys.stdin.buffer if path == STANDARD_INPUT else open(path, "rb")
        except OSError as error:
            raise DataError(f"{self.name}: {error.strerror}") from None
        self.is_file = self._raw.seekable() and path != STANDARD_INPUT
        if not self.is_file:
            pipe, self._raw = self._raw, tempfile.TemporaryFile()
            shutil.copyfileobj(pipe, self._raw)
            if path != STANDARD_INPUT:
                pipe.close()
        self._begin()

    def _begin(self) -> None:
        self._raw.seek(0)
        start = self._raw.read(6)
        self._raw.seek(0)
        unpack = next((function for magic, function in _UNPACK.items() if start.startswith(magic)), None)
        self.is_packed = unpack is not None
        self._file = self._raw if unpack is None else unpack(self._raw)
        self._buffer = b""
        self._next = 0
        self._passed = 0
        self.number = 0
        self.is_ended = True
        start = self.peek(3)
        if start[:2] in (b"\xff\xfe", b"\xfe\xff"):
            raise DataError(f"{self.name}: is UTF-16: save it as UTF-8")
        self._next = 3 if start == b"\xef\xbb\xbf" else 0

    def close(self) -> None:
        self._raw.close()

    def __del__(self) -> None:  # frames keep the file open
        if hasattr(self, "_raw") and self._raw is not sys.stdin.buffer:
            self.close()

    def _read(self, size: int) -> bytes:
        try:
            return cast(bytes, self._file.read(size))
        except Exception as error:
            is_of_packers = isinstance(error, (EOFError, OSError, zlib.error, lzma.LZMAError))
            if not is_of_packers and type(error).__name__ != "ZstdError":
                raise
            raise DataError(f"{self.name}: after {self.byte:,} unpacked bytes: {error}: the file is damaged or was cut "
                            "short") from None

    def _fill(self) -> bool:
        more = self._read(BLOCK_BYTES)
        self._buffer = self._buffer[self._next:] + more
        self._passed += self._next
        self._next = 0
        return bool(more)

    @property
    def byte(self) -> int:
        return self._passed + self._next

    def peek(self, size: int) -> bytes:
        while len(self._buffer) - self._next < size and self._fill():
            pass
        return self._buffer[self._next:self._next + size]

    def take(self, size: int) -> bytes:
        taken = bytearray(self._buffer[self._next:self._next + size])
        self._next += len(taken)
        while len(taken) < size and (more := self._read(min(size - len(taken), BLOCK_BYTES))):
            taken += more
            self._passed += len(more)
        return bytes(taken) if size < BLOCK_BYTES else cast(bytes, taken)

    def line(self) -> str | None:
        while (end := self._buffer.find(b"\n", self._next)) < 0 and self._fill():
            self._check_length()
        if self._next == len(self._buffer):
            return None
        self.is_ended = end >= 0
        line = self._buffer[self._next:end if self.is_ended else len(self._buffer)]
        self._next += len(line) + self.is_ended
        self.number += 1
        return line.decode("utf-8", "replace").rstrip("\r")

    def _check_length(self) -> None:
        if len(self._buffer) > LONGEST_LINE:
            raise DataError(f"{self.name}:{self.number + 1}: the line is longer than {LONGEST_LINE:,} bytes: this is no text")

    def text(self) -> bytes:
        blocks = []
        while (block := self.block())[1]:
            blocks.append(block[0])
        return b"".join(blocks)

    def block(self, most: int = sys.maxsize) -> tuple[bytes, int]:
        """Returns up to `most` whole lines from the buffer, and their count, which is 0 at the end."""
        if len(self._buffer) - self._next < BLOCK_BYTES:
            self._fill()
        while (end := self._buffer.rfind(b"\n", self._next) + 1) == 0 and self._fill():
            self._check_length()
        self.is_ended = end > 0 or self._next == len(self._buffer)
        end, count = _after_lines(self._buffer, self._next, end or len(self._buffer), most)
        data = self._buffer[self._next:end]
        self._next = end
        count += not self.is_ended
        self.number += count
        return data, count

    def skip(self, count: int) -> int:
        passed = 0
        while passed < count and (lines := self.block(count - passed)[1]):
            passed += lines
        return passed

    def place(self) -> tuple[int, int]:
        return self.byte, self.number

    def go_to(self, place: tuple[int, int]) -> None:
        """Going back in a packed file unpacks it again."""
        byte, number = place
        if byte != self.byte:
            if self.is_packed:
                if byte < self.byte:
                    self._begin()
                while self.byte < byte and self.take(min(byte - self.byte, BLOCK_BYTES)):
                    pass
            else:
                self._raw.seek(byte)
                self._buffer, self._next, self._passed = b"", 0, byte
        self.number = number

    def mapped(self, dtype: npt.DTypeLike, count: int) -> npt.NDArray[Any]:
        """Reads in place unless the file is packed."""
        size = np.dtype(dtype).itemsize
        if self.is_file and not self.is_packed:
            count = min(count, (Path(self.path).stat().st_size - self.byte) // size)
            if count:
                records = np.memmap(self.path, dtype, "r", self.byte, (count,))
                self.go_to((self.byte + count * size, self.number))
                return records
        data = self.take(count * size)
        return np.frombuffer(data, dtype, len(data) // size)

    def refuse(self, what: str) -> DataError:
        return DataError(f"{self.name}:{self.number}: {what}")


def _after_lines(data: bytes, start: int, end: int, most: int) -> tuple[int, int]:
    count = 0
    while count < most and start < end:
        stop = min(end, start + 64 * (most - count))
        is_end = np.frombuffer(data, np.uint8, stop - start, start) == 10
        found = int(np.count_nonzero(is_end))
        if count + found >= most:
            return start + int(np.flatnonzero(is_end)[most - count - 1]) + 1, most
        count, start = count + found, stop
    return start, count


def ending(path: str) -> str:
    """In lower case, without a packer's ending such as .gz."""
    name = Path(path.lower())
    return Path(name.stem).suffix if name.suffix in PACKED_ENDINGS else name.suffix
