"""Straight walls with gaps for doors, used by the worlds that are generated. Lengths in metres."""

from __future__ import annotations

from collections.abc import Sequence

from rosmini.sim.shapes import Box
from rosmini.sim.world import Obstacle

WALL_HEIGHT = 1.2
"""High enough to block the view of a TurtleBot3's sensors, low enough to look into the rooms from above [m]."""


def wall(
    name: str,
    begin: tuple[float, float],
    end: tuple[float, float],
    thickness: float,
    doors: Sequence[tuple[float, float]] = (),
    height: float = WALL_HEIGHT,
) -> list[Obstacle]:
    """Return a wall along x or y between two points on its centre line; each door is a gap (from, to) on that axis."""
    along_x = begin[1] == end[1]
    at = begin[1] if along_x else begin[0]
    low, high = sorted((begin[0], end[0]) if along_x else (begin[1], end[1]))
    cuts = [low, *(edge for door in sorted(doors) for edge in door), high]
    pieces = [(a, b) for a, b in zip(cuts[::2], cuts[1::2], strict=True) if b - a > 1e-9]
    found = []
    for i, (a, b) in enumerate(pieces, 1):
        middle, length = round((a + b) / 2, 6), round(b - a, 6)
        shape = Box(length, thickness) if along_x else Box(thickness, length)
        pose = (middle, at, 0.0) if along_x else (at, middle, 0.0)
        part = f"{name} {i}" if len(pieces) > 1 else name
        found.append(Obstacle(f"walls::{part}", shape, pose, height, "wall"))
    return found
