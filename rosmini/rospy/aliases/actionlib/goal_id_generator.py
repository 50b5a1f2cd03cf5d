"""``actionlib.goal_id_generator``: names for goals."""

from __future__ import annotations

from rosmini import actionlib
from rosmini.rospy.session import require_node

__all__ = ["GoalIDGenerator"]


class GoalIDGenerator(actionlib.GoalIDGenerator):
    """Makes ids that begin with ``name``, the node's unless given. Raises ``ROSInitException`` before ``init_node``."""

    def __init__(self, name: str | None = None) -> None:
        super().__init__(require_node("a generator of goal ids"), name)
