"""The errors that rosmini raises, in one hierarchy.

Catch :class:`RosminiError` to catch them all. An error that ROS names has the same name and the same base classes
here (an ``except rospy.ROSInterruptException`` or an ``except KeyError`` in a script written for rospy works as
in ROS); the other names are ours. A message says what happened, what was found instead, and what to do
next: :func:`nearest` writes the "did you mean" part, :func:`shown` formats the value that was found.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path
from types import TracebackType
from typing import Any


class RosminiError(Exception):
    """Base class of all errors in rosmini."""

    def _render_traceback_(self) -> list[str]:
        """Return the traceback that IPython shows."""
        return short_traceback(self)


# ---- rospy's names (http://docs.ros.org/en/noetic/api/rospy/html/rospy.exceptions-module.html) ----


class ROSException(RosminiError):
    """A ROS call failed: a timeout, a call before ``init_node``, a publish after shutdown."""


class ROSInitException(ROSException):
    """The node could not be initialised."""


class ROSSerializationException(ROSException):
    """A message could not be serialised or deserialised."""


class ROSInterruptException(ROSException, KeyboardInterrupt):
    """A blocking call (sleep, wait, spin) ended because the node is shutting down."""


class ROSTimeMovedBackwardsException(ROSInterruptException):
    """Simulated time jumped back while a call was sleeping; ``time`` is the size of the jump [s]."""

    def __init__(self, time: Any) -> None:
        super().__init__("ROS time moved backwards")
        self.time = time


class ROSInternalException(RosminiError):
    """The client library itself failed; a script cannot do anything about it."""


class TransportException(ROSInternalException):
    """A connection between two nodes failed."""


class TransportInitError(TransportException):
    """A connection between two nodes could not be established (for example, its header was refused).

    ``header`` contains the fields sent by the refusing end (``type``, ``md5sum``, ``callerid`` ...), if any.
    """

    def __init__(self, message: str = "", header: Mapping[str, str] | None = None) -> None:
        super().__init__(message)
        self.header = dict(header or {})


class TransportTerminated(TransportException):
    """A connection between two nodes was closed by the other side."""


class ServiceException(RosminiError):
    """A service call failed: no server, the handler raised, or no response arrived."""


class ServiceRefused(ServiceException):
    """Raised by a service handler to refuse a request (a C++ handler returns false); the caller gets only its text."""


# ---- genpy's names ----


class MessageException(RosminiError):
    """A message or its definition is wrong."""


class SerializationError(MessageException):
    """A field of a message has a value that does not fit its ROS type."""


class DeserializationError(MessageException):
    """Bytes from a connection or a bag are not a message of the expected type."""


# ---- ours ----


class IllegalName(RosminiError, ValueError):
    """A graph or package resource name breaks the rules of http://wiki.ros.org/Names."""


class InvalidRate(RosminiError, ZeroDivisionError, ValueError):
    """A rate is not positive (rospy raises ``ZeroDivisionError`` for 0, ``ValueError`` for NaN, else nothing)."""


class UnknownPackage(RosminiError):
    """There is no ROS package of this name on the package path."""


class UnknownType(RosminiError):
    """There is no message, service or action type of this name."""


class LocatedError(RosminiError):
    """Base class of errors in a file. ``file`` and ``line`` (counted from 1) are None if they are not known."""

    def __init__(self, message: str, file: str | Path | None = None, line: int | None = None) -> None:
        self.message = message
        self.file = None if file is None else str(file)
        self.line = line
        super().__init__(message, self.file, line)

    def __str__(self) -> str:
        place = ":".join(str(part) for part in (self.file, self.line) if part is not None)
        return f"{place}: {self.message}" if place else self.message


class DefinitionError(LocatedError):
    """A ``.msg``, ``.srv``, ``.action`` or manifest file is wrong."""


class MasterUnreachable(ROSException):
    """The Master did not answer: it is not running, or its address is wrong."""


class TypeMismatch(RosminiError):
    """The two ends of a topic or service have different types."""


class ParameterError(RosminiError):
    """A parameter has a wrong type, is out of range, or has a value that ROS does not support."""


