"""What can be wrong with a parameter file."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rosmini.errors import ParameterError

if TYPE_CHECKING:
    from pathlib import Path


class RosParamException(ParameterError):
    """A parameter file, or a value in it, is wrong; ``file`` and ``line`` (from 1) say where, if known."""

    def __init__(self, message: str, file: str | Path | None = None, line: int | None = None) -> None:
        self.message = message
        self.file = None if file is None else str(file)
        self.line = line
        super().__init__(message, self.file, line)

    def __str__(self) -> str:
        place = ":".join(str(part) for part in (self.file, self.line) if part)
        return f"{place}: {self.message}" if place else self.message


class RosParamIOException(RosParamException):
    """The Parameter Server could not be reached."""
