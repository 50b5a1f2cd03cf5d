"""Errors of launch files."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from rosmini.core.markup import MarkupError

MAX_SHOWN = 50
"""Maximum number of missing things that an error lists."""


@dataclass(frozen=True)
class Place:
    """A position in a file: its path, and a line counted from 1."""

    file: str
    line: int

    def __str__(self) -> str:
        return f"{self.file}:{self.line}"


@dataclass(frozen=True)
class Missing:
    """A missing package, file, argument or executable that a launch file needs."""

    kind: str
    name: str
    place: Place
    message: str = ""

    def __str__(self) -> str:
        return self.message or f"there is no {self.kind} {self.name!r}"


class LaunchError(MarkupError):
    """A launch file is invalid at ``file``, line ``line``; ``missing`` lists what was not found, if anything."""

    def __init__(
        self, message: str, file: str | Path | None = None, line: int | None = None, missing: Sequence[Missing] = ()
    ) -> None:
        super().__init__(message, file, line)
        self.missing = tuple(missing)


def not_there(missing: Sequence[Missing]) -> LaunchError:
    """Return the error that lists all missing things with their places."""
    if len(missing) == 1:
        (only,) = missing
        return LaunchError(str(only), only.place.file, only.place.line, missing)
    kinds: dict[str, list[Missing]] = {}
    for each in missing:
        kinds.setdefault(each.kind, []).append(each)
    lines = [f"{len(missing)} things are missing:"]
    for kind, found in kinds.items():
        lines.append(f"  {kind}s:" if len(found) > 1 else f"  {kind}:")
        lines += [f"    {each.name}  ({each.place})" for each in found[:MAX_SHOWN]]
        if len(found) > MAX_SHOWN:
            lines.append(f"    and {len(found) - MAX_SHOWN} more")
    hints = dict.fromkeys(line for each in missing for line in str(each).splitlines() if "did you mean" in line)
    return LaunchError("\n".join([*lines, *list(hints)[:5]]), missing=missing)
