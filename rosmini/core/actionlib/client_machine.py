"""The client's state machine, driven by the server's reports (http://wiki.ros.org/actionlib/DetailedDescription).

It does no I/O: it takes statuses and returns states. The server publishes the status of a goal periodically, so a
client may miss some: if it receives ``SUCCEEDED`` while ``PENDING``, it passes through ``ACTIVE`` first.
:data:`CLIENT_TRANSITIONS` lists all of these paths.

>>> machine = ClientMachine()
>>> machine.hear(Status.SUCCEEDED)
>>> machine.state.name
'WAITING_FOR_RESULT'
"""

from __future__ import annotations

from collections.abc import Callable

from .states import CommState, IllegalTransition, Status

_LETTERS = {
    "P": CommState.PENDING,
    "A": CommState.ACTIVE,
    "W": CommState.WAITING_FOR_RESULT,
    "r": CommState.RECALLING,
    "p": CommState.PREEMPTING,
}

_REPORTED = (
    Status.PENDING,
    Status.ACTIVE,
    Status.RECALLING,
    Status.PREEMPTING,
    Status.REJECTED,
    Status.RECALLED,
    Status.PREEMPTED,
    Status.SUCCEEDED,
    Status.ABORTED,
)

# One row per state, one column per status above: the states to pass through. "-": no change; "!": not
# allowed.
_TABLE = """
    WAITING_FOR_GOAL_ACK    P  A  Pr Ap PW PW  ApW AW AW
    PENDING                 -  A  r  Ap W  rW  ApW AW AW
    ACTIVE                  !  -  !  p  !  !   pW  W  W
    WAITING_FOR_RESULT      !  -  !  !  -  -   -   -  -
    WAITING_FOR_CANCEL_ACK  -  -  r  p  W  rW  pW  pW pW
    RECALLING               !  !  -  p  W  W   pW  pW pW
    PREEMPTING              !  !  !  -  !  !   W   W  W
    DONE                    !  !  !  !  -  -   -   -  -
"""

CLIENT_TRANSITIONS: dict[CommState, dict[Status, tuple[CommState, ...] | None]] = {
    CommState[row.split()[0]]: {
        status: None if states == "!" else tuple(_LETTERS[letter] for letter in states if letter != "-")
        for status, states in zip(_REPORTED, row.split()[1:], strict=True)
    }
    for row in _TABLE.strip().splitlines()
}
"""For each state and each reported status: the states to pass through; the last one is the new state.

None if the report is not allowed in that state.
"""

CANCELLABLE = frozenset({CommState.WAITING_FOR_GOAL_ACK, CommState.PENDING, CommState.ACTIVE})
"""States in which a goal can be cancelled; in the others it is being cancelled already, or over."""

_MAY_BE_UNLISTED = frozenset({CommState.WAITING_FOR_GOAL_ACK, CommState.WAITING_FOR_RESULT, CommState.DONE})
"""States in which a status list may lack the goal: the server has not received it yet, or has dropped it."""


def path(state: CommState, status: int) -> tuple[CommState, ...]:
    """Return the states that a client in ``state`` passes through when it receives ``status``; empty for no change.

    Raises ``IllegalTransition`` if the protocol does not allow ``status`` here, or if there is no such status.
    """
    row = CLIENT_TRANSITIONS.get(state, {})
    if status not in row:
        known = ", ".join(f"{one.value} {one.name}" for one in _REPORTED)
        raise IllegalTransition(
            f"the server sent the status {Status.to_string(status)}, which is not valid; valid are {known}"
        )
    states = row[Status(status)]
    if states is None:
        raise IllegalTransition(
            f"the server reports the goal as {Status(status).name}, but the client was already {state.name}: "
            "this order is not possible. Do two servers, or two nodes of the same name, use these topics?"
        )
    return states


class ClientMachine:
    """The state of one goal as its client knows it.

    ``on_transition(state)`` is called for each state that it enters, in order.
    """

    def __init__(self, on_transition: Callable[[CommState], object] | None = None) -> None:
        self.state = CommState.WAITING_FOR_GOAL_ACK
        self.status: int = Status.PENDING
        self.text = ""
        self._on_transition = on_transition

    def _enter(self, state: CommState) -> None:
        self.state = state
        if self._on_transition is not None:
            self._on_transition(state)

    def hear(self, status: int, text: str = "") -> None:
        """Handle a reported status; does nothing once the goal is done.

        Raises ``IllegalTransition`` if the protocol does not allow the status in this state.
        """
        if self.state is CommState.DONE:
            return
        self.status, self.text = status, text
        for state in path(self.state, status):
            self._enter(state)

    def miss(self) -> bool:
        """Handle a status list that lacks this goal; return whether the goal is now lost."""
        if self.state in _MAY_BE_UNLISTED:
            return False
        self.status = Status.LOST
        self._enter(CommState.DONE)
        return True

    def finish(self, status: int, text: str = "") -> None:
        """Handle the result, which contains the final status.

        Raises ``IllegalTransition`` for a second result, or a status not allowed here; the goal is done in any case.
        """
        if self.state is CommState.DONE:
            raise IllegalTransition(
                f"a second result arrived for a goal that is over ({Status.to_string(self.status)}): "
                f"now {Status.to_string(status)}"
            )
        try:
            self.hear(status, text)
        finally:
            self._enter(CommState.DONE)

    def cancel(self) -> bool:
        """Record a request for cancellation; return False, without effect, if this state does not allow it."""
        if self.state not in CANCELLABLE:
            return False
        self._enter(CommState.WAITING_FOR_CANCEL_ACK)
        return True
