"""`costmap_2d::StaticLayer`: the costs of a map (http://wiki.ros.org/costmap_2d/hydro/staticmap)."""

from __future__ import annotations

from typing import Any

import numpy as np

from rosmini.core.dynamic_reconfigure import Server
from rosmini.core.geometry.poses import Pose
from rosmini.core.tf import TransformException
from rosmini.core.tf.rigid import matrix
from rosmini.msgs import message_class

from .costmap import FREE_SPACE, LETHAL_OBSTACLE, NO_INFORMATION, Costmap2D, Costs
from .layer import Bounds, CostmapLayer, Window
from .parameters import LayerConfig, StaticParameters

WARN_PERIOD = 5.0
"""Interval between warnings while the map is missing [s]."""


def cost_table(settings: StaticParameters) -> Costs:
    """Return the cost (256) for each map value, taken as an unsigned byte (-1 is 255)."""
    values = np.arange(256)
    lethal = max(min(settings.lethal_cost_threshold, 100), 0)
    # With a threshold of 0 every cell is an obstacle; avoid dividing by it.
    table = np.zeros(256) if settings.trinary_costmap else values / max(lethal, 1) * LETHAL_OBSTACLE
    table[values >= lethal] = LETHAL_OBSTACLE
    costs = table.astype(np.uint8)
    costs[settings.unknown_cost_value & 0xFF] = NO_INFORMATION if settings.track_unknown_space else FREE_SPACE
    return costs


