"""Publication of a costmap: the whole grid or only the changes (http://wiki.ros.org/costmap_2d#Published_Topics)."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from rosmini.msgs import message_class

from .costmap import INSCRIBED_INFLATED_OBSTACLE, LETHAL_OBSTACLE, NO_INFORMATION, Costmap2D
from .layer import Window

if TYPE_CHECKING:
    from rosmini.core.graph import Node


@cache
def published_values() -> NDArray[np.int8]:
    """Return the `OccupancyGrid` value of each cost (256): 0 to 98 for 0 to 252, then 99, 100, and -1 for 255."""
    costs = np.arange(256)
    table = 1 + 97 * (costs - 1) // 251
    table[0] = 0
    table[INSCRIBED_INFLATED_OBSTACLE], table[LETHAL_OBSTACLE], table[NO_INFORMATION] = 99, 100, -1
    values = table.astype(np.int8)
    values.setflags(write=False)
    return values


class Costmap2DPublisher:
    """Publishes a grid on `topic`, and its changed rectangles on `topic`_updates."""

    def __init__(
        self, node: Node, grid: Costmap2D, global_frame: str, topic: str, *, always_send_full: bool = False
    ) -> None:
        self._node, self._grid, self._frame = node, grid, global_frame
        self._always_send_full = always_send_full
        self._sent: tuple[Any, ...] | None = None
        self._changed: Window | None = None
        self._whole_publisher = node.publisher(
            topic, message_class("nav_msgs/OccupancyGrid"), queue_size=1, on_connect=self._send_whole
        )
        self._update_publisher = node.publisher(
            topic + "_updates", message_class("map_msgs/OccupancyGridUpdate"), queue_size=1
        )
        for publisher in (self._whole_publisher, self._update_publisher):
            publisher.expect_nobody()

    def changed(self, window: Window) -> None:
        """Record that the cells of a window have changed since the last message."""
        if not window.is_empty:
            self._changed = window.united(self._changed)

    def publish(self) -> None:
        """Publish the changes, or the whole grid if its size or origin differs from the last message.

        No message is created without subscribers; a new subscriber receives the whole grid.
        """
        geometry = self._grid.geometry
        changed, self._changed = self._changed, None
        if self._always_send_full or self._sent != geometry:
            self._sent = geometry
            if self._whole_publisher.num_connections():
                self._whole_publisher.publish(self._message())
        elif changed is not None and self._update_publisher.num_connections():
            self._update_publisher.publish(self._update(changed))

    def _send_whole(self, subscriber: str) -> None:
        """Send the whole grid to a new subscriber."""
        self._whole_publisher.publish_to(subscriber, self._message())

    def _message(self) -> Any:
        grid = self._grid
        message = message_class("nav_msgs/OccupancyGrid")()
        message.header.frame_id = self._frame
        message.header.stamp = message.info.map_load_time = self._node.now()
        message.info.resolution = grid.resolution
        message.info.width, message.info.height = grid.width, grid.height
        message.info.origin.position.x, message.info.origin.position.y = grid.origin
        message.info.origin.orientation.w = 1.0
        message.data = published_values()[grid.costs].ravel()
        return message

    def _update(self, window: Window) -> Any:
        update = message_class("map_msgs/OccupancyGridUpdate")()
        update.header.frame_id = self._frame
        update.header.stamp = self._node.now()
        update.x, update.y = window.x0, window.y0
        update.width, update.height = window.xn - window.x0, window.yn - window.y0
        update.data = published_values()[window.view(self._grid.costs)].ravel()
        return update
