"""The floor of a house, and its map.

The map is what `map_saver` would make: cells of 5 cm, occupied where something stands, free inside, unknown outside.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry import polygons
from rosmini.core.maps import GridMap
from rosmini.sim.world import Box, Cylinder, Obstacle, Polygon, Pose, edges

RESOLUTION = 0.05
"""[m]"""
LENGTH, WIDTH = 12.0, 8.0
"""Of the house, with its outer walls [m]."""
MARGIN = 0.25
"""What the map shows of the world outside [m]."""
CORNER = (-1.0, -4.0)
"""Where the house has its south-west corner. The origin is in its corridor [m]."""

# Rectangles of the walls: west, south, east and north border, from the corner of the house [m]. Doors are 0.9 m wide.
_WALLS = (
    (0.0, 0.0, 12.0, 0.15),
    (0.0, 7.85, 12.0, 8.0),
    (0.0, 0.15, 0.15, 7.85),
    (11.85, 0.15, 12.0, 7.85),
    # the corridor, its doors to the north and to the south
    (0.15, 4.7, 1.6, 4.8),
    (2.5, 4.7, 5.6, 4.8),
    (6.5, 4.7, 9.8, 4.8),
    (10.7, 4.7, 11.85, 4.8),
    (0.15, 3.2, 2.0, 3.3),
    (2.9, 3.2, 6.4, 3.3),
    (8.2, 3.2, 11.85, 3.3),
    # between the rooms, and a door from the workshop into the hall
    (4.0, 4.8, 4.1, 7.85),
    (8.2, 4.8, 8.3, 7.85),
    (5.0, 0.15, 5.1, 1.0),
    (5.0, 1.9, 5.1, 3.2),
)


_BENCH = ((0.0, 0.0), (2.2, 0.0), (2.2, 0.6), (0.6, 0.6), (0.6, 2.0), (0.0, 2.0))


def things() -> tuple[Obstacle, ...]:
    """The walls and all that stands on the floor."""
    walls = [
        Obstacle(f"wall {i}", Box(x1 - x0, y1 - y0), _at((x0 + x1) / 2, (y0 + y1) / 2), colour="wall")
        for i, (x0, y0, x1, y1) in enumerate(_WALLS, 1)
    ]
    furniture = [
        # the three rooms in the north: a bed and a cupboard, a desk, a round table with two stools
        Obstacle("bed", Box(1.0, 2.0), _at(0.65, 6.85)),
        Obstacle("cupboard", Box(0.5, 1.2), _at(3.75, 7.25)),
        Obstacle("desk", Box(1.6, 0.7), _at(5.3, 6.9, 0.5)),
        Obstacle("chair", Cylinder(0.22), _at(5.65, 6.2)),
        Obstacle("bookcase", Box(1.4, 0.3), _at(7.5, 7.7)),
        Obstacle("round table", Cylinder(0.5), _at(9.7, 6.6)),
        Obstacle("stool 1", Cylinder(0.15), _at(10.5, 6.9)),
        Obstacle("stool 2", Cylinder(0.15), _at(9.0, 6.1)),
        Obstacle("stove", Polygon(((-0.9, 0.0), (0.0, -0.9), (0.0, 0.0))), _at(11.85, 7.85)),
        # the workshop in the south-west
        Obstacle("bench", Polygon(_BENCH), _at(0.15, 0.15)),
        Obstacle("machine", Box(0.9, 0.6), _at(4.1, 2.4, -0.3)),
        # the hall: pillars, a slanted counter, a bench in the wall
        *(Obstacle(f"pillar {i}", Cylinder(0.2), _at(x, 2.1)) for i, x in enumerate((6.6, 8.6, 10.6), 1)),
        Obstacle("counter", Box(1.8, 0.4), _at(10.6, 1.0, 2.5)),
        Obstacle("seat", Box(1.5, 0.35), _at(7.4, 0.325)),
        # the corridor is narrow in one place
        Obstacle("chest", Box(0.8, 0.4), _at(8.9, 4.5)),
    ]  # fmt: skip
    return (*walls, *furniture)


def draw() -> GridMap:
    """The map of the floor."""
    columns, rows = (round((size + 2 * MARGIN) / RESOLUTION) for size in (LENGTH, WIDTH))
    left, low = CORNER[0] - MARGIN, CORNER[1] - MARGIN
    x = left + (np.arange(columns) + 0.5) * RESOLUTION
    y = low + (np.arange(rows) + 0.5) * RESOLUTION
    centres = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)
    within = (np.abs(centres - np.add(CORNER, (LENGTH / 2, WIDTH / 2))) < (LENGTH / 2, WIDTH / 2)).all(axis=1)
    cells = np.where(within, 0, -1).astype(np.int8)
    for thing in things():
        cells[_covered(thing, centres)] = 100
    return GridMap(cells.reshape(rows, columns), RESOLUTION, (left, low, 0.0))


def _at(x: float, y: float, theta: float = 0.0) -> Pose:
    """A pose given from the corner of the house."""
    return (round(CORNER[0] + x, 6), round(CORNER[1] + y, 6), theta)


def _covered(thing: Obstacle, centres: NDArray[np.float64]) -> NDArray[np.bool_]:
    if isinstance(thing.shape, Cylinder):
        x, y = thing.pose[:2]
        return np.asarray(np.hypot(centres[:, 0] - x, centres[:, 1] - y) < thing.shape.radius)
    return polygons.inside(centres, edges(thing.outline()))
