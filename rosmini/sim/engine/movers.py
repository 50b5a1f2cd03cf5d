"""Things that move by themselves, and wait for what is in their way, or go back."""

from __future__ import annotations

from rosmini.geometry.poses import Pose
from rosmini.sim.motion import Door, Walk
from rosmini.sim.shapes import reach_of
from rosmini.sim.world import Obstacle

from .instant import SECOND, Instant
from .trails import Leg

DELTA = 1e-4
"""The period [s] over which a velocity is measured."""


class Mover:
    """A walker or a door, whose own clock stops while something is in its way."""

    def __init__(self, obstacle: Obstacle, motion: Walk | Door, instant: Instant) -> None:
        self.obstacle = obstacle
        self.reach = reach_of(obstacle.shape)
        self.haste = motion.max_speed + self.reach * motion.max_turn
        """How fast any point of it can move [m/s]."""
        speed = motion.max_speed + (self.reach * motion.max_turn if isinstance(motion, Door) else 0.0)
        self.ahead = motion.keep / speed if speed else 0.0
        """How far ahead [s] it checks for obstacles in its path."""
        self._instant = instant
        self.start()

    def start(self) -> None:
        """Return to its initial pose."""
        self._since_ns, self._clock, self.waiting = self._instant.ns, 0.0, False
        self.room = 0.0
        """How far it could move [m] at `room_ns` before its clearance must be measured again."""
        self.room_ns = self._instant.ns

    @property
    def clock(self) -> float:
        """The time of its own motion [s]."""
        return self._clock if self.waiting else self._clock + (self._instant.ns - self._since_ns) / SECOND

    @property
    def pose(self) -> Pose:
        """Where it is now."""
        return self.obstacle.at(self.clock)

    @property
    def velocity(self) -> tuple[float, float, float]:
        """How fast it moves, in the world's directions [m/s, m/s, rad/s]."""
        if self.waiting:
            return (0.0, 0.0, 0.0)
        clock = self.clock
        before, after = self.obstacle.at(clock), self.obstacle.at(clock + DELTA)
        vx, vy, w = ((b - a) / DELTA for a, b in zip(before, after, strict=True))
        return (vx, vy, w)

    def wait(self, *, waiting: bool) -> None:
        """Stop from now on, or continue."""
        if waiting != self.waiting:
            self._clock, self._since_ns, self.waiting = self.clock, self._instant.ns, waiting

    @property
    def clock_back(self) -> float | None:
        """Its clock [s] if it went back from here; None if it has no way back: it stands, or walks."""
        motion = self.obstacle.motion
        return motion.turned_back(self.clock) if isinstance(motion, Door) else None

    def go_back(self, clock: float) -> None:
        """Go on from a clock at which it is where it is now."""
        self._clock, self._since_ns, self.waiting = clock, self._instant.ns, False

    def room_left(self, ns: int) -> float:
        """How far any point of it can still move then [m]."""
        return self.room - self.haste * (ns - self.room_ns) / SECOND

    def leg(self) -> tuple[float, Pose, float, tuple[bool, int]]:
        """Return the current leg of its trail: start time [s], pose, its own clock, whether it waits and since when."""
        course = (self.waiting, self._since_ns)
        return (self._since_ns / SECOND, self.obstacle.at(self._clock), self._clock, course)

    def later(self, leg: Leg, dt: float) -> Pose:
        """Return its pose `dt` seconds after the start of a leg of its trail."""
        _, _, clock, (waiting, _) = leg
        return self.obstacle.at(clock if waiting else clock + dt)

    def state(self) -> tuple[int, float, bool]:
        """Return when it last started or stopped [ns], its own clock then [s], and whether it waits."""
        return (self._since_ns, self._clock, self.waiting)

    def restore(self, state: tuple[int, float, bool]) -> None:
        """Restore what `state` returned."""
        self._since_ns, self._clock, self.waiting = state
        self.room = 0.0
