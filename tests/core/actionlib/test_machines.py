"""The server's machine, written out from the diagram of http://wiki.ros.org/actionlib/DetailedDescription.

`tests/interop/actionlib_peer.py` compares all that the client's machine hears in every state.
"""

from __future__ import annotations

import itertools

import pytest

from rosmini.core.actionlib import (
    SERVER_TRANSITIONS,
    ClientMachine,
    CommState,
    GoalEvent,
    IllegalTransition,
    Status,
    TerminalState,
    next_status,
)
from rosmini.msgs.actionlib_msgs.msg import GoalStatus

# -- the server ----------------------------------------------------------------------------------------------------

SERVER_ARROWS = {
    ("PENDING", "set_accepted"): "ACTIVE",
    ("PENDING", "set_rejected"): "REJECTED",
    ("PENDING", "set_canceled"): "RECALLED",
    ("PENDING", "set_cancel_requested"): "RECALLING",
    ("RECALLING", "set_accepted"): "PREEMPTING",
    ("RECALLING", "set_rejected"): "REJECTED",
    ("RECALLING", "set_canceled"): "RECALLED",
    ("ACTIVE", "set_succeeded"): "SUCCEEDED",
    ("ACTIVE", "set_aborted"): "ABORTED",
    ("ACTIVE", "set_canceled"): "PREEMPTED",
    ("ACTIVE", "set_cancel_requested"): "PREEMPTING",
    ("PREEMPTING", "set_succeeded"): "SUCCEEDED",
    ("PREEMPTING", "set_aborted"): "ABORTED",
    ("PREEMPTING", "set_canceled"): "PREEMPTED",
}


@pytest.mark.parametrize(
    ("status", "event"), itertools.product(Status, GoalEvent), ids=lambda one: getattr(one, "name", one)
)
def test_each_event_in_each_status_of_the_server(status: Status, event: GoalEvent) -> None:
    expected = SERVER_ARROWS.get((status.name, event.value))
    if expected is not None:
        assert next_status(status, event) is Status[expected]
        return
    with pytest.raises(IllegalTransition) as caught:
        next_status(status, event)
    text = str(caught.value)
    assert event.value in text
    assert f"this one is {status.name}" in text
    assert ("final" in text) == status.is_terminal
    for allowed in SERVER_TRANSITIONS[event]:
        assert allowed.name in text


# -- the client ----------------------------------------------------------------------------------------------------


def test_no_client_is_surprised_by_a_server_that_keeps_to_its_machine() -> None:
    """Whatever the server does, and whichever of the statuses on the way are heard."""
    ends = set()
    for steps in itertools.product(GoalEvent, repeat=4):
        history = [Status.PENDING]
        for event in steps:
            if history[-1] in SERVER_TRANSITIONS[event]:
                history.append(next_status(history[-1], event))
        for heard in itertools.product([True, False], repeat=len(history)):
            machine = ClientMachine()
            for status, arrives in zip(history, heard, strict=True):
                if arrives:
                    machine.hear(status)
            if history[-1].is_terminal:
                machine.finish(history[-1])
                assert machine.state is CommState.DONE
                ends.add(machine.status)
    assert ends == {one for one in Status if one.is_terminal} - {Status.LOST}


# -- numbers and names -----------------------------------------------------------------------------------------------


def test_the_numbers_are_those_of_the_message() -> None:
    assert {one.name: one.value for one in Status} == {one.name: getattr(GoalStatus, one.name) for one in Status}
    assert all(Status[one.name] == one for one in TerminalState)
