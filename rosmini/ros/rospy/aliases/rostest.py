"""``import rostest``: tests of nodes, started from launch files by `rosmini test` (http://wiki.ros.org/rostest)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from rosmini.ros.rospy.core import signal_shutdown

from .rosgraph.masterapi import Master
from .rosunit import unitrun

__all__ = ["is_publisher", "is_subscriber", "rosrun", "run", "unitrun"]

CALLER = "/script"


def is_subscriber(topic: str, subscriber_id: str) -> bool:
    """Return True if the node ``subscriber_id`` (full name) subscribes to a topic, according to the Master."""
    return _holds(1, topic, subscriber_id)


def is_publisher(topic: str, publisher_id: str) -> bool:
    """Return True if the node ``publisher_id`` (full name) publishes on a topic, according to the Master."""
    return _holds(0, topic, publisher_id)


def _holds(part: int, topic: str, node: str) -> bool:
    return node in dict(Master(CALLER).getSystemState()[part]).get(topic, [])


def rosrun(package: str, test_name: str, test: Any, sysargs: Sequence[str] | None = None) -> None:
    """Run the tests of a class in a node; see `rosunit.unitrun`. Raises ``SystemExit`` with 1 if one failed."""
    try:
        unitrun(package, test_name, test, sysargs)
    finally:
        signal_shutdown("test complete")


run = rosrun
