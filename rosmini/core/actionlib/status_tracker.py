"""An entry in a server's list of goals."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rosmini.core.time import Time
from rosmini.msgs import message_class

from .states import Status

if TYPE_CHECKING:
    from .goal_id_generator import GoalIDGenerator

__all__ = ["StatusTracker"]


class StatusTracker:
    """One goal in a server's list: its message, its status, and the time of its end.

    Made from an action goal (``FibonacciActionGoal``), which is ``PENDING`` and gets an id and a stamp if it has none;
    or from an id and a status, for a goal that was cancelled before it arrived.
    """

    def __init__(
        self,
        id_generator: GoalIDGenerator,
        now: Time,
        goal_id: Any = None,
        status: int | None = None,
        goal: Any = None,
    ) -> None:
        self.id_generator = id_generator
        self.goal: Any = None
        self.handle_tracker: Any = None
        """The first handle that the server made for the goal; None before that."""
        self.handle_destruction_time = Time()
        """When the goal ended; 0 before that."""
        self.status = message_class("actionlib_msgs/GoalStatus")()
        if goal_id is not None:
            self.status.goal_id, self.status.status = goal_id, status
            return
        self.goal = goal
        self.status.goal_id = goal.goal_id if goal.goal_id.id else id_generator.generate_ID()
        self.status.status = Status.PENDING
        if not self.status.goal_id.stamp:
            self.status.goal_id.stamp = now
