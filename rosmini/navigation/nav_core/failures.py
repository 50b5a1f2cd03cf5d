"""Failures to plan or to find a command: one class for each cause, with numbers that explain it.

In ROS a planner returns false, and only the log contains the reason. Here a planner raises one of these exceptions; the
messages, topics and actions of `move_base` in that case are those of ROS.
"""

from __future__ import annotations

from typing import Any

from rosmini.core.errors import RosminiError


class NavigationFailure(RosminiError):
    """The base of all failures. Keyword arguments are stored in `numbers`, for tables and pictures."""

    def __init__(self, message: str, **numbers: Any) -> None:
        super().__init__(message)
        self.numbers: dict[str, Any] = numbers


class TransformMissing(NavigationFailure):
    """The robot's pose, or a pose in another frame, is unknown: the transform is missing or too old."""


class BadGoal(NavigationFailure):
    """A goal is invalid: its quaternion is not a rotation about the z axis, or one of its numbers is not finite."""


class PlanningFailure(NavigationFailure):
    """A global planner cannot find a plan."""


class OutsideMap(PlanningFailure):
    """The start or the goal is outside the costmap."""


class StartBlocked(PlanningFailure):
    """The robot is in a cell that no plan may leave."""


class GoalBlocked(PlanningFailure):
    """No plan may enter the goal or any cell within the tolerance."""


class NoPath(PlanningFailure):
    """Start and goal are free, but no free cells connect them."""


class ControlFailure(NavigationFailure):
    """A local planner cannot find a command."""


class NoValidCommand(ControlFailure):
    """Every sampled command was rejected; `numbers` counts them by critic."""
