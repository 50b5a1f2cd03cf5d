"""``rospy.loginfo`` and related functions: http://wiki.ros.org/rospy/Overview/Logging."""

from __future__ import annotations

import sys
import traceback
from collections.abc import Mapping
from types import FrameType, TracebackType
from typing import Any, Protocol, cast

from rosmini.core.graph.rosout import LEVELS, NAMES

from .rostime import Duration
from .session import current_node, current_session, require_node

DEBUG, INFO, WARN, ERROR, FATAL = (LEVELS[name] for name in ("DEBUG", "INFO", "WARN", "ERROR", "FATAL"))

KEYWORDS = frozenset({"logger_name", "exc_info", "stack_info", "stacklevel", "extra"})
"""Keyword arguments of Python's ``logging``, on which rospy's log calls are based."""


class LogFunction(Protocol):
    """Type of ``rospy.loginfo(msg, *args, **kwargs)`` and similar functions."""

    def __call__(self, msg: Any, *args: Any, **kwargs: Any) -> None:
        """Log."""


class ThrottledLogFunction(Protocol):
    """Type of ``rospy.loginfo_throttle(period, msg, *args, **kwargs)`` and similar functions."""

    def __call__(self, period: float, msg: Any, *args: Any, **kwargs: Any) -> None:
        """Log, if the period has passed."""


def log(level: int, text: Any, args: tuple[Any, ...], options: dict[str, Any], base: str = "rosout") -> None:
    """Log ``text % args``. Before ``init_node`` only warnings are shown, on standard error, as in rospy.

    ``base`` is the logger, or the parent of the one in the option ``logger_name``.

    Raises ``TypeError`` for an unknown option.
    """
    unknown = options.keys() - KEYWORDS
    if unknown:
        raise TypeError(f"a log call has no option {', '.join(sorted(unknown))}; it has {', '.join(sorted(KEYWORDS))}")
    node = current_node()
    name: str | None = options.get("logger_name")
    logger = f"{base}.{name}" if name else base
    if node is None:
        if level >= WARN:
            sys.stderr.write(_text(text, args, options) + "\n")
        return
    if node.logger.is_enabled(level, logger):
        shown = _text(text, args, options)
        node.logger.log(level, shown, logger=logger)
        _call_handlers(level, shown, logger)


def _call_handlers(level: int, text: str, name: str) -> None:
    """Call the handlers that the script has added to Python's logger ``name`` or its parents, such as ``rosout``."""
    importer = getattr(current_session().context, "importer", None)
    # A script has a logging of its own, once it has imported it.
    logging = sys.modules.get("logging") if importer is None else importer.private.get("logging")
    if logging is None or not (logger := logging.getLogger(name)).hasHandlers():
        return
    code = (frame := _caller(1)).f_code
    severity = getattr(logging, NAMES[level])
    logger.handle(logger.makeRecord(name, severity, code.co_filename, frame.f_lineno, text, (), None, code.co_name))


def _text(text: Any, args: tuple[Any, ...], options: dict[str, Any]) -> str:
    shown = str(text)
    if args:
        values = args[0] if len(args) == 1 and isinstance(args[0], Mapping) and args[0] else args
        try:
            shown %= values
        except (TypeError, ValueError, KeyError) as error:
            shown += f" (this log call's arguments {args!r} do not fit its text: {error})"
    trace = _trace(options.get("exc_info"))
    if trace:
        shown += "\n" + trace
    if options.get("stack_info"):
        shown += "\n" + "".join(traceback.format_stack(_caller(1))).rstrip("\n")
    return shown


def _trace(exc_info: Any) -> str:
    if not exc_info:
        return ""
    if isinstance(exc_info, BaseException):
        lines = traceback.format_exception(exc_info)
    elif isinstance(exc_info, tuple):
        kind: type[BaseException] | None
        error: BaseException | None
        trace: TracebackType | None
        kind, error, trace = exc_info
        lines = traceback.format_exception(kind, error, trace)
    else:
        error = sys.exc_info()[1]
        lines = ["NoneType: None"] if error is None else traceback.format_exception(error)
    return "".join(lines).rstrip("\n")


