"""The client: collects the markers of servers from their messages, as RViz does.

It takes messages and times and has no node; its user subscribes and passes the messages on.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from rosmini.msgs import message_class

InteractiveMarkerUpdate = message_class("visualization_msgs/InteractiveMarkerUpdate")

SILENT = 2.0
"""Time without updates after which a server may be dead [s]."""
MAX_WAITING = 100
MAX_SERVERS = 100


@dataclass
class ServerState:
    """State of one server as the client knows it."""

    markers: dict[str, Any] = field(default_factory=dict)
    """Markers by name, each a ``visualization_msgs/InteractiveMarker``."""
    seq_num: int | None = None
    """Number of the last update included in the markers; None before the first full message."""
    heard_ns: int | None = None
    """Time of the last update [ns], including updates without changes."""
    problem: str = ""
    """Why the server's markers were discarded; empty if all is well."""
    waiting: dict[int, Any] = field(default_factory=dict)
    """Updates received before the first full message, by number."""

    def text(self, now_ns: int) -> tuple[bool, str]:
        """Return True if all is well, and the state of the server in RViz's words."""
        if self.problem:
            return False, self.problem
        if self.seq_num is None:
            return True, "Waiting for init message."
        silent = 0.0 if self.heard_ns is None else (now_ns - self.heard_ns) / 1e9
        if silent > SILENT:
            return False, f"No update received for {round(silent)} seconds."
        return True, "Initialization complete."


class InteractiveMarkerClient:
    """Markers of all servers that publish on one pair of topics, by server id.

    Updates are numbered; after a gap the markers of a server are discarded until its next full message.
    """

    def __init__(self) -> None:
        self.servers: dict[str, ServerState] = {}

    def init(self, message: Any, now_ns: int) -> set[str]:
        """Process a ``visualization_msgs/InteractiveMarkerInit``; return the names of new markers."""
        state = self._state(message.server_id)
        if state is None or state.seq_num is not None:
            return set()
        state.markers = {marker.name: marker for marker in message.markers}
        state.seq_num, state.heard_ns, state.problem = message.seq_num, now_ns, ""
        changed = set(state.markers)
        waiting, state.waiting = state.waiting, {}
        for number in sorted(waiting):
            if number > message.seq_num:
                changed |= self.update(waiting[number], now_ns)
        return changed

    def update(self, message: Any, now_ns: int) -> set[str]:
        """Process a ``visualization_msgs/InteractiveMarkerUpdate``; return the names of changed markers."""
        state = self._state(message.server_id)
        if state is None:
            return set()
        state.heard_ns = now_ns
        is_change = message.type == InteractiveMarkerUpdate.UPDATE
        if state.seq_num is None:
            if is_change and len(state.waiting) < MAX_WAITING:
                state.waiting[message.seq_num] = message
            return set()
        expected = state.seq_num + is_change
        if message.seq_num != expected:
            names = set(state.markers)
            state.markers, state.seq_num = {}, None
            state.problem = (
                f"Sequence number of update is out of order. Expected: {expected} Received: {message.seq_num}"
            )
            return names
        state.seq_num = message.seq_num
        return self._apply(state, message) if is_change else set()

    def _apply(self, state: ServerState, message: Any) -> set[str]:
        changed = set()
        for marker in message.markers:
            state.markers[marker.name] = marker
            changed.add(marker.name)
        for pose in message.poses:
            if pose.name in state.markers:
                marker = state.markers[pose.name]
                marker.pose, marker.header = pose.pose, pose.header
                changed.add(pose.name)
            else:
                state.problem = f"Pose received for non-existing marker '{pose.name}'"
        for name in message.erases:
            state.markers.pop(name, None)
            changed.add(name)
        return changed

    def _state(self, server_id: str) -> ServerState | None:
        if server_id not in self.servers and len(self.servers) >= MAX_SERVERS:
            return None
        return self.servers.setdefault(server_id, ServerState())
