"""Obstacles that move by themselves: walkers on a path, and doors.

The functions are pure: they return the pose at a time. The engine moves such an obstacle by a separate
clock. An object in its way (a robot, an obstacle that was pushed there) stops that
clock: the obstacle waits and never pushes through, and later continues from the same pose. A walker that has waited
for long gives way, as people do: it walks its round in reverse, until it has to wait for long again. A door that meets
an object while it closes opens again, as EN 16005 and ANSI/BHMA A156.19 require of powered doors. One that meets an
object while it opens stays ajar for as long as it would have been open, and closes.
"""

from __future__ import annotations

import math
from bisect import bisect_right
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

from rosmini.core.geometry.angles import shortest_angular_distance
from rosmini.core.geometry.poses import Pose, compose

from .shapes import WorldError, is_finite

Leg = tuple[float, Pose, Pose]
"""Its duration [s], and the poses at its beginning and its end; the motion between them is uniform."""


@dataclass(frozen=True)
class Walk:
    """Motion along straight lines between waypoints, at constant speed.

    At each waypoint it waits, turns, and goes on. The waypoints are positions (x, y) [m] in the map frame; the pose of
    the obstacle has no effect. It faces its direction of motion.
    """

    waypoints: tuple[tuple[float, float], ...]
    speed: float = 0.5
    """Speed [m/s]."""
    wait: float = 0.0
    """Waiting time at each waypoint [s], before it turns to the next."""
    loop: bool = True
    """True: from the last waypoint it returns to the first, and continues; False: it stays at the last."""
    keep: float = 0.3
    """Minimum distance to an object in its way, ahead or beside it [m]."""
    turning: float = math.pi
    """Rate of turn at a waypoint [rad/s]."""
    patience: float = 5.0
    """Waiting time [s] after which a walker in a `loop` turns back and goes round in reverse."""

    def __post_init__(self) -> None:
        try:
            points = tuple((float(x), float(y)) for x, y in self.waypoints)
        except (TypeError, ValueError) as error:
            raise WorldError(f"the waypoints of a walk are pairs of x and y, not {self.waypoints!r}") from error
        object.__setattr__(self, "waypoints", points)
        if len(points) < 2 or not all(map(is_finite, sum(points, ()))):
            raise WorldError(f"a walk has two finite waypoints or more, not {points!r}")
        if len(set(points)) < 2:
            raise WorldError(f"the waypoints of a walk are all the same: {points[0]!r}")
        _check_numbers("walk", positive={"speed": self.speed, "turning": self.turning})
        _check_numbers("walk", least={"wait": self.wait, "keep": self.keep, "patience": self.patience})

    @property
    def max_speed(self) -> float:
        """Maximum speed of its origin [m/s]."""
        return self.speed

    @property
    def max_turn(self) -> float:
        """Maximum rate of turn [rad/s]."""
        return self.turning

    @property
    def period(self) -> float:
        """Duration of one round, or of the path to the last waypoint [s]."""
        return self._ends[-1]

    def pose_at(self, t: float, start: Pose | None = None) -> Pose:  # noqa: ARG002 - a door needs it
        """Return the pose at time t of its clock [s]; `start` has no effect.

        Negative times are those of a walker that goes round in reverse.

        >>> Walk(((0, 0), (2, 0)), speed=0.5).pose_at(1.0)
        (0.5, 0.0, 0.0)
        """
        t = t % self.period if self.loop else min(max(0.0, t), self.period)
        index = min(bisect_right(self._ends, t), len(self._ends) - 1)
        length, (x1, y1, a), (x2, y2, b) = self._legs[index]
        part = min(1.0, 1.0 - (self._ends[index] - t) / length)
        return (x1 + part * (x2 - x1), y1 + part * (y2 - y1), a + part * (b - a))

    @cached_property
    def _legs(self) -> tuple[Leg, ...]:
        points = [
            p for i, p in enumerate(self.waypoints) if not i or p != self.waypoints[i - 1]
        ]  # without those that come twice
        if self.loop and points[0] != points[-1]:
            points.append(points[0])
        headings = [math.atan2(q[1] - p[1], q[0] - p[0]) for p, q in pairwise(points)]
        legs: list[Leg] = []
        for i, heading in enumerate(headings):
            begin, end = points[i], points[i + 1]
            legs.append((math.dist(begin, end) / self.speed, (*begin, heading), (*end, heading)))
            last = i + 1 == len(headings)
            if self.wait:
                legs.append((self.wait, (*end, heading), (*end, heading)))
            if last and not self.loop:
                break
            turn = float(shortest_angular_distance(heading, headings[(i + 1) % len(headings)]))
            if turn:
                legs.append((abs(turn) / self.turning, (*end, heading), (*end, heading + turn)))
        return tuple(legs)

    @cached_property
    def _ends(self) -> tuple[float, ...]:
        ends, t = [], 0.0
        for length, _, _ in self._legs:
            t += length
            ends.append(t)
        return tuple(ends)


