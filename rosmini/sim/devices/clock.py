"""The world's time for the whole graph."""

from __future__ import annotations

from rosmini.msgs import message_class
from rosmini.sim.host import Device, Host, Stamp

from .sensor import Outlet

FIELDS = ("clock.secs", "clock.nsecs")


class ClockDevice(Device):
    """`rosgraph_msgs/Clock`: the time that the host's messages bear. Nodes live on it that have /use_sim_time set.

    Args:
        host: whose time; it has to be one that counts `from_zero`, for another lives on the graph's time itself.
        rate: how often [Hz].
        topic: where it is published.

    """

    order = 0.0

    def __init__(self, host: Host, *, rate: float = 100.0, topic: str = "/clock") -> None:
        super().__init__(host, f"time on {topic}", rate)
        self._outlet = Outlet(host.node, topic, message_class("rosgraph_msgs/Clock")(), FIELDS)

    def due(self, stamp: Stamp, _: int, /) -> None:
        """Tell what time it is."""
        if self._outlet.heard():
            self._outlet.publish(stamp, stamp)

    def tell(self) -> None:
        """Tell it at once: after time was set back, or stepped while it stands."""
        now = self.host.stamp
        self.due((now.secs, now.nsecs), 0)

    def close(self) -> None:
        """End the topic."""
        self._outlet.close()