class StaticLayer(CostmapLayer, plugin="costmap_2d::StaticLayer"):
    """Subscribes to a map, blocks until the first one arrives, and sets the size of the costmap."""

    def on_initialize(self) -> None:
        """Read the parameters and wait for the map."""
        self._subscribers: list[Any] = []
        self._received = False
        self._changed: Window | None = None
        self._request_map()
        self._server = Server(self.node, LayerConfig, self._reconfigure, namespace=self.namespace)

    @property
    def topics(self) -> tuple[str, ...]:
        """The topic of the map and, if subscribed, that of its updates."""
        return tuple(each.topic for each in self._subscribers)

    def _request_map(self) -> None:
        """Read the parameters, subscribe to the map unless already subscribed, and wait for it."""
        node = self.node
        self._settings = StaticParameters.read(node, self.namespace)
        self._table = cost_table(self._settings)
        self._map_frame = self.layered.global_frame
        topic = node.resolve(self._settings.map_topic)
        if self._subscribers and self._subscribers[0].topic == topic:
            self._changed = self._whole_window()
            return
        self.deactivate()
        node.loginfo("Requesting the map...")
        self._received = False
        self._waiter = node.waiter(f"the map on {topic}")
        self._subscribers = [
            node.subscriber(topic, message_class("nav_msgs/OccupancyGrid"), self._on_map, queue_size=1)
        ]
        while not self._received and not node.wait(self._waiter, WARN_PERIOD):
            node.logwarn(
                f"The layer {self.name} is still waiting for the map on {topic}: {node.master.who_publishes(topic)}"
            )
            self._waiter = node.waiter(f"the map on {topic}")
        grid = self.grid
        node.loginfo(f"Received a {grid.width} X {grid.height} map at {grid.resolution:f} m/pix")
        if self._settings.subscribe_to_updates:
            node.loginfo("Subscribing to updates")
            kind = message_class("map_msgs/OccupancyGridUpdate")
            self._subscribers.append(node.subscriber(topic + "_updates", kind, self._on_update, queue_size=10))

    def _reconfigure(self, config: Any, _: int) -> Any:
        if config["enabled"] != self.is_enabled:
            self.is_enabled = config["enabled"]
            self._changed = self._whole_window()
        return config

    def _whole_window(self) -> Window:
        return Window(0, 0, self.grid.width, self.grid.height)

    def _on_map(self, message: Any) -> None:
        info = message.info
        size = info.width, info.height
        if len(message.data) != size[0] * size[1] or not info.resolution > 0:
            self.node.logerr(
                f"The map on {self._settings.map_topic} has {len(message.data)} cells, and its info says {size[0]} x "
                f"{size[1]} of {info.resolution:g} m: the map is ignored"
            )
            return
        origin = info.origin.position.x, info.origin.position.y
        geometry = (*size, float(info.resolution), origin)
        text = f"{size[0]} X {size[1]} at {info.resolution:f} m/pix"
        if not self.layered.is_rolling and geometry != self.layered.grid.geometry:
            self.node.loginfo(f"Resizing costmap to {text}")
            self.layered.resize(*geometry, lock=True)
        if geometry != self.grid.geometry:
            if self.layered.is_rolling:
                self.node.loginfo(f"Resizing static layer to {text}")
            self.grid.resize(*geometry)
        self.costs[...] = self._costs_of(message.data).reshape(size[1], size[0])
        self._map_frame = message.header.frame_id.lstrip("/")
        self._changed = self._whole_window()
        self._received = True
        self._waiter.wake()
        if self._settings.first_map_only:
            self.node.loginfo("Shutting down the map subscriber. first_map_only flag is on")
            self.deactivate()

    def _on_update(self, update: Any) -> None:
        window = Window(update.x, update.y, update.x + update.width, update.y + update.height)
        if not window.fits(self.grid) or len(update.data) != update.width * update.height:
            self.node.logerr(
                f"An update of {update.width} x {update.height} cells at ({update.x}, {update.y}) with "
                f"{len(update.data)} values does not fit the map of {self.grid.width} x {self.grid.height}: it is "
                "ignored"
            )
            return
        window.view(self.costs)[...] = self._costs_of(update.data).reshape(update.height, update.width)
        self._changed = window.united(self._changed)

    def _costs_of(self, data: Any) -> Costs:
        costs: Costs = self._table[np.asarray(data, dtype=np.int8).view(np.uint8)]
        return costs

    def match_size(self) -> None:
        """Keep the map's size in a rolling window; otherwise adopt that of the master grid."""
        if not self.layered.is_rolling:
            super().match_size()

    def activate(self) -> None:
        """Subscribe to the map again."""
        self._request_map()

    def deactivate(self) -> None:
        """Unsubscribe from the map's topics."""
        for subscriber in self._subscribers:
            subscriber.unregister()
        self._subscribers = []

    def reset(self) -> None:
        """Receive the map again; with `first_map_only`, write the known one again."""
        if self._settings.first_map_only:
            self._changed = self._whole_window()
        else:
            self._request_map()

    def update_bounds(self, robot: Pose, bounds: Bounds) -> None:
        """Extend `bounds` to the part of the map that has changed, or to the whole map if there are extra bounds.

        In a rolling window the bounds become unlimited.
        """
        del robot
        extra = self.use_extra_bounds(bounds)
        if self._received and (self.layered.is_rolling or self._changed is not None or extra):
            if self.layered.is_rolling:
                bounds.touch_all()
            else:
                bounds.touch_cells(self.grid, self._changed or self._whole_window())
            self._changed = None

    def update_costs(self, grid: Costmap2D, window: Window) -> None:
        """Write the map's costs into the window of the master grid; with `use_maximum`, only where they are higher."""
        if not self._received:
            return
        if self.layered.is_rolling:
            self._write_rolling(grid, window)
        elif self._settings.use_maximum:
            self.update_with_max(grid, window)
        else:
            self.update_with_true_overwrite(grid, window)

    def _write_rolling(self, grid: Costmap2D, window: Window) -> None:
        """Write the map's costs into a rolling window, whose frame may differ from the map's."""
        try:
            found = self.buffer.tree.lookup(self._map_frame, self.layered.global_frame)
        except TransformException as error:
            self.node.logerr(f"{error}", throttle=1.0)
            return
        mx, my = self._map_cells(grid, window, matrix(found.transform))
        inside = (mx >= 0) & (my >= 0) & (mx < self.grid.width) & (my < self.grid.height)
        costs = self.costs[np.where(inside, my, 0), np.where(inside, mx, 0)]
        target = window.view(grid.costs)
        if self._settings.use_maximum:
            costs = np.maximum(costs, target)
        np.copyto(target, costs, where=inside)

    def _map_cells(self, grid: Costmap2D, window: Window, pose: Any) -> tuple[Any, Any]:
        """Return the map column and row (h, w) of each cell in the window."""
        x, y = grid.map_to_world(window.x0, window.y0)
        wx = x + np.arange(window.xn - window.x0) * grid.resolution
        wy = (y + np.arange(window.yn - window.y0) * grid.resolution)[:, None]
        cells = []
        for axis in (0, 1):
            along = (pose[axis, 0] * wx + (pose[axis, 3] - self.grid.origin[axis])) / self.grid.resolution
            cells.append(np.floor(along + pose[axis, 1] / self.grid.resolution * wy).astype(np.int64))
        return cells[0], cells[1]
