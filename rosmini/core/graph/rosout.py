"""Log messages: to the console and to ``/rosout`` (http://wiki.ros.org/rosout)."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any, TextIO, TypedDict

from rosmini.core.errors import RosminiError
from rosmini.core.time import Time
from rosmini.msgs import message_class, service_class

from .clock import TopicClock
from .log_file import LogFile

if TYPE_CHECKING:
    from collections.abc import Callable, Hashable
    from types import FrameType

    from .node import Node

LEVELS = {"DEBUG": 1, "INFO": 2, "WARN": 4, "ERROR": 8, "FATAL": 16}
"""The levels of ``rosgraph_msgs/Log``."""

NAMES = {value: name for name, value in LEVELS.items()}

INTERNAL = ("rospy", "rospy.client", "rospy.core", "rospy.init", "rospy.internal")
"""The loggers of the client library itself, by rospy's names; they write only to log files."""

OWN = str(Path(__file__).resolve().parents[2]) + os.sep
"""Common prefix of the names of rosmini's source files."""
LOGGING = (str(Path(__file__).parent) + os.sep, str(Path(OWN, "ros", "rospy")) + os.sep)
"""Prefixes of those of rosmini's files that log on behalf of other code; built-in nodes are elsewhere."""


def source_of(filename: str) -> str:
    """Return the name of a source file for log messages: "notebook" for cells, whose file names are random."""
    if "ipykernel" in filename or filename.startswith("<"):
        return "notebook"
    return filename


def logger_services(logger: Logger) -> list[tuple[str, Any, Callable[[Any], Any]]]:
    """Return (name, class, handler) of the services ``~get_loggers`` and ``~set_logger_level`` for a node's logger."""
    logger_class = message_class("roscpp/Logger")

    def listing(_: Any) -> Any:
        return {"loggers": [logger_class(name=name, level=level) for name, level in logger.listing()]}

    def change(request: Any) -> Any:
        if request.level.upper() not in LEVELS:
            msg = f"no level {request.level!r}: use one of {', '.join(LEVELS)}"
            raise RosminiError(msg)
        logger.set_level(request.logger, request.level)
        return {}

    return [
        ("~get_loggers", service_class("roscpp/GetLoggers"), listing),
        ("~set_logger_level", service_class("roscpp/SetLoggerLevel"), change),
    ]


class LoggerTree:
    """The loggers of a node and their levels.

    ``rosout.camera.driver`` is below ``rosout.camera``, which is below ``rosout``. A logger whose level was not set
    has the level of the nearest logger above it; the root above all has the level INFO.
    """

    def __init__(self) -> None:
        self._own: dict[str, int] = {"rosout": LEVELS["INFO"]}
        self._known: dict[str, None] = dict.fromkeys(("rosout", *INTERNAL))

    def level(self, name: str) -> int:
        """Return the lowest level that ``name`` logs; the logger is listed from now on."""
        if name not in self._known:
            parts = name.split(".")
            self._known.update(dict.fromkeys(".".join(parts[: n + 1]) for n in range(len(parts))))
        while name not in self._own and "." in name:
            name = name.rpartition(".")[0]
        return self._own.get(name, LEVELS["INFO"])

    def set(self, name: str, level: int) -> None:
        """Set the level of a logger."""
        self._own[name] = level
        self.level(name)

    def listing(self) -> list[tuple[str, int]]:
        """Return the name and the level number of each known logger."""
        return [(name, self.level(name)) for name in self._known]


class LogOptions(TypedDict, total=False):
    """The options of a log call."""

    throttle: float | None
    """Log at most once in this period [s] of the node's time from this place in the program."""
    identical: bool
    """Log only a text that has changed; with ``throttle``, repeat the same text when it is due."""
    once: bool
    """Log only the first time that this place in the program is reached."""
    logger: str
    """The logger ``rosout.<logger>``, which may have its own level."""


class LogGates:
    """Decides by the earlier log calls at the same place in the program whether a message is suppressed."""

    def __init__(self) -> None:
        self._times: dict[Hashable, int] = {}
        self._texts: dict[Hashable, str] = {}
        self._seen: set[Hashable] = set()

    def is_due(self, where: Hashable, now_ns: int, period_ns: int) -> bool:
        """Return True for the first call with ``where``, and then once in each ``period_ns`` or if time jumps back."""
        last = self._times.get(where)
        if last is not None and last <= now_ns <= last + period_ns:
            return False
        self._times[where] = now_ns
        return True

    def is_new(self, where: Hashable, text: str) -> bool:
        """Return True if ``text`` differs from the last one logged at this place."""
        changed = self._texts.get(where) != text
        self._texts[where] = text
        return changed

    def is_first(self, where: Hashable) -> bool:
        """Return True if this place logs for the first time."""
        fresh = where not in self._seen
        self._seen.add(where)
        return fresh


