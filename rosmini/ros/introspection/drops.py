"""Messages dropped by queues, as counted by nodes (``getBusStats``, http://wiki.ros.org/ROS/Slave_API)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from rosmini.core.peers import Peers


class Flow(NamedTuple):
    """One end of a topic connection: the peers, and the number of messages dropped by the queue at this end."""

    topic: str
    publisher: str
    subscriber: str
    side: str
    """Owner of the queue: "publisher" or "subscriber"."""
    dropped: int

    def __str__(self) -> str:
        return (
            f"{self.publisher} -> {self.subscriber} ({self.topic}): {self.dropped} dropped by the queue of the "
            f"{self.side}"
        )


def flows(peers: Peers, caller: str, name: str, uri: str, names: Mapping[str, str]) -> tuple[Flow, ...]:
    """Ask a node for its dropped messages; empty for clients that do not count them or use another format.

    ``names`` maps addresses to names of nodes. Raises ``TransportException`` if the node does not answer.
    """
    stats, rows = (peers.transport.call(uri, method, caller) for method in ("getBusStats", "getBusInfo"))
    try:
        return tuple(_flows(stats, rows, name, names))
    except (LookupError, TypeError, ValueError):
        return ()


def _flows(stats: Any, rows: Any, name: str, names: Mapping[str, str]) -> Iterator[Flow]:
    published, subscribed, *_ = stats[2] if stats[0] == 1 else stats  # roscpp's answer has no code
    others = {row[0]: names.get(row[1], str(row[1])) for row in rows[2]}
    for topic, _, links in published:
        for row in links:
            if len(row) > 4 and row[0] in others:  # rosmini's addition
                yield Flow(topic, name, others[row[0]], "publisher", int(row[4]))
    for topic, links in subscribed:
        for row in links:
            dropped = int(row[3] if len(row) > 4 else row[2])  # rospy and roscpp count the messages before it
            if dropped >= 0 and row[0] in others:
                yield Flow(topic, others[row[0]], name, "subscriber", dropped)
