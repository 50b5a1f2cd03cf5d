"""Checks of the exercises in the chapter Actions."""

from __future__ import annotations

from typing import Any

from rosmini.book.checks import exercise, expect, expect_node, expect_type
from rosmini.core.actionlib import (
    SERVER_TRANSITIONS,
    ActionClient,
    CommState,
    SimpleActionClient,
    SimpleActionServer,
    Status,
)
from rosmini.core.graph import Graph
from rosmini.msgs.actionlib.msg import TestAction, TestFeedback, TestGoal, TestResult, TwoIntsAction, TwoIntsGoal

# ---- possible_ends: where can it end? ----


def _ends(status: Status) -> set[Status]:
    if status.is_terminal:
        return {status}
    nexts = {table[status] for table in SERVER_TRANSITIONS.values() if status in table}
    return {end for after in nexts for end in _ends(after)}


@exercise("possible_ends", praise="An accepted goal cannot be rejected or recalled: the robot may have moved.")
def possible_ends(answer: Any) -> None:
    """The final statuses that a goal can still reach."""
    for status in Status:
        if status is Status.LOST:
            continue
        found, expected = answer(status), _ends(status)
        expect_type(found, set, "It returned", "a set", "set() is an empty set, and | unites two sets")
        expect(
            all(isinstance(end, Status) for end in found),
            "The set contains objects that are not statuses.",
            "take them from the dictionaries unchanged",
        )
        if status.is_terminal:
            expect(found == expected, f"{status.name} is final, so the only end is itself.", "check status.is_terminal")
        missing = sorted(end.name for end in expected - found)
        expect(
            not missing,
            f"From {status.name} a goal can also reach {', '.join(missing)}.",
            "follow the arrows from every status that you reach, not only from the first",
        )
        extra = sorted(end.name for end in found - expected)
        expect(not extra, f"From {status.name} a goal cannot reach {', '.join(extra)}.", "look at figure 91.2")


# ---- start_counter: count ----


def _count(graph: Graph) -> None:
    """Start a server that counts as the exercise requires."""
    node = graph.node("counter")

    def count(goal: Any) -> None:
        for number in range(1, goal.goal + 1):
            node.sleep(1.0)
            if server.is_preempt_requested():
                server.set_preempted(TestResult(number - 1))
                return
            server.publish_feedback(TestFeedback(number))
        server.set_succeeded(TestResult(goal.goal))

    server = SimpleActionServer(node, "count", TestAction, count)


@exercise(
    "start_counter",
    praise="The goal can be stopped only where the server calls `is_preempt_requested`, so call it often.",
)
def start_counter(answer: Any) -> None:
    """An action server that counts, publishes feedback and can be stopped."""
    with Graph() as graph:
        answer(graph)
        expect_node(graph, "/counter")
        client = SimpleActionClient(graph.node("check"), "count", TestAction)
        expect(
            client.wait_for_server(1.0),
            "No action server answers on /count.",
            'use SimpleActionServer(node, "count", TestAction, ...)',
        )
        heard: list[tuple[int, int]] = []
        begin = graph.now()

        def note(feedback: Any) -> None:
            heard.append((round((graph.now() - begin).to_sec()), feedback.feedback))

        client.send_goal(TestGoal(3), feedback_cb=note)
        expect(client.wait_for_result(20.0), "A goal of 3 has not ended after 20 s.", "use set_succeeded()")
        numbers = [number for _, number in heard]
        expect(
            numbers == [1, 2, 3],
            f"With the goal 3 the feedback was {numbers}, not [1, 2, 3].",
            "call publish_feedback(TestFeedback(number)) for each number, from 1",
        )
        seconds = [second for second, _ in heard]
        expect(
            seconds == [1, 2, 3],
            f"The numbers arrived after {seconds} s, not one each second.",
            "call node.sleep(1.0) before each number",
        )
        _expect_end(client, Status.SUCCEEDED, 3)
        client.send_goal(TestGoal(100))
        expect(not client.wait_for_result(4.5), "A goal of 100 ended within 4.5 s.", "count once a second")
        client.cancel_goal()
        expect(
            client.wait_for_result(3.0),
            "After a request to stop, it continued for more than three seconds.",
            "call is_preempt_requested() before each number",
        )
        _expect_end(client, Status.PREEMPTED, 4)


