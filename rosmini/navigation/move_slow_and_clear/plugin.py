"""`move_slow_and_clear/MoveSlowAndClear` (http://wiki.ros.org/move_slow_and_clear).

It clears a square around the robot in the obstacle layers, and limits the local planner's speeds through its
dynamic_reconfigure server until the robot has driven `limited_distance`.

The original clears layers with "obstacles" in their names. ROBOTIS's files have no such layer; theirs is named
`obstacle_layer`. So this one clears layers whose names begin with "obstacle" or "voxel".
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from rosmini.core.errors import ServiceException
from rosmini.core.graph.clock import Timer
from rosmini.core.parameters import Parameters, parameter
from rosmini.msgs import message_class, service_class
from rosmini.navigation.nav_core import RecoveryBehavior, TransformMissing, planar_pose

CHECK_PERIOD = 0.1
"""Interval between checks of the distance driven [s]."""

CLEARED_PREFIXES = ("obstacle", "voxel")
"""Prefixes of the names of the layers that it clears."""


@dataclass(frozen=True)
class MoveSlowAndClearParameters(Parameters):
    """The parameters of a `move_slow_and_clear/MoveSlowAndClear`, in `~NAME/`."""

    clearing_distance: float = parameter(0.5, "half the side of the square that is cleared", unit="m")
    limited_trans_speed: float = parameter(0.25, "the limited speed", unit="m/s")
    limited_rot_speed: float = parameter(0.45, "the limited turning speed", unit="rad/s")
    limited_distance: float = parameter(0.3, "straight-line distance after which the limit ends", unit="m")
    planner_namespace: str = parameter("DWAPlannerROS", "the local planner, below the node's name")
    max_trans_param_name: str = parameter("max_vel_trans", "the name of the planner's parameter for the maximum speed")
    max_rot_param_name: str = parameter("max_vel_theta", "the name of its parameter for the maximum turning speed")


class MoveSlowAndClear(RecoveryBehavior, plugin="move_slow_and_clear/MoveSlowAndClear"):
    """Clears the costmaps near the robot, and limits the robot's speed."""

    def initialize(self, name: str, buffer: Any, global_costmap: Any, local_costmap: Any) -> None:
        """Read the parameters in `~name/`."""
        super().initialize(name, buffer, global_costmap, local_costmap)
        self.node = local_costmap.node
        self.parameters = own = MoveSlowAndClearParameters.read(self.node, f"~{name}")
        self._planner = f"~{own.planner_namespace}/"
        self._reconfigure = self.node.service_client(
            f"{self._planner}set_parameters", service_class("dynamic_reconfigure/Reconfigure")
        )
        self._double = message_class("dynamic_reconfigure/DoubleParameter")
        self._config = message_class("dynamic_reconfigure/Config")
        self._old: tuple[float, float] | None = None
        self._start = (0.0, 0.0)
        self._timer: Timer | None = None

    def costmaps(self) -> list[Any]:
        """Return both costmaps."""
        return [self.global_costmap, self.local_costmap]

    def run_behavior(self) -> None:
        """Clear the square, and limit the speeds until the robot is `limited_distance` away from here."""
        self.node.logwarn("Move slow and clear recovery behavior started.")
        try:
            for costmap in self.costmaps():
                self._clear(costmap)
            self._start = self._position()
        except TransformMissing as error:
            self.node.logerr(f"Cannot clear map because pose cannot be retrieved: {error}")
            return
        own = self.parameters
        if self._old is None:
            self._old = self._limits()
        if self._old is None or not self._set_speeds(own.limited_trans_speed, own.limited_rot_speed):
            return
        if self._timer is None:
            self._timer = self.node.timer(CHECK_PERIOD, lambda _: self._check_distance())

    def _position(self) -> tuple[float, float]:
        x, y, _ = planar_pose(self.global_costmap.robot_pose())
        return x, y

    def _clear(self, costmap: Any) -> None:
        x, y, _ = planar_pose(costmap.robot_pose())
        distance = self.parameters.clearing_distance
        for layer in costmap.layers:
            if layer.name.rpartition("/")[2].startswith(CLEARED_PREFIXES):
                x0, y0 = layer.grid.world_to_map_no_bounds(x - distance, y - distance)
                x1, y1 = layer.grid.world_to_map_no_bounds(x + distance, y + distance)
                layer.clear_area(x0, y0, x1, y1, True)

    def _limits(self) -> tuple[float, float] | None:
        """Return the planner's limits [m/s, rad/s]; log an error and return None if it lacks these parameters."""
        own = self.parameters
        names = [self._planner + each for each in (own.max_trans_param_name, own.max_rot_param_name)]
        for name in names:
            if not self.node.has_param(name):
                self.node.logerr(
                    f"The planner {own.planner_namespace} does not have the parameter {name}: speeds are not limited. "
                    f"Check ~{self.name}/planner_namespace, max_trans_param_name and max_rot_param_name"
                )
                return None
        fast, turning = (float(self.node.get_param(name)) for name in names)
        return fast, turning

    def _set_speeds(self, speed: float, turn: float) -> bool:
        own = self.parameters
        doubles = [
            self._double(name=own.max_trans_param_name, value=speed),
            self._double(name=own.max_rot_param_name, value=turn),
        ]
        try:
            self._reconfigure(config=self._config(doubles=doubles))
        except ServiceException as error:
            self.node.logerr(f"Something went wrong in the service call to dynamic_reconfigure: {error}")
            return False
        self.node.loginfo(f"Recovery setting trans vel: {speed:g}")
        self.node.loginfo(f"Recovery setting rot vel: {turn:g}")
        return True

    def _check_distance(self) -> None:
        try:
            gone = math.dist(self._start, self._position())
        except TransformMissing:
            return
        if gone < self.parameters.limited_distance or self._timer is None or self._old is None:
            return
        self.node.loginfo("Moved far enough, removing speed limit.")
        self._timer.shutdown()
        self._timer = None
        old, self._old = self._old, None
        self._set_speeds(*old)
