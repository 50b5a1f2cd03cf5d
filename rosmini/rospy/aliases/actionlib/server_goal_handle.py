"""``actionlib.server_goal_handle``: what a server's author has of a goal."""

from __future__ import annotations

from rosmini import actionlib
from rosmini.actionlib.errors import ActionException
from rosmini.rospy.session import any_node

__all__ = ["ServerGoalHandle"]


class ServerGoalHandle(actionlib.ServerGoalHandle):
    """One goal at the server; one that is made without a goal logs an error at whatever it is asked."""

    def _complain(self, error: ActionException) -> None:
        any_node().logerr(error)
