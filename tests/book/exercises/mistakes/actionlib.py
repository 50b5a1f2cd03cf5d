"""Wrong answers to the exercises of the chapter Actions."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rosmini.book.exercises.actionlib import _ends
from rosmini.core.actionlib import SERVER_TRANSITIONS, ActionServer, SimpleActionServer, Status
from rosmini.core.graph import Graph
from rosmini.msgs.actionlib.msg import TestAction, TestFeedback, TestResult, TwoIntsAction, TwoIntsResult

if TYPE_CHECKING:
    from collections.abc import Callable


def _counter(
    *, period: float = 1.0, first: int = 1, heeds: bool = True, says: bool = True, ends: str = "set_preempted"
) -> Callable[[], Any]:
    def start(graph: Graph) -> None:
        node = graph.node("counter")

        def count(goal: Any) -> None:
            number = first - 1
            while number < goal.goal:
                node.sleep(period)
                if heeds and server.is_preempt_requested():
                    getattr(server, ends)(TestResult(number))
                    return
                number += 1
                if says:
                    server.publish_feedback(TestFeedback(number))
            server.set_succeeded(TestResult(number))

        server = SimpleActionServer(node, "count", TestAction, count)

    return lambda: start


def _one_step(status: Status) -> set[Status]:
    return {table[status] for table in SERVER_TRANSITIONS.values() if status in table and table[status].is_terminal}


def _jumper(graph: Graph) -> None:
    node = graph.node("counter")

    def count(goal: Any) -> None:
        node.sleep(float(goal.goal))
        server.set_succeeded(TestResult(goal.goal))

    server = SimpleActionServer(node, "count", TestAction, count)


def _named_otherwise(graph: Graph) -> None:
    SimpleActionServer(graph.node("count"), "counter", TestAction, lambda _: None)


# ---- ask_with_patience: patience ----


def _never_cancels(client: Any, goal: Any, seconds: float) -> tuple[str, Any]:
    client.send_goal(goal)
    client.wait_for_result(seconds)
    return client.get_state().name, client.get_result()


def _does_not_wait(client: Any, goal: Any, seconds: float) -> tuple[str, Any]:
    client.send_goal(goal)
    if not client.wait_for_result(seconds):
        client.cancel_goal()
    return client.get_state().name, client.get_result()


def _always_cancels(client: Any, goal: Any, seconds: float) -> tuple[str, Any]:
    client.send_goal(goal)
    client.node.sleep(seconds)
    client.cancel_goal()
    client.wait_for_result()
    return client.get_state().name, client.get_result()


def _without_limit(client: Any, goal: Any, _: float) -> tuple[str, Any]:
    return client.send_goal_and_wait(goal).name, client.get_result()


# ---- start_adder: choose your goals ----


def _adder(
    *, limit: int = 0, both: bool = True, accept: bool = True, reject: str = "set_rejected"
) -> Callable[[], Any]:
    def start(graph: Graph) -> None:
        def on_goal(handle: Any) -> None:
            goal = handle.get_goal()
            if goal.a < limit or (both and goal.b < limit):
                if reject != "set_rejected":
                    handle.set_accepted()
                getattr(handle, reject)()
                return
            if accept:
                handle.set_accepted()
            handle.set_succeeded(TwoIntsResult(goal.a + goal.b))

        ActionServer(graph.node("adder"), "add", TwoIntsAction, on_goal)

    return lambda: start


def _accepts_only(graph: Graph) -> None:
    ActionServer(graph.node("adder"), "add", TwoIntsAction, lambda handle: handle.set_accepted())


MISTAKES = {
    "possible_ends": [
        lambda: _one_step,
        lambda: lambda _: {status for status in Status if status.is_terminal},
        lambda: lambda status: _ends(status) if not status.is_terminal else set(),
        lambda: lambda status: sorted(_ends(status)),
        lambda: lambda status: {end.name for end in _ends(status)},
        lambda: lambda status: _ends(status) | {status},
    ],
    "start_counter": [
        _counter(period=0.5),
        _counter(first=2),
        _counter(heeds=False),
        _counter(says=False),
        _counter(ends="set_succeeded"),
        lambda: _jumper,
        lambda: _named_otherwise,
        lambda: lambda graph: graph.node("counter"),
    ],
    "ask_with_patience": [
        lambda: _never_cancels,
        lambda: _does_not_wait,
        lambda: _always_cancels,
        lambda: _without_limit,
        lambda: lambda client, goal, seconds: client.send_goal_and_wait(goal, seconds),
        lambda: lambda client, goal, seconds: ("SUCCEEDED", client.send_goal_and_wait(goal, seconds)),
    ],
    "start_adder": [
        _adder(limit=1),
        _adder(both=False),
        _adder(accept=False),
        _adder(reject="set_aborted"),
        _adder(limit=-100),
        lambda: _accepts_only,
        lambda: lambda graph: graph.node("adder"),
    ],
}
