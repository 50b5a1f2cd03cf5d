"""A node's log file: a line for each message, as in rospy (http://wiki.ros.org/rospy/Overview/Logging)."""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Literal, TextIO

from rosmini.core.errors import RosminiError

VARIABLE = "ROS_LOG_DIR"
LEVEL_NAMES = {1: "DEBUG", 2: "INFO", 4: "WARNING", 8: "ERROR", 16: "CRITICAL"}
"""Python's names of the levels, which rospy writes to files."""


def log_folder(log_dir: str | Path | None, run_id: str) -> Path | None:
    """Make and return the folder for log files, ``<log_dir>/<run_id>`` or ``<ROS_LOG_DIR>/<run_id>``.

    Returns None if neither is given. Raises ``RosminiError`` if the folder cannot be made.
    """
    given = log_dir or os.environ.get(VARIABLE)
    if not given:
        return None
    folder = Path(given).expanduser() / run_id
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        source = "log_dir" if log_dir else f"the environment variable {VARIABLE}"
        raise RosminiError(
            f"cannot make the folder {folder} for log files: {error.strerror}. Set {source} to a folder that you may "
            "write to."
        ) from error
    return folder


class LogFile:
    """A log file, written line by line. After a disk error it is closed with a warning, and the node continues.

    Args:
        path: the file's path.
        simulated: write graph time, shown in UTC, and replace the file; otherwise write local time, and append to an
            existing file, as rospy does.

    """

    def __init__(self, path: Path, *, simulated: bool) -> None:
        self.path = path
        self._calendar = time.gmtime if simulated else time.localtime
        self._mode: Literal["w", "a"] = "w" if simulated else "a"
        self._file: TextIO | None = None
        self._attempt(self._open)

    def _open(self) -> None:
        self.path.parent.mkdir(parents=True, exist_ok=True)
        self._file = self.path.open(self._mode, encoding="utf-8", errors="backslashreplace", newline="\n", buffering=1)

    def write(self, logger: str, level: int, now_ns: int, text: str) -> None:
        """Write one message of the given logger and level, with the time ``now_ns``."""
        file = self._file
        if file is None:
            return
        seconds, rest = divmod(now_ns, 10**9)
        when = time.strftime("%Y-%m-%d %H:%M:%S", self._calendar(seconds))
        line = f"[{logger}][{LEVEL_NAMES[level]}] {when},{rest // 10**6:03d}: {text}\n"
        self._attempt(lambda: file.write(line))

    def close(self) -> None:
        """Close the file. Safe to call again."""
        file, self._file = self._file, None
        if file is not None:
            self._attempt(file.close)

    def _attempt(self, step: Callable[[], object]) -> None:
        try:
            step()
        except OSError as error:
            sys.stderr.write(f"[WARN] the log file {self.path} ends here: {error.strerror}\n")
            file, self._file = self._file, None
            if file is not None:
                with suppress(OSError):  # the error has just been reported
                    file.close()
