"""How a rendering can fail."""

from __future__ import annotations

from pt._enums import Result


class FarmError(RuntimeError):
    """The picture cannot be made; with what workers said. What came back before is in the checkpoint.

    result: the library's, of the worker's error that is to blame; ERROR_INTERNAL if there is none."""

    def __init__(self, message: str, result: int = Result.ERROR_INTERNAL) -> None:
        super().__init__(message)
        self.result = Result(result)
