"""``actionlib.action_client``: clients with goal handles."""

from __future__ import annotations

from typing import Any

from rosmini import actionlib
from rosmini.actionlib.client import ClientGoalHandle
from rosmini.actionlib.states import CommState, Status, TerminalState
from rosmini.msgs import message_class
from rosmini.rospy.session import require_node

__all__ = [
    "ActionClient",
    "ClientGoalHandle",
    "CommState",
    "GoalID",
    "GoalStatus",
    "GoalStatusArray",
    "TerminalState",
    "get_name_of_constant",
]

GoalID = message_class("actionlib_msgs/GoalID")
GoalStatus = message_class("actionlib_msgs/GoalStatus")
GoalStatusArray = message_class("actionlib_msgs/GoalStatusArray")
if not hasattr(GoalStatus, "to_string"):  # actionlib gives the message this method, and scripts call it
    GoalStatus.to_string = staticmethod(Status.to_string)


def get_name_of_constant(C: Any, n: int) -> str:
    """Return the name that a class of constants, such as ``GoalStatus``, has for a number; ``NO_SUCH_STATE_<number>`` if it has none."""
    if C is GoalStatus:
        return Status.to_string(n)
    return next((name for name in dir(C) if name[0] != "_" and getattr(C, name) == n), f"NO_SUCH_STATE_{n:d}")


class ActionClient(actionlib.ActionClient):
    """Sends goals to the action server ``ns``. Raises ``ROSInitException`` before ``init_node``."""

    def __init__(self, ns: str, ActionSpec: Any) -> None:
        super().__init__(require_node(f"an action client of {ns}"), ns, ActionSpec, numpy=False)
