"""``actionlib.simple_action_server``: the server for one goal at a time."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rosmini import actionlib
from rosmini.rospy.session import require_node

from .action_client import GoalStatus
from .action_server import ActionServer, nop_cb, warn_of_auto_start
from .server_goal_handle import ServerGoalHandle

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["ActionServer", "GoalStatus", "ServerGoalHandle", "SimpleActionServer", "nop_cb"]


class SimpleActionServer(actionlib.SimpleActionServer):
    """Works on one goal of ``name`` at a time. Raises ``ROSInitException`` before ``init_node``."""

    def __init__(
        self,
        name: str,
        ActionSpec: Any,
        execute_cb: Callable[[Any], object] | None = None,
        auto_start: bool = True,
    ) -> None:
        node = require_node(f"an action server of {name}")
        if auto_start:
            warn_of_auto_start(node, name)
        super().__init__(
            node,
            name,
            ActionSpec,
            execute_cb,
            auto_start,
            numpy=False,
            strict=False,
            handle_class=ServerGoalHandle,
        )
