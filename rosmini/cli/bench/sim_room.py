"""What both simulators simulate: a room, a robot in it, and what the robot is told."""

from __future__ import annotations

import math

import numpy as np

from rosmini.sim.world import Box, Cylinder, Obstacle, Polygon, World, edges

SIZE = 10.0
"""The room is a square around the origin; it is so long and so wide [m]."""

BOXES = [(x, y) for x in (-3.9, 3.9) for y in (-1.5, 1.5)] + [
    (x, y) for x in (-1.5, 1.5) for y in (-3.9, 3.9)
]
PILLARS = [(x, y) for x in (-3.0, 0.0, 3.0) for y in (-3.0, 0.0, 3.0)]

BOX = Box(0.6, 0.4)
BOX_HEADING = 0.3
PILLAR = Cylinder(0.15)

START = (2.0, 1.6, math.pi / 2)

SPEED = 0.2
"""[m/s]"""
TURN_RATE = 0.4
"""[rad/s]"""


def room() -> World:
    """A room of 10 m by 10 m with 8 boxes, which is 36 wall segments, and 9 pillars."""
    corner = SIZE / 2
    outer = Polygon(((-corner, -corner), (corner, -corner), (corner, corner), (-corner, corner)))
    boxes = [Obstacle(f"box {i}", BOX, (x, y, BOX_HEADING)) for i, (x, y) in enumerate(BOXES, 1)]
    pillars = [Obstacle(f"pillar {i}", PILLAR, (x, y, 0.0)) for i, (x, y) in enumerate(PILLARS, 1)]
    return World("bench", (*boxes, *pillars), walls=edges(outer.outline), starts=(START,))


def crowded_room() -> World:
    """The same with 24 boxes, which is 100 wall segments, and 10 pillars."""
    places = np.random.default_rng(2).uniform(-4.5, 4.5, (200, 2))
    clear = [(float(x), float(y)) for x, y in places if math.hypot(x - START[0], y - START[1]) > 1.2]
    more = [Obstacle(f"box {i}", BOX, (*place, BOX_HEADING)) for i, place in enumerate(clear[:16], 9)]
    return room().with_obstacles([*more, Obstacle("pillar 10", PILLAR, (*clear[16], 0.0))])


def command(seconds: float) -> tuple[float, float]:
    """What the robot is told then, v [m/s] and w [rad/s]: circles to the left and to the right in turn, an eight."""
    left = seconds * TURN_RATE // (2 * math.pi) % 2 == 0
    return SPEED, TURN_RATE if left else -TURN_RATE
