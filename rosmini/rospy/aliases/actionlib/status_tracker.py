"""``actionlib.status_tracker``: what a server's list has of one goal."""

from __future__ import annotations

from typing import Any

from rosmini import actionlib, rospy

from .goal_id_generator import GoalIDGenerator

__all__ = ["StatusTracker"]


class StatusTracker(actionlib.StatusTracker):
    """One goal in a server's list. Raises ``ROSInitException`` before ``init_node``."""

    def __init__(self, goal_id: Any = None, status: int | None = None, goal: Any = None) -> None:
        super().__init__(GoalIDGenerator(), rospy.Time.now(), goal_id, status, goal)
