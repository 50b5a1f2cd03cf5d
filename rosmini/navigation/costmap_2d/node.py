"""The nodes of the package: a stand-alone costmap, and two that display its voxels.

| node | topics |
|---|---|
| `costmap_2d/costmap_2d_node` | those of a costmap, in `~costmap/`, where its parameters are, too |
| `costmap_2d/costmap_2d_markers` | converts `voxel_grid` to cubes on `visualization_marker` |
| `costmap_2d/costmap_2d_cloud` | converts `voxel_grid` to points on `voxel_marked_cloud` and `voxel_unknown_cloud` |
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from rosmini.core.tf import Buffer, TransformListener
from rosmini.msgs import message_class

from .costmap_ros import Costmap2DROS
from .voxels import BITS

if TYPE_CHECKING:
    from rosmini.core.graph import Node

CUBE_LIST = 6
"""The marker type of the cubes."""


class Costmap2DNode:
    """A costmap without a planner."""

    def __init__(self, node: Node) -> None:
        buffer = Buffer(node)
        TransformListener(node, buffer)
        self.costmap = Costmap2DROS("costmap", buffer, node)


def voxel_points(grid: Any) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the centres (n, 3) [m] of the marked and of the unknown voxels in a `costmap_2d/VoxelGrid`."""
    columns = np.asarray(grid.data, dtype=np.int64).reshape(grid.size_y, grid.size_x)
    heights = np.arange(grid.size_z)[:, None, None]
    known, marked = columns >> heights & 1, columns >> heights + BITS & 1
    step = np.array([grid.resolutions.x, grid.resolutions.y, grid.resolutions.z])
    corner = np.array([grid.origin.x, grid.origin.y, grid.origin.z])

    def middles(chosen: Any) -> NDArray[np.float64]:
        cells: NDArray[np.float64] = corner + (np.argwhere(chosen)[:, ::-1] + 0.5) * step
        return cells

    return middles(marked == 1), middles((known == 1) & (marked == 0))


class VoxelMarkers:
    """Publishes the marked voxels as cubes."""

    def __init__(self, node: Node) -> None:
        self.node = node
        self._publisher = node.publisher(
            "visualization_marker", message_class("visualization_msgs/Marker"), queue_size=1
        )
        node.subscriber("voxel_grid", message_class("costmap_2d/VoxelGrid"), self._show, queue_size=1)

    def _show(self, grid: Any) -> None:
        marker = message_class("visualization_msgs/Marker")()
        marker.header, marker.ns, marker.type = grid.header, self.node.name, CUBE_LIST
        marker.pose.orientation.w = 1.0
        size = grid.resolutions
        marker.scale.x, marker.scale.y, marker.scale.z = size.x, size.y, size.z
        marker.color.r = marker.color.a = 1.0
        point = message_class("geometry_msgs/Point")
        marker.points = [point(*each) for each in voxel_points(grid)[0].tolist()]
        self._publisher.publish(marker)


class VoxelCloud:
    """Publishes the marked and the unknown voxels as point clouds."""

    def __init__(self, node: Node) -> None:
        kind = message_class("sensor_msgs/PointCloud")
        self._publishers = [
            node.publisher(topic, kind, queue_size=2) for topic in ("voxel_marked_cloud", "voxel_unknown_cloud")
        ]
        node.subscriber("voxel_grid", message_class("costmap_2d/VoxelGrid"), self._show, queue_size=1)

    def _show(self, grid: Any) -> None:
        point = message_class("geometry_msgs/Point32")
        for publisher, points in zip(self._publishers, voxel_points(grid), strict=True):
            cloud = message_class("sensor_msgs/PointCloud")()
            cloud.header = grid.header
            cloud.points = [point(*each) for each in points.tolist()]
            publisher.publish(cloud)
