"""The errors of actions, and the states that actionlib names: of a goal, of its client, and of the simple client.

Numbers and names are those of ``actionlib_msgs/GoalStatus`` and of actionlib's Python classes
(http://wiki.ros.org/actionlib/DetailedDescription).
"""

from __future__ import annotations

from enum import IntEnum

from rosmini.core.errors import RosminiError


class ActionException(RosminiError):
    """An action client or server was used in an unsupported way; actionlib's name."""


class IllegalTransition(ActionException):
    """The state machine has no such transition from its current state."""


class _Named(IntEnum):
    """Named numbers, as in actionlib's classes of constants."""

    @classmethod
    def to_string(cls, number: int) -> str:
        """Return the name of a state, or ``NO_SUCH_STATE_<number>``."""
        try:
            return cls(number).name
        except ValueError:
            return f"NO_SUCH_STATE_{number:d}"


class Status(_Named):
    """Status of a goal: the constants of ``actionlib_msgs/GoalStatus``."""

    PENDING = 0
    ACTIVE = 1
    PREEMPTED = 2
    SUCCEEDED = 3
    ABORTED = 4
    REJECTED = 5
    PREEMPTING = 6
    RECALLING = 7
    RECALLED = 8
    LOST = 9

    @property
    def is_terminal(self) -> bool:
        """True if the status can no longer change."""
        return self in _TERMINAL


_TERMINAL = frozenset(
    {Status.PREEMPTED, Status.SUCCEEDED, Status.ABORTED, Status.REJECTED, Status.RECALLED, Status.LOST}
)


class TerminalState(_Named):
    """Final status of a goal, with the numbers of :class:`Status`."""

    RECALLED = 8
    REJECTED = 5
    PREEMPTED = 2
    ABORTED = 4
    SUCCEEDED = 3
    LOST = 9


class CommState(_Named):
    """A client's view of its goal: the states of the client's machine."""

    WAITING_FOR_GOAL_ACK = 0
    PENDING = 1
    ACTIVE = 2
    WAITING_FOR_RESULT = 3
    WAITING_FOR_CANCEL_ACK = 4
    RECALLING = 5
    PREEMPTING = 6
    DONE = 7
    LOST = 8
    """Not a state of the machine: reported by a handle that no longer follows its goal."""


class SimpleGoalState(_Named):
    """The three states of :class:`~rosmini.core.actionlib.SimpleActionClient`."""

    PENDING = 0
    ACTIVE = 1
    DONE = 2
