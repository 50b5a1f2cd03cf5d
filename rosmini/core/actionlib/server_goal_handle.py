"""The server's view of a goal: the state machine (http://wiki.ros.org/actionlib/DetailedDescription) and the handle.

The machine does no I/O: it takes a status and an event and returns a status. A client can only request
(:attr:`GoalEvent.CANCEL_REQUEST`); the server decides everything else.

>>> next_status(Status.PENDING, GoalEvent.ACCEPT).name
'ACTIVE'
>>> next_status(Status.SUCCEEDED, GoalEvent.ABORT)  # doctest: +ELLIPSIS
Traceback (most recent call last):
...
rosmini.core.actionlib.states.IllegalTransition: set_aborted() is for a goal that is ACTIVE or PREEMPTING; ...
"""

from __future__ import annotations

from enum import Enum
from typing import TYPE_CHECKING, Any

from rosmini.msgs import message_class

from .states import ActionException, IllegalTransition, Status

if TYPE_CHECKING:
    from .server import ActionServer
    from .spec import StatusTracker


class GoalEvent(Enum):
    """Events in the life of a goal; the values are the methods of a server's goal handle."""

    ACCEPT = "set_accepted"
    REJECT = "set_rejected"
    SUCCEED = "set_succeeded"
    ABORT = "set_aborted"
    CANCEL = "set_canceled"
    CANCEL_REQUEST = "set_cancel_requested"


SERVER_TRANSITIONS: dict[GoalEvent, dict[Status, Status]] = {
    GoalEvent.ACCEPT: {Status.PENDING: Status.ACTIVE, Status.RECALLING: Status.PREEMPTING},
    GoalEvent.REJECT: {Status.PENDING: Status.REJECTED, Status.RECALLING: Status.REJECTED},
    GoalEvent.SUCCEED: {Status.ACTIVE: Status.SUCCEEDED, Status.PREEMPTING: Status.SUCCEEDED},
    GoalEvent.ABORT: {Status.ACTIVE: Status.ABORTED, Status.PREEMPTING: Status.ABORTED},
    GoalEvent.CANCEL: {
        Status.PENDING: Status.RECALLED,
        Status.RECALLING: Status.RECALLED,
        Status.ACTIVE: Status.PREEMPTED,
        Status.PREEMPTING: Status.PREEMPTED,
    },
    GoalEvent.CANCEL_REQUEST: {Status.PENDING: Status.RECALLING, Status.ACTIVE: Status.PREEMPTING},
}
"""For each event: old status to new status. Anything else is illegal."""


def next_status(status: Status, event: GoalEvent) -> Status:
    """Return the status of a goal after ``event``. Raises ``IllegalTransition`` if ``status`` does not allow it."""
    allowed = SERVER_TRANSITIONS[event]
    if status in allowed:
        return allowed[status]
    names = [one.name for one in allowed]
    listed = " or ".join(filter(None, [", ".join(names[:-1]), names[-1]]))
    hint = ", which is final" if status.is_terminal else ""
    if status is Status.PENDING and event in (GoalEvent.SUCCEED, GoalEvent.ABORT):
        hint = ": call set_accepted() first"
    raise IllegalTransition(f"{event.value}() is for a goal that is {listed}; this one is {status.name}{hint}.")


