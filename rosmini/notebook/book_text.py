"""What differs from machine to machine in the text that a cell prints, and what the book has instead."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from rosmini.packages import own_dirs

from .places import SHARE

if TYPE_CHECKING:
    from pathlib import Path

WORKSPACE = "~/catkin_ws"
"""Where the notebook's own package is, in the book."""

PID = "4242"
PING = "0.42ms"

_PID = re.compile(r"(?<=\bPid: )\d+|(?<=\bpid \[)\d+")
_PING = re.compile(r"(?<=time=)\d+\.\d+ms|(?<=ping average: )\d+\.\d+ms")


def book_text(text: str, workspace: Path) -> str:
    """Return a text with the paths, process numbers and ping times of the book; ``workspace`` is the notebook's."""
    for folder, shown in ((workspace, WORKSPACE), *((folder, SHARE) for folder in own_dirs())):
        text = text.replace(str(folder), shown)
    return _PING.sub(PING, _PID.sub(PID, text))
