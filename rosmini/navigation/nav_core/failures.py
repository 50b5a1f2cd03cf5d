"""Why there is no plan and no command: one class for each cause, each with the numbers that explain it.

In ROS a planner returns false, and the reason is a line in a log. Here it raises one of these; what `move_base` says,
publishes and does then is as there.
"""

from __future__ import annotations

from typing import Any

from rosmini.core.errors import RosminiError


class NavigationFailure(RosminiError):
    """The base of all of them. What the keywords name is kept as `numbers`, for tables and pictures."""

    def __init__(self, message: str, **numbers: Any) -> None:
        super().__init__(message)
        self.numbers: dict[str, Any] = numbers


class TransformMissing(NavigationFailure):
    """Where the robot is, or a pose in another frame, is not known: the transform is missing or too old."""


class BadGoal(NavigationFailure):
    """A goal is no pose: its quaternion is not a rotation about the z axis, or a number of it is not finite."""


class PlanningFailure(NavigationFailure):
    """A global planner finds no plan."""


class OutsideMap(PlanningFailure):
    """The start or the goal lies outside the costmap."""


class StartBlocked(PlanningFailure):
    """The robot stands in a cell that no plan may leave."""


class GoalBlocked(PlanningFailure):
    """The goal, and all within the tolerance around it, is in cells that no plan may enter."""


class NoPath(PlanningFailure):
    """Start and goal are free, and nothing free joins them."""


class ControlFailure(NavigationFailure):
    """A local planner finds no command."""


class NoValidCommand(ControlFailure):
    """Every sampled command was rejected; `numbers` counts them by critic."""
