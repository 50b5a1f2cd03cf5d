"""The simple client and server: one goal at a time."""

from __future__ import annotations

import threading

import pytest

from rosmini.core.actionlib import ActionException, SimpleActionClient, SimpleActionServer, Status
from rosmini.core.errors import CallbackError
from rosmini.core.graph import Graph
from rosmini.core.time import Duration, Time
from rosmini.msgs.actionlib_tutorials.msg import FibonacciAction, FibonacciFeedback, FibonacciGoal, FibonacciResult
from rosmini.msgs.rosgraph_msgs.msg import Clock

from ...processes import PATIENCE
from .conftest import Fibonacci, until


class Diary:
    """What a client's callbacks were told, in order."""

    def __init__(self, graph, name="client", action="fibonacci"):
        self.entries = []
        self.client = SimpleActionClient(graph.node(name), action, FibonacciAction)

    def send(self, order):
        self.client.send_goal(FibonacciGoal(order), self.done, self.active, self.feedback)

    def done(self, state, result):
        self.entries.append((Status(state).name, list(result.sequence)))

    def active(self):
        self.entries.append("active")

    def feedback(self, feedback):
        self.entries.append(len(feedback.sequence))


def start(graph, **options):
    served = Fibonacci(graph, **options)
    diary = Diary(graph)
    assert diary.client.wait_for_server(100)
    return served, diary


def test_in_process_the_order_is_that_of_events(sim):
    _, diary = start(sim)
    diary.send(2)
    diary.client.wait_for_result()
    assert diary.entries == ["active", 2, 3, ("SUCCEEDED", [0, 1, 1, 2])]
    assert sim.now() == Time(1000, 200_000_000)
    assert diary.client.gh.id == "/client-1-1000.000"


def test_timeouts(graph):
    _, diary = start(graph)
    diary.send(50)
    assert not diary.client.wait_for_result(0.25)
    assert diary.client.get_state() is Status.ACTIVE
    assert diary.client.get_result() is None
    assert not diary.client.wait_for_result(Duration.from_sec(0.1))
    diary.client.cancel_goal()
    assert diary.client.wait_for_result(Duration(100))
    assert diary.client.get_state() is Status.PREEMPTED
    assert diary.client.get_goal_status_text() == "stopped"


def test_of_several_that_wait_the_newest_is_kept(sim):
    _, first = start(sim)
    others = [Diary(sim, name) for name in ("a", "b", "c")]
    for other in others:
        assert other.client.wait_for_server()
    first.send(5)
    sim.run(0.05)
    for number, other in enumerate(others):
        sim.run(0.001)
        other.send(number)
    sim.run(3)
    assert first.entries[-1][0] == "PREEMPTED"
    assert [other.entries[-1] for other in others] == [("RECALLED", []), ("RECALLED", []), ("SUCCEEDED", [0, 1, 1, 2])]
    assert (
        others[0].client.get_goal_status_text()
        == "This goal was canceled because another goal was received by the simple action server"
    )


def test_a_goal_that_is_overtaken_is_cancelled(sim):
    """One that was sent before the current goal and arrives after it."""
    _, diary = start(sim)
    late = Diary(sim, "late")
    assert late.client.wait_for_server()
    diary.send(5)
    sim.run(0.05)
    handle = late.client.action_client
    sent = handle.types.action_goal(goal=FibonacciGoal(1))
    sent.goal_id.id, sent.goal_id.stamp = "old", Time(999)
    results = []
    sim.node("ear").subscriber("fibonacci/result", handle.types.action_result, results.append)
    handle._goal.publish(sent)
    sim.run(0.01)
    assert [(one.status.goal_id.id, one.status.status) for one in results] == [("old", Status.RECALLED)]
    assert diary.client.get_state() is Status.ACTIVE


def test_a_goal_cancelled_while_it_waits(sim):
    _, first = start(sim)
    second = Diary(sim, "second")
    assert second.client.wait_for_server()
    first.send(5)
    sim.run(0.05)
    second.send(7)
    second.client.cancel_goal()
    sim.run(0.01)
    assert second.client.get_state() is Status.PENDING  # RECALLING, for the simple client
    assert second.client.wait_for_result(5)
    assert second.entries == ["active", ("PREEMPTED", [0, 1])]


