"""What both simulators simulate: a room, a robot in it, and what the robot is told."""

from __future__ import annotations

import math

import numpy as np

from rosmini.sim.world import Box, Cylinder, Obstacle, Polygon, World, edges

SIZE = 10.0
"""The room is a square around the origin; it is so long and so wide [m]."""

UPRIGHT = math.pi / 2
PARTITIONS = [
    (-2.0, 2.8, 0.0),
    (0.4, 3.2, UPRIGHT),
    (-3.6, 0.6, 0.0),
    (3.8, 0.2, UPRIGHT),
    (3.5, 3.6, 0.0),
    (-1.6, -1.2, UPRIGHT),
    (1.6, -1.4, 0.0),
    (0.4, -3.4, UPRIGHT),
]
PILLARS = [(x, y) for x in (-3.0, 0.0, 3.0) for y in (-3.0, 0.0, 3.0)]

PARTITION = Box(2.4, 0.1)
PILLAR = Cylinder(0.15)

START = (2.0, 1.6, math.pi / 2)

SPEED = 0.2
"""[m/s]"""
TURN_RATE = 0.4
"""[rad/s]"""


def room() -> World:
    """A room of 10 m by 10 m with 8 partitions, which makes 36 wall segments, and 9 pillars."""
    corner = SIZE / 2
    outer = Polygon(((-corner, -corner), (corner, -corner), (corner, corner), (-corner, corner)))
    partitions = [Obstacle(f"partition {i}", PARTITION, pose) for i, pose in enumerate(PARTITIONS, 1)]
    pillars = [Obstacle(f"pillar {i}", PILLAR, (x, y, 0.0)) for i, (x, y) in enumerate(PILLARS, 1)]
    return World("bench", (*partitions, *pillars), walls=edges(outer.outline), starts=(START,))


def crowded_room() -> World:
    """The same with 16 boxes and a pillar more, which makes 100 wall segments and 10 pillars."""
    rng = np.random.default_rng(2)
    poses = [(float(x), float(y), float(heading)) for x, y, heading in rng.uniform(-4.5, 4.5, (200, 3))]
    clear = [pose for pose in poses if math.dist(pose[:2], START[:2]) > 1.2]
    boxes = [Obstacle(f"box {i}", Box(0.6, 0.4), pose) for i, pose in enumerate(clear[:16], 1)]
    return room().with_obstacles([*boxes, Obstacle("pillar 10", PILLAR, clear[16])])


def command(seconds: float) -> tuple[float, float]:
    """What the robot is told then, v [m/s] and w [rad/s]: circles to the left and to the right in turn, an eight."""
    left = seconds * TURN_RATE // (2 * math.pi) % 2 == 0
    return SPEED, TURN_RATE if left else -TURN_RATE
