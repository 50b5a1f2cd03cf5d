"""Actions: goals that take time, report how they get on, and can be cancelled (http://wiki.ros.org/actionlib).

The object API, on a :class:`rosmini.graph.Node`. What scripts import as ``actionlib`` is the same in rospy's style, :mod:`rosmini.rospy.aliases.actionlib`.
The two state machines are apart from nodes, in :mod:`~rosmini.actionlib.client_machine` and :mod:`~rosmini.actionlib.server_machine`.
"""

from __future__ import annotations

from .client import ActionClient, ClientGoalHandle
from .client_machine import CLIENT_TRANSITIONS, ClientMachine
from .errors import ActionException, IllegalTransition
from .server import ActionServer, ServerGoalHandle
from .server_machine import SERVER_TRANSITIONS, GoalEvent, next_status
from .simple_client import SimpleActionClient
from .simple_server import SimpleActionServer
from .states import CommState, SimpleGoalState, Status, TerminalState

__all__ = [
    "CLIENT_TRANSITIONS",
    "SERVER_TRANSITIONS",
    "ActionClient",
    "ActionException",
    "ActionServer",
    "ClientGoalHandle",
    "ClientMachine",
    "CommState",
    "GoalEvent",
    "IllegalTransition",
    "ServerGoalHandle",
    "SimpleActionClient",
    "SimpleActionServer",
    "SimpleGoalState",
    "Status",
    "TerminalState",
    "next_status",
]
