"""Obstacles that move by themselves, and wait or turn back when a body is in their way."""

from __future__ import annotations

from rosmini.core.geometry.poses import Pose
from rosmini.sim.motion import Door, Walk
from rosmini.sim.shapes import reach_of
from rosmini.sim.world import Obstacle

from .instant import SECOND, Instant
from .trails import Leg

DELTA = 1e-4
"""The period [s] over which a velocity is measured."""


class Mover:
    """A walker or a door; its own clock stops while a body is in its way."""

    def __init__(self, obstacle: Obstacle, motion: Walk | Door, instant: Instant) -> None:
        self.obstacle = obstacle
        self.reach = reach_of(obstacle.shape)
        self.top_speed = motion.max_speed + self.reach * motion.max_turn
        """Maximum speed of any of its points [m/s]."""
        self.keep = motion.keep
        self._instant = instant
        self.start()

    def start(self) -> None:
        """Return to the initial pose."""
        self._since_ns, self._clock, self.waiting, self.pace = self._instant.ns, 0.0, False, 1
        self.clearance = 0.0
        """Distance it can move [m], measured at `clearance_ns`, before its clearance must be measured again."""
        self.clearance_ns = self._instant.ns

    @property
    def clock(self) -> float:
        """The time of its own motion [s]."""
        return self._clock + self.rate * (self._instant.ns - self._since_ns) / SECOND

    @property
    def rate(self) -> int:
        """Rate of its own clock: 0 while it waits, else `pace`, which is -1 for a walker going in reverse."""
        return 0 if self.waiting else self.pace

    @property
    def pose(self) -> Pose:
        """Its current pose."""
        return self.obstacle.at(self.clock)

    @property
    def velocity(self) -> tuple[float, float, float]:
        """Its velocity in the map frame [m/s, m/s, rad/s]."""
        if self.waiting:
            return (0.0, 0.0, 0.0)
        before, after = self.pose, self.predict(DELTA)
        vx, vy, w = ((b - a) / DELTA for a, b in zip(before, after, strict=True))
        return (vx, vy, w)

    def wait(self, *, waiting: bool) -> None:
        """Stop or continue."""
        if waiting != self.waiting:
            self._clock, self._since_ns, self.waiting = self.clock, self._instant.ns, waiting

    def predict(self, dt: float) -> Pose:
        """Return its pose `dt` seconds from now if it does not stop."""
        return self.obstacle.at(self.clock + self.rate * dt)

    @property
    def return_course(self) -> tuple[float, int] | None:
        """Its clock [s] and pace if it turned back from here; None if it cannot, or has not waited long enough yet."""
        motion = self.obstacle.motion
        waited = (self._instant.ns - self._since_ns) / SECOND if self.waiting else 0.0
        if isinstance(motion, Door):
            back = motion.turned_back(self.clock) if waited >= motion.patience(self.clock) else None
            return None if back is None else (back, self.pace)
        walks = isinstance(motion, Walk) and motion.loop and waited >= motion.patience
        return (self.clock, -self.pace) if walks else None

    def turn_back(self, clock: float, pace: int) -> None:
        """Continue from `clock` [s] of its own motion, which gives the same pose, at this pace."""
        self._clock, self._since_ns, self.waiting, self.pace = clock, self._instant.ns, False, pace

    def clearance_at(self, ns: int) -> float:
        """Return the distance [m] that any of its points can still move from time `ns` on."""
        return self.clearance - self.top_speed * (ns - self.clearance_ns) / SECOND

    def free_distance_at(self, ns: int) -> float:
        """Return the distance [m] that it can still move from time `ns` on before it may have to stop for a body."""
        return self.clearance_at(ns) - self.keep

    def leg(self) -> tuple[float, Pose, float, tuple[int, int]]:
        """Return the current leg of its trail: start time [s], pose, clock [s], and course.

        The course is its rate and the time [ns] at which the rate last changed.
        """
        course = (self.rate, self._since_ns)
        return (self._since_ns / SECOND, self.obstacle.at(self._clock), self._clock, course)

    def pose_on_leg(self, leg: Leg, dt: float) -> Pose:
        """Return its pose `dt` seconds after the start of a leg of its trail."""
        _, _, clock, (rate, _) = leg
        return self.obstacle.at(clock + rate * dt)

    def state(self) -> tuple[int, float, bool, int]:
        """Return when it last started or stopped [ns], its own clock then [s], whether it waits, and its pace."""
        return (self._since_ns, self._clock, self.waiting, self.pace)

    def restore(self, state: tuple[int, float, bool, int]) -> None:
        """Restore what `state` returned."""
        self._since_ns, self._clock, self.waiting, self.pace = state
        self.clearance = 0.0
