"""A Master in another process, called by a graph: the Master API over XML-RPC."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rosmini.core.errors import TransportException
from rosmini.core.graph.master_port import MasterPort

from .master_answers import checked, unreachable

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
