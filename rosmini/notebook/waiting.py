"""Let time pass, in a cell or in a program."""

from __future__ import annotations

from rosmini.core.graph import running_graph
from rosmini.core.graph.event_queue import span_ns


def wait(seconds: float) -> None:
    """Let ``seconds`` of graph time pass: nodes run meanwhile, and their output appears here.

    An interrupt ends the wait, but not the nodes. In a script or callback this sleeps like ``rospy.sleep``.
    Raises ``RosminiError`` unless ``seconds`` is a number of at least zero.
    """
    scheduler = running_graph().scheduler
    scheduler.sleep_until(scheduler.now_ns() + span_ns(seconds, "the time to wait"))
    scheduler.yield_to_others()  # messages published at this moment arrive
