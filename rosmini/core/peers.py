"""Interfaces for calling the Master on behalf of a node, and the slave API of each node."""

from __future__ import annotations

from typing import Any, Protocol
from urllib.parse import urlsplit

Triple = list[Any]
"""The response of every method of the Master and of a node: [code, status, value]."""


class Asker(Protocol):
    """Calls methods of the Master on behalf of one caller."""

    def call(self, method: str, *arguments: Any) -> Triple:
        """Return the Master's response: code, status and value. Raises ``MasterUnreachable`` if there is none."""

    def ask(self, method: str, *arguments: Any) -> Any:
        """Return the value of the response.

        Raises ``ROSException`` if the code is not 1, and ``MasterUnreachable`` if there is no response.
        """

    def find(self, method: str, *arguments: Any) -> Any:
        """Return the value of the response, or None if the code is not 1. Raises ``MasterUnreachable``."""


class Slaves(Protocol):
    """The slave APIs of all nodes."""

    def call(self, uri: str, method: str, *arguments: Any) -> Triple:
        """Return the response of a node's slave API. Raises ``TransportException`` if there is none."""

    def probe_service(self, uri: str, header: dict[str, str]) -> dict[str, str]:
        """Return the header sent by a service's server. Raises ``TransportException`` if there is no response."""


class Clock(Protocol):
    """The graph's clock."""

    def now_ns(self) -> int:
        """Return the time in nanoseconds."""

    def sleep_until(self, when_ns: int, reason: str | None = None) -> None:
        """Block until the given time [ns]; ``reason`` says what the caller waits for."""


class Peers(Protocol):
    """The Master and the nodes of a graph; a :class:`~rosmini.Graph` is one."""

    @property
    def master_uri(self) -> str:
        """The Master's address."""

    @property
    def transport(self) -> Slaves:
        """The connection to the nodes."""

    @property
    def scheduler(self) -> Clock:
        """The clock."""

    def ask_as(self, caller_id: str) -> Asker:
        """Return an interface for calling the Master on behalf of ``caller_id``."""


def host_of(uri: str) -> str:
    """Return the host in the address of a node; empty if there is none."""
    try:
        return urlsplit(uri).hostname or ""
    except ValueError:
        return ""
