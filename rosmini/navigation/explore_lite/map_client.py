"""A map or costmap received from two topics, and the robot's position on it."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, Any

import numpy as np

from rosmini.core.tf import TransformException, TransformListener
from rosmini.core.time import Time
from rosmini.msgs import message_class
from rosmini.navigation.costmap_2d.costmap import (
    INSCRIBED_INFLATED_OBSTACLE,
    LETHAL_OBSTACLE,
    NO_INFORMATION,
    Costmap2D,
    Costs,
)
from rosmini.navigation.costmap_2d.layer import Window
from rosmini.navigation.nav_core import TransformMissing
from rosmini.navigation.nav_core.poses import planar_transform

if TYPE_CHECKING:
    from rosmini.core.graph import Node

    from .node import ExploreParameters

WARN_PERIOD = 5.0
"""Interval between warnings while the map or the robot's transform is missing [s]."""


@cache
def costs_by_value() -> Costs:
    """Return the cost (256) of each `OccupancyGrid` value as a byte: 0 to 98 are spread over 0 to 252."""
    values = np.arange(256)
    table = (251 * (values - 1) - 1) // 97 + 1
    table[0] = 0
    table[99], table[100:] = INSCRIBED_INFLATED_OBSTACLE, LETHAL_OBSTACLE
    table[255] = NO_INFORMATION
    costs = table.astype(np.uint8)
    costs.setflags(write=False)
    return costs


class MapClient:
    """Receives a map and its updates into `grid`.

    The constructor blocks until there is a map, and until the robot's pose on it is known.
    """

    def __init__(self, node: Node, parameters: ExploreParameters) -> None:
        self.node = node
        self.base_frame = parameters.robot_base_frame.lstrip("/")
        self.grid = Costmap2D(0, 0, 1.0, default=NO_INFORMATION)
        self.global_frame = ""
        self._tolerance = parameters.transform_tolerance
        self.buffer = TransformListener(node).buffer
        topic = parameters.costmap_topic
        self._waiter = node.waiter(f"the map on {node.resolve(topic)}")
        node.subscriber(topic, message_class("nav_msgs/OccupancyGrid"), self._on_map, queue_size=1000)
        self._wait_for_map(topic)
        node.subscriber(
            parameters.costmap_updates_topic,
            message_class("map_msgs/OccupancyGridUpdate"),
            self._on_update,
            queue_size=1000,
        )
        self._wait_for_robot()

    def _wait_for_map(self, topic: str) -> None:
        node = self.node
        node.loginfo(f"Waiting for costmap to become available, topic: {topic}")
        while not self.global_frame and not node.wait(self._waiter, WARN_PERIOD):
            node.logwarn(
                f"Still waiting for the map on {node.resolve(topic)}: {node.master.who_publishes(node.resolve(topic))}"
            )
            self._waiter = node.waiter(f"the map on {node.resolve(topic)}")

    def _wait_for_robot(self) -> None:
        while not self.buffer.wait_for_transform(self.global_frame, self.base_frame, timeout=WARN_PERIOD):
            why = self.buffer.tree.why_not(self.global_frame, self.base_frame)
            self.node.logwarn(
                f"Timed out waiting for transform from {self.base_frame} to {self.global_frame} to become available "
                f"before subscribing to costmap, tf error: {why}"
            )

    def _on_map(self, message: Any) -> None:
        info = message.info
        if len(message.data) != info.width * info.height or not info.resolution > 0:
            self.node.logerr(
                f"A map has {len(message.data)} cells, and its info says {info.width} x {info.height} of "
                f"{info.resolution:g} m: the map is ignored"
            )
            return
        origin = info.origin.position
        self.grid.resize(info.width, info.height, float(info.resolution), (origin.x, origin.y))
        self.grid.costs[...] = _costs(message.data, info.width)
        self.global_frame = message.header.frame_id.lstrip("/")
        self._waiter.wake()

    def _on_update(self, update: Any) -> None:
        window = Window(update.x, update.y, update.x + update.width, update.y + update.height)
        if not window.fits(self.grid) or len(update.data) != update.width * update.height:
            self.node.logerr(
                f"An update of {update.width} x {update.height} cells at ({update.x}, {update.y}) does not fit the "
                f"map of {self.grid.width} x {self.grid.height}: it is ignored",
                throttle=WARN_PERIOD,
            )
            return
        if not window.is_empty:
            window.view(self.grid.costs)[...] = _costs(update.data, update.width)

    def robot(self) -> tuple[float, float]:
        """Return the robot's position on the map [m]. Raises `TransformMissing` if it is unknown or too old."""
        try:
            found = self.buffer.lookup_transform(self.global_frame, self.base_frame, Time(0))
        except TransformException as error:
            raise TransformMissing(f"No Transform available Error looking up robot pose: {error}") from error
        age = (self.node.now() - found.header.stamp).to_sec()
        if not found.header.stamp.is_zero() and age > self._tolerance:
            raise TransformMissing(
                f"Transform timeout: the robot's pose in {self.global_frame} is {age:.2f} s old, and the "
                f"transform_tolerance is {self._tolerance:g} s"
            )
        x, y, _ = planar_transform(found)
        return x, y


def _costs(data: Any, width: int) -> Costs:
    costs: Costs = costs_by_value()[np.asarray(data, dtype=np.int8).view(np.uint8)].reshape(-1, max(width, 1))
    return costs
