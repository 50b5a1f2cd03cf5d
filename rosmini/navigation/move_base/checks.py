"""Checks of the configuration before the robot moves; `move_base` logs the warnings once when it starts."""

from __future__ import annotations

from typing import Any

from rosmini.core.entry_points import entry_points
from rosmini.core.errors import nearest
from rosmini.core.graph import Node
from rosmini.core.plugins import GROUP
from rosmini.navigation.costmap_2d.inflation_layer import InflationLayer
from rosmini.navigation.nav_core.plugin_files import short_name

ROUND_TOLERANCE = 0.01
"""A footprint counts as round if its two radii differ by at most this length [m]."""


def check_setup(move_base: Any) -> None:
    """Warn about parameters that are valid but can leave the robot stuck, and about namespaces that nothing reads."""
    node = move_base.node
    for costmap in (move_base.global_costmap, move_base.local_costmap):
        for text in inflation_warnings(costmap):
            node.logwarn(text)
    known = ["global_costmap", "local_costmap", *(each.name for each in move_base.recovery_behaviors)]
    known += [short_name(name) for name in move_base.planners.names.values()]
    for text in unread_namespaces(node, known):
        node.logwarn(text)


def inflation_warnings(costmap: Any) -> list[str]:
    """Return warnings about inflation parameters with which planner and controller can disagree."""
    layers = [layer for layer in costmap.layers if isinstance(layer, InflationLayer)]
    inscribed, circumscribed = costmap.inscribed_radius, costmap.circumscribed_radius
    if not layers:
        text = (
            f"{costmap.name} has no inflation layer: plans may touch walls as if the robot were a point. Add "
            '{name: inflation_layer, type: "costmap_2d::InflationLayer"} to its plugins'
        )
        return [text]
    radius = max(layer.radius for layer in layers)
    found = []
    if radius < inscribed:
        found.append(
            f"{costmap.name}: inflation_radius is {radius:g} m, and the inscribed radius of the footprint "
            f"{inscribed:.3f} m: cells in which the robot would certainly collide appear free. Set it to more than "
            f"{circumscribed:.2f} m"
        )
    if costmap.name == "global_costmap" and circumscribed - inscribed > ROUND_TOLERANCE:
        found.append(
            f"the footprint's inscribed radius is {inscribed * 100:.1f} cm, its circumscribed radius "
            f"{circumscribed * 100:.1f} cm: the global planner may lead through gaps of {2 * inscribed * 100:.0f} cm, "
            f"and the controller, which checks the whole footprint, may refuse those under "
            f"{2 * circumscribed * 100:.0f} cm"
        )
    return found


def unread_namespaces(node: Node, known: list[str]) -> list[str]:
    """Return warnings about unread parameter namespaces whose names resemble one that is read."""
    tree = node.get_param("~", {})
    plugins = {short_name(entry.name) for entry in entry_points(group=GROUP)}  # one file may configure several planners
    unread = [name for name, value in tree.items() if isinstance(value, dict) and name not in {*known, *plugins}]
    return [
        f"nothing reads the parameters in {node.name}/{name}; {hint}"
        for name in unread
        if (hint := nearest(name, known))
    ]
