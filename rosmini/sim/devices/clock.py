"""The world's time, published for the whole graph."""

from __future__ import annotations

from rosmini.msgs import message_class
from rosmini.sim.host import Device, Host, Stamp

from .sensor import Outlet

FIELDS = ("clock.secs", "clock.nsecs")


class ClockDevice(Device):
    """`rosgraph_msgs/Clock`: the time of the host's stamps, for nodes with /use_sim_time.

    Args:
        host: the simulated world; it must count `from_zero`, because any other follows the graph's own time.
        rate: messages per second [Hz].
        topic: where it is published.

    """

    order = 0.0

    def __init__(self, host: Host, *, rate: float = 100.0, topic: str = "/clock") -> None:
        super().__init__(host, f"time on {topic}", rate)
        self._outlet = Outlet(host.node, topic, message_class("rosgraph_msgs/Clock")(), FIELDS)

    def due(self, stamp: Stamp, _: int, /) -> None:
        """Publish the time."""
        if self._outlet.num_connections():
            self._outlet.publish(stamp, stamp)

    def publish_now(self) -> None:
        """Publish the time immediately: after a reset of time, or a step while paused."""
        now = self.host.stamp
        self.due((now.secs, now.nsecs), 0)

    def close(self) -> None:
        """Close the topic."""
        self._outlet.close()
