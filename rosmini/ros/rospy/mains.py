"""The ``main`` functions of ROS's modules, such as ``rostopic.rostopicmain``: command lines that a script runs."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

from rosmini.core.graph.show import find_extension

if TYPE_CHECKING:
    from collections.abc import Sequence

GROUP = "rosmini.tools"


def run_tool(name: str, argv: Sequence[str] | None) -> None:
    """Do what a command line says, ``sys.argv`` if it is None, on the graph that runs the script, and print it.

    Raises ``SystemExit`` with the exit status if that is not 0.
    """
    words = list(sys.argv if argv is None else argv)[1:]
    status = find_extension(GROUP, "in_script")(name, words)
    if status:
        raise SystemExit(status)