def _caller(depth: int) -> FrameType:
    """Return the frame that called the log function: the first one outside this package."""
    frame = sys._getframe(depth)  # noqa: SLF001 - the documented way to find a caller
    while frame.f_back is not None and frame.f_globals.get("__package__") == __package__:
        frame = frame.f_back
    return frame


def place() -> tuple[str, int, int]:
    """Return the location of a log call in the user's code."""
    frame = _caller(1)
    return frame.f_code.co_filename, frame.f_lineno, frame.f_lasti


def is_due(where: Any, period: float) -> bool:
    """Return True if ``period`` seconds of the node's time have passed since this line last logged.

    Raises ``ROSInitException`` before ``init_node``, as rospy does.
    """
    now = require_node("a throttled log call, which asks for the time,").clock.now_ns()
    return current_session().log_gates.is_due(where, now, Duration.from_sec(period).to_nsec())


def is_new(where: Any, text: Any) -> bool:
    """Return True if this line logs another text than last time."""
    return current_session().log_gates.is_new(where, str(text))


def is_first(where: Any) -> bool:
    """Return True if this line logs for the first time."""
    return current_session().log_gates.is_first(where)


def warn_once(text: str) -> None:
    """Log a warning of rosmini, but only the first time that the script causes this text."""
    if is_first(text):
        log(WARN, text, (), {})


# ---- the functions: one maker for each kind, one function for each level ----


def _named(function: Any, level: int, kind: str) -> Any:
    base = {"ERROR": "err"}.get(NAMES[level], NAMES[level].lower())
    function.__name__ = function.__qualname__ = f"log{base}{kind}"
    function.__doc__ = f"{function.__doc__[:-1]}, at level {NAMES[level]}."
    function.__module__ = "rosmini.ros.rospy"
    return function


def plainly(level: int) -> LogFunction:
    """Make ``rospy.loginfo`` for ``level``."""

    def log_plainly(msg: Any, *args: Any, **kwargs: Any) -> None:
        """Log ``msg % args``, under the logger ``rosout.<logger_name>`` if that is given."""
        log(level, msg, args, kwargs)

    return cast("LogFunction", _named(log_plainly, level, ""))


def internally(level: int) -> LogFunction:
    """Make ``rospy.core.rospyinfo`` for ``level``: what the client library logs about itself."""

    def log_internally(msg: Any, *args: Any, **kwargs: Any) -> None:
        """Log ``msg % args`` to the node's log file only."""
        log(level, msg, args, kwargs, base="rospy.internal")

    return cast("LogFunction", _named(log_internally, level, "_internally"))


def once(level: int) -> LogFunction:
    """Make ``rospy.loginfo_once`` for ``level``."""

    def log_once(msg: Any, *args: Any, **kwargs: Any) -> None:
        """Log ``msg % args`` the first time that this place of the program is reached."""
        if is_first(place()):
            log(level, msg, args, kwargs)

    return cast("LogFunction", _named(log_once, level, "_once"))


def throttled(level: int) -> ThrottledLogFunction:
    """Make ``rospy.loginfo_throttle`` for ``level``."""

    def log_throttle(period: float, msg: Any, *args: Any, **kwargs: Any) -> None:
        """Log ``msg % args``, at most once in ``period`` seconds of the node's time from one place of the program."""
        if is_due(place(), period):
            log(level, msg, args, kwargs)

    return cast("ThrottledLogFunction", _named(log_throttle, level, "_throttle"))


def throttled_identical(level: int) -> ThrottledLogFunction:
    """Make ``rospy.loginfo_throttle_identical`` for ``level``."""

    def log_throttle_identical(period: float, msg: Any, *args: Any, **kwargs: Any) -> None:
        """Log ``msg % args`` when ``msg`` has changed, else once in ``period`` seconds from one place."""
        where = place()
        due = is_due(where, period)
        if is_new(where, msg) or due:
            log(level, msg, args, kwargs)

    return cast("ThrottledLogFunction", _named(log_throttle_identical, level, "_throttle_identical"))
