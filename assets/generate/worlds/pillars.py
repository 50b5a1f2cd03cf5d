"""Nine pillars, three by three, in a hexagonal fence: the pillars stand as in ROBOTIS's `turtlebot3_world`."""

from __future__ import annotations

import math

from rosmini.sim.shapes import Cylinder, Polygon
from rosmini.sim.world import Obstacle, World

STARTS = (
    (-2.0, -0.5, 0.0),
    (-0.55, -0.55, 0.0),
    (0.55, 0.55, math.pi),
    (1.9, 0.5, math.pi),
    (-0.55, 1.7, -math.pi / 2),
    (0.55, -1.7, math.pi / 2),
)

SPACING = 1.1
PILLAR = 0.15
INSIDE = 2.5
"""From the middle to the sides of the fence, within [m]."""
THICKNESS = 0.1
HEIGHT = 0.5
POST = 0.22
"""The posts at the corners are hexagons of this radius: the head, the feet and the tail of a turtle [m]."""


def pillars() -> World:
    """The stage, as its file is written from."""
    things = [
        Obstacle(f"turtlebot3_world::pillar {row} {column}", Cylinder(PILLAR), (x, y, 0.0), HEIGHT, "grey")
        for row, x in enumerate((-SPACING, 0.0, SPACING), 1)
        for column, y in enumerate((-SPACING, 0.0, SPACING), 1)
    ]
    inner, outer = (_hexagon(INSIDE / math.cos(math.pi / 6)), _hexagon((INSIDE + THICKNESS) / math.cos(math.pi / 6)))
    for i in range(6):
        after = (i + 1) % 6
        corners = (inner[i], outer[i], outer[after], inner[after])
        things.append(Obstacle(f"turtlebot3_world::fence {i + 1}", Polygon(corners), (0.0, 0.0, 0.0), HEIGHT, "wall"))
    names = ("head", "left front foot", "left hind foot", "tail", "right hind foot", "right front foot")
    for i, name in enumerate(names):
        size = {"head": 1.8, "tail": 0.6}.get(name, 1.0) * POST
        x, y = _hexagon((INSIDE + THICKNESS) / math.cos(math.pi / 6) + size - 0.03)[i]
        things.append(
            Obstacle(f"turtlebot3_world::{name}", Polygon(tuple(_hexagon(size))), (x, y, 0.0), HEIGHT, "green")
        )
    return World("pillars", tuple(things), starts=STARTS)


def _hexagon(radius: float) -> list[tuple[float, float]]:
    """Corners, the first of them ahead."""
    angles = [i * math.pi / 3 for i in range(6)]
    return [(round(radius * math.cos(a), 6) + 0.0, round(radius * math.sin(a), 6) + 0.0) for a in angles]
