"""The ``main`` functions of ROS's modules ``rosbag`` and ``rosparam``: command lines run by a script."""

from __future__ import annotations

import sys
from collections.abc import Sequence

from rosmini.core.graph.show import find_extension

GROUP = "rosmini.tools"


def run_tool(name: str, argv: Sequence[str] | None) -> None:
    """Run a command line (``sys.argv`` if None) on the graph that runs the script, and print the result.

    Raises ``SystemExit`` with the exit status if that is not 0.
    """
    words = list(sys.argv if argv is None else argv)[1:]
    status = find_extension(GROUP, "in_script")(name, words)
    if status:
        raise SystemExit(status)
