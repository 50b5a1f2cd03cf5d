"""Log messages: to the console and to ``/rosout`` (http://wiki.ros.org/rosout)."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any, TextIO

from rosmini.time import Time

from .clock import TopicClock

if TYPE_CHECKING:
    from types import FrameType

    from .node import Node

LEVELS = {"DEBUG": 1, "INFO": 2, "WARN": 4, "ERROR": 8, "FATAL": 16}
"""The levels of ``rosgraph_msgs/Log``."""

NAMES = {value: name for name, value in LEVELS.items()}


OWN = str(Path(__file__).resolve().parents[1]) + os.sep
"""How the names of rosmini's own source files begin."""


def source_of(filename: str) -> str:
    """Return what to call a source file in a log message; a notebook's cells have random file names."""
    if "ipykernel" in filename or filename.startswith("<"):
        return "notebook"
    return filename


class Logger:
    """One node's logger.

    What is logged before the node is on a topic is kept for the console only. ``set_level`` is what the service
    ``~set_logger_level`` calls.
    """

    def __init__(self, node: Node) -> None:
        self._node = node
        self.levels = {"rosout": LEVELS["INFO"], "rospy": LEVELS["INFO"]}

    def log(self, level: int, text: str, *, logger: str | None = None, depth: int = 2) -> None:
        """Log ``text``; ``depth`` is how many frames above this call the user's code stands."""
        if level < self.levels.get(logger or "rosout", self.levels["rosout"]):
            return
        node = self._node
        now = node.now()
        shown = _shown(now)
        if isinstance(node.clock, TopicClock):
            shown = (
                f"{_shown(node.graph.now())}, {shown}"  # rospy's way: the wall's time, then that of /clock
            )
        self.console(level, f"[{NAMES[level]}] [{shown}]: {text}")
        publication = node.publications.get("/rosout")
        if publication is not None:
            frame = _frame(depth + 1)
            publication.send(self._message(level, text, now, frame))

    def console(self, level: int, line: str) -> None:
        """Write a line: warnings and worse to standard error, as rospy does, and in a notebook all to standard output."""
        name = "stdout" if level <= LEVELS["INFO"] or self._node.graph.notebook else "stderr"
        # A script's real thread does not see the script's streams in `sys`, which belong to whoever the graph is running.
        own = getattr(self._node.scheduler.current().context, "get_own", None)
        stream: TextIO = getattr(sys, name) if own is None else own(name)
        stream.write(line + "\n")

    def _message(self, level: int, text: str, now: Time, frame: FrameType | None) -> Any:
        node = self._node
        message = node.graph.log_class()
        message.header.stamp = Time(now.secs, now.nsecs)
        message.level = level
        message.name = node.name
        message.msg = text
        if frame is not None:
            message.file = source_of(frame.f_code.co_filename)
            message.function = frame.f_code.co_name
            message.line = frame.f_lineno
        message.topics = list(node.publications)
        return message

    def set_level(self, logger: str, level: str) -> None:
        """Show only messages of ``level`` and above. Raises ``KeyError`` for an unknown level."""
        self.levels[logger.removeprefix("ros.")] = LEVELS[level.upper()]

    def listing(self) -> list[tuple[str, str]]:
        """Return (logger, level) pairs."""
        return [(name, NAMES[level]) for name, level in self.levels.items()]


def _shown(when: Time) -> str:
    return f"{when.secs}.{when.nsecs // 1000:06d}"


def _frame(depth: int) -> FrameType | None:
    """Return the frame ``depth`` calls up, leaving rosmini's own files out."""
    frame: FrameType | None = sys._getframe(depth)  # noqa: SLF001 - the documented way to find a caller
    while frame is not None and frame.f_back is not None and frame.f_code.co_filename.startswith(OWN):
        frame = frame.f_back
    return frame
