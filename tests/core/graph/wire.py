"""What is still on its way over the TCP connections that this process has with itself, as Linux tells it."""

from __future__ import annotations

import asyncio
import os
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING

from rosmini.ros.net.network import network_of

if TYPE_CHECKING:
    from rosmini.core.graph import Graph

TURNS = 50
"""More turns of the I/O thread's loop than it takes from the last byte read to what the hub learns of it."""


def unread() -> bool:
    """Whether a socket of this process has sent what was not received, or received what was not read."""
    own = set()
    for number in os.listdir("/proc/self/fd"):
        with suppress(OSError):  # closed meanwhile
            own.add(os.readlink(f"/proc/self/fd/{number}"))
    rows = [
        line.split()
        for table in ("tcp", "tcp6")
        for line in Path(f"/proc/self/net/{table}").read_text(encoding="ascii").splitlines()[1:]
    ]
    return any(row[4] != "00000000:00000000" and f"socket:[{row[9]}]" in own for row in rows)


def is_under_way(graph: Graph) -> bool:
    """Whether the nodes of a graph that talk over TCPROS have sent what the graph has not taken up yet."""

    async def turn() -> None:
        for _ in range(TURNS):
            await asyncio.sleep(0)

    io = network_of(graph).io
    if io.runs:
        if unread():
            return True
        io.start(turn()).result()
        if unread():
            return True
    return not graph.scheduler.is_idle()