def test_a_client_that_sends_the_next_goal_forgets_the_first(sim):
    _, diary = start(sim)
    diary.send(50)
    sim.run(0.15)
    diary.send(1)
    diary.client.wait_for_result()
    assert diary.entries == ["active", 2, 3, "active", 2, ("SUCCEEDED", [0, 1, 1])]


def test_the_next_goal_from_within_done_cb(sim):
    _, diary = start(sim)
    client, left, ended = diary.client, [3, 2], []

    def again(state, result):
        ended.append((state, len(result.sequence)))
        if left:
            client.send_goal(FibonacciGoal(left.pop()), again)

    client.send_goal(FibonacciGoal(1), again)
    assert client.wait_for_result(5)
    assert ended == [(3, 3), (3, 4), (3, 5)]


def test_stop_tracking(sim):
    served, diary = start(sim)
    diary.send(3)
    sim.run(0.05)
    diary.client.stop_tracking_goal()
    sim.run(1)
    assert diary.entries == ["active", 2]
    assert diary.client.get_state() is Status.LOST
    assert served.server.current_goal.state is Status.SUCCEEDED


def test_cancel_all_and_by_stamp(sim):
    _, diary = start(sim)
    diary.send(50)
    sim.run(0.05)
    diary.client.cancel_goals_at_and_before_time(Time(999))
    sim.run(0.2)
    assert diary.client.get_state() is Status.ACTIVE
    diary.client.cancel_goals_at_and_before_time(sim.now())
    assert diary.client.wait_for_result(1)
    diary.send(50)
    sim.run(0.05)
    diary.client.cancel_all_goals()
    assert diary.client.wait_for_result(1)
    assert [one[0] for one in diary.entries if isinstance(one, tuple)] == ["PREEMPTED", "PREEMPTED"]


# -- without an execute callback ---------------------------------------------------------------------------------------


def test_goal_and_preempt_callbacks(sim):
    node = sim.node("server")
    server = SimpleActionServer(node, "fibonacci", FibonacciAction, auto_start=False)
    diary = Diary(sim)
    told = []

    def take():
        told.append(("take", server.is_active(), server.accept_new_goal().order))

    def stop():
        told.append("stop")
        if not server.is_new_goal_available():
            server.set_preempted(FibonacciResult([7]))

    server.register_goal_callback(take)
    server.register_preempt_callback(stop)
    assert not diary.client.wait_for_server(0.5)
    server.start()
    assert diary.client.wait_for_server(0.5)
    diary.send(1)
    sim.run(0.1)
    assert server.is_active()
    server.publish_feedback(FibonacciFeedback([1, 2, 3]))
    diary.client.cancel_goal()
    sim.run(0.1)
    assert diary.entries == ["active", 3, ("PREEMPTED", [7])]
    other = Diary(sim, "other")
    assert other.client.wait_for_server()
    diary.send(2)
    sim.run(0.1)
    other.send(3)
    sim.run(0.1)
    assert told == [("take", False, 1), "stop", ("take", False, 2), "stop", ("take", True, 3)]
    assert diary.entries[-1] == ("PREEMPTED", [])
    server.set_succeeded()
    sim.run(0.1)
    assert other.entries[-1] == ("SUCCEEDED", [])
    server.stop()
    sim.run(0.1)
    assert not other.client.wait_for_server(0.1)


# -- mistakes ----------------------------------------------------------------------------------------------------------


def test_questions_without_a_goal(sim, lenient, log):
    client = Diary(sim).client
    for ask in (client.get_result, client.wait_for_result, client.get_goal_status_text):
        with pytest.raises(
            ActionException, match=rf"{ask.__name__}\(\) was called before any goal was sent .*send_goal\(\) first"
        ):
            ask()
    assert client.get_state() is Status.LOST
    client.cancel_goal()
    client = Diary(lenient).client
    assert client.get_result() is None
    assert not client.wait_for_result()
    assert client.get_goal_status_text().startswith("ERROR")
    assert log().count("send_goal() first") == 3


