"""`rosrun` (http://wiki.ros.org/rosbash#rosrun) as a function."""

from __future__ import annotations

import os
from typing import Any

from rosmini.errors import ScriptError
from rosmini.graph import Graph, default_graph

from .executables import BuiltIn, find
from .runner import ScriptSpec, run_scripts


def rosrun(
    package: str, executable: str, *args: str | os.PathLike[str], graph: Graph | None = None, **options: Any
) -> Any:
    """Start an executable of a package, as `rosrun package executable args` does, and return what it gives.

    A built-in node is started and goes on with the graph; its object is returned. A script is run until it ends: the
    graph is driven meanwhile, the options are those of :func:`~rosmini.scripts.run_scripts`, and its result is returned.
    ``args`` are ROS's: ``"scan:=/laser"``, ``"__name:=sim2"``, ``"__ns:=/robot1"``, ``"_rate:=10"``, and words and paths for the
    executable itself. The graph is the default one if none is given.

    Raises:
        UnknownPackage: there is no such package.
        ScriptError: it has no such executable; or an option was given to a built-in node.
        RosminiError: what the node raises while it is set up.

    """
    found = find(f"{package}/{executable}")
    words = tuple(os.fspath(each) for each in args)
    if graph is None:
        graph = default_graph()
    if found.path is not None:
        return run_scripts([ScriptSpec(str(found.path), words)], graph=graph, **options)
    if options:
        raise ScriptError(
            f"{package}/{executable} is a built-in node, which takes no option {min(options)!r}; parameters are "
            f'given as ROS does: "_{min(options)}:=value"'
        )
    node = BuiltIn(graph, found, words)
    node.start()
    return node.wait()
