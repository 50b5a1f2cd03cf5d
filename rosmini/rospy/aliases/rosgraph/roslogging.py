"""``rosgraph.roslogging``: log records as rospy prints them (http://wiki.ros.org/rospy/Overview/Logging)."""

from __future__ import annotations

import logging
import os
import re
import sys
import time
from typing import TYPE_CHECKING, Any

from rosmini.errors import RosminiError
from rosmini.rospy.names import get_name
from rosmini.rospy.session import any_node

if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import TextIO

COLOURS = {"DEBUG": "\033[32m", "WARN": "\033[33m", "ERROR": "\033[31m", "FATAL": "\033[31m"}
SEVERITIES = {"WARNING": "WARN", "CRITICAL": "FATAL"}
"""What ROS calls Python's levels, where the names differ."""
FORMAT = "[${severity}] [${time}]: ${message}"
PLACE = re.compile(r"\$\{(\w+)(?::([^}]*))?\}")

_formatter = logging.Formatter()


class LoggingException(RosminiError):
    """Log files cannot be set up."""


class RosStreamHandler(logging.Handler):
    """Writes records up to INFO to ``stdout`` and others to ``stderr``, in the form that ROSCONSOLE_FORMAT gives.

    The time is the graph's. Colours are used on a terminal, unless ``colorize`` is false.
    """

    def __init__(
        self, colorize: bool = True, stdout: TextIO | None = None, stderr: TextIO | None = None
    ) -> None:
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


def __getattr__(name: str) -> Any:
    """Name the way out for what sets up log files for a whole process."""
    if name in ("configure_logging", "renew_latest_logdir"):
        raise AttributeError(
            f"module 'rosgraph.roslogging' has no {name!r} in rosmini: set ROS_LOG_DIR for log files of nodes, or call "
            "logging.basicConfig(filename=...)"
        )
    raise AttributeError(f"module 'rosgraph.roslogging' has no attribute {name!r}")
