"""Folders as the book shows them: ``~`` and ``/opt/ros/noetic/share`` on every machine.

A reader's files are in a temporary folder, whose name is another one each time, and rosmini's own packages are where
pip put them. What is printed names both as they are on a robot, so that outputs are equal everywhere.
"""

from __future__ import annotations

import io
import os
import re
from pathlib import Path
from typing import Any, TextIO

from rosmini.core.errors import RosminiError
from rosmini.core.packages import own_dirs

HOME = "~"
ROS = "/opt/ros/noetic"
"""Where ROS is on a robot; the packages are in its folder ``share``."""

SHARE = f"{ROS}/share"

LISTS = ("CMAKE_PREFIX_PATH", "PYTHONPATH", "ROS_PACKAGE_PATH")
"""The variables of the environment that hold lists of folders."""


_HOME_IN = re.compile(rf"(^|:=|=){re.escape(HOME)}(?=/|$)")
_SHARE_IN = re.compile(rf"(^|:=|=){re.escape(SHARE)}(?:/([^/:]+)|/?$|(?=/))")


_REPEATED = re.compile(rf"^([ ]*{re.escape(SHARE)})(?:\n\1)+$", re.MULTILINE)
"""What is one folder on a robot, listed once for each of the folders that it is here."""


class OutsideHome(RosminiError):
    """A path that a terminal of a notebook does not reach."""


class Places:
    """A home folder, rosmini's packages, and how both are shown."""

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
        """Return a text with the paths in it as the book shows them."""
        shown = self._pattern.sub(lambda match: self._names[match[1]] + match[2].replace("\\", "/"), text)
        return _REPEATED.sub(r"\1", shown)

    def real(self, text: str) -> str:
        """Return a word with the path in it (``~/maps``, ``file:=~/x.yaml``) as this machine has it."""
        for start, real in ((_HOME_IN, self._real_home), (_SHARE_IN, self._real_share)):
            text = start.sub(real, text)
        return text

    def _real_home(self, match: re.Match[str]) -> str:
        return f"{match[1]}{self.home}"

    def _real_share(self, match: re.Match[str]) -> str:
        """Return the folder of that package: what is shown as one folder is more than one here."""
        package = match[2] or ""
        share = next((each for each in self.shares if (each / package).exists()), self.shares[0])
        return f"{match[1]}{share}{'/' * bool(package)}{package}"

    def real_list(self, value: str) -> str:
        """Return a list of folders (``~/ws/src:/opt/ros/noetic/share``) as this machine's environment has it."""
        return os.pathsep.join(self.real(each) for each in value.split(":") if each)

    def find(self, word: str, folder: Path, *, writes: bool = False) -> Path:
        """Return the path that a word means in a folder.

        Raises `OutsideHome` if it is outside of the home folder, or, where nothing is written, of ROS's packages.
        """
        path = Path(os.path.normpath(os.path.join(folder, self.real(word))))  # noqa: PTH118 (an absolute word wins)
        real = path.resolve()
        is_brought = any(real.is_relative_to(share) for share in self.shares)
        if real.is_relative_to(self.home) or (is_brought and not writes):
            return path
        if is_brought:
            raise OutsideHome(
                f"{word}: Permission denied; the packages that rosmini brings are not to be changed"
            )
        raise OutsideHome(
            f"{word}: Permission denied; the terminals of a notebook reach {HOME} and {SHARE} only"
        )


class ShownStream(io.TextIOBase):
    """A text stream that shows paths as the book does."""

    def __init__(self, target: TextIO, places: Places) -> None:
        self._target, self._places = target, places

    def writable(self) -> bool:
        """Return True."""
        return True

    def write(self, text: str, /) -> int:
        """Write, with the paths as they are shown."""
        self._target.write(self._places.shown(text))
        return len(text)

    def flush(self) -> None:
        """Flush what is behind it, unless that was closed first: a stream that is forgotten is flushed, too."""
        if not self._target.closed:
            self._target.flush()

    def __getattr__(self, name: str) -> Any:
        """Return what only the stream behind it has: that of a kernel is told to which cell it writes."""
        return getattr(self._target, name)


def _spellings(path: Path) -> set[Path]:
    """Return the other names by which programs know a folder: macOS's /private/var is /var."""
    parts = path.parts
    return {Path("/", *parts[2:])} if parts[:2] == ("/", "private") else set()
