"""``rosgraph.roslogging``: log records as rospy prints them (http://wiki.ros.org/rospy/Overview/Logging)."""

from __future__ import annotations

import importlib
import logging
import os
import re
import sys
import time
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, TextIO

from rosmini.core.errors import RosminiError
from rosmini.ros.rospy.names import get_name
from rosmini.ros.rospy.session import any_node, current_session

COLOURS = {"DEBUG": "\033[32m", "WARN": "\033[33m", "ERROR": "\033[31m", "FATAL": "\033[31m"}
SEVERITIES = {"WARNING": "WARN", "CRITICAL": "FATAL"}
"""ROS's names for Python's levels where they differ."""
FORMAT = "[${severity}] [${time}]: ${message}"
PLACE = re.compile(r"\$\{(\w+)(?::([^}]*))?\}")

_formatter = logging.Formatter()


class LoggingException(RosminiError):
    """Log files cannot be set up."""


class RosStreamHandler(logging.Handler):
    """Writes records up to INFO to ``stdout`` and others to ``stderr``, in the format of ROSCONSOLE_FORMAT.

    Times are graph time. Colours are used on a terminal, unless ``colorize`` is false.
    """

    def __init__(self, colorize: bool = True, stdout: TextIO | None = None, stderr: TextIO | None = None) -> None:
        super().__init__()
        self._stdout, self._stderr, self._colorize = stdout or sys.stdout, stderr or sys.stderr, colorize

    def emit(self, record: logging.LogRecord) -> None:
        """Write one record."""
        now = any_node().now().to_sec()
        severity = SEVERITIES.get(record.levelname, record.levelname)
        values: dict[str, Callable[[], Any]] = {
            "severity": lambda: severity,
            "message": lambda: _formatter.format(record),
            "time": lambda: f"{now:f}",
            "walltime": lambda: f"{now:f}",
            "thread": lambda: record.thread,
            "logger": lambda: record.name,
            "file": lambda: record.pathname,
            "line": lambda: record.lineno,
            "function": lambda: record.funcName,
            "node": get_name,
        }

        def shown(place: re.Match[str]) -> str:
            name, form = place.groups()
            if form is not None and name in ("time", "walltime"):
                return time.strftime(form, time.gmtime(now))
            return str(values[name]()) if name in values else place.group()

        line = PLACE.sub(shown, os.environ.get("ROSCONSOLE_FORMAT", FORMAT)) + "\n"
        stream = self._stdout if record.levelno < logging.WARNING else self._stderr
        colour = COLOURS.get(severity) if self._colorize and stream.isatty() else None
        stream.write(f"{colour}{line}\033[0m" if colour else line)


def configure_logging(
    logname: str, level: int = logging.INFO, filename: str | None = None, env: Mapping[str, str] | None = None
) -> str | None:
    """Write the script's log records from `level` upwards to a file in ROS's log folder; return its path.

    The folder is ROS_LOG_DIR, or ``log`` in ROS_HOME, by default ``~/.ros`` (http://wiki.ros.org/ROS/EnvironmentVariables).
    Return None, with a warning, if it cannot be created. Raises ``LoggingException`` if a file is in its place.
    """
    env = os.environ if env is None else env
    folder = env.get("ROS_LOG_DIR") or Path(env.get("ROS_HOME") or "~/.ros").expanduser() / "log"
    path = Path(folder) / (filename or f"{logname or 'unknown'}-{os.getpid()}.log")
    if path.parent.is_file():
        raise LoggingException(f"Cannot save log files: file [{path.parent}] is in the way")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
    except OSError:
        sys.stderr.write(
            f"WARNING: cannot create log directory [{path.parent}]. Please set ROS_LOG_DIR to a writable location.\n"
        )
        return None
    # A script has its own copy of `logging`.
    load = getattr(getattr(current_session().context, "importer", None), "load", importlib.import_module)
    handler = load("logging.handlers").RotatingFileHandler(path, maxBytes=50_000_000, backupCount=4)
    handler.setFormatter(load("logging").Formatter("[%(name)s][%(levelname)s] %(asctime)s: %(message)s"))
    root = load("logging").getLogger()
    root.addHandler(handler)
    root.setLevel(level)
    os.environ["ROS_LOG_FILENAME"] = str(path)
    return str(path)