class ServerGoalHandle:
    """One goal at the server: its message, its status, and methods to decide its outcome.

    An illegal transition (:mod:`rosmini.core.actionlib.server_goal_handle`) raises ``IllegalTransition``, and a
    transition of a handle without a goal raises ``ActionException``. A server that is not strict logs an error
    instead, as rospy does. The methods that end the goal publish ``result``, or an empty one if it is None.
    """

    def __init__(
        self,
        status_tracker: StatusTracker | None = None,
        action_server: ActionServer | None = None,
        handle_tracker: Any = None,
    ) -> None:
        self.status_tracker = status_tracker
        self.action_server = action_server
        self.handle_tracker = handle_tracker
        self.goal: Any = None if status_tracker is None else status_tracker.goal
        """The action goal as received, such as ``FibonacciActionGoal``; None for a handle without a goal."""

    @property
    def status(self) -> Any:
        """The ``actionlib_msgs/GoalStatus``; an empty one if there is no goal."""
        tracker = self.status_tracker
        return message_class("actionlib_msgs/GoalStatus")() if tracker is None or self.goal is None else tracker.status

    @property
    def id(self) -> str:
        """The goal's id."""
        return str(self.status.goal_id.id)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, ServerGoalHandle) or self.goal is None or other.goal is None:
            return False
        return self.id == other.id

    def __hash__(self) -> int:
        return hash(self.id)

    @property
    def state(self) -> Status:
        """The status as an enum member."""
        return Status(self.status.status)

    def get_goal(self) -> Any:
        """Return the goal, a message such as ``FibonacciGoal``, or None."""
        return None if self.goal is None else self.goal.goal

    def get_goal_id(self) -> Any:
        """Return the ``actionlib_msgs/GoalID``; without a goal, log an error and return an empty one."""
        return self.get_goal_status().goal_id

    def get_goal_status(self) -> Any:
        """Return the ``actionlib_msgs/GoalStatus``; without a goal, log an error and return an empty one."""
        if self.goal is None:
            self._complain(ActionException("this goal handle has no goal: its id and status are empty"))
        return self.status

    def get_default_result(self) -> Any:
        """Return an empty result."""
        return self._server().get_default_result()

    # -- transitions ---------------------------------------------------------------------------------------------

    def set_accepted(self, text: str = "") -> None:
        """Accept the goal: it becomes ``ACTIVE``, or ``PREEMPTING`` if its client has already cancelled it."""
        self._step(GoalEvent.ACCEPT, text)

    def set_rejected(self, result: Any = None, text: str = "") -> None:
        """Reject the goal, which must not have been accepted yet: it becomes ``REJECTED``."""
        self._step(GoalEvent.REJECT, text, result)

    def set_succeeded(self, result: Any = None, text: str = "") -> None:
        """Report that the goal has been reached: it becomes ``SUCCEEDED``."""
        self._step(GoalEvent.SUCCEED, text, result)

    def set_aborted(self, result: Any = None, text: str = "") -> None:
        """Report that the goal cannot be reached: it becomes ``ABORTED``."""
        self._step(GoalEvent.ABORT, text, result)

    def set_canceled(self, result: Any = None, text: str = "") -> None:
        """Report the goal as cancelled: ``RECALLED`` if it was never active, otherwise ``PREEMPTED``."""
        self._step(GoalEvent.CANCEL, text, result)

    def set_cancel_requested(self) -> bool:
        """Record a client's cancel request; return False if it has no effect. Called by the server."""
        if self.goal is None:
            return False
        try:
            self.status.status = next_status(self.state, GoalEvent.CANCEL_REQUEST)
        except IllegalTransition:
            return False
        self._server().publish_change()
        return True

    def publish_feedback(self, feedback: Any) -> None:
        """Publish progress: a message such as ``FibonacciFeedback``."""
        if self.goal is None:
            self._complain(ActionException("publish_feedback() was called on a goal handle that has no goal"))
        else:
            self._server().publish_feedback(self.status, feedback)

    def _step(self, event: GoalEvent, text: str, result: Any = None) -> None:
        if self.goal is None:
            self._complain(ActionException(f"{event.value}() was called on a goal handle that has no goal"))
        else:
            self._server().node.scheduler.run_in_scheduler(self._go, event, text, result)

    def _go(self, event: GoalEvent, text: str, result: Any) -> None:
        server, status = self._server(), self.status
        try:
            state = next_status(self.state, event)
        except IllegalTransition as error:
            server.complain(IllegalTransition(f"goal {self.id} of {server.ns}: {error}"))
            return
        status.status, status.text = state, str(text)
        if state.is_terminal and self.status_tracker is not None:
            server.end(self.status_tracker)
            server.publish_result(status, server.get_default_result() if result is None else result)
        else:
            server.publish_change()

    def _server(self) -> ActionServer:
        if self.action_server is None:
            raise ActionException("this goal handle has no server: it was not made by one")
        return self.action_server

    def _complain(self, error: ActionException) -> None:
        self._server().complain(error)