class ParameterOverflow(ParameterError, OverflowError):
    """A parameter was set to an integer of more than 32 bits (rospy raises ``OverflowError``)."""


class ParameterTypeError(ParameterError, TypeError):
    """A parameter was set to a value of a type that ROS does not support (rospy raises ``TypeError``)."""


class ParameterNotSet(ParameterError, KeyError):
    """A parameter that is not set was read (rospy raises ``KeyError``)."""

    # KeyError shows the repr of its argument, which would add quotes and "\n" to our messages.
    __str__ = Exception.__str__


class ScriptError(RosminiError):
    """A script does not exist, is not Python, or failed while it was loaded."""


class CommandError(RosminiError):
    """A ROS command failed. A terminal shows only its message, and a cell omits the causes too."""

    def _render_traceback_(self) -> list[str]:
        """Return the traceback that IPython shows."""
        cause, context, quiet = self.__cause__, self.__context__, self.__suppress_context__
        self.__cause__ = self.__context__ = None
        try:
            return short_traceback(self)
        finally:
            self.__cause__, self.__context__, self.__suppress_context__ = cause, context, quiet


class UsageError(CommandError):
    """A command line is wrong."""


class CallbackError(RosminiError):
    """A callback raised ``__cause__``."""


class DuplicateNode(RosminiError):
    """A node was shut down because another node registered with the same name."""


class GraphEnded(RosminiError):
    """No event is left in the graph, so a wait would never end."""


_LONGEST_NAME = 300
"""Longer names are not compared with others."""


def _counts(letters: str, text: str) -> list[int]:
    """Return the number of occurrences in ``text`` of each distinct letter of ``letters``."""
    return [text.count(letter) for letter in dict.fromkeys(letters)]


def nearest(name: str, candidates: Iterable[str], limit: int = 3) -> str:
    """Return the clause "did you mean ...?" for a mistyped ``name``, with at most ``limit`` candidates.

    The clause is empty if no candidate is similar. The comparison ignores case. Names with equal last parts in
    different namespaces (``/scan`` and ``/robot1/scan``) are similar. The order of the candidates has no effect.

    >>> nearest("/chater", ["/chatter", "/rosout"])
    'did you mean /chatter?'
    """
    if len(name) > _LONGEST_NAME:
        return ""
    from difflib import SequenceMatcher  # only needed for error messages

    target = name.lower()
    target_base = target.rpartition("/")[2]

    def ratio(one: str, other: str) -> float:
        """Return the ratio of `SequenceMatcher`, or 0 if the letters in common show that it is below 0.7."""
        if (
            not one
            or not other
            or 2 * sum(map(min, _counts(one, one), _counts(one, other))) < 0.7 * (len(one) + len(other))
        ):
            return 0.0
        return SequenceMatcher(None, one, other).ratio()

    def likeness(candidate: str) -> float:
        folded = candidate.lower()
        return max(ratio(target, folded), 0.95 * ratio(target_base, folded.rpartition("/")[2]))

    known = {each for each in candidates if each != name and len(each) <= _LONGEST_NAME}
    ranked = sorted((-likeness(candidate), candidate) for candidate in known)
    if not ranked or ranked[0][0] > -0.7:
        return ""
    best = ranked[0][0]
    found = [candidate for score, candidate in ranked if score <= min(-0.7, best + 0.1)][:limit]
    listed = found[0] if len(found) == 1 else f"{', '.join(found[:-1])} or {found[-1]}"
    return f"did you mean {listed}?"


class Hints:
    """Limits the number of hints in the warnings about one file to `MAX_HINTS`, since each hint takes milliseconds."""

    MAX_HINTS = 20

    def __init__(self) -> None:
        self._count = 0

    def __call__(self, name: str, candidates: Iterable[str]) -> str:
        """Return the clause of `nearest`, or an empty string after `MAX_HINTS` calls."""
        self._count += 1
        return nearest(name, candidates) if self._count <= self.MAX_HINTS else ""


