"""The interfaces of global planners, local planners and recovery behaviours (http://wiki.ros.org/nav_core).

To write a planner, derive a class with a plugin name, and set `base_global_planner` to that name:

    class Straight(BaseGlobalPlanner, plugin="my_pkg/Straight"):
        def make_plan(self, start, goal):
            return [start, goal]

A plugin that blocks (in `rospy.sleep` or a service call) blocks only its own lane, as everywhere in a graph.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from rosmini.core.plugins import Plugin

if TYPE_CHECKING:
    from rosmini.core.tf import Buffer
    from rosmini.navigation.costmap_2d.costmap_ros import Costmap2DROS


class BaseGlobalPlanner(Plugin, ABC):
    """Plans a path through the whole costmap."""

    name: str
    """The planner's name in `move_base`: the namespace of its topics, services and parameters is `~name/`."""
    costmap: Costmap2DROS
    """The global costmap; `costmap.node` is the node, `costmap.grid` contains the costs."""

    def initialize(self, name: str, costmap: Costmap2DROS) -> None:
        """Set up the planner: read parameters, advertise topics. Called once, before all other methods."""
        self.name, self.costmap = name, costmap

    @abstractmethod
    def make_plan(self, start: Any, goal: Any) -> Sequence[Any]:
        """Return poses (`PoseStamped` in the costmap's global frame) from `start` to `goal`, which have the same type.

        Raises a `PlanningFailure` with the reason if there is no plan.
        """


class BaseLocalPlanner(Plugin, ABC):
    """Follows a plan: computes the velocity for each control cycle."""

    name: str
    buffer: Buffer
    """The transform buffer."""
    costmap: Costmap2DROS
    """The local costmap."""

    def initialize(self, name: str, buffer: Buffer, costmap: Costmap2DROS) -> None:
        """Set up the planner. Called once, before all other methods."""
        self.name, self.buffer, self.costmap = name, buffer, costmap

    @abstractmethod
    def set_plan(self, plan: Sequence[Any]) -> None:
        """Start following a plan (`geometry_msgs/PoseStamped`, all in one frame); forget the state of the last one."""

    @abstractmethod
    def compute_velocity_commands(self) -> Any:
        """Return the command (`geometry_msgs/Twist`, in the robot's base frame) for the next cycle.

        Raises a `ControlFailure` with the reason if there is none, or `TransformMissing`.
        """

    @abstractmethod
    def is_goal_reached(self) -> bool:
        """Return whether the robot has reached the end of the plan and has stopped."""


class RecoveryBehavior(Plugin, ABC):
    """Tries to free a robot that is stuck."""

    name: str
    buffer: Buffer
    global_costmap: Costmap2DROS
    local_costmap: Costmap2DROS

    def initialize(self, name: str, buffer: Buffer, global_costmap: Costmap2DROS, local_costmap: Costmap2DROS) -> None:
        """Set up the behaviour. Called once, before all other methods."""
        self.name, self.buffer = name, buffer
        self.global_costmap, self.local_costmap = global_costmap, local_costmap

    def costmaps(self) -> list[Costmap2DROS]:
        """Return the costmaps that it clears; none by default."""
        return []

    @abstractmethod
    def run_behavior(self) -> None:
        """Run the behaviour to its end. It may block: only the caller's lane waits."""
