"""``actionlib.action_server``: servers with goal handles."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rosmini import actionlib
from rosmini.rospy.session import require_node

from .action_client import GoalID, GoalStatus, GoalStatusArray
from .goal_id_generator import GoalIDGenerator
from .server_goal_handle import ServerGoalHandle
from .status_tracker import StatusTracker

if TYPE_CHECKING:
    from collections.abc import Callable

    from rosmini.graph import Node

__all__ = [
    "ActionServer",
    "GoalID",
    "GoalIDGenerator",
    "GoalStatus",
    "GoalStatusArray",
    "ServerGoalHandle",
    "StatusTracker",
    "nop_cb",
    "warn_of_auto_start",
]


def nop_cb(goal_handle: actionlib.ServerGoalHandle) -> None:
    """Do nothing: what a server does about cancellations that it is not told to heed."""


def warn_of_auto_start(node: Node, ns: str) -> None:
    """Say why a server should not start by itself: goals may come before its author is ready for them."""
    node.logwarn(
        f"the action server {ns} starts by itself (auto_start=True): with real ROS goals may arrive before the program is ready for "
        "them. Give auto_start=False, and call start() when all is set up."
    )


class ActionServer(actionlib.ActionServer):
    """Takes goals on ``ns`` and hands each to ``goal_cb(handle)``. Raises ``ROSInitException`` before ``init_node``."""

    def __init__(
        self,
        ns: str,
        ActionSpec: Any,
        goal_cb: Callable[[actionlib.ServerGoalHandle], object],
        cancel_cb: Callable[[actionlib.ServerGoalHandle], object] = nop_cb,
        auto_start: bool = True,
    ) -> None:
        node = require_node(f"an action server of {ns}")
        if auto_start:
            warn_of_auto_start(node, ns)
        super().__init__(
            node,
            ns,
            ActionSpec,
            goal_cb,
            cancel_cb,
            auto_start,
            numpy=False,
            strict=False,
            handle_class=ServerGoalHandle,
        )
