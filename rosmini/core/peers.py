"""Who can be asked: the Master, in somebody's name, and each node by its slave API."""

from __future__ import annotations

from typing import Any, Protocol
from urllib.parse import urlsplit

Triple = list[Any]
"""What every method of the Master and of a node answers: [code, status, value]."""


class Asker(Protocol):
    """The Master as one caller sees it."""

    def call(self, method: str, *arguments: Any) -> Triple:
        """Return the Master's answer. Raises ``MasterUnreachable``."""

    def ask(self, method: str, *arguments: Any) -> Any:
        """Return the value of the answer. Raises ``ROSException`` for any code but 1, and ``MasterUnreachable``."""

    def find(self, method: str, *arguments: Any) -> Any:
        """Return the value of the answer, or None if the code is not 1. Raises ``MasterUnreachable``."""


class Slaves(Protocol):
    """The nodes."""

    def call(self, uri: str, method: str, *arguments: Any) -> Triple:
        """Call a method of a node's slave API. Raises ``TransportException`` when nobody answers."""

    def probe_service(self, uri: str, header: dict[str, str]) -> dict[str, str]:
        """Return the header with which a service's server answers. Raises ``TransportException`` when nobody does."""


class Clock(Protocol):
    """The time in which questions take their time."""

    def now_ns(self) -> int:
        """Return the time in nanoseconds."""

    def sleep_until(self, when_ns: int, reason: str | None = None) -> None:
        """Block until that time."""


class Peers(Protocol):
    """The Master and the nodes of a graph; a :class:`~rosmini.Graph` is one."""

    @property
    def master_uri(self) -> str:
        """The Master's address."""

    @property
    def transport(self) -> Slaves:
        """The way to the nodes."""

    @property
    def scheduler(self) -> Clock:
        """The clock."""

    def ask_as(self, caller_id: str) -> Asker:
        """Return the Master as a caller of this name sees it."""


def host_of(uri: str) -> str:
    """Return the host in the address of a node; empty if there is none."""
    try:
        return urlsplit(uri).hostname or ""
    except ValueError:
        return ""
