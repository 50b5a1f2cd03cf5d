"""``actionlib.action_client``: clients with goal handles."""

from __future__ import annotations

from typing import Any

from rosmini import actionlib
from rosmini.actionlib.client import ClientGoalHandle
from rosmini.actionlib.states import CommState, Status, TerminalState
from rosmini.msgs import message_class
from rosmini.rospy.session import require_node

__all__ = ["ActionClient", "ClientGoalHandle", "CommState", "GoalStatus", "TerminalState"]

GoalStatus = message_class("actionlib_msgs/GoalStatus")
if not hasattr(GoalStatus, "to_string"):  # actionlib gives the message this method, and scripts call it
    GoalStatus.to_string = staticmethod(Status.to_string)


class ActionClient(actionlib.ActionClient):
    """Sends goals to the action server ``ns``. Raises ``ROSInitException`` before ``init_node``."""

    def __init__(self, ns: str, ActionSpec: Any) -> None:
        super().__init__(require_node(f"an action client of {ns}"), ns, ActionSpec, numpy=False)
