"""Replace text in outputs and errors of a cell that differs between machines by the text of the book."""

from __future__ import annotations

import re
import sys
from typing import TYPE_CHECKING, Any

from rosmini.core.errors import RosminiError

if TYPE_CHECKING:
    from collections.abc import Callable

    from .places import Places

PID = "4242"

OWN_TOOLS = f"{sys.executable} -m rosmini "
"""Prefix of rosmini's command lines, which ROS's do not have."""

_PID = re.compile(r"(?<=\bPid: )\d+|(?<=\bpid \[)\d+")


def book_text(text: str, places: Places) -> str:
    """Return a text with the paths, command lines and process numbers of the book."""
    return _PID.sub(PID, places.shown(text.replace(OWN_TOOLS, "")))


class BookErrors:
    """A context that rewrites the texts of rosmini's errors, and of their causes, when they leave it."""

    def __init__(self, rewrite: Callable[[str], str]) -> None:
        self._rewrite = rewrite

    def __enter__(self) -> None:
        pass

    def __exit__(self, kind: object, error: BaseException | None, trace: object) -> None:
        while isinstance(error, RosminiError):
            error.args = tuple(map(self._rewritten, error.args))
            vars(error).update({name: self._rewritten(value) for name, value in vars(error).items()})
            error = error.__cause__

    def _rewritten(self, value: Any) -> Any:
        return self._rewrite(value) if isinstance(value, str) else value
