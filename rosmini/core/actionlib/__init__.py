"""Actions: long-running goals that report progress and can be cancelled (http://wiki.ros.org/actionlib).

Clients and servers take a :class:`rosmini.core.graph.Node`. Scripts import the same classes in rospy's style as
``actionlib``: :mod:`rosmini.ros.rospy.aliases.actionlib`. The two state machines do not depend on nodes; they are in
:mod:`~rosmini.core.actionlib.client_machine` and :mod:`~rosmini.core.actionlib.server_goal_handle`.
"""

from __future__ import annotations

from .client import ActionClient
from .client_machine import CLIENT_TRANSITIONS, ClientMachine
from .server import ActionServer
from .server_goal_handle import SERVER_TRANSITIONS, GoalEvent, ServerGoalHandle, next_status
from .simple_client import SimpleActionClient
from .simple_server import SimpleActionServer
from .spec import GoalIDGenerator, StatusTracker
from .states import ActionException, CommState, IllegalTransition, SimpleGoalState, Status, TerminalState

__all__ = [
    "CLIENT_TRANSITIONS",
    "SERVER_TRANSITIONS",
    "ActionClient",
    "ActionException",
    "ActionServer",
    "ClientMachine",
    "CommState",
    "GoalEvent",
    "GoalIDGenerator",
    "IllegalTransition",
    "ServerGoalHandle",
    "SimpleActionClient",
    "SimpleActionServer",
    "SimpleGoalState",
    "Status",
    "StatusTracker",
    "TerminalState",
    "next_status",
]
