"""Checks of the configuration before the robot moves; `move_base` logs the warnings once when it starts."""

from __future__ import annotations

from typing import Any

from rosmini.navigation.costmap_2d.inflation_layer import InflationLayer

ROUND_TOLERANCE = 0.01
"""A footprint counts as round if its two radii differ by at most this length [m]."""


def check_setup(move_base: Any) -> None:
    """Warn of parameters that are valid but can leave the robot stuck."""
    for costmap in (move_base.global_costmap, move_base.local_costmap):
        for text in inflation_warnings(costmap):
            move_base.node.logwarn(text)


def inflation_warnings(costmap: Any) -> list[str]:
    """Return warnings about inflation parameters that let planner and controller disagree."""
    layers = [layer for layer in costmap.layers if isinstance(layer, InflationLayer)]
    inscribed, circumscribed = costmap.inscribed_radius, costmap.circumscribed_radius
    found = []
    if layers and max(layer.radius for layer in layers) < inscribed:
        found.append(
            f"{costmap.name}: inflation_radius is less than the inscribed radius of the footprint, {inscribed:.3f} m: "
            f"cells in which the robot would certainly collide appear free. Set it to more than {circumscribed:.2f} m"
        )
    if costmap.name == "global_costmap" and circumscribed - inscribed > ROUND_TOLERANCE:
        found.append(
            f"the footprint's inscribed radius is {inscribed * 100:.1f} cm, its circumscribed radius "
            f"{circumscribed * 100:.1f} cm: the global planner may lead through gaps of {2 * inscribed * 100:.0f} cm, "
            f"and the controller, which checks the whole footprint, may refuse those under "
            f"{2 * circumscribed * 100:.0f} cm"
        )
    return found
