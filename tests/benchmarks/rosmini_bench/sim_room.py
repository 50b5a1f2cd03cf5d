"""What all simulators simulate: a room, robots in it, and what these are told."""

from __future__ import annotations

import math
from functools import cache

import numpy as np

from rosmini.core.errors import RosminiError
from rosmini.core.geometry.poses import Pose
from rosmini.sim.models import BURGER
from rosmini.sim.world import Box, Cylinder, Obstacle, Polygon, World, edges

SIZE = 10.0
"""The room is a square around the origin; it is so long and so wide [m]."""

UPRIGHT = math.pi / 2
PARTITIONS = [
    (-2.0, 2.8, 0.0), (0.4, 3.2, UPRIGHT), (-3.6, 0.6, 0.0), (3.8, 0.2, UPRIGHT), (3.5, 3.6, 0.0),
    (-1.6, -1.2, UPRIGHT), (1.6, -1.4, 0.0), (0.4, -3.4, UPRIGHT),
]  # fmt: skip
PILLARS = [(x, y) for x in (-3.0, 0.0, 3.0) for y in (-3.0, 0.0, 3.0)]

PARTITION = Box(2.4, 0.1)
PILLAR = Cylinder(0.15)

SPEED = 0.1
"""[m/s]"""
TURN_RATE = 0.4
"""[rad/s]"""
RADIUS = SPEED / TURN_RATE
"""Of the circles in which the robots go, to the left [m]."""

CLEAR = RADIUS + BURGER.reach
"""So far from the middle of its circle a robot may reach [m]."""

START = (2.0 + RADIUS, 1.6, UPRIGHT)


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


@cache
def middles() -> tuple[tuple[float, float], ...]:
    """Where circles can be in the room that no robot leaves: none reaches what stands there, or another one.

    The first is that of `START`.
    """
    world = room()
    lines = np.arange(-SIZE / 2 + CLEAR, SIZE / 2 - CLEAR, 0.05)
    grid = np.stack(np.meshgrid(lines, lines), axis=-1).reshape(-1, 1, 2)
    begin, end = world.segments[:, :2], world.segments[:, 2:]
    along = end - begin
    part = (((grid - begin) * along).sum(axis=-1) / (along * along).sum(axis=-1)).clip(0, 1)
    walls = np.linalg.norm(begin + part[..., None] * along - grid, axis=-1).min(axis=1)
    pillars = (np.linalg.norm(world.discs[:, :2] - grid, axis=-1) - world.discs[:, 2]).min(axis=1)
    found = [(START[0] - RADIUS, START[1])]
    for x, y in grid[np.minimum(walls, pillars) > CLEAR, 0].tolist():
        if all(math.dist((x, y), other) > 2 * CLEAR for other in found):
            found.append((x, y))
    return tuple(found)


def starts(count: int) -> list[Pose]:
    """Where so many robots begin, all over the room, each with a circle of its own.

    Raises `RosminiError` for more than there is room for.
    """
    places = middles()
    if count > len(places):
        msg = f"{count} robots do not fit into the room: {len(places)} do"
        raise RosminiError(msg)
    found = [START]
    for i in range(1, count):
        x, y = places[1 + (i - 1) * (len(places) - 1) // max(count - 1, 1)]
        heading = math.remainder(2.4 * i, 2 * math.pi)
        found.append((x + RADIUS * math.sin(heading), y - RADIUS * math.cos(heading), heading))
    return found
