"""Clients and servers with goal handles. `tests/interop/test_actionlib.py` compares them with the real ones."""

from __future__ import annotations

from contextlib import nullcontext

import pytest

from rosmini.core.actionlib import (
    ActionClient,
    ActionException,
    ActionServer,
    CommState,
    IllegalTransition,
    ServerGoalHandle,
    Status,
)
from rosmini.msgs import message_class
from rosmini.msgs.actionlib_msgs.msg import GoalID, GoalStatusArray
from rosmini.msgs.actionlib_tutorials.msg import (
    AveragingGoal,
    FibonacciAction,
    FibonacciFeedback,
    FibonacciGoal,
    FibonacciResult,
)

from .conftest import Desk, until


@pytest.fixture
def desk(graph):
    return Desk(graph)


@pytest.fixture
def client(graph, desk):
    made = ActionClient(graph.node("client"), "work", FibonacciAction)
    assert made.wait_for_server(100)
    return made


def pair(graph):
    desk = Desk(graph)
    client = ActionClient(graph.node("client"), "work", FibonacciAction)
    assert client.wait_for_server(10)
    return desk, client


def send(client, order=1):
    """Send a goal and note the states that its client comes through."""
    states = []
    handle = client.send_goal(FibonacciGoal(order), lambda one: states.append(one.get_comm_state().name))
    return handle, states


def test_several_goals_at_a_time(graph, desk, client):
    handles = [send(client, order)[0] for order in (1, 2, 3)]
    assert len({handle.id for handle in handles}) == 3
    until(graph, lambda: len(desk.goals) == 3)
    assert [goal.get_goal().order for goal in desk.goals] == [1, 2, 3]
    heard = []
    fourth = client.send_goal(
        FibonacciGoal(4), None, lambda one, feedback: heard.append((one, list(feedback.sequence)))
    )
    until(graph, lambda: len(desk.goals) == 4)
    for goal in desk.goals:
        goal.set_accepted()
    for number in range(20):
        desk.goals[0].publish_feedback(FibonacciFeedback([99]))
        desk.goals[3].publish_feedback(FibonacciFeedback([number]))
    for goal in (desk.goals[2], desk.goals[0], desk.goals[1], desk.goals[3]):
        goal.set_succeeded(FibonacciResult([goal.get_goal().order]))
    until(graph, lambda: all(one.get_comm_state() is CommState.DONE for one in [*handles, fourth]))
    assert [list(one.get_result().sequence) for one in handles] == [[1], [2], [3]]
    assert heard == [(fourth, [number]) for number in range(20)]


def test_a_handle_without_a_goal_says_so(sim):
    desk = Desk(sim)
    empty = ServerGoalHandle(None, desk.server)
    assert (empty.get_goal(), empty.id, empty == empty, empty.set_cancel_requested()) == (None, "", False, False)
    for step in (empty.set_accepted, empty.get_goal_id, lambda: empty.publish_feedback(FibonacciFeedback())):
        with pytest.raises(ActionException, match=r"goal handle .*has no goal"):
            step()
    with pytest.raises(ActionException, match="has no server"):
        ServerGoalHandle().get_default_result()


# -- the list of goals -------------------------------------------------------------------------------------------------


def test_status_at_five_hertz_and_on_each_change(sim):
    desk, client = pair(sim)
    lists = []
    sim.node("ear").subscriber("/work/status", GoalStatusArray, lists.append)
    sim.run(1.05)
    assert [round(one.header.stamp.to_sec() - 1000, 6) for one in lists] == [0.0, 0.2, 0.4, 0.6, 0.8, 1.0]
    send(client)
    sim.run(0.01)
    desk.goals[0].set_accepted()
    sim.run(0.01)
    assert [one.status for one in lists[-1].status_list] == [Status.ACTIVE]


def test_the_old_parameter_is_heeded_with_a_warning(sim, log):
    desk = Desk(sim, auto_start=False)
    desk.node.set_param("/work/status_frequency", 0)
    desk.server.start()
    lists = []
    sim.node("ear").subscriber("/work/status", GoalStatusArray, lists.append)
    sim.run(3)
    assert len(lists) == 1  # latched
    assert "/work/status_frequency is deprecated: set actionlib_status_frequency" in log()


# -- who is there ------------------------------------------------------------------------------------------------------


def test_waiting_for_a_server_that_comes_later(graph):
    client = ActionClient(graph.node("client"), "work", FibonacciAction)
    assert not client.wait_for_server(0.5)
    node = graph.node("waker")
    made = []
    node.timer(1.0, lambda _: made.append(Desk(graph)), oneshot=True)
    assert client.wait_for_server(900)
    handle, _ = send(client)
    until(graph, lambda: made[0].goals)
    assert made[0].goals[0].id == handle.id


