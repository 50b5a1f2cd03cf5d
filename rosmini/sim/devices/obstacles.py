"""Poses of the objects that move: those that robots push, walkers and doors."""

from __future__ import annotations

from typing import Any

from rosmini.msgs import message_class
from rosmini.sim.host import Device, Host, Stamp
from rosmini.sim.markers import Markers
from rosmini.sim.messages import MAP


class ObstacleMarkers(Device):
    """`visualization_msgs/MarkerArray` of all moving objects: one marker per simple part, with the object's name as ns.

    Args:
        host: the simulated world.
        topic: where it is published.
        frame: the world's frame.
        rate: messages per second [Hz].
        name: the device's name.

    """

    always = False

    def __init__(
        self, host: Host, *, topic: str = "obstacles", frame: str = MAP, rate: float = 10.0, name: str = "obstacles"
    ) -> None:
        super().__init__(host, name, rate)
        self._publisher = host.node.publisher(topic, message_class("visualization_msgs/MarkerArray"), queue_size=10)
        self._markers = Markers(frame)

    def wanted(self) -> bool:
        """Return True if the topic has a subscriber."""
        return self._publisher.num_connections() > 0

    def due(self, stamp: Stamp, _: int, /) -> None:
        """Publish the poses, and deletions of the objects that are gone."""
        self._publisher.publish(self._message(stamp))

    def _message(self, stamp: Stamp) -> Any:
        return self._markers.message(self.host.engine.obstacles(), stamp)

    def close(self) -> None:
        """Close the topic."""
        self._publisher.unregister()
