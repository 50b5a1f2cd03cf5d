"""Letting time pass, in a cell or in a program."""

from __future__ import annotations

from rosmini.core.graph import running_graph
from rosmini.core.graph.event_queue import span_ns


def wait(seconds: float) -> None:
    """Let ``seconds`` of graph time pass: nodes run meanwhile, and what they print appears here.

    An interrupt ends the wait; the nodes are still there. In a script or callback this sleeps, as ``rospy.sleep`` does.
    Raises ``RosminiError`` for what is no number of seconds from zero on.
    """
    scheduler = running_graph().scheduler
    scheduler.sleep_until(scheduler.now_ns() + span_ns(seconds, "the time to wait"))
    scheduler.give_way()  # what was published at this moment arrives
