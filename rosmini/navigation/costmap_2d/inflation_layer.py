"""`costmap_2d::InflationLayer`: adds costs around obstacles (http://wiki.ros.org/costmap_2d/hydro/inflation)."""

from __future__ import annotations

from typing import Any

import numpy as np

from rosmini.core.dynamic_reconfigure import Server
from rosmini.core.geometry.poses import Pose

from .costmap import Costmap2D
from .inflation import cell_distance, cost_table, inflate
from .layer import Bounds, Layer, Window
from .parameters import InflationConfig


class InflationLayer(Layer, plugin="costmap_2d::InflationLayer"):
    """Raises the costs of cells near obstacles in the layers below."""

    def __init__(self) -> None:
        self.radius = 0.0
        """The inflation radius [m]."""
        self.cost_scaling_factor = 0.0
        self._inflate_unknown = False
        self._cells = 0
        self._table = np.zeros(2, dtype=np.uint8)
        self._needs_full_update = True
        self._last = Bounds()

    def on_initialize(self) -> None:
        """Read the parameters."""
        InflationConfig.read(self.node, self.namespace)
        self._server = Server(self.node, InflationConfig, self._reconfigure, namespace=self.namespace)

    def _reconfigure(self, config: Any, _: int) -> Any:
        self.is_enabled = config["enabled"]
        self._inflate_unknown = config["inflate_unknown"]
        self.radius, self.cost_scaling_factor = config["inflation_radius"], config["cost_scaling_factor"]
        self.on_footprint_changed()
        return config

    def on_footprint_changed(self) -> None:
        """Recompute the table of costs by distance."""
        resolution = self.layered.grid.resolution
        self._cells = cell_distance(self.radius, resolution)
        self._table = cost_table(self._cells, resolution, self.layered.inscribed_radius, self.cost_scaling_factor)
        self._needs_full_update = True

    def match_size(self) -> None:
        """Recompute the costs for the new resolution."""
        self.on_footprint_changed()

    def update_bounds(self, robot: Pose, bounds: Bounds) -> None:
        """Widen the bounds by the inflation radius around all changes in this update and the previous one."""
        del robot
        last, self._last = self._last, bounds.copy()
        if self._needs_full_update:
            self._needs_full_update = False
            bounds.touch_all()
            return
        bounds.min_x, bounds.max_x = min(bounds.min_x, last.min_x), max(bounds.max_x, last.max_x)
        bounds.min_y, bounds.max_y = min(bounds.min_y, last.min_y), max(bounds.max_y, last.max_y)
        if not bounds.is_empty:
            # Half a cell more, because a point on the edge between two cells belongs to both.
            margin = (self._cells + 0.5) * self.layered.grid.resolution
            bounds.touch(bounds.min_x - margin, bounds.min_y - margin)
            bounds.touch(bounds.max_x + margin, bounds.max_y + margin)

    def update_costs(self, grid: Costmap2D, window: Window) -> None:
        """Inflate the obstacles that the layers below have written."""
        inflate(grid.costs, window, self._cells, self._table, inflate_unknown=self._inflate_unknown)
