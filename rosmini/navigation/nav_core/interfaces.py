"""The interfaces of global planners, local planners and recovery behaviours (http://wiki.ros.org/nav_core).

A planner of one's own is a class with a name, and `base_global_planner` names it:

    class Straight(BaseGlobalPlanner, plugin="my_pkg/Straight"):
        def make_plan(self, start, goal):
            return [start, goal]

Whatever blocks in a plugin (`rospy.sleep`, a service) parks only its own lane, as everywhere in a graph.
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
    """Plans a path through a whole costmap."""

    name: str
    """What `move_base` calls it: the namespace of its topics, services and parameters, `~name/`."""
    costmap: Costmap2DROS
    """The global costmap; `costmap.node` is the node, `costmap.grid` the costs."""

    def initialize(self, name: str, costmap: Costmap2DROS) -> None:
        """Learn the name and the costmap: called once, before everything else. Read parameters, advertise topics."""
        self.name, self.costmap = name, costmap

    @abstractmethod
    def make_plan(self, start: Any, goal: Any) -> Sequence[Any]:
        """Poses (`geometry_msgs/PoseStamped`, in the costmap's global frame) from `start` to `goal`, of that type too.

        Raises a `PlanningFailure` that says why there is no plan.
        """


class BaseLocalPlanner(Plugin, ABC):
    """Follows a plan: from one cycle of control to the next it says how fast to drive."""

    name: str
    buffer: Buffer
    """The transforms."""
    costmap: Costmap2DROS
    """The local costmap."""

    def initialize(self, name: str, buffer: Buffer, costmap: Costmap2DROS) -> None:
        """Learn the name, the transforms and the costmap: called once, before everything else."""
        self.name, self.buffer, self.costmap = name, buffer, costmap

    @abstractmethod
    def set_plan(self, plan: Sequence[Any]) -> None:
        """Follow this plan (`geometry_msgs/PoseStamped`, in any one frame) from now on, and forget what was latched."""

    @abstractmethod
    def compute_velocity_commands(self) -> Any:
        """The command (`geometry_msgs/Twist`, in the robot's base frame) for the next cycle.

        Raises a `ControlFailure` that says why there is none, or `TransformMissing`.
        """

    @abstractmethod
    def is_goal_reached(self) -> bool:
        """Whether the robot has reached the end of the plan, and stands."""


class RecoveryBehavior(Plugin, ABC):
    """Tries to free a robot that is stuck."""

    name: str
    buffer: Buffer
    global_costmap: Costmap2DROS
    local_costmap: Costmap2DROS

    def initialize(
        self, name: str, buffer: Buffer, global_costmap: Costmap2DROS, local_costmap: Costmap2DROS
    ) -> None:
        """Learn the name, the transforms and the costmaps: called once, before everything else."""
        self.name, self.buffer = name, buffer
        self.global_costmap, self.local_costmap = global_costmap, local_costmap

    def costmaps(self) -> list[Costmap2DROS]:
        """The costmaps in which it clears something; none by default."""
        return []

    @abstractmethod
    def run_behavior(self) -> None:
        """Do it. It may take its time: the caller's lane waits."""
