"""Problems found in a package or a workspace, with their places."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from rosmini.core.errors import RosminiError


class CatkinError(RosminiError):
    """A workspace cannot be built, or a package cannot be created."""


@dataclass(frozen=True)
class Finding:
    """A problem: its description, file and line, and how to fix it.

    An error prevents its package from being built; a warning does not.
    """

    message: str
    file: Path
    line: int | None = None
    is_error: bool = True

    def __str__(self) -> str:
        where = f"{self.file}:{self.line}" if self.line is not None else str(self.file)
        return f"{where}: {'error' if self.is_error else 'warning'}: {self.message}"


def warning(message: str, file: Path, line: int | None = None) -> Finding:
    """Return a finding that does not prevent a build."""
    return Finding(message, file, line, is_error=False)
