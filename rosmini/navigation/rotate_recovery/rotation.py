"""A turn of 360 degrees in place: how far it still goes, whether it is free, and how fast to turn. No node."""

from __future__ import annotations

import math
from collections.abc import Callable

from rosmini.core.geometry.angles import shortest_angular_distance


class FullTurn:
    """A turn once around from the heading `start` [rad], counter-clockwise; done within `tolerance` [rad]."""

    def __init__(self, start: float, tolerance: float) -> None:
        self.start, self.tolerance = start, tolerance
        self.is_half_done = False
        self._left = 2 * math.pi

    def left(self, heading: float) -> float:
        """How far it still goes [rad] from this heading, of which it takes note."""
        if self.is_half_done:
            self._left = abs(shortest_angular_distance(heading, self.start))
        else:
            to_half = abs(shortest_angular_distance(heading, self.start + math.pi))
            self._left = math.pi + to_half
            self.is_half_done = to_half < self.tolerance
        return self._left

    @property
    def is_done(self) -> bool:
        """Whether the last heading was the end of it."""
        return self.is_half_done and self._left <= self.tolerance


def first_collision(
    heading: float, left: float, granularity: float, cost: Callable[[float], float]
) -> tuple[float, float] | None:
    """The first heading of a turn at which the footprint collides, and its cost there; None if the turn is free.

    `cost(heading)` is below 0 in a collision; headings are `granularity` [rad] apart.
    """
    for step in range(math.ceil(left / granularity)):
        at = heading + step * granularity
        found = cost(at)
        if found < 0:
            return at, found
    return None


def turn_speed(left: float, acceleration: float, slowest: float, fastest: float) -> float:
    """The speed [rad/s] from which the robot can still stop in time, within limits; `acceleration` in rad/s2."""
    return min(max(math.sqrt(2 * acceleration * left), slowest), fastest)
