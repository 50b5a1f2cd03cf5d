"""Every state of both machines with everything that can happen in it, legal or not.

The expected values are written out from the two diagrams of http://wiki.ros.org/actionlib/DetailedDescription, apart
from the library's tables.
"""

from __future__ import annotations

import itertools

import pytest

from rosmini.core.actionlib import (
    CLIENT_TRANSITIONS,
    SERVER_TRANSITIONS,
    ClientMachine,
    CommState,
    GoalEvent,
    IllegalTransition,
    SimpleGoalState,
    Status,
    TerminalState,
    next_status,
)
from rosmini.core.actionlib.client_machine import path
from rosmini.core.errors import RosminiError
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


def test_every_goal_of_a_server_ends_and_stays_ended() -> None:
    reachable, new = set(), {Status.PENDING}
    while new:
        reachable |= new
        new = {after for table in SERVER_TRANSITIONS.values() for before, after in table.items() if before in new}
        new -= reachable
    assert reachable == set(Status) - {Status.LOST}
    ends = {one for one in reachable if not any(one in table for table in SERVER_TRANSITIONS.values())}
    assert ends == {one for one in reachable if one.is_terminal}
    assert {one.name for one in ends} == {one.name for one in TerminalState} - {"LOST"}


def test_the_hint_for_the_usual_mistake() -> None:
    with pytest.raises(IllegalTransition, match=r"this one is PENDING: call set_accepted\(\) first"):
        next_status(Status.PENDING, GoalEvent.SUCCEED)


# -- the client ----------------------------------------------------------------------------------------------------

CLIENT_ARROWS = {
    (state, status): visited
    for state, row in {
        "WAITING_FOR_GOAL_ACK": {"PENDING": "PENDING", "ACTIVE": "ACTIVE", "RECALLING": "PENDING RECALLING",
            "PREEMPTING": "ACTIVE PREEMPTING", "REJECTED": "PENDING WAITING_FOR_RESULT",
            "RECALLED": "PENDING WAITING_FOR_RESULT", "PREEMPTED": "ACTIVE PREEMPTING WAITING_FOR_RESULT",
            "SUCCEEDED": "ACTIVE WAITING_FOR_RESULT", "ABORTED": "ACTIVE WAITING_FOR_RESULT"},
        "PENDING": {"PENDING": "", "ACTIVE": "ACTIVE", "RECALLING": "RECALLING", "PREEMPTING": "ACTIVE PREEMPTING",
            "REJECTED": "WAITING_FOR_RESULT", "RECALLED": "RECALLING WAITING_FOR_RESULT",
            "PREEMPTED": "ACTIVE PREEMPTING WAITING_FOR_RESULT", "SUCCEEDED": "ACTIVE WAITING_FOR_RESULT",
            "ABORTED": "ACTIVE WAITING_FOR_RESULT"},
        "ACTIVE": {"ACTIVE": "", "PREEMPTING": "PREEMPTING", "PREEMPTED": "PREEMPTING WAITING_FOR_RESULT",
            "SUCCEEDED": "WAITING_FOR_RESULT", "ABORTED": "WAITING_FOR_RESULT"},
        "WAITING_FOR_CANCEL_ACK": {"PENDING": "", "ACTIVE": "", "RECALLING": "RECALLING", "PREEMPTING": "PREEMPTING",
            "REJECTED": "WAITING_FOR_RESULT", "RECALLED": "RECALLING WAITING_FOR_RESULT",
            "PREEMPTED": "PREEMPTING WAITING_FOR_RESULT", "SUCCEEDED": "PREEMPTING WAITING_FOR_RESULT",
            "ABORTED": "PREEMPTING WAITING_FOR_RESULT"},
        "RECALLING": {"RECALLING": "", "PREEMPTING": "PREEMPTING", "REJECTED": "WAITING_FOR_RESULT",
            "RECALLED": "WAITING_FOR_RESULT", "PREEMPTED": "PREEMPTING WAITING_FOR_RESULT",
            "SUCCEEDED": "PREEMPTING WAITING_FOR_RESULT", "ABORTED": "PREEMPTING WAITING_FOR_RESULT"},
        "PREEMPTING": {"PREEMPTING": "", "PREEMPTED": "WAITING_FOR_RESULT", "SUCCEEDED": "WAITING_FOR_RESULT",
            "ABORTED": "WAITING_FOR_RESULT"},
        "WAITING_FOR_RESULT": {"ACTIVE": "", "REJECTED": "", "RECALLED": "", "PREEMPTED": "", "SUCCEEDED": "",
            "ABORTED": ""},
        "DONE": {"REJECTED": "", "RECALLED": "", "PREEMPTED": "", "SUCCEEDED": "", "ABORTED": ""},
    }.items()
    for status, visited in row.items()
}  # fmt: skip
STATES = [state for state in CommState if state is not CommState.LOST]
HEARD = [status for status in Status if status is not Status.LOST]
WAYS = {
    "WAITING_FOR_GOAL_ACK": [],
    "PENDING": ["PENDING"],
    "ACTIVE": ["ACTIVE"],
    "RECALLING": ["RECALLING"],
    "PREEMPTING": ["PREEMPTING"],
    "WAITING_FOR_RESULT": ["SUCCEEDED"],
    "WAITING_FOR_CANCEL_ACK": ["cancel"],
    "DONE": ["finish"],
}
"""What to do with a new machine to have it in each state."""


