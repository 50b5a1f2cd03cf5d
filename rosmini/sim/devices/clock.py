"""The world's time for the whole graph."""

from __future__ import annotations

from rosmini.msgs import message_class
from rosmini.sim.host import Device, Host, Stamp

from .sensor import Outlet

FIELDS = ("clock.secs", "clock.nsecs")


class ClockDevice(Device):
    """`rosgraph_msgs/Clock`: the time of the host's stamps, for nodes with /use_sim_time.

    Args:
        host: whose time; one that counts `from_zero`, because any other follows the graph's own time.
        rate: how often [Hz].
        topic: where it is published.

    """

    order = 0.0

    def __init__(self, host: Host, *, rate: float = 100.0, topic: str = "/clock") -> None:
        super().__init__(host, f"time on {topic}", rate)
        self._outlet = Outlet(host.node, topic, message_class("rosgraph_msgs/Clock")(), FIELDS)

    def due(self, stamp: Stamp, _: int, /) -> None:
        """Publish the time."""
        if self._outlet.heard():
            self._outlet.publish(stamp, stamp)

    def tell(self) -> None:
        """Publish it immediately: after time was reset, or stepped while paused."""
        now = self.host.stamp
        self.due((now.secs, now.nsecs), 0)

    def close(self) -> None:
        """End the topic."""
        self._outlet.close()
