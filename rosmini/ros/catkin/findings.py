"""What is wrong with a package or a workspace, and where."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from rosmini.core.errors import RosminiError


class CatkinError(RosminiError):
    """A workspace cannot be built, or a package cannot be made."""


@dataclass(frozen=True)
class Finding:
    """One thing that is amiss: what, in which file and line, and what to do.

    An error keeps its package from being built; a warning does not.
    """

    message: str
    file: Path
    line: int | None = None
    is_error: bool = True

    def __str__(self) -> str:
        where = f"{self.file}:{self.line}" if self.line is not None else str(self.file)
        return f"{where}: {'error' if self.is_error else 'warning'}: {self.message}"


def warning(message: str, file: Path, line: int | None = None) -> Finding:
    """A finding that keeps nothing from being built."""
    return Finding(message, file, line, is_error=False)
