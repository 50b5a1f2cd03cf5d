"""A rotation by 360 degrees in place: the remaining angle, collisions, and the turning speed, without a node."""

from __future__ import annotations

import math
from collections.abc import Callable

from rosmini.core.geometry.angles import shortest_angular_distance


class FullTurn:
    """A full counter-clockwise turn from the heading `start` [rad], which ends within `tolerance` [rad] of it."""

    def __init__(self, start: float, tolerance: float) -> None:
        self.start, self.tolerance = start, tolerance
        self.is_half_done = False
        self._remaining = 2 * math.pi

    def update(self, heading: float) -> float:
        """Update the turn with this heading, and return the remaining angle [rad]."""
        if self.is_half_done:
            self._remaining = abs(shortest_angular_distance(heading, self.start))
        else:
            to_half = abs(shortest_angular_distance(heading, self.start + math.pi))
            self._remaining = math.pi + to_half
            self.is_half_done = to_half < self.tolerance
        return self._remaining

    @property
    def is_done(self) -> bool:
        """True if the latest heading completed the turn."""
        return self.is_half_done and self._remaining <= self.tolerance


def first_collision(
    heading: float, remaining: float, granularity: float, cost: Callable[[float], float]
) -> tuple[float, float] | None:
    """Return the first heading of a turn at which the footprint collides, and its cost there; None if the turn is free.

    `cost(heading)` is negative in a collision; headings are `granularity` [rad] apart.
    """
    for step in range(math.ceil(remaining / granularity)):
        at = heading + step * granularity
        found = cost(at)
        if found < 0:
            return at, found
    return None


def turn_speed(remaining: float, acceleration: float, slowest: float, fastest: float) -> float:
    """Return the speed [rad/s] from which the robot can still stop in time, within limits; `acceleration` in rad/s2."""
    return min(max(math.sqrt(2 * acceleration * remaining), slowest), fastest)