def test_a_server_that_goes_and_one_that_comes(sim, log):
    desk, client = pair(sim)
    handle, states = send(client)
    sim.run(0.1)
    desk.goals[0].set_accepted()
    sim.run(0.1)
    desk.node.shutdown()
    sim.run(1)
    assert "the action server /server of /work has ended, with 1 goal open" in log()
    assert handle.get_comm_state() is CommState.ACTIVE  # as in ROS nothing says more
    assert not client.wait_for_server(0.5)
    Desk(sim)
    sim.run(1)
    assert states[-1] == "DONE"
    assert handle.get_terminal_state() is Status.LOST
    assert handle.get_result() is None
    assert f"/work no longer knows goal {handle.id}: it is LOST" in log()
    assert client.wait_for_server(0.5)


def test_a_client_that_goes_stops_nothing(sim, log):
    desk, client = pair(sim)
    send(client)
    sim.run(0.1)
    client.node.shutdown()
    (goal,) = desk.goals
    goal.set_accepted()
    goal.publish_feedback(FibonacciFeedback([1]))
    goal.set_succeeded()
    sim.run(0.1)
    assert goal.state is Status.SUCCEEDED
    assert log() == ""


def test_a_goal_before_any_server_says_that_nobody_heard_it(sim, log):
    client = ActionClient(sim.node("client"), "work", FibonacciAction)
    handle, _ = send(client)
    Desk(sim)
    sim.run(1)
    assert "published on /work/goal while nobody was connected" in log()
    assert handle.get_comm_state() is CommState.WAITING_FOR_GOAL_ACK
    assert handle.get_terminal_state() is Status.LOST
    assert "has not ended: its client is WAITING_FOR_GOAL_ACK" in log()


def test_forgotten_goals_and_stopped_ends(sim):
    desk, client = pair(sim)
    handle, states = send(client)
    handle.reset()
    sim.run(0.1)
    desk.goals[0].set_rejected()
    sim.run(0.1)
    assert states == []
    assert handle.get_comm_state() is CommState.LOST
    client.stop()
    desk.server.stop()
    desk.server.stop()
    sim.run(0.1)
    assert [entry for entry in sim.master.getSystemState("/t")[2][0] if entry[0].startswith("/work")] == []


# -- mistakes ----------------------------------------------------------------------------------------------------------


def test_what_is_no_action(sim):
    node = sim.node("n")
    with pytest.raises(ActionException, match=r"FibonacciGoal is not an action type.*: give FibonacciAction$"):
        ActionClient(node, "work", FibonacciGoal)
    with pytest.raises(ActionException, match=r"int is not an action type"):
        ActionServer(node, "work", int, print)
    client = ActionClient(node, "work", FibonacciAction)
    with pytest.raises(
        ActionException,
        match="/work takes goals of type actionlib_tutorials/FibonacciGoal, not actionlib_tutorials/AveragingGoal",
    ):
        client.send_goal(AveragingGoal())


def test_illegal_steps_are_raised_or_logged_in_rospys_style(sim, lenient, log):
    for graph in (sim, lenient):
        desk, client = pair(graph)
        handle, _ = send(client)
        graph.run(0.1)
        (goal,) = desk.goals
        with pytest.raises(IllegalTransition, match=f"goal {handle.id} of /work") if graph is sim else nullcontext():
            goal.set_succeeded()
        assert goal.state is Status.PENDING
    assert "set_succeeded() is for a goal that is ACTIVE or PREEMPTING; this one is PENDING" in log()


def test_two_servers_on_one_topic_are_noticed(lenient, log):
    desk, client = pair(lenient)
    handle, _ = send(client)
    lenient.run(0.1)
    desk.goals[0].set_accepted()
    lenient.run(0.1)
    liar = lenient.node("liar").publisher("/work/status", GoalStatusArray)
    liar.wait_for_subscribers()
    status = message_class("actionlib_msgs/GoalStatus")
    liar.publish(status_list=[status(goal_id=GoalID(id=handle.id), status=Status.RECALLING)])
    lenient.run(0.1)
    assert "RECALLING, but the client was already ACTIVE" in log()
    assert handle.get_comm_state() is CommState.ACTIVE


def test_callbacks_that_fail(lenient, log):
    def fail(*_):
        raise ValueError("oh")

    node = lenient.node("server")
    server = ActionServer(node, "work", FibonacciAction, fail, fail)
    client = ActionClient(lenient.node("client"), "work", FibonacciAction)
    assert client.wait_for_server()
    handle = client.send_goal(FibonacciGoal(1), fail, fail)
    lenient.run(0.1)
    assert "called for a goal of /work, raised ValueError: oh" in log()
    handle.cancel()
    lenient.run(0.1)
    server.goals[0].publish_feedback(FibonacciFeedback())
    server.goals[0].set_canceled()
    lenient.run(0.1)
    text = log()
    for what in ("a cancellation of /work", "feedback of /work", "transitions of /work"):
        assert f"called for {what}, raised ValueError: oh" in text
    assert handle.get_terminal_state() is Status.RECALLED
