"""The server's state machine: the life of a goal (http://wiki.ros.org/actionlib/DetailedDescription).

It does no I/O: it takes a status and an event and returns a status. A client can only request
(:attr:`GoalEvent.CANCEL_REQUEST`); the server decides everything else.

>>> next_status(Status.PENDING, GoalEvent.ACCEPT).name
'ACTIVE'
>>> next_status(Status.SUCCEEDED, GoalEvent.ABORT)  # doctest: +ELLIPSIS
Traceback (most recent call last):
...
rosmini.core.actionlib.errors.IllegalTransition: set_aborted() is for a goal that is ACTIVE or PREEMPTING; ...
"""

from __future__ import annotations

from enum import Enum

from .errors import IllegalTransition
from .states import Status

__all__ = ["SERVER_TRANSITIONS", "GoalEvent", "next_status"]


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
    """Return the status of a goal after ``event``. Raises ``IllegalTransition``."""
    allowed = SERVER_TRANSITIONS[event]
    if status in allowed:
        return allowed[status]
    names = [one.name for one in allowed]
    listed = " or ".join(filter(None, [", ".join(names[:-1]), names[-1]]))
    hint = ", which is final" if status.is_terminal else ""
    if status is Status.PENDING and event in (GoalEvent.SUCCEED, GoalEvent.ABORT):
        hint = ": call set_accepted() first"
    raise IllegalTransition(
        f"{event.value}() is for a goal that is {listed}; this one is {status.name}{hint}."
    )
