"""What scripts import as ``actionlib``: http://wiki.ros.org/actionlib.

Names and signatures are those of actionlib 1.14; the node is that of the script. What is wrong is logged, not raised, as there. The work is
done in :mod:`rosmini.actionlib`.
"""

from __future__ import annotations

from rosmini.actionlib.errors import ActionException
from rosmini.msgs.actionlib import msg

from .action_client import (
    ActionClient,
    ClientGoalHandle,
    CommState,
    GoalID,
    GoalStatus,
    GoalStatusArray,
    TerminalState,
    get_name_of_constant,
)
from .action_server import ActionServer, nop_cb
from .goal_id_generator import GoalIDGenerator
from .server_goal_handle import ServerGoalHandle
from .simple_action_client import SimpleActionClient, SimpleGoalState
from .simple_action_server import SimpleActionServer
from .status_tracker import StatusTracker

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
