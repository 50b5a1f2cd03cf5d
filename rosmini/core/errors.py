"""Every error that rosmini raises on purpose, in one tree.

Catch :class:`RosminiError` to catch them all. Where ROS has a name for an error, ours has the same name and the
same relatives (an ``except rospy.ROSInterruptException`` or an ``except KeyError`` in a script written for rospy
works as it does there); the others are ours. A message says what happened, what was found instead, and what to do
next: :func:`nearest` writes the "did you mean" part, :func:`shown` the value that was found.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping
    from pathlib import Path
    from types import TracebackType

__all__ = [
    "CallbackError",
    "CommandError",
    "DefinitionError",
    "DeserializationError",
    "DuplicateNode",
    "GraphEnded",
    "IllegalName",
    "InvalidRate",
    "MasterUnreachable",
    "MessageException",
    "ParameterError",
    "ParameterNotSet",
    "ParameterOverflow",
    "ParameterTypeError",
    "ROSException",
    "ROSInitException",
    "ROSInternalException",
    "ROSInterruptException",
    "ROSSerializationException",
    "ROSTimeMovedBackwardsException",
    "RosminiError",
    "ScriptError",
    "SerializationError",
    "ServiceException",
    "TransportException",
    "TransportInitError",
    "TransportTerminated",
    "TypeMismatch",
    "UnknownPackage",
    "UnknownType",
    "UsageError",
    "nearest",
    "shown",
]


class RosminiError(Exception):
    """The base of every error in rosmini."""

    def _render_traceback_(self) -> list[str]:
        """What IPython shows."""
        return short_traceback(self)


# ---- rospy's names (http://docs.ros.org/en/noetic/api/rospy/html/rospy.exceptions-module.html) ----


class ROSException(RosminiError):
    """Something went wrong in a ROS call: a timeout, a call before ``init_node``, a publish after shutdown."""


class ROSInitException(ROSException):
    """The node could not be initialised."""


class ROSSerializationException(ROSException):
    """A message could not be written to, or read from, the wire."""


class ROSInterruptException(ROSException, KeyboardInterrupt):
    """A blocking call (sleep, wait, spin) was ended because the node shuts down."""


class ROSTimeMovedBackwardsException(ROSInterruptException):
    """Simulated time jumped back while a call was sleeping; ``time`` says by how much, in seconds."""

    def __init__(self, time: Any) -> None:
        super().__init__("ROS time moved backwards")
        self.time = time


class ROSInternalException(RosminiError):
    """The client library itself failed; a script can do nothing about it."""


class TransportException(ROSInternalException):
    """A connection between two nodes failed."""


class TransportInitError(TransportException):
    """A connection between two nodes could not be made (the header was refused, for instance).

    ``header`` has what the refusing end said about itself (``type``, ``md5sum``, ``callerid`` ...), if anything.
    """

    def __init__(self, message: str = "", header: Mapping[str, str] | None = None) -> None:
        super().__init__(message)
        self.header = dict(header or {})


class TransportTerminated(TransportException):
    """A connection between two nodes was closed by the other side."""


class ServiceException(RosminiError):
    """A service call failed: no server, the handler raised, or the answer did not arrive."""


class ServiceRefused(ServiceException):
    """A handler refuses a request as one in C++ that returns false: the caller gets this text, empty or not, alone."""


# ---- genpy's names ----


class MessageException(RosminiError):
    """A message, or the description of one, is wrong."""


class SerializationError(MessageException):
    """A field of a message holds something that its ROS type cannot hold."""


class DeserializationError(MessageException):
    """Bytes from a wire or a bag are not a message of the type that was expected."""


# ---- ours ----


class IllegalName(RosminiError, ValueError):
    """A graph or package resource name breaks the rules of http://wiki.ros.org/Names."""


class InvalidRate(RosminiError, ZeroDivisionError, ValueError):
    """A rate is not positive (rospy raises ``ZeroDivisionError`` for 0, ``ValueError`` for NaN, and takes the rest)."""


class UnknownPackage(RosminiError):
    """No ROS package of this name is on the package path."""


class UnknownType(RosminiError):
    """No message, service or action type of this name is known."""


class LocatedError(RosminiError):
    """Something is wrong in ``file``, at line ``line`` (counted from 1), where these are known."""

    def __init__(self, message: str, file: str | Path | None = None, line: int | None = None) -> None:
        self.message = message
        self.file = None if file is None else str(file)
        self.line = line
        super().__init__(message, self.file, line)

    def __str__(self) -> str:
        place = ":".join(str(part) for part in (self.file, self.line) if part is not None)
        return f"{place}: {self.message}" if place else self.message


class DefinitionError(LocatedError):
    """A ``.msg``, ``.srv``, ``.action`` or manifest file is broken."""


class MasterUnreachable(ROSException):
    """The Master did not answer: it is not running, or its address is wrong."""


class TypeMismatch(RosminiError):
    """Two ends of a topic or a service disagree about its type."""


class ParameterError(RosminiError):
    """A parameter has a value of the wrong type, out of range, or one that ROS cannot hold."""


class ParameterOverflow(ParameterError, OverflowError):
    """A parameter was to be set to an integer of more than 32 bits (rospy raises ``OverflowError``)."""


class ParameterTypeError(ParameterError, TypeError):
    """A parameter was to be set to a kind of value that ROS cannot hold (rospy raises ``TypeError``)."""


