"""`multirobot_map_merge/map_merge`: merges the maps of several robots (http://wiki.ros.org/multirobot_map_merge).

Robots are found by their maps: each OccupancyGrid topic that ends with `~robot_map_topic` and contains
`~robot_namespace` in its name belongs to the robot with its namespace. The pose of a robot's map in the merged map is
set by four parameters in the robot's namespace, `map_merge/init_pose_x`, `_y`, `_z` and `_yaw`.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from rosmini.core.errors import ParameterError
from rosmini.core.geometry.poses import Pose
from rosmini.core.graph import Node
from rosmini.core.maps import GridMap, MapError
from rosmini.core.names import join
from rosmini.core.parameters import Parameters, parameter
from rosmini.msgs import message_class

from .merging import merge

GRID = "nav_msgs/OccupancyGrid"


@dataclass(frozen=True)
class MapMergeParameters(Parameters):
    """The private parameters of `multirobot_map_merge/map_merge`."""

    robot_map_topic: str = parameter("map", "the end of the names of the robots' map topics")
    robot_map_updates_topic: str = parameter("map_updates", "the topic of map updates, in the same namespace")
    robot_namespace: str = parameter("", "a part of the names of the robots' namespaces")
    known_init_poses: bool = parameter(True, "whether the robots' init_pose parameters are set")
    merged_map_topic: str = parameter("map", "the topic of the merged map")
    world_frame: str = parameter("world", "the frame of the merged map")
    merging_rate: float = parameter(4.0, "rate at which maps are merged", unit="Hz", minimum=1e-3)
    discovery_rate: float = parameter(0.05, "rate of the search for new robots", unit="Hz", minimum=1e-3)
    estimation_rate: float = parameter(0.5, "not used: poses are not estimated", unit="Hz", minimum=1e-3)
    estimation_confidence: float = parameter(1.0, "not used: poses are not estimated", minimum=0.0)


@dataclass
class _Robot:
    """A discovered robot."""

    pose: Pose
    """The pose of its map's frame in the merged map's frame."""
    grid: GridMap | None = None
    """Its latest map."""


class MapMerge:
    """Merges the maps of robots with known start poses.

    Raises:
        ParameterError: a parameter is wrong, or `known_init_poses` is false: poses are not estimated.

    """

    def __init__(self, node: Node) -> None:
        self.node = node
        self.parameters = own = MapMergeParameters.read(node)
        if not own.known_init_poses:
            raise ParameterError(
                "~known_init_poses is false: this map_merge does not estimate start poses. Set "
                "ROBOT/map_merge/init_pose_x, _y, _z and _yaw for each of them, and ~known_init_poses to true"
            )
        self.robots: dict[str, _Robot] = {}
        self._unplaced: set[str] = set()
        self._grid_class = message_class(GRID)
        self._merged = node.publisher(own.merged_map_topic, self._grid_class, queue_size=50, latch=True)
        node.timer(1.0 / own.discovery_rate, lambda _: self.discover())
        node.timer(1.0 / own.merging_rate, lambda _: self.merge())
        self.discover()

    # -- robots --------------------------------------------------------------------------------------------------

    def discover(self) -> None:
        """Subscribe to the maps of new robots."""
        own = self.parameters
        _, _, published = self.node.master.insist("getPublishedTopics", "", warn=self.node.logwarn)
        for topic, kind in sorted(map(tuple, published)):
            name = topic.rpartition("/")[0] or "/"
            ends = topic.endswith(f"/{own.robot_map_topic.strip('/')}")
            is_ours = topic == self.node.resolve(own.merged_map_topic) or own.robot_namespace not in name
            if kind == GRID and ends and not is_ours and name not in self.robots:
                self._add(name, topic)

    def _add(self, name: str, topic: str) -> None:
        pose = self._pose(name)
        if pose is None:
            if name not in self._unplaced:
                self._unplaced.add(name)
                self.node.logwarn(
                    f"Couldn't get initial position for robot [{name}]: set the parameters "
                    f"{join(name, 'map_merge/init_pose_x')}, _y, _z and _yaw. Its map is ignored until then"
                )
            return
        robot = self.robots[name] = _Robot(pose)
        self.node.loginfo(f"adding robot [{name}] to system")
        self.node.subscriber(topic, self._grid_class, lambda message: self._on_map(robot, name, message), queue_size=1)
        updates = join(name, self.parameters.robot_map_updates_topic)
        kind = message_class("map_msgs/OccupancyGridUpdate")
        self.node.subscriber(updates, kind, lambda update: self._on_update(robot, update), queue_size=10)

    def _pose(self, name: str) -> Pose | None:
        """Return a robot's start pose, which is that of its map's frame; None if one of the parameters is missing."""
        found = [
            self.node.get_param(join(name, f"map_merge/init_pose_{each}"), None) for each in ("x", "y", "z", "yaw")
        ]
        numbers = [float(each) for each in found if isinstance(each, int | float) and not isinstance(each, bool)]
        return (numbers[0], numbers[1], numbers[3]) if len(numbers) == 4 else None

    # -- maps ----------------------------------------------------------------------------------------------------

    def _on_map(self, robot: _Robot, name: str, message: Any) -> None:
        try:
            robot.grid = GridMap.from_message(message)
        except MapError as error:
            self.node.logwarn(f"a map of {name} is ignored: {error}", throttle=10.0)

    def _on_update(self, robot: _Robot, update: Any) -> None:
        """Update a rectangle of cells in a robot's map; an update that does not fit is ignored with a warning."""
        if robot.grid is None:
            return
        cells = robot.grid.occupancy.copy()
        rows, columns = slice(update.y, update.y + update.height), slice(update.x, update.x + update.width)
        if update.x < 0 or update.y < 0 or cells[rows, columns].size != len(update.data):
            self.node.logwarn("an update does not fit its map, and is ignored", throttle=10.0)
            return
        cells[rows, columns] = np.array(update.data, dtype=np.int8).reshape(update.height, update.width)
        robot.grid = GridMap(cells, robot.grid.resolution, robot.grid.origin)

    def merge(self) -> None:
        """Publish the merged map if there is at least one map; log an error if the maps cannot be merged."""
        maps = [(robot.grid, robot.pose) for robot in self.robots.values() if robot.grid is not None]
        if not maps:
            return
        try:
            merged = merge(maps)
        except MapError as error:
            self.node.logerr(error, throttle=10.0)
            return
        self._merged.publish(merged.to_message(self.parameters.world_frame, self.node.now()))