def shown(value: object, limit: int = 60) -> str:
    """Return ``repr(value)`` for an error message: one line of at most ``limit`` characters.

    Only the part that is shown is formatted, so a large value costs nothing. Large numbers and arrays are described
    instead. A value whose ``__repr__`` fails is shown by its class.

    >>> shown("a" * 10**6, 20)
    "'aaaaaaaaaaaaaaaa..."
    >>> shown({"ranges": [1.5] * 10**6}, 30)
    "{'ranges': [1.5, 1.5, 1.5, ..."
    """
    text = _repr(value, limit + 1)
    return text if len(text) <= limit else f"{text[: max(limit - 3, 0)]}..."


def _repr(value: Any, room: int) -> str:
    """Return ``repr(value)``, formatting little more than the first ``room`` characters.

    If the result is longer than ``room``, the rest is incomplete, and the caller must cut it off.
    """
    if isinstance(value, (str, bytes, bytearray)):
        return repr(value[:room])
    if isinstance(value, int) and value.bit_length() > 256:
        return f"<an integer of {value.bit_length()} bits>"
    cls = type(value)
    parts = getattr(cls, "__match_args__", ())  # fields of messages, data classes, named tuples
    if parts:
        named = ((f"{part}=", getattr(value, part, None)) for part in parts)
        return _joined(f"{cls.__name__}(", named, ")", room)
    if isinstance(value, dict):
        return _joined("{", ((f"{_repr(key, room)}: ", each) for key, each in value.items()), "}", room)
    if isinstance(value, list):
        return _joined("[", (("", each) for each in value), "]", room)
    if isinstance(value, tuple):
        return _joined("(", (("", each) for each in value), ",)" if len(value) == 1 else ")", room)
    if isinstance(value, set) and value:
        return _joined("{", (("", each) for each in value), "}", room)
    if hasattr(cls, "dtype") and (value.size > room or value.dtype.itemsize > room or value.dtype.hasobject):
        return f"<an array of {value.dtype} of the shape {value.shape}>"
    try:
        return " ".join(repr(value).split())
    except Exception:
        return f"<{cls.__name__} object>"


def _joined(start: str, entries: Iterable[tuple[str, object]], end: str, room: int) -> str:
    text, comma = start, ""
    for label, each in entries:
        text += comma + label
        if len(text) > room:
            return text
        text += _repr(each, room - len(text))
        comma = ", "
    return text + end


def short_traceback(error: BaseException) -> list[str]:
    """Return the traceback of ``error`` and of its causes as IPython shows it, without the frames of rosmini.

    An error that is not a `RosminiError` keeps the frame that raised it, since it may be a bug in rosmini.
    """
    from IPython import get_ipython

    chain: list[tuple[BaseException, TracebackType | None]] = []
    link: BaseException | None = error
    while link is not None and all(link is not seen for seen, _ in chain):
        chain.append((link, link.__traceback__))
        link = link.__cause__ or (None if link.__suppress_context__ else link.__context__)
    try:
        for link, trace in chain:
            link.__traceback__ = _without_our_frames(
                trace, keep_last=not isinstance(link, (RosminiError, KeyboardInterrupt))
            )
        lines: list[str] = get_ipython().InteractiveTB.structured_traceback(
            type(error), error, error.__traceback__, tb_offset=0
        )
        return lines
    finally:
        for link, trace in chain:
            link.__traceback__ = trace


def _without_our_frames(trace: TracebackType | None, *, keep_last: bool) -> TracebackType | None:
    from pathlib import Path
    from types import TracebackType

    ours = Path(__file__).parents[1]
    entries: list[TracebackType] = []
    while trace is not None:
        entries.append(trace)
        trace = trace.tb_next
    result: TracebackType | None = None
    for entry in reversed(entries):
        file = Path(entry.tb_frame.f_code.co_filename)
        users = not file.is_relative_to(ours) and file.parts[-3:] != ("IPython", "core", "interactiveshell.py")
        if users or keep_last:
            result = TracebackType(result, entry.tb_frame, entry.tb_lasti, entry.tb_lineno)
        keep_last = keep_last and not users
    return result
