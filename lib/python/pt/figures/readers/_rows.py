"""Rows of text as columns. pandas reads large blocks. Small blocks, and blocks with a bad row, are read row by row."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Final

import numpy as np

from pt._fit import Array
from pt.figures._errors import DataError, module
from pt.figures._columns import LABELS
from pt.figures.readers._lines import Lines

_TABLE: Final = ""  # key of positions stored as one table of three columns
FEW_BYTES: Final = 1 << 16
MISSING: Final = ("", "nan", "NaN", "NAN", "-nan", "NA", "N/A", "n/a", "null", "None", "-")
_WHOLE: Final = re.compile(r"[+-]?\d+")
_EXPONENT: Final = re.compile(r"([\d.])(?:[dD]|\*\^)([+-]?\d)")


@dataclass
class Layout:
    """The rules of a row.

    positions  columns that must be numbers
    separator  "" for blanks
    least      least number of fields in a row; fields without a name are ignored
    is_table   whether the number of rows is unknown. Blank lines and comments (#) are then skipped, and columns except
               positions may mix numbers and words
    rows       name of rows in messages
    """

    names: list[str]
    positions: list[str] = field(default_factory=list)
    separator: str = ""
    decimal: str = "."
    least: int | None = None
    is_table: bool = False
    rows: str = "particles"


def number(text: str, decimal: str = ".") -> float:
    """Also reads exponents of Fortran (1.5D+02) and Mathematica (1.5*^2). A missing value is NaN. Raises ValueError."""
    if text in MISSING:
        return np.nan
    if "_" in text:
        raise ValueError(text)
    return float(_EXPONENT.sub(r"\1e\2", text if decimal == "." else text.replace(decimal, ".")))


def is_number(text: str, decimal: str = ".") -> bool:
    try:
        number(text, decimal)
    except ValueError:
        return False
    return True


def are_numbers(words: Iterable[str]) -> bool:
    return all(word not in MISSING and is_number(word) for word in words)


def is_comment(line: str) -> bool:
    return line.lstrip().startswith(("#", "//"))


def fields_of(line: str, separator: str) -> list[str]:
    if not separator:
        return [word.strip('"') for word in line.split()]
    if '"' not in line:
        return [word.strip() for word in line.split(separator)]
    return [word.strip() for word in next(csv.reader([line], delimiter=separator, skipinitialspace=True, strict=True))]


class Rows:
    def __init__(self, lines: Lines, layout: Layout) -> None:
        self.lines = lines
        self.layout = layout
        self.count = 0
        self.notes: list[str] = []
        self._columns: dict[str, Array] = {}
        self._are_words: list[bool] = []

    def read(self, count: int | None = None, marks: re.Pattern[bytes] | None = None) -> None:
        """Text that matches `marks` counts as blank."""
        lines = self.lines
        while count is None or self.count < count:
            first = lines.number + 1
            data, height = lines.block() if count is None else lines.block(count - self.count)
            if not height:
                if count is not None:
                    raise lines.refuse(f"the file ends after {self.count:,} of {count:,} {self.layout.rows}: it was cut short")
                return
            self.add(data if marks is None else marks.sub(b" ", data), height, first)
            if not lines.is_ended and not data[-1:].isspace():
                self.notes.append("the last line does not end with a newline: its last number may be cut")

    def add(self, data: bytes, height: int, first: int) -> None:
        if not self._are_words:
            self._find_words(data)
        columns = self._by_pandas(data, height) if len(data) > FEW_BYTES else None
        if columns is None:
            columns = self._one_by_one(data, first)
        named = dict(zip(self.layout.names, columns))
        if len(self.layout.positions) == 3:
            named[_TABLE] = np.stack([named.pop(name) for name in self.layout.positions], axis=1)
        for key, piece in named.items():
            self._put(key, piece)
        self.count += len(columns[0])

    def _put(self, key: str, piece: Array) -> None:
        """Doubling the array is cheap, because the system allocates only pages that are written."""
        have, end = self._columns.get(key, piece[:0]), self.count + len(piece)
        kind = np.result_type(have, piece)
        if end > len(have) or kind != have.dtype:
            grown = np.empty((max(end, 2 * len(have)), *piece.shape[1:]), kind)
            grown[:self.count] = have[:self.count]
            self._columns[key] = have = grown
        have[self.count:end] = piece

    def columns(self) -> dict[str, Array]:
        result = {name: np.empty(0) for name in self.layout.names}
        for key, values in self._columns.items():
            result.update(zip(self.layout.positions, values[:self.count].T) if key == _TABLE else ((key, values[:self.count]),))
        return result

    def _find_words(self, data: bytes) -> None:
        """A column has words if its first field is no number and layout.positions lacks it."""
        layout = self.layout
        lines = (line.decode("utf-8", "replace") for line in io.BytesIO(data))
        first = next((line for line in lines if line.strip() and not (layout.is_table and is_comment(line))), "")
        fields = [word.strip('"') for word in first.rstrip("\r\n").split(layout.separator or None)]
        fields += [""] * len(layout.names)
        self._are_words = [name not in layout.positions and not is_number(word.strip(), layout.decimal)
                           for name, word in zip(layout.names, fields)]

    def _may_mix(self, name: str) -> bool:
        return name not in self.layout.positions and (self.layout.is_table or name.lower() in LABELS)

    def _by_pandas(self, data: bytes, height: int) -> list[Array] | None:
        """Returns None if the block may be bad: pandas fills up short rows and does not report line numbers."""
        layout = self.layout
        try:
            pandas = module("pandas", "fast reading of large text")
        except DataError as error:
            self.notes[:] = [*(note for note in self.notes if note != str(error)), str(error)]
            return None
        if layout.is_table and (data.startswith(b"#") or b"\n#" in data):
            data = re.sub(rb"(?m)^#.*\n?", b"", data)
            height = data.count(b"\n") + (not data.endswith(b"\n"))
        width = len(layout.names)
        try:
            frame = pandas.read_csv(
                io.BytesIO(data), header=None, sep=layout.separator or r"\s+", decimal=layout.decimal,
                skipinitialspace=True, quoting=csv.QUOTE_MINIMAL if layout.separator else csv.QUOTE_NONE,
                dtype={i: "category" for i in range(width) if self._are_words[i]}, keep_default_na=False,
                na_values={i: list(MISSING) for i in range(width) if not self._are_words[i]}, low_memory=False,
                encoding_errors="replace", engine="c",
                **({"float_precision": "round_trip"} if pandas.__version__ < "3" else {}))
        except (ValueError, OverflowError):
            return None
        may_skip = layout.is_table and b'"' not in data
        if frame.shape[1] != width or len(frame) > height or (len(frame) < height and not may_skip):
            return None
        columns: list[Array] = []
        for i, is_words in enumerate(self._are_words):
            if is_words:
                values = frame[i].cat
                words = np.array([str(word).strip() for word in values.categories] + [""])
                columns.append(words[values.codes.to_numpy()])
            elif frame[i].dtype.kind not in "if":
                return None
            else:
                columns.append(frame[i].to_numpy(np.int64 if frame[i].dtype.kind == "i" else np.float64))
        last = columns[-1]
        return columns if self._has_all_fields(last == "" if last.dtype.kind == "U" else np.isnan(last), data, height) else None

    def _has_all_fields(self, is_missing: Array, data: bytes, height: int) -> bool:
        """Whether no row lacks its last field. For pandas, such a field is a missing value."""
        rows = np.flatnonzero(is_missing)
        if not len(rows) or len(self.layout.names) == 1:
            return True
        lines = data.split(b"\n")[:height]
        if len(lines) != len(is_missing):
            lines = [line for line in lines if line.strip()]
        return all(len(fields_of(lines[row].decode("utf-8", "replace"), self.layout.separator)) == len(self.layout.names)
                   for row in rows)

    def _one_by_one(self, data: bytes, first: int) -> list[Array]:
        layout = self.layout
        rows, places = [], []
        text = data.decode("utf-8", "replace")
        for place, line in enumerate(text.removesuffix("\n").split("\n"), first):
            if layout.is_table and (not line.strip() or is_comment(line)):
                continue
            try:
                row = fields_of(line, layout.separator)
            except csv.Error:
                raise self._error(place, f"{shown(line)}: a quoted field must end in the line in which it begins") from None
            rows.append(self._complete(row, place, line))
            places.append(place)
        return [self._typed(i, [row[i] for row in rows], places) for i in range(len(layout.names))]

    def _complete(self, row: list[str], place: int, line: str) -> list[str]:
        width = len(self.layout.names)
        if self.layout.least is not None and len(row) >= self.layout.least:
            return (row + [""] * width)[:width]
        if len(row) == width + 1 and self.layout.separator and not row[-1]:
            return row[:-1]
        if len(row) != width:
            expected = f"must have {self.layout.least or width}" + (" or more" if self.layout.least else "")
            raise self._error(place, f"{shown(line)}: has {len(row)} values, {expected}")
        return row

    def _typed(self, column: int, words: list[str], places: list[int]) -> Array:
        name = self.layout.names[column]
        if self._are_words[column]:
            return np.array(words, str)
        if all(len(word) < 19 and _WHOLE.fullmatch(word) for word in words):
            return np.array([int(word) for word in words], np.int64)
        values = np.empty(len(words))
        for i, word in enumerate(words):
            try:
                values[i] = number(word, self.layout.decimal)
            except ValueError:
                if not self._may_mix(name):
                    raise self._error(places[i], f"{name} = {word!r}: must be a number") from None
                if name.lower() not in LABELS:
                    self.notes.append(f"column {name} is taken for words: {word!r} in line {places[i]} is no number")
                return np.array(words, str)
        return values

    def _error(self, place: int, what: str) -> DataError:
        return DataError(f"{self.lines.name}:{place}: {what}")


def shown(line: str, most: int = 60) -> str:
    line = line.strip()
    return repr(line if len(line) <= most else line[:most] + "...")
