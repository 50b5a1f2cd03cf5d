"""Checks the addresses under which nodes register at a Master of this process.

The Master passes these addresses on to other nodes. A wrong one is the most frequent fault of ROS on
several machines: all lists are complete, but no message arrives (http://wiki.ros.org/ROS/NetworkSetup).
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from urllib.parse import urlsplit

from .addresses import is_literal, is_loopback
from .sockets import Unreached, resolve

LIMIT = 1_000
"""Maximum number of nodes and addresses remembered, to warn of each only once."""


class Advertised:
    """Warns once about each node that others cannot reach at its advertised address. I/O thread only."""

    def __init__(self, warn: Callable[[str], object]) -> None:
        self._warn = warn
        self._seen: set[tuple[str, str]] = set()
        self._tasks: set[asyncio.Task[None]] = set()

    def look(self, caller: str, name: str, uri: str) -> None:
        """Check a registration that came from the address ``caller``, of a node that advertises ``uri``."""
        try:
            host = urlsplit(uri).hostname or ""
        except ValueError:
            return
        if is_loopback(caller) or not host or (name, host) in self._seen or len(self._seen) >= LIMIT:
            return
        self._seen.add((name, host))
        if is_loopback(host):
            self._warn_unreachable(caller, name, uri, f"on every machine {host} is that machine itself")
        elif not is_literal(host):
            task = asyncio.get_running_loop().create_task(self._resolve(caller, name, uri, host))
            self._tasks.add(task)
            task.add_done_callback(self._tasks.discard)

    async def _resolve(self, caller: str, name: str, uri: str, host: str) -> None:
        try:
            await resolve(host, 0)
        except Unreached:
            self._warn_unreachable(caller, name, uri, f"the name {host} does not resolve here")

    def _warn_unreachable(self, caller: str, name: str, uri: str, why: str) -> None:
        self._warn(
            f"{name}, on the machine at {caller}, advertises {uri}, but {why}: other machines list its topics and get "
            f"no message. There, set ROS_IP={caller} and start {name} again."
        )
