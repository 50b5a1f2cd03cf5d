"""ROS 1 in one Python process: the computation graph behind the book.

>>> from rosmini import Graph
>>> graph = Graph()
>>> graph.node("talker")
<Node /talker>
"""

from __future__ import annotations

TYPE_CHECKING = False  # as `typing` has it, which takes longer to import than all of this
if TYPE_CHECKING:
    from typing import Any

    from .core.errors import RosminiError
    from .core.graph import Graph, Node, default_graph, set_default_graph
    from .core.time import Duration, Time
    from .notebook.waiting import wait
    from .ros.rospy import install, uninstall
    from .ros.scripts import rosrun

__version__ = "0.1.0"

_HOMES = {
    "Duration": "rosmini.core.time",
    "Graph": "rosmini.core.graph",
    "Node": "rosmini.core.graph",
    "RosminiError": "rosmini.core.errors",
    "Time": "rosmini.core.time",
    "default_graph": "rosmini.core.graph",
    "install": "rosmini.ros.rospy",
    "rosrun": "rosmini.ros.scripts",
    "set_default_graph": "rosmini.core.graph",
    "uninstall": "rosmini.ros.rospy",
    "wait": "rosmini.notebook.waiting",
}

__all__ = [
    "Duration",
    "Graph",
    "Node",
    "RosminiError",
    "Time",
    "default_graph",
    "install",
    "rosrun",
    "set_default_graph",
    "uninstall",
    "wait",
]


def __getattr__(name: str) -> Any:
    """Import what is asked for on first use, so that ``import rosmini`` costs next to nothing."""
    if name not in _HOMES:
        msg = f"module 'rosmini' has no attribute {name!r}"
        raise AttributeError(msg)
    import importlib

    return getattr(importlib.import_module(_HOMES[name]), name)


def load_ipython_extension(shell: Any) -> None:
    """Make a notebook one whose cells are terminals: what ``%load_ext rosmini`` does."""
    import importlib

    importlib.import_module("rosmini.notebook.extension").load(shell)
    importlib.import_module("rosmini.notebook.unknown_magics").load_ipython_extension(shell)


def unload_ipython_extension(shell: Any) -> None:
    """Undo that: what ``%unload_ext rosmini`` does."""
    import importlib

    importlib.import_module("rosmini.notebook.extension").unload(shell)


def __dir__() -> list[str]:
    return [*__all__, "__version__"]
