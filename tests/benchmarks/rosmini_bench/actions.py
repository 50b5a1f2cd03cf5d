"""What is measured of actions: goals a second, beside real actionlib."""

from __future__ import annotations

import subprocess
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rosmini.core.actionlib import ActionClient, ActionServer, CommState, Status
from rosmini.core.errors import RosminiError
from rosmini.core.graph import Graph
from rosmini.msgs import message_class

from . import Measure

if TYPE_CHECKING:
    from .peer import Rospy

NODE = Path(__file__).with_name("actionlib_node.py")


def goals(count: int) -> float:
    """Return goals a second: each is sent, accepted, told of with feedback, and succeeds, before the next is sent."""
    graph = Graph(simulated=False)
    action, result, feedback, goal = (
        message_class(f"actionlib/{name}") for name in ("TestAction", "TestResult", "TestFeedback", "TestGoal")
    )
    told: list[int] = []

    def work(handle: Any) -> None:
        number = handle.get_goal().goal
        handle.set_accepted()
        handle.publish_feedback(feedback(number))
        handle.set_succeeded(result(2 * number))

    ActionServer(graph.node("server"), "bench", action, work)
    client = ActionClient(graph.node("client"), "bench", action, numpy=False)
    client.wait_for_server()
    begin = time.perf_counter()
    for number in range(count):
        handle = client.send_goal(goal(number), None, lambda _, message: told.append(message.feedback))
        graph.run(until=lambda sent=handle: sent.get_comm_state() is CommState.DONE)  # type: ignore[misc]
        if handle.get_goal_status() is not Status.SUCCEEDED or handle.get_result().result != 2 * number:
            break
    seconds = time.perf_counter() - begin
    graph.run(0.05)  # the last feedback may come after the result
    graph.shutdown()
    if sorted(told) != list(range(count)):
        msg = "the benchmark's client did not get the results and the feedback of its goals, so there is no figure"
        raise RosminiError(msg)
    return count / seconds


def has_actionlib(rospy: Rospy) -> bool:
    """Tell whether the real actionlib is installed beside the real rospy."""
    done = subprocess.run([rospy.python, "-c", "import actionlib.msg"], capture_output=True, check=False)
    return done.returncode == 0


def measures(rospy: Rospy | None, scale: float) -> Iterator[Measure]:
    """Yield what is measured."""
    count = max(int(300 * scale), 10)
    peer: Callable[[], float] | None = None
    if rospy is not None and has_actionlib(rospy):
        real = rospy

        def measure() -> float:
            return real.measure("goals", count, node=NODE)

        peer = measure
    yield Measure(
        "action goals, one after the other, each with feedback", "goals/s", lambda: goals(count), peer, "actionlib"
    )