def test_a_server_without_a_goal(sim, lenient, log):
    for graph in (sim, lenient):
        server = SimpleActionServer(graph.node("server"), "fibonacci", FibonacciAction)
        steps = (server.set_succeeded, server.set_aborted, server.set_preempted, server.accept_new_goal)
        for step in steps:
            if graph is sim:
                with pytest.raises(ActionException, match=r"/fibonacci: .*\(\) was called.* goal"):
                    step()
            else:
                assert step() is None
    assert log().count("[ERROR]") == 4
    assert not server.is_active()
    assert server.get_default_result() == FibonacciResult()


def test_an_execute_callback_that_says_nothing(sim, log):
    served, diary = start(sim)
    served.server.execute_callback = lambda goal: None
    diary.send(1)
    assert diary.client.wait_for_result(1)
    assert diary.client.get_state() is Status.ABORTED
    assert "the execute callback of /fibonacci returned without setting how the goal ended" in log()
    served.server.register_goal_callback(print)
    assert "has an execute callback, which gets the goals" in log()


def test_an_execute_callback_that_fails(sim, lenient, log):
    def fail(goal):
        raise ZeroDivisionError("no")

    served, diary = start(lenient)
    served.server.execute_callback = fail
    diary.send(1)
    assert diary.client.wait_for_result(1)
    assert diary.client.get_state() is Status.ABORTED
    assert diary.client.get_goal_status_text() == "Exception in execute callback: no"
    assert "called for a goal of /fibonacci, raised ZeroDivisionError: no" in log()
    served, diary = start(sim)
    served.server.execute_callback = fail
    diary.send(1)
    with pytest.raises(CallbackError, match="called for a goal of /fibonacci"):
        diary.client.wait_for_result(1)


# -- clocks, shutdown, determinism -------------------------------------------------------------------------------------


def test_time_that_comes_over_the_topic_clock(sim):
    clock = sim.node("bag").publisher("/clock", Clock, latch=True)
    sim.master.setParam("/t", "/use_sim_time", True)
    _, diary = start(sim)
    now = [100.0]

    def tick(_):
        now[0] += 0.1
        clock.publish(Time.from_sec(now[0]))

    sim.nodes["/bag"].timer(0.01, tick)  # ten times as fast as the graph
    sim.run(0.05)
    diary.send(3)
    begin = sim.now()
    assert diary.client.wait_for_result(2)
    assert (sim.now() - begin).to_sec() < 0.06
    diary.send(1000)
    begin = sim.now()
    assert not diary.client.wait_for_result(2)
    assert (sim.now() - begin).to_sec() == pytest.approx(0.2, abs=0.02)


def test_shutdown_ends_the_waiting(graph):
    _, diary = start(graph)
    client = diary.client
    client.node.timer(0.5, lambda _: client.node.shutdown("enough"), oneshot=True)
    diary.send(10**6)
    ended = []
    client.node.run(lambda: ended.append(client.wait_for_result()))
    until(graph, lambda: ended)
    assert ended == [False]


def test_goals_from_a_real_thread():
    """In wall time; each goal ends as fast as it can, so that its end comes while the thread is still sending."""
    graph = Graph(simulated=False)
    graph.notebook = False
    served, diary = start(graph)
    served.server.execute_callback = lambda goal: served.server.set_succeeded(FibonacciResult([goal.order]))
    ended = []

    def work():
        for order in range(30):
            diary.client.send_goal(FibonacciGoal(order))
            ended.append(
                (
                    diary.client.wait_for_result(PATIENCE),
                    diary.client.get_state(),
                    diary.client.get_result().sequence[0],
                )
            )

    thread = threading.Thread(target=work)
    # Not before this thread drives the graph: of two that begin at once one is refused.
    diary.client.node.timer(0.001, lambda _: thread.start(), oneshot=True)
    try:
        until(graph, lambda: len(ended) == 30)
    finally:
        thread.join(PATIENCE)
        graph.shutdown()
    assert ended == [(True, Status.SUCCEEDED, order) for order in range(30)]


def test_a_namespace_and_a_remapping(sim):
    Fibonacci(sim)
    node = sim.node("client", namespace="/robot1", remappings={"fib": "/fibonacci"})
    client = SimpleActionClient(node, "fib", FibonacciAction)
    assert client.wait_for_server(1)
    assert client.send_goal_and_wait(FibonacciGoal(1)) is Status.SUCCEEDED
    assert client.gh.id.startswith("/robot1/client-1-")
