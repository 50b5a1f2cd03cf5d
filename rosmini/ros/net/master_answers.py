"""What a Master in another process answers, checked before anybody takes it apart, and what it means if none comes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rosmini.core.errors import MasterUnreachable, TransportException, TransportTerminated, shown

from .sockets import Unreached

if TYPE_CHECKING:
    from rosmini.core.graph.transport import Triple


def checked(uri: str, method: str, answer: Any) -> Triple:
    """Return an answer of the Master's. Raises ``MasterUnreachable`` if it is none, or its value is of another type."""
    if (
        isinstance(answer, list)
        and len(answer) == 3
        and isinstance(answer[0], int)
        and isinstance(answer[1], str)
        and (answer[0] != 1 or VALUES.get(method, _anything)(answer[2]))
    ):
        return answer
    raise _no_master(uri, f"to {method} it said {shown(answer)}")


def _anything(_value: Any) -> bool:
    return True


def _is_text(value: Any) -> bool:
    return isinstance(value, str)


def _are_texts(value: Any) -> bool:
    return isinstance(value, list) and all(map(_is_text, value))


def _are_pairs(value: Any) -> bool:
    return isinstance(value, list) and all(_are_texts(each) and len(each) == 2 for each in value)


def _is_state(value: Any) -> bool:
    """Tell whether a value is as that of ``getSystemState``: three tables of names, each with those of nodes."""
    return (
        isinstance(value, list)
        and len(value) == 3
        and all(isinstance(table, list) for table in value)
        and all(
            isinstance(row, list) and len(row) == 2 and _is_text(row[0]) and _are_texts(row[1])
            for table in value
            for row in table
        )
    )


VALUES = {
    **dict.fromkeys(("lookupNode", "lookupService", "getUri"), _is_text),
    **dict.fromkeys(("registerPublisher", "registerSubscriber", "getParamNames"), _are_texts),
    **dict.fromkeys(("getPublishedTopics", "getTopicTypes"), _are_pairs),
    "getSystemState": _is_state,
}
"""What the value of an answer has to be: whoever asks takes it apart."""


def unreachable(uri: str, error: TransportException) -> MasterUnreachable:
    """Return the error that says that a Master does not answer, why, and what to do."""
    if not isinstance(error, Unreached | TransportTerminated):
        return _no_master(uri, str(error))
    hangs = isinstance(error.__cause__, TimeoutError)
    start = "End it and start it again, if it runs" if hangs else "Start it with `rosmini roscore`"
    return MasterUnreachable(
        f"the Master at {uri} does not answer: {error}. {start}, or set ROS_MASTER_URI to the address of one that runs"
    )


def _no_master(uri: str, why: str) -> MasterUnreachable:
    return MasterUnreachable(
        f"what answers at {uri} is not a ROS Master: {why}. Set ROS_MASTER_URI to the address that roscore shows "
        "when it starts."
    )
