"""The parts shared by the Navigation Stack (http://wiki.ros.org/nav_core).

These are three interfaces, whose plugins `move_base` finds by their ROS names, and the failures that plugins raise.
"""

from __future__ import annotations

from .failures import (
    BadGoal,
    ControlFailure,
    GoalBlocked,
    NavigationFailure,
    NoPath,
    NoValidCommand,
    OutsideMap,
    PlanningFailure,
    TransformMissing,
)
from .interfaces import BaseGlobalPlanner, BaseLocalPlanner, RecoveryBehavior
from .poses import planar_pose, pose_stamped

__all__ = [
    "BadGoal",
    "BaseGlobalPlanner",
    "BaseLocalPlanner",
    "ControlFailure",
    "GoalBlocked",
    "NavigationFailure",
    "NoPath",
    "NoValidCommand",
    "OutsideMap",
    "PlanningFailure",
    "RecoveryBehavior",
    "TransformMissing",
    "planar_pose",
    "pose_stamped",
]
