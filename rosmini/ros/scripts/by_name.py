"""`rosrun` (http://wiki.ros.org/rosbash#rosrun) as a function."""

from __future__ import annotations

import os
from typing import Any

from rosmini.core.errors import ScriptError
from rosmini.core.graph import Graph, running_graph
from rosmini.core.packages import Executable, PackageIndex

from .console import Console
from .node_handle import NodeHandle, NodeSpec
from .script_handle import ScriptHandle, ScriptSpec


def find(name: str) -> Executable:
    """Return the executable named by ``package/executable``.

    Raises ``ScriptError`` if the name is invalid or there is no such executable, and ``UnknownPackage``.
    """
    package, slash, executable = name.partition("/")
    if not (package and slash and executable) or "/" in executable:
        raise ScriptError(f"{name!r} is not of the form PACKAGE/EXECUTABLE, for example rosmini_sim/simulator")
    return PackageIndex().find_executable(package, executable)


def rosrun(
    package: str,
    executable: str,
    *args: str | os.PathLike[str],
    graph: Graph | None = None,
    seed: int = 0,
    **console: Any,
) -> ScriptHandle | NodeHandle:
    """Start an executable of a package, like `rosrun package executable args &`, and return its handle at once.

    It runs while the graph is driven: by ``graph.run()``, by ``handle.wait()`` until it ends, or by
    ``handle.instance()`` until a built-in node is set up, which returns the object created by the node.

    Args:
        package: the package's name.
        executable: the name of a built-in node, or of a script in the package.
        args: ROS's arguments (``"scan:=/laser"``, ``"__name:=sim2"``, ``"__ns:=/robot1"``, ``"_rate:=10"``), and
            words and paths for the executable itself.
        graph: where to run; by default the graph that runs the caller, or else the default graph.
        seed: seed of a script's random numbers in simulated time.
        console: ``stdin``, ``stdout``, ``stderr``, ``prefix`` and ``capture_output`` of
            :class:`~rosmini.ros.scripts.Console`.

    Raises:
        UnknownPackage: there is no such package.
        ScriptError: the package has no such executable, or it does not accept these arguments, or is not Python.
        RosminiError: a name or a parameter in the arguments is invalid.

    """
    found = find(f"{package}/{executable}")
    words = tuple(os.fspath(each) for each in args)
    used = running_graph() if graph is None else graph

    def make_console() -> Console:
        return Console(used.scheduler, **console)

    handle: ScriptHandle | NodeHandle
    if found.path is None:
        handle = NodeHandle(used, NodeSpec(found, words), make_console)
    else:
        handle = ScriptHandle(used, ScriptSpec(str(found.path), words), make_console, seed=f"{seed}/0")
    handle.start()
    return handle
