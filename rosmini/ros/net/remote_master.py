"""A Master in another process, called by a graph: the Master API over XML-RPC, whose answers are validated."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rosmini.core.errors import MasterUnreachable, TransportException, TransportTerminated, shown
from rosmini.core.graph.master_port import MasterPort

from .sockets import Unreached

if TYPE_CHECKING:
    from rosmini.core.graph.transport import Triple

    from .watch import Watch
    from .xmlrpc_client import XmlRpcClient

TIMEOUT_S = 10.0
"""Timeout of a call to the Master, in wall-clock time [s]."""

LEAVE_S = 2.0
"""Timeout of a call that unregisters [s], so that a Master that hangs does not delay a node's end."""


def patience(method: str) -> float:
    """Return the timeout of a call to the Master [s]."""
    return LEAVE_S if method.startswith(("unregister", "unsubscribe")) else TIMEOUT_S


class RemoteMaster(MasterPort):
    """The Master at ``uri``; a call parks the calling lane, while simulated time continues.

    ``watch`` monitors the registrations made through it.
    """

    def __init__(self, uri: str, client: XmlRpcClient, watch: Watch | None = None) -> None:
        self.uri = uri
        self._client = client
        self._watch = watch

    def call(self, method: str, caller_id: str, *arguments: Any) -> Triple:
        """Return the Master's answer: [code, status, value].

        Raises ``MasterUnreachable``, which says what to do, if there is no answer.
        """
        try:
            answer = self._client.call(self.uri, method, caller_id, *arguments, timeout=patience(method))
        except TransportException as error:
            raise unreachable(self.uri, error) from error
        triple = checked(self.uri, method, answer)
        if self._watch is not None and method.startswith("register"):
            self._watch.begin()
        return triple


def checked(uri: str, method: str, answer: Any) -> Triple:
    """Return a Master's answer. Raises ``MasterUnreachable`` if it is invalid or its value has the wrong type."""
    if (
        isinstance(answer, list)
        and len(answer) == 3
        and isinstance(answer[0], int)
        and isinstance(answer[1], str)
        and (answer[0] != 1 or method not in VALUES or VALUES[method](answer[2]))
    ):
        return answer
    raise _no_master(uri, f"to {method} it said {shown(answer)}")


def _is_text(value: Any) -> bool:
    return isinstance(value, str)


def _are_texts(value: Any) -> bool:
    return isinstance(value, list) and all(map(_is_text, value))


def _are_pairs(value: Any) -> bool:
    return isinstance(value, list) and all(_are_texts(each) and len(each) == 2 for each in value)


def _is_state(value: Any) -> bool:
    """Return True if a value has the form of ``getSystemState``: three tables of names with lists of nodes."""
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
"""Expected type of the value in an answer, by method; callers rely on it."""


def unreachable(uri: str, error: TransportException) -> MasterUnreachable:
    """Return the error for a Master that does not answer, with the cause and what to do."""
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
