"""Finds the windows of turtlesim in a graph."""

from __future__ import annotations

from rosmini.core.errors import nearest
from rosmini.core.graph import Graph, running_graph
from rosmini.core.names import resolve

from .node import TurtleSim
from .turtle import TurtleError


def windows(graph: Graph | None = None) -> dict[str, TurtleSim]:
    """Return the turtlesims of a graph (the default one if not given) by the names of their nodes."""
    nodes = (running_graph() if graph is None else graph).nodes
    return {name: node.program for name, node in sorted(nodes.items()) if isinstance(node.program, TurtleSim)}


def window(name: str | None = None, graph: Graph | None = None) -> TurtleSim:
    """Return the turtlesim whose node has this name, or the only one.

    >>> from rosmini import Graph, rosrun
    >>> graph = Graph()
    >>> _ = rosrun("turtlesim", "turtlesim_node", graph=graph).instance()
    [INFO] [1000.000000]: Starting turtlesim with node name /turtlesim
    [INFO] [1000.000000]: Spawning turtle [turtle1] at x=[5.544445], y=[5.544445], theta=[0.000000]
    >>> list(window(graph=graph).turtles)
    ['turtle1']

    Raises `TurtleError` if there is no turtlesim of this name, none at all, or more than one.
    """
    found = windows(graph)
    if not found:
        raise TurtleError(
            "no turtlesim runs in this graph: start one with `rosrun turtlesim turtlesim_node`, and let time pass"
        )
    if name is None and len(found) == 1:
        return next(iter(found.values()))
    if name is None:
        raise TurtleError(f"there are {len(found)} windows: say which one is meant, of {', '.join(found)}")
    full = resolve(name, "/")
    if full not in found:
        raise TurtleError(f"no turtlesim is called {full}: {nearest(full, found) or 'there is ' + ', '.join(found)}")
    return found[full]