def _expect_end(client: SimpleActionClient, status: Status, number: int) -> None:
    found, result = client.get_state(), client.get_result()
    step = "set_preempted" if status is Status.PREEMPTED else "set_succeeded"
    expect(
        found is status,
        f"A goal that should end as {status.name} ended as {found.name}.",
        f"call {step}(TestResult(number))",
    )
    expect(
        result.result == number,
        f"The result is {result.result}, but the last number was {number}.",
        f"call {step}(TestResult(number))",
    )


# ---- ask_with_patience: patience ----


@exercise(
    "ask_with_patience",
    praise="Your function waits for the end after a cancellation, because the robot may move until then.",
)
def ask_with_patience(answer: Any) -> None:
    """A goal that is cancelled after a timeout."""
    with Graph() as graph:
        _count(graph)
        client = SimpleActionClient(graph.node("check"), "count", TestAction)
        client.wait_for_server(1.0)
        for far, seconds, status, number, took in ((2, 10.0, "SUCCEEDED", 2, 2.0), (9, 3.5, "PREEMPTED", 3, 4.0)):
            begin = graph.now()
            found = answer(client, TestGoal(far), seconds)
            spent = (graph.now() - begin).to_sec()
            expect(
                isinstance(found, tuple) and len(found) == 2,
                "It did not return two values.",
                "return client.get_state().name, client.get_result()",
            )
            case = f"a goal that takes {far} s and a patience of {seconds} s"
            expect(
                abs(spent - took) < 0.1,
                f"With {case} it returned after {spent:.1f} s, not after {took:.1f} s.",
                "wait for the result with the timeout; then cancel, and wait again",
            )
            expect(
                found[0] == status,
                f"With {case} the status is {found[0]!r}, not {status!r}.",
                "read client.get_state().name after the goal has ended",
            )
            expect(
                getattr(found[1], "result", None) == number,
                f"With {case} the second value is not the result.",
                "return client.get_result()",
            )


# ---- start_adder: choose your goals ----


@exercise("start_adder", praise="A rejected goal was never ACTIVE, so the client knows that nothing has started.")
def start_adder(answer: Any) -> None:
    """A server that rejects some goals."""
    with Graph() as graph:
        answer(graph)
        expect_node(graph, "/adder")
        client = ActionClient(graph.node("check"), "add", TwoIntsAction)
        expect(
            client.wait_for_server(1.0),
            "No action server answers on /add.",
            'use ActionServer(node, "add", TwoIntsAction, on_goal)',
        )
        for a, b in ((2, 3), (0, 0), (-1, 5), (5, -1)):
            _check_sum(graph, client, a, b)


def _check_sum(graph: Graph, client: ActionClient, a: int, b: int) -> None:
    states: list[CommState] = []
    goal = TwoIntsGoal(a, b)
    handle = client.send_goal(goal, lambda one: states.append(one.get_comm_state()))
    graph.run(1.0)
    text = f"The goal a={a}, b={b}"
    expect(
        handle.get_comm_state() is CommState.DONE,
        f"{text} has not ended after a second.",
        "call set_accepted(), then set_succeeded(...)",
    )
    wanted = Status.REJECTED if min(a, b) < 0 else Status.SUCCEEDED
    found = handle.get_terminal_state()
    expect(
        found is wanted,
        f"{text} ended as {found.name}, not as {wanted.name}.",
        "call set_rejected() for a goal with a negative number, set_accepted() and set_succeeded(...) for any other",
    )
    if wanted is Status.SUCCEEDED:
        total = handle.get_result().sum
        expect(total == a + b, f"{text} has the result {total}, not the sum.", "TwoIntsResult(a + b)")