class ParameterNotSet(ParameterError, KeyError):
    """A parameter was asked for that nobody has set (rospy raises ``KeyError``)."""

    # KeyError shows the repr of its argument, which would put quotes and "\n" into our sentences.
    __str__ = Exception.__str__


class ScriptError(RosminiError):
    """A script is not there, is not Python, or failed while it was being loaded."""


class CommandError(RosminiError):
    """A command of ROS's failed: its text is all that a terminal shows, and a cell shows no causes either."""

    def _render_traceback_(self) -> list[str]:
        """What IPython shows."""
        cause, context, quiet = self.__cause__, self.__context__, self.__suppress_context__
        self.__cause__ = self.__context__ = None
        try:
            return short_traceback(self)
        finally:
            self.__cause__, self.__context__, self.__suppress_context__ = cause, context, quiet


class UsageError(CommandError):
    """A command line that makes no sense."""


class CallbackError(RosminiError):
    """A callback raised; ``__cause__`` is what it raised."""


class DuplicateNode(RosminiError):
    """A node was shut down because another one registered under the same name."""


class GraphEnded(RosminiError):
    """Nothing more can happen in the graph, so what was waited for will never come."""


_LONGEST_NAME = 300
"""A longer name is not compared with others."""


def _counts(letters: str, text: str) -> list[int]:
    """How often each of the letters is in a text."""
    return [text.count(letter) for letter in dict.fromkeys(letters)]


def nearest(name: str, candidates: Iterable[str], limit: int = 3) -> str:
    """The clause "did you mean ...?" for a mistyped ``name``; empty if no candidate resembles it.

    Upper and lower case count as alike, and so do equal last parts of names in different namespaces (``/scan`` and
    ``/robot1/scan``). The answer depends only on the set of candidates, not on their order.

    >>> nearest("/chater", ["/chatter", "/rosout"])
    'did you mean /chatter?'
    """
    if len(name) > _LONGEST_NAME:
        return ""
    from difflib import SequenceMatcher  # only needed once something has gone wrong

    wanted = name.lower()
    wanted_base = wanted.rpartition("/")[2]

    def ratio(one: str, other: str) -> float:
        """The ratio of `SequenceMatcher`; 0 if it is certainly too small."""
        if (
            not one
            or not other
            or 2 * sum(map(min, _counts(one, one), _counts(one, other))) < 0.7 * (len(one) + len(other))
        ):
            return 0.0
        return SequenceMatcher(None, one, other).ratio()

    def likeness(candidate: str) -> float:
        folded = candidate.lower()
        return max(ratio(wanted, folded), 0.95 * ratio(wanted_base, folded.rpartition("/")[2]))

    known = {each for each in candidates if each != name and len(each) <= _LONGEST_NAME}
    ranked = sorted((-likeness(candidate), candidate) for candidate in known)
    if not ranked or ranked[0][0] > -0.7:
        return ""
    best = ranked[0][0]
    found = [candidate for score, candidate in ranked if score <= min(-0.7, best + 0.1)][:limit]
    listed = found[0] if len(found) == 1 else f"{', '.join(found[:-1])} or {found[-1]}"
    return f"did you mean {listed}?"


class Hints:
    """`nearest` for the notes on one file. Only the first `MOST` names get a hint, since each takes milliseconds."""

    MOST = 20

    def __init__(self) -> None:
        self._count = 0

    def __call__(self, name: str, candidates: Iterable[str]) -> str:
        """The clause of `nearest`, or nothing."""
        self._count += 1
        return nearest(name, candidates) if self._count <= self.MOST else ""


def shown(value: object, limit: int = 60) -> str:
    """``repr(value)`` for an error message: one line of at most ``limit`` characters, and cut before it is made.

    Of a text, a list or a message only as much is looked at as is shown, so a value of a gigabyte costs nothing. Large
    numbers and arrays are described. What cannot say what it is, because its ``__repr__`` fails, is shown by its class.

    >>> shown("a" * 10**6, 20)
    "'aaaaaaaaaaaaaaaa..."
    >>> shown({"ranges": [1.5] * 10**6}, 30)
    "{'ranges': [1.5, 1.5, 1.5, ..."
    """
    text = _repr(value, limit + 1)
    return text if len(text) <= limit else f"{text[: max(limit - 3, 0)]}..."


def _repr(value: Any, room: int) -> str:
    """``repr(value)``, right in its first ``room`` characters; longer than that if anything was left out."""
    if isinstance(value, (str, bytes, bytearray)):
        return repr(value[:room])
    if isinstance(value, int) and value.bit_length() > 256:
        return f"<an integer of {value.bit_length()} bits>"
    cls = type(value)
    parts = getattr(cls, "__match_args__", ())  # messages, data classes and named tuples name their parts
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
    """The traceback of ``error`` and of its causes as IPython shows it, without the frames of rosmini.

    What is no error of ours keeps those in which it was raised: there it may be a fault of ours.
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
        users = not file.is_relative_to(ours) and file.parts[-3:] != (
            "IPython",
            "core",
            "interactiveshell.py",
        )
        if users or keep_last:
            result = TracebackType(result, entry.tb_frame, entry.tb_lasti, entry.tb_lineno)
        keep_last = keep_last and not users
    return result
