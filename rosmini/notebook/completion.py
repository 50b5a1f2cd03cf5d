"""Completion of the words after ``%rosrun``."""

from __future__ import annotations

from typing import Any

from rosmini.core.errors import RosminiError
from rosmini.core.packages import PackageIndex


def complete(_shell: Any, event: Any) -> list[str]:
    """Return the packages, or the executables of the given package, that begin with the word."""
    before = event.text_until_cursor.lstrip().removeprefix("%").split()
    if event.text_until_cursor[-1:].isspace():
        before.append("")
    packages = PackageIndex()
    match before:
        case [_, start]:
            names = packages.names()
        case [_, package, start]:
            try:
                names = packages.executables(package)
            except RosminiError:
                return []
        case _:
            return []
    return [name for name in names if name.startswith(start)]
