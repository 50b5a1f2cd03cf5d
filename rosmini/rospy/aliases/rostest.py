"""``import rostest``: tests of nodes, which `rosmini test` starts from launch files (http://wiki.ros.org/rostest)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from rosmini.rospy.core import signal_shutdown

from .rosunit import unitrun

__all__ = ["rosrun", "run", "unitrun"]


def rosrun(package: str, test_name: str, test: Any, sysargs: Sequence[str] | None = None) -> None:
    """Run the tests of a class in a node; see `rosunit.unitrun`. Raises ``SystemExit`` with 1 if one failed."""
    try:
        unitrun(package, test_name, test, sysargs)
    finally:
        signal_shutdown("test complete")


run = rosrun
