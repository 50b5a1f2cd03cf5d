"""Paths and other texts as the book shows them: ``~`` and ``/opt/ros/noetic/share`` on every machine.

A reader's files are in a temporary folder with a different name each time, and rosmini's own packages are where
pip put them. Outputs show both as on a robot, so that they are equal everywhere.
"""

from __future__ import annotations

import io
import os
import re
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any, TextIO

from rosmini.core.errors import RosminiError
from rosmini.core.packages import own_dirs

HOME = "~"
ROS = "/opt/ros/noetic"
"""Folder of ROS on a robot; the packages are in its folder ``share``."""

SHARE = f"{ROS}/share"

LISTS = ("CMAKE_PREFIX_PATH", "PYTHONPATH", "ROS_PACKAGE_PATH")
"""Environment variables that contain lists of folders."""

PID = "4242"

OWN_TOOLS = f"{sys.executable} -m rosmini "
"""Prefix of rosmini's command lines, which ROS's do not have."""

_PID = re.compile(r"(?<=\bPid: )\d+|(?<=\bpid \[)\d+")

_HOME_IN = re.compile(rf"(^|:=|=){re.escape(HOME)}(?=/|$)")
_SHARE_IN = re.compile(rf"(^|:=|=){re.escape(SHARE)}(?:/([^/:]+)|/?$|(?=/))")

_REPEATED = re.compile(rf"^([ ]*{re.escape(SHARE)})(?:\n\1)+$", re.MULTILINE)
"""Repeated lines of one folder: on a robot it is one folder, here there are several."""


class OutsideHome(RosminiError):
    """The path is outside the folders that a notebook's terminal may use."""


class Places:
    """Converts the paths of the home folder and of rosmini's packages to the book's form and back."""

    def __init__(self, home: Path) -> None:
        self.home = home.resolve()
        self.shares = tuple(each.resolve() for each in own_dirs())
        shown = [(HOME, self.home), *((SHARE, share) for share in self.shares)]
        found = sorted(
            ((str(real), name) for name, path in shown for real in {path, *_spellings(path)}),
            key=lambda pair: -len(pair[0]),
        )
        self._names = dict(found)
        start = "|".join(re.escape(real) for real, _ in found)
        self._pattern = re.compile(rf"({start})((?:[\\/][^\s:;,'\"()\[\]{{}}<>*?]*)?)(?![\w.-])")

    def shown(self, text: str) -> str:
        """Return a text with its paths in the book's form."""
        shown = self._pattern.sub(lambda match: self._names[match[1]] + match[2].replace("\\", "/"), text)
        return _REPEATED.sub(r"\1", shown)

    def real(self, text: str) -> str:
        """Return a word with its path (``~/maps``, ``file:=~/x.yaml``) as on this machine."""
        for start, real in ((_HOME_IN, self._real_home), (_SHARE_IN, self._real_share)):
            text = start.sub(real, text)
        return text

    def _real_home(self, match: re.Match[str]) -> str:
        return f"{match[1]}{self.home}"

    def _real_share(self, match: re.Match[str]) -> str:
        """Return the folder of the package: the book shows several folders as one."""
        package = match[2] or ""
        share = next((each for each in self.shares if (each / package).exists()), self.shares[0])
        return f"{match[1]}{share}{'/' * bool(package)}{package}"

    def find(self, word: str, folder: Path, *, writes: bool = False) -> Path:
        """Return the path that a word means in a folder.

        Raises `OutsideHome` if it is outside the home folder and, for reading, also outside ROS's packages.
        """
        path = Path(os.path.normpath(os.path.join(folder, self.real(word))))  # noqa: PTH118 (an absolute word wins)
        real = path.resolve()
        is_brought = any(real.is_relative_to(share) for share in self.shares)
        if real.is_relative_to(self.home) or (is_brought and not writes):
            return path
        if is_brought:
            raise OutsideHome(f"{word}: Permission denied; rosmini's own packages are read-only")
        raise OutsideHome(f"{word}: Permission denied; a notebook's terminals can use only {HOME} and {SHARE}")


class ShownStream(io.TextIOBase):
    """A text stream that writes paths in the book's form."""

    def __init__(self, target: TextIO, places: Places) -> None:
        self._target, self._places = target, places

    def writable(self) -> bool:
        """Return True."""
        return True

    def write(self, text: str, /) -> int:
        """Write a text with its paths in the book's form."""
        self._target.write(self._places.shown(text))
        return len(text)

    def flush(self) -> None:
        """Flush the target unless it is closed: Python also flushes a stream that it deletes."""
        if not self._target.closed:
            self._target.flush()

    def __getattr__(self, name: str) -> Any:
        """Return an attribute of the target: a kernel sets the cell to which its stream writes."""
        return getattr(self._target, name)


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


def _spellings(path: Path) -> set[Path]:
    """Return other spellings of a folder: on macOS, /private/var is also /var."""
    parts = path.parts
    return {Path("/", *parts[2:])} if parts[:2] == ("/", "private") else set()
