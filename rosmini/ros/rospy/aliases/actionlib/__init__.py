"""The module that scripts import as ``actionlib``: http://wiki.ros.org/actionlib.

Names and signatures are those of actionlib 1.14; all its modules (``actionlib.simple_action_client`` ...) are this
one. The node is that of the script. As in ROS, errors are logged, not raised. The implementation is
:mod:`rosmini.core.actionlib`.
"""

from __future__ import annotations

import sys
import threading
from typing import TYPE_CHECKING, Any

from rosmini.core import actionlib
from rosmini.core.actionlib.client import ClientGoalHandle
from rosmini.core.actionlib.states import ActionException, CommState, SimpleGoalState, Status, TerminalState
from rosmini.msgs import message_class
from rosmini.msgs.actionlib import msg
from rosmini.ros import rospy
from rosmini.ros.rospy.session import any_node, require_node

if TYPE_CHECKING:
    from collections.abc import Callable

    from rosmini.core.graph import Node

__all__ = [
    "ActionClient",
    "ActionException",
    "ActionServer",
    "ClientGoalHandle",
    "CommState",
    "GoalID",
    "GoalIDGenerator",
    "GoalStatus",
    "GoalStatusArray",
    "ServerGoalHandle",
    "SimpleActionClient",
    "SimpleActionServer",
    "SimpleGoalState",
    "StatusTracker",
    "TerminalState",
    "get_name_of_constant",
    "msg",
    "nop_cb",
]

action_client = action_server = exceptions = goal_id_generator = sys.modules[__name__]
handle_tracker_deleter = server_goal_handle = simple_action_client = sys.modules[__name__]
simple_action_server = status_tracker = sys.modules[__name__]

GoalID = message_class("actionlib_msgs/GoalID")
GoalStatus = message_class("actionlib_msgs/GoalStatus")
GoalStatusArray = message_class("actionlib_msgs/GoalStatusArray")
if not hasattr(GoalStatus, "to_string"):  # actionlib gives the message this method, and scripts call it
    GoalStatus.to_string = staticmethod(Status.to_string)


def get_name_of_constant(C: Any, n: int) -> str:
    """Return the name of a number in a class of constants such as ``GoalStatus``, or ``NO_SUCH_STATE_<number>``."""
    if C is GoalStatus:
        return Status.to_string(n)
    return next((name for name in dir(C) if name[0] != "_" and getattr(C, name) == n), f"NO_SUCH_STATE_{n:d}")


def nop_cb(goal_handle: actionlib.ServerGoalHandle) -> None:
    """Do nothing; the server's default callback for cancellations."""


class ActionClient(actionlib.ActionClient):
    """Sends goals to the action server ``ns``. Raises ``ROSInitException`` before ``init_node``."""

    def __init__(self, ns: str, ActionSpec: Any) -> None:
        super().__init__(require_node(f"an action client of {ns}"), ns, ActionSpec, numpy=False)


class SimpleActionClient(actionlib.SimpleActionClient):
    """Sends one goal after another to the action server ``ns``. Raises ``ROSInitException`` before ``init_node``."""

    def __init__(self, ns: str, ActionSpec: Any) -> None:
        super().__init__(require_node(f"an action client of {ns}"), ns, ActionSpec, numpy=False, strict=False)


class GoalIDGenerator(actionlib.GoalIDGenerator):
    """Creates ids that begin with ``name`` (default: the node's). Raises ``ROSInitException`` before ``init_node``."""

    def __init__(self, name: str | None = None) -> None:
        super().__init__(require_node("a generator of goal ids"), name)


class StatusTracker(actionlib.StatusTracker):
    """A goal in a server's list. Raises ``ROSInitException`` before ``init_node``."""

    def __init__(self, goal_id: Any = None, status: int | None = None, goal: Any = None) -> None:
        super().__init__(GoalIDGenerator(), rospy.Time.now(), goal_id, status, goal)


class ServerGoalHandle(actionlib.ServerGoalHandle):
    """A goal at the server; a handle created without a goal logs an error at every call."""

    def _complain(self, error: ActionException) -> None:
        any_node().logerr(error)


_OPTIONS: dict[str, Any] = {"numpy": False, "strict": False, "handle_class": ServerGoalHandle}


def _node_of_server(ns: str, auto_start: bool) -> Node:
    """Return the script's node, and warn of a server that starts before the script is ready for goals."""
    node = require_node(f"an action server of {ns}")
    if auto_start:
        node.logwarn(
            f"the action server {ns} starts by itself (auto_start=True): in ROS goals may arrive before the program "
            "is ready for them. Give auto_start=False, and call start() when all is set up."
        )
    return node


def _locks(node: Node) -> dict[str, Any]:
    """Return the lock classes of the node's script, by their names in ``threading``."""
    return getattr(node.context, "thread_classes", None) or vars(threading)


class ActionServer(actionlib.ActionServer):
    """Accepts goals on ``ns`` and passes each to ``goal_cb(handle)``. Raises ``ROSInitException`` without a node."""

    def __init__(
        self,
        ns: str,
        ActionSpec: Any,
        goal_cb: Callable[[actionlib.ServerGoalHandle], object],
        cancel_cb: Callable[[actionlib.ServerGoalHandle], object] = nop_cb,
        auto_start: bool = True,
    ) -> None:
        node = _node_of_server(ns, auto_start)
        super().__init__(node, ns, ActionSpec, goal_cb, cancel_cb, auto_start, **_OPTIONS)
        self.lock = _locks(node)["RLock"]()


class SimpleActionServer(actionlib.SimpleActionServer):
    """Executes one goal of ``name`` at a time. Raises ``ROSInitException`` before ``init_node``."""

    def __init__(
        self, name: str, ActionSpec: Any, execute_cb: Callable[[Any], object] | None = None, auto_start: bool = True
    ) -> None:
        node = _node_of_server(name, auto_start)
        super().__init__(node, name, ActionSpec, execute_cb, auto_start, **_OPTIONS)
        locks = _locks(node)
        self.action_server.lock = locks["RLock"]()
        self.lock = locks["RLock"]()  # what extends the server uses it, and the condition, for its own ends
        self.execute_condition = locks["Condition"](self.lock)
