"""``actionlib.simple_action_client``: the client for one goal at a time."""

from __future__ import annotations

from typing import Any

from rosmini import actionlib
from rosmini.actionlib.states import SimpleGoalState
from rosmini.rospy.session import require_node

from .action_client import ActionClient, ClientGoalHandle, CommState, GoalStatus, TerminalState

__all__ = [
    "ActionClient",
    "ClientGoalHandle",
    "CommState",
    "GoalStatus",
    "SimpleActionClient",
    "SimpleGoalState",
    "TerminalState",
]


class SimpleActionClient(actionlib.SimpleActionClient):
    """Sends one goal after another to the action server ``ns``. Raises ``ROSInitException`` before ``init_node``."""

    def __init__(self, ns: str, ActionSpec: Any) -> None:
        super().__init__(require_node(f"an action client of {ns}"), ns, ActionSpec, numpy=False, strict=False)
