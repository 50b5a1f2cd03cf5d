"""Things that move by themselves, and wait for what is in their way."""

from __future__ import annotations

from rosmini.geometry.poses import Pose
from rosmini.sim.motion import Door, Walk
from rosmini.sim.shapes import reach_of
from rosmini.sim.world import Obstacle

from .instant import SECOND, Instant
from .trails import Leg

DELTA = 1e-4
"""Over so long a time [s] a velocity is measured."""


class Mover:
    """A walker or a door, with a clock of its own that stands while something is in its way."""

    def __init__(self, obstacle: Obstacle, motion: Walk | Door, instant: Instant) -> None:
        self.obstacle = obstacle
        self.reach = reach_of(obstacle.shape)
        self.haste = motion.max_speed + self.reach * motion.max_turn
        """How fast any point of it can move [m/s]."""
        speed = motion.max_speed + (self.reach * motion.max_turn if isinstance(motion, Door) else 0.0)
        self.ahead = motion.keep / speed if speed else 0.0
        """So far ahead of time [s] it looks for what is in its way."""
        self._instant = instant
        self.start()

    def start(self) -> None:
        """Be where it began."""
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
        """Stand from now on, or go on."""
        if waiting != self.waiting:
            self._clock, self._since_ns, self.waiting = self.clock, self._instant.ns, waiting

    def room_left(self, ns: int) -> float:
        """How far any point of it can still move then [m]."""
        return self.room - self.haste * (ns - self.room_ns) / SECOND

    def leg(self) -> tuple[float, Pose, float, bool]:
        """Since when [s] it goes or waits, from where, at which time of its own: a leg of its trail."""
        return (self._since_ns / SECOND, self.obstacle.at(self._clock), self._clock, self.waiting)

    def later(self, leg: Leg, dt: float) -> Pose:
        """Where it was so long [s] after the begin of a leg of its trail."""
        _, _, clock, waiting = leg
        return self.obstacle.at(clock if waiting else clock + dt)

    def state(self) -> tuple[int, float, bool]:
        """Since when it goes or waits, at which time of its own, and which of the two."""
        return (self._since_ns, self._clock, self.waiting)

    def restore(self, state: tuple[int, float, bool]) -> None:
        """Be as it was then."""
        self._since_ns, self._clock, self.waiting = state
        self.room = 0.0