class Logger:
    """One node's loggers. ``rosout`` and those below it write to the console, to ``/rosout`` and to the log file.

    All others write to the log file only. Until the node publishes ``/rosout``, messages go only to the console. The
    service ``~set_logger_level`` calls ``set_level``.
    """

    def __init__(self, node: Node) -> None:
        self._node = node
        self.tree = LoggerTree()
        self.gates = LogGates()
        self.streams: Any = None
        """The holder of a built-in node's own standard output and error, if it has them."""
        self._file: LogFile | None = None

    def is_enabled(self, level: int, logger: str = "rosout") -> bool:
        """Return True if a message of this level is logged."""
        return level >= self.tree.level(logger)

    def log(self, level: int, text: str, *, logger: str | None = None, depth: int = 2, is_shown: bool = True) -> None:
        """Log ``text``; ``depth`` is the number of frames from this call up to the user's code.

        Without ``is_shown`` the text goes to ``/rosout`` and to the log file, but not to the console.
        """
        logger = logger or "rosout"
        if not self.is_enabled(level, logger):
            return
        node = self._node
        if self._file is not None:
            self._file.write(logger, level, node.graph.scheduler.now_ns(), text)
        if logger.partition(".")[0] != "rosout":
            return
        now = node.now()
        shown = _shown(now)
        if isinstance(node.clock, TopicClock):
            shown = f"{_shown(node.graph.now())}, {shown}"  # as in rospy: wall-clock time, then the time of /clock
        if is_shown:
            self.console(level, f"[{NAMES[level]}] [{shown}]: {text}")
        publication = node.publications.get("/rosout")
        if publication is not None:
            publication.send(self._message(level, text, now, caller(depth + 1)))

    def write(
        self,
        level: str,
        text: object,
        throttle: float | None = None,
        identical: bool = False,
        once: bool = False,
        logger: str = "",
    ) -> None:
        """Log a message from user code (``node.loginfo()``) unless an option suppresses it: see :class:`LogOptions`."""
        shown = str(text)
        is_always_logged = throttle is None and not identical and not once
        if is_always_logged or self._is_let_through(shown, throttle, identical=identical, once=once):
            self.log(LEVELS[level], shown, logger=f"rosout.{logger}" if logger else None)

    def _is_let_through(self, text: str, throttle: float | None, *, identical: bool, once: bool) -> bool:
        frame = caller(2, LOGGING)
        where = (frame.f_code.co_filename, frame.f_lineno, frame.f_lasti)
        if once:
            return self.gates.is_first(where)
        now = self._node.clock.now_ns()
        due = throttle is not None and self.gates.is_due(where, now, round(throttle * 1e9))
        return (self.gates.is_new(where, text) or due) if identical else due

    # -- the file ------------------------------------------------------------------------------------------------

    @property
    def path(self) -> Path | None:
        """The path of the log file, or None."""
        return None if self._file is None else self._file.path

    def open_file(self, path: Path) -> None:
        """Write messages to the log file ``path`` from now on, starting with rospy's first lines."""
        node = self._node
        self._file = LogFile(path, simulated=node.graph.simulated)
        self.log(LEVELS["INFO"], f"init_node, name[{node.name}]", logger="rospy.client")
        self.log(LEVELS["INFO"], f"ROS Slave URI: [{node.uri}]", logger="rospy.init")

    def close_file(self) -> None:
        """Write the last line of the log file and close it. Safe to call again."""
        if self._file is not None:
            self.log(LEVELS["INFO"], f"signal_shutdown [{self._node.shutdown_reason or ''}]", logger="rospy.core")
            self._file.close()
            self._file = None

    # -- output -------------------------------------------------------------------------------------------------

    def console(self, level: int, line: str) -> None:
        """Write a line to the console: to standard error for WARN and above, as rospy does.

        In a notebook every line goes to standard output, unless that is redirected to a log.
        """
        # `sys.stdout` is wrong in two cases: in a real thread of a script it belongs to the code that the graph is
        # running, and in a simulator's step, which has no lane, it is not that of the built-in node. Use the context's
        # streams.
        own = getattr(self.streams or self._node.scheduler.current().context, "get_own", None)
        to_log = own is not None and getattr(own("stdout"), "to_log", False)
        name = "stdout" if level <= LEVELS["INFO"] or (self._node.graph.notebook and not to_log) else "stderr"
        stream: TextIO = getattr(sys, name) if own is None else own(name)
        stream.write(line + "\n")

    def _message(self, level: int, text: str, now: Time, frame: FrameType) -> Any:
        node = self._node
        message = node.graph.log_class()
        message.header.stamp = Time(now.secs, now.nsecs)
        message.level = level
        message.name = node.name
        message.msg = text
        message.file = os.path.basename(source_of(frame.f_code.co_filename))  # noqa: PTH119 - a frame's text
        message.function = function_of(frame)
        message.line = frame.f_lineno
        message.topics = list(dict.fromkeys((*node.publications, *node.subscriptions)))
        return message

    def set_level(self, logger: str, level: str) -> None:
        """Set the lowest level that ``logger`` logs; a prefix ``ros.`` is removed from its name.

        Raises ``KeyError`` for an unknown level.
        """
        self.tree.set(logger.removeprefix("ros."), LEVELS[level.upper()])

    def listing(self) -> list[tuple[str, str]]:
        """Return the name and the level of each known logger, such as ("rosout", "INFO")."""
        return [(name, NAMES[level]) for name, level in self.tree.listing()]


def _shown(when: Time) -> str:
    return f"{when.secs}.{when.nsecs // 1000:06d}"


def function_of(frame: FrameType) -> str:
    """Return rospy's name of the function of a frame: ``Class.method`` if there is a ``self``."""
    code = frame.f_code
    # Before Python 3.13 a frame whose locals were read keeps references to them until it ends.
    if "self" not in (*code.co_varnames, *code.co_cellvars, *code.co_freevars) or "self" not in frame.f_locals:
        return code.co_name
    return f"{type(frame.f_locals['self']).__name__}.{code.co_name}"


def caller(depth: int, own: str | tuple[str, ...] = OWN) -> FrameType:
    """Return the frame ``depth`` calls up; skip frames of files that begin with ``own``, unless there are no others."""
    nearest = frame = sys._getframe(depth)  # noqa: SLF001 - the documented way to find a caller
    while frame.f_code.co_filename.startswith(own):
        if frame.f_back is None:
            return nearest
        frame = frame.f_back
    return frame
