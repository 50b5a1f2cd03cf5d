"""`costmap_2d::VoxelLayer`: obstacles by height, in voxel columns (http://wiki.ros.org/costmap_2d/hydro/obstacles)."""

from __future__ import annotations

from typing import Any

import numpy as np

from rosmini.core.geometry.poses import Pose
from rosmini.msgs import message_class

from .costmap import LETHAL_OBSTACLE, shifted
from .inflation import cell_distance
from .layer import Bounds, Window
from .observations import Observation
from .obstacle_layer import ObstacleLayer
from .parameters import VoxelConfig, VoxelParameters
from .voxels import BITS, UNKNOWN, Columns, compiled_clear_voxels, mark_voxels, marked_count


class VoxelLayer(ObstacleLayer, plugin="costmap_2d::VoxelLayer"):
    """An obstacle layer with heights: a ray that passes above a box does not clear the box."""

    config = VoxelConfig
    settings_class = VoxelParameters

    def __init__(self) -> None:
        super().__init__()
        self.columns: Columns = np.zeros((0, 0), dtype=np.int64)
        """The voxels (h, w), see `rosmini.navigation.costmap_2d.voxels`."""
        self.size_z = 10
        self.origin_z, self.z_resolution = 0.0, 0.2
        self._mark_threshold, self._unknown_threshold = 0, 15

    def on_initialize(self) -> None:
        """Read the parameters, subscribe to the sources, and advertise the topics."""
        super().on_initialize()
        self._ends = self.node.publisher(
            f"{self.namespace}clearing_endpoints", message_class("sensor_msgs/PointCloud"), queue_size=1
        )
        self._ends.expect_nobody()

    def _reconfigure(self, config: Any, level: int) -> Any:
        self.size_z, self.origin_z = config["z_voxels"], config["origin_z"]
        self.z_resolution = max(config["z_resolution"], 1e-6)
        self._mark_threshold = config["mark_threshold"]
        # The bits above the top of the column always stay unknown.
        self._unknown_threshold = config["unknown_threshold"] + BITS - self.size_z
        result = super()._reconfigure(config, level)
        self.match_size()
        return result

    def match_size(self) -> None:
        """Adopt the size of the master grid; all columns become unknown."""
        super().match_size()
        self.columns = np.full(self.costs.shape, UNKNOWN, dtype=np.int64)

    def reset(self) -> None:
        """Clear all obstacles."""
        self.columns[...] = UNKNOWN
        super().reset()

    def roll(self, robot: Pose) -> tuple[int, int]:
        """Move the costs and columns with the robot; return the number of cells moved, (columns, rows)."""
        dx, dy = super().roll(robot)
        if (dx, dy) != (0, 0):
            self.columns = shifted(self.columns, dx, dy, UNKNOWN)
        return dx, dy

    def clear(self, observation: Observation, bounds: Bounds) -> None:
        """Clear the voxels between the sensor and the observed points, and extend `bounds` to their columns."""
        grid, (ox, oy, oz) = self.grid, observation.origin
        top = self.origin_z + self.size_z * self.z_resolution
        if grid.world_to_map(ox, oy) is None or not self.origin_z <= oz < top:
            self.warn_outside(f"({ox:.2f}, {oy:.2f}, {oz:.2f})")
            return
        frame = (*grid.origin, self.origin_z, grid.resolution, self.z_resolution, self._max_height)
        x0, y0, x1, y1 = compiled_clear_voxels()(
            self.columns,
            grid.costs,
            np.array(frame),
            np.array(observation.origin),
            observation.points,
            self.size_z,
            cell_distance(observation.raytrace_range, grid.resolution),
            self._mark_threshold,
            self._unknown_threshold,
        )
        bounds.touch_cells(grid, Window(x0, y0, x1 + 1, y1 + 1))
        if self._ends.num_connections():
            self._ends.publish(self._cloud(observation))

    def mark(self, observation: Observation, bounds: Bounds) -> None:
        """Mark the observed voxels; a column with more than `mark_threshold` marked voxels is an obstacle."""
        points = self._near(observation)
        mx, my = np.floor((points[:, :2] - self.grid.origin) / self.grid.resolution).astype(np.int64).T
        height = np.maximum(points[:, 2], self.origin_z) - self.origin_z
        mz = np.floor(height / self.z_resolution).astype(np.int64)
        inside = (mx >= 0) & (my >= 0) & (mx < self.grid.width) & (my < self.grid.height) & (mz < self.size_z)
        mx, my = mx[inside], my[inside]
        mark_voxels(self.columns, mx, my, mz[inside])
        solid = marked_count(self.columns[my, mx]) > self._mark_threshold
        mx, my = mx[solid], my[solid]
        if len(mx):
            self.costs[my, mx] = LETHAL_OBSTACLE
            bounds.touch_cells(self.grid, Window(mx.min(), my.min(), mx.max() + 1, my.max() + 1))

    def _cloud(self, observation: Observation) -> Any:
        """Return the end points of an observation's rays as a point cloud."""
        cloud = message_class("sensor_msgs/PointCloud")()
        cloud.header.frame_id, cloud.header.stamp = self.layered.global_frame, self.node.now()
        point = message_class("geometry_msgs/Point32")
        cloud.points = [point(x=x, y=y, z=z) for x, y, z in observation.points.tolist()]
        return cloud