def machine_in(state: CommState, visited: list[str]) -> ClientMachine:
    machine = ClientMachine(lambda one: visited.append(one.name))
    for step in WAYS[state.name]:
        if step == "cancel":
            assert machine.cancel()
        elif step == "finish":
            machine.finish(Status.SUCCEEDED)
        else:
            machine.hear(Status[step])
    assert machine.state is state
    visited.clear()
    return machine


@pytest.mark.parametrize(
    ("state", "status"), itertools.product(STATES, HEARD), ids=lambda one: getattr(one, "name", one)
)
def test_each_status_heard_in_each_state_of_the_client(state: CommState, status: Status) -> None:
    visited: list[str] = []
    machine = machine_in(state, visited)
    expected = CLIENT_ARROWS.get((state.name, status.name))
    if expected is not None:
        assert [one.name for one in path(state, status)] == expected.split()
        machine.hear(status, "why")
        assert visited == expected.split()
        assert machine.state.name == (visited[-1] if visited else state.name)
    else:
        with pytest.raises(IllegalTransition, match=f"{status.name}, but the client was already {state.name}"):
            path(state, status)
        if state is CommState.DONE:  # what is over is deaf
            machine.hear(status)
        else:
            with pytest.raises(IllegalTransition):
                machine.hear(status)
        assert visited == []
        assert machine.state is state


@pytest.mark.parametrize(
    ("state", "status"), itertools.product(STATES, HEARD), ids=lambda one: getattr(one, "name", one)
)
def test_a_result_ends_it_in_each_state(state: CommState, status: Status) -> None:
    visited: list[str] = []
    machine = machine_in(state, visited)
    expected = CLIENT_ARROWS.get((state.name, status.name))
    if state is CommState.DONE:
        with pytest.raises(IllegalTransition, match="a second result"):
            machine.finish(status)
        assert visited == []
        return
    if expected is None:
        with pytest.raises(IllegalTransition):
            machine.finish(status, "late")
    else:
        machine.finish(status, "late")
    assert visited == [*(expected or "").split(), "DONE"]
    assert (machine.state, machine.status, machine.text) == (CommState.DONE, status, "late")


@pytest.mark.parametrize("state", STATES, ids=lambda one: one.name)
def test_a_list_without_the_goal(state: CommState) -> None:
    visited: list[str] = []
    machine = machine_in(state, visited)
    lost = state.name in ("PENDING", "ACTIVE", "WAITING_FOR_CANCEL_ACK", "RECALLING", "PREEMPTING")
    assert machine.miss() is lost
    assert visited == (["DONE"] if lost else [])
    assert machine.state is (CommState.DONE if lost else state)
    assert (machine.status == Status.LOST) is lost


@pytest.mark.parametrize("state", STATES, ids=lambda one: one.name)
def test_asking_for_cancellation(state: CommState) -> None:
    visited: list[str] = []
    machine = machine_in(state, visited)
    heeded = state.name in ("WAITING_FOR_GOAL_ACK", "PENDING", "ACTIVE")
    assert machine.cancel() is heeded
    assert visited == (["WAITING_FOR_CANCEL_ACK"] if heeded else [])


@pytest.mark.parametrize("number", [Status.LOST, 10, 255])
def test_a_status_that_no_server_may_tell(number: int) -> None:
    for state in STATES:
        with pytest.raises(IllegalTransition, match="valid are 0 PENDING, 1 ACTIVE"):
            path(state, number)


def test_the_tables_are_whole() -> None:
    assert set(CLIENT_TRANSITIONS) == set(STATES)
    assert all(set(row) == set(HEARD) for row in CLIENT_TRANSITIONS.values())


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


def test_names_of_numbers() -> None:
    assert Status.to_string(3) == "SUCCEEDED"
    assert CommState.to_string(7) == "DONE"
    assert SimpleGoalState.to_string(2) == "DONE"
    assert TerminalState.to_string(1) == "NO_SUCH_STATE_1"
    assert f"{Status.SUCCEEDED}" == "3"
    assert issubclass(IllegalTransition, RosminiError)