@dataclass(frozen=True)
class Door:
    """Opens and closes periodically: a leaf that turns about a hinge, or one that slides.

    The pose of the obstacle is that of the closed door. A door follows half a cosine wave, with a smooth start and end.
    """

    opening: float = math.pi / 2
    """Opening: an angle [rad, counter-clockwise], or, if it slides, a distance [m]."""
    hinge: tuple[float, float] = (0.0, 0.0)
    """Position of the hinge in the obstacle's frame [m]."""
    slide: float | None = None
    """Direction of sliding in the obstacle's frame [rad]; None: it turns."""
    moving: float = 2.0
    """Time to open, and to close [s]."""
    open: float = 5.0
    """Time it stays open [s]."""
    closed: float = 5.0
    """Time it stays closed [s]."""
    phase: float = 0.0
    """Initial time within its period [s]; 0: it has just closed."""
    keep: float = 0.1
    """Minimum distance to an object in its way [m], at which it stops, or moves back."""

    def __post_init__(self) -> None:
        _check_numbers("door", positive={"moving": self.moving})
        _check_numbers("door", least={"open": self.open, "closed": self.closed, "keep": self.keep})
        try:
            x, y = self.hinge
        except (TypeError, ValueError) as error:
            raise WorldError(f"the hinge of a door is a pair of x and y, not {self.hinge!r}") from error
        for what, value in (
            ("opening", self.opening),
            ("hinge", x),
            ("hinge", y),
            ("slide", self.slide or 0.0),
            ("phase", self.phase),
        ):
            if not is_finite(value):
                raise WorldError(f"the {what} of a door is {value!r}; it must be a finite number")

    @property
    def period(self) -> float:
        """Time from one closing to the next [s]."""
        return self.closed + self.open + 2 * self.moving

    @property
    def max_speed(self) -> float:
        """Maximum speed of its origin [m/s]."""
        rate = abs(self.opening) * math.pi / 2 / self.moving
        return rate * math.hypot(*self.hinge) if self.slide is None else rate

    @property
    def max_turn(self) -> float:
        """Maximum rate of turn [rad/s]."""
        return abs(self.opening) * math.pi / 2 / self.moving if self.slide is None else 0.0

    def openness(self, t: float) -> float:
        """Return how far it is open at time t of its clock [s]: from 0, closed, to 1."""
        t = math.fmod(max(0.0, t) + self.phase, self.period) - self.closed
        if t <= 0:
            return 0.0
        if t < self.moving:
            return (1 - math.cos(math.pi * t / self.moving)) / 2
        t -= self.moving + self.open
        return 1.0 if t <= 0 else (1 + math.cos(math.pi * t / self.moving)) / 2

    def patience(self, t: float) -> float:
        """Return how long it waits at time t of its clock [s] for an object in its way before it moves back [s]."""
        into = math.fmod(max(0.0, t) + self.phase, self.period)
        return self.open if self.closed < into < self.closed + self.moving else 0.0

    def turned_back(self, t: float) -> float | None:
        """Return the next time [s] with the same pose as at `t` and the reverse motion; None if it is at rest then.

        >>> Door(closed=1.0, moving=2.0, open=3.0).turned_back(1.5)
        7.5
        """
        into = math.fmod(max(0.0, t) + self.phase, self.period)
        opened = self.closed + self.moving
        if not (self.closed < into < opened or opened + self.open < into):
            return None
        return t + math.fmod(2 * (opened + self.open / 2 - into) + self.period, self.period)

    def pose_at(self, t: float, start: Pose = (0.0, 0.0, 0.0)) -> Pose:
        """Return the pose at time t of its clock [s]; `start` is the pose when closed.

        >>> Door(opening=0.9, slide=0.0, closed=1.0, moving=2.0).pose_at(3.0)
        (0.9, 0.0, 0.0)
        """
        part = self.openness(t)
        if self.slide is not None:
            way = part * self.opening
            return compose(start, (way * math.cos(self.slide), way * math.sin(self.slide), 0.0))
        turn = part * self.opening
        x, y = self.hinge
        c, s = math.cos(turn), math.sin(turn)
        return compose(start, (x - c * x + s * y, y - s * x - c * y, turn))


Motion = Walk | Door


def _check_numbers(
    what: str, *, positive: dict[str, float] | None = None, least: dict[str, float] | None = None
) -> None:
    for field, value in (positive or {}).items():
        if not is_finite(value) or value <= 0:
            raise WorldError(f"the {field} of a {what} is {value!r}; it must be a finite number above 0")
    for field, value in (least or {}).items():
        if not is_finite(value) or value < 0:
            raise WorldError(f"the {field} of a {what} is {value!r}; it must be a finite number, 0 or more")
