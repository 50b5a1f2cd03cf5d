"""`rotate_recovery/RotateRecovery` (http://wiki.ros.org/rotate_recovery).

As in ROS its limits are those of the Trajectory Rollout planner, in `~TrajectoryPlannerROS/`, whichever planner is
used. The original never ends if the robot cannot turn; this one gives up after `TIME_FACTOR` times the duration of the
turn at the slowest speed. It also commands a stop at the end.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import partial
from typing import Any

from rosmini.core.parameters import Parameters, parameter
from rosmini.msgs import message_class
from rosmini.navigation.base_local_planner.costmap_model import footprint_cost
from rosmini.navigation.nav_core import RecoveryBehavior, TransformMissing, planar_pose

from .rotation import FullTurn, first_collision, turn_speed

TIME_FACTOR = 2.0
PLANNER = "~TrajectoryPlannerROS/"
LIMITS = (
    ("acc_lim_theta", "acc_lim_th", 3.2),
    ("max_vel_theta", "max_rotational_vel", 1.0),
    ("min_in_place_vel_theta", "min_in_place_rotational_vel", 0.4),
    ("yaw_goal_tolerance", "", 0.10),
)
"""The planner's parameters that it reads: name, former name, default; in rad/s2, rad/s, rad/s and rad."""


@dataclass(frozen=True)
class RotateParameters(Parameters):
    """The parameters of a `rotate_recovery/RotateRecovery`, in `~NAME/`."""

    sim_granularity: float = parameter(0.017, "angle between the headings that are checked", unit="rad", minimum=1e-4)
    frequency: float = parameter(20.0, "how often commands are sent", unit="Hz", minimum=0.1)


class RotateRecovery(RecoveryBehavior, plugin="rotate_recovery/RotateRecovery"):
    """Rotates the robot once in place, if the footprint allows it."""

    def initialize(self, name: str, buffer: Any, global_costmap: Any, local_costmap: Any) -> None:
        """Read the parameters in `~name/` and those of the planner."""
        super().initialize(name, buffer, global_costmap, local_costmap)
        self.node = local_costmap.node
        self.parameters = RotateParameters.read(self.node, f"~{name}")
        self.acceleration, self.fastest, self.slowest, self.tolerance = (self._limit(*each) for each in LIMITS)
        self._twist = message_class("geometry_msgs/Twist")
        self._commands = self.node.publisher("cmd_vel", self._twist, queue_size=10)

    def _limit(self, name: str, former: str, default: float) -> float:
        if former and self.node.has_param(PLANNER + former) and not self.node.has_param(PLANNER + name):
            self.node.logwarn(f"Parameter {former} is deprecated, please use the name {name} instead.")
            name = former
        return float(self.node.get_param(PLANNER + name, default))

    def run_behavior(self) -> None:
        """Rotate once; give up at the first heading that causes a collision, or after the time limit.

        Raises `TransformMissing` if the robot's pose is unknown at the start.
        """
        self.node.logwarn("Rotate recovery behavior started.")
        rate = self.node.rate(self.parameters.frequency)
        heading = self._pose()[2]
        turn = FullTurn(heading, self.tolerance)
        end = self.node.clock.now_ns() + int(TIME_FACTOR * 1e9 * 2 * math.pi / self.slowest)
        try:
            while not turn.is_done and self._continue_turn(turn):
                if self.node.clock.now_ns() > end:
                    self.node.logerr(
                        "Rotate recovery gives up: the robot has not completed the commanded turn in "
                        f"{TIME_FACTOR * 2 * math.pi / self.slowest:.0f} s"
                    )
                    return
                rate.sleep()
        except TransformMissing as error:
            self.node.logerr(f"Rotate recovery can't tell the robot's heading: {error}")
        finally:
            self._commands.publish(self._twist())

    def _pose(self) -> tuple[float, float, float]:
        return planar_pose(self.local_costmap.robot_pose())

    def _continue_turn(self, turn: FullTurn) -> bool:
        """Command the next part of the rotation; return False if it would cause a collision."""
        x, y, heading = self._pose()
        remaining = turn.update(heading)
        if turn.is_done:
            return True
        cost = partial(self._cost, x, y)
        collision = first_collision(heading, remaining, self.parameters.sim_granularity, cost)
        if collision is not None:
            self.node.logerr(
                "Rotate recovery can't rotate in place because there is a potential collision. Cost: "
                f"{collision[1]:.2f} ({math.degrees(collision[0] - heading):.0f} degrees further on)"
            )
            return False
        command = self._twist()
        command.angular.z = turn_speed(remaining, self.acceleration, self.slowest, self.fastest)
        self._commands.publish(command)
        return True

    def _cost(self, x: float, y: float, heading: float) -> float:
        return footprint_cost(self.local_costmap.grid, (x, y, heading), self.local_costmap.footprint)
