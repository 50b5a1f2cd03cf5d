"""Actions: long-running goals that report progress and can be cancelled (http://wiki.ros.org/actionlib).

This is the object API, on a :class:`rosmini.core.graph.Node`. Scripts import the same in rospy's style as
``actionlib``: :mod:`rosmini.ros.rospy.aliases.actionlib`. The two state machines do not depend on nodes; they are in
:mod:`~rosmini.core.actionlib.client_machine` and :mod:`~rosmini.core.actionlib.server_machine`.
"""

from __future__ import annotations

from .client import ActionClient, ClientGoalHandle
from .client_machine import CLIENT_TRANSITIONS, ClientMachine
from .errors import ActionException, IllegalTransition
from .goal_id_generator import GoalIDGenerator
from .server import ActionServer
from .server_goal_handle import ServerGoalHandle
from .server_machine import SERVER_TRANSITIONS, GoalEvent, next_status
from .simple_client import SimpleActionClient
from .simple_server import SimpleActionServer
from .states import CommState, SimpleGoalState, Status, TerminalState
from .status_tracker import StatusTracker

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
