"""Which turtles a program drives in a graph: those of turtlesim, robots, or one on paper."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .errors import LogoError, suggestion
from .floor import FloorFlock
from .turtles import Flock, Paper
from .turtlesim import WindowFlock, turtles_of

if TYPE_CHECKING:
    from rosmini.graph import Node


def robots_of(node: Node) -> list[str]:
    """The namespaces that have the topic `odom`, published, and `cmd_vel`, subscribed to; "" is the outermost."""
    published, subscribed, _ = node.master.ask("getSystemState")
    told = {name.removesuffix("/odom") for name, _ in published if name.endswith("/odom")}
    heard = {name.removesuffix("/cmd_vel") for name, _ in subscribed if name.endswith("/cmd_vel")}
    return sorted(told & heard)


def flock_on(node: Node, names: list[str]) -> Flock:
    """The turtles of these names, which may be namespaces of robots (`/` for one without a namespace).

    Without names: the first turtle of turtlesim if there is one, else all robots, else a turtle on paper.
    Raises ``LogoError`` for a name that nobody has.
    """
    turtles, robots = turtles_of(node), robots_of(node)
    wanted = [name.strip("/") for name in names]
    if not names:
        return WindowFlock(node) if turtles else FloorFlock(node, robots) if robots else Paper()
    if set(wanted) <= set(turtles):
        return WindowFlock(node, wanted)
    spaces = [f"/{name}" if name else "" for name in wanted]
    if set(spaces) <= set(robots):
        return FloorFlock(node, spaces)
    known = [*turtles, *(robot.strip("/") or "/" for robot in robots)]
    missing = next(
        (name for name, bare in zip(names, wanted, strict=True) if (bare or "/") not in known), names[0]
    )
    listed = suggestion(missing, known) or (f"; there are {', '.join(known)}" if known else "")
    raise LogoError(f"there is no turtle and no robot {missing} in the graph{listed}")
