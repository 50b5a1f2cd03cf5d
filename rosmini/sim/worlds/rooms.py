"""The worlds made in Python: a furnished room, an empty arena, and an empty world."""

from __future__ import annotations

import math

from rosmini.sim.world import Box, Cylinder, Obstacle, Polygon, World

WALL_THICKNESS = 0.08
"""Thickness of walls [m]."""
WALL_HEIGHT = 0.3
"""Height of walls [m]: above the laser of every TurtleBot3, and low enough to look over."""


def walled(left: float, bottom: float, right: float, top: float) -> tuple[Obstacle, ...]:
    """Return four walls around a rectangle, whose inside stays free [m]."""
    t = WALL_THICKNESS
    middle_x, middle_y = (left + right) / 2, (bottom + top) / 2
    lying = Box(right - left + 2 * t, t)
    standing = Box(t, top - bottom)

    def wall(side: str, shape: Box, x: float, y: float) -> Obstacle:
        return Obstacle(f"{side} wall", shape, (x, y, 0.0), WALL_HEIGHT, "wall")

    return (
        wall("south", lying, middle_x, bottom - t / 2),
        wall("east", standing, right + t / 2, middle_y),
        wall("north", lying, middle_x, top + t / 2),
        wall("west", standing, left - t / 2, middle_y),
    )


def empty() -> World:
    """Return an empty, unbounded world."""
    return World("empty", title="Nothing but the ground")


def arena() -> World:
    """Return four walls around an empty square of 4 m by 4 m, with its centre at the origin."""
    return World(
        "arena",
        walled(-2.0, -2.0, 2.0, 2.0),
        wall_height=WALL_HEIGHT,
        starts=((0.0, 0.0, 0.0), (-1.0, -1.0, 0.0), (1.0, 1.0, math.pi), (-1.0, 1.0, -math.pi / 2)),
        title="An empty square of 4 m by 4 m",
    )


def room() -> World:
    """Return a furnished room of 4.0 m by 3.5 m with a corridor along its east side.

    A robot starts at the origin, facing along x. The straight line to the east wall is free for 3 m, and so is the
    square with a corner at the origin and a side of 1 m. The corridor and back is a loop.
    """
    legs = [(0.24, 1.80), (0.74, 1.80), (0.74, 2.16), (0.24, 2.16)]
    hexagon = tuple((0.15 * math.cos(i * math.pi / 3), 0.15 * math.sin(i * math.pi / 3)) for i in range(6))
    sofa = ((0.0, 0.0), (0.38, 0.0), (0.38, 0.85), (1.15, 0.85), (1.15, 1.23), (0.0, 1.23))
    things = (
        Obstacle("partition", Box(WALL_THICKNESS, 1.55), (2.44, 1.325, 0.0), WALL_HEIGHT, "wall"),
        Obstacle("sofa", Polygon(sofa), (-0.7, 1.67, 0.0), 0.22, "blue"),
        *(Obstacle(f"table leg {i}", Cylinder(0.03), (x, y, 0.0), 0.35, "orange") for i, (x, y) in enumerate(legs, 1)),
        Obstacle("south pillar", Cylinder(0.11), (1.70, 0.72, 0.0), 0.45, "green"),
        Obstacle("north pillar", Cylinder(0.11), (1.70, 1.72, 0.0), 0.45, "green"),
        Obstacle("chest", Box(0.48, 0.26), (1.30, 2.52, -0.35), 0.25, "purple"),
        Obstacle("planter", Polygon(hexagon), (1.75, -0.40, 0.0), 0.25, "green"),
        Obstacle("corner shelf", Polygon(((-0.45, 0.0), (0.0, 0.0), (0.0, 0.45))), (3.3, -0.6, 0.0), 0.3, "sky"),
        Obstacle("crate", Box(0.2, 0.2), (1.22, 1.38, 0.3), 0.2, "vermilion", mass=0.3),
    )
    return World(
        "room",
        (*walled(-0.7, -0.6, 3.3, 2.9), *things),
        wall_height=WALL_HEIGHT,
        starts=((0.0, 0.0, 0.0), (2.9, 1.2, math.pi / 2), (2.05, 1.22, math.pi), (1.9, 2.5, 0.0)),
        title="A furnished room of 4 m by 3.5 m",
    )
