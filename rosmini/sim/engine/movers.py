"""Things that move by themselves, and wait for what is in their way."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rosmini.geometry.poses import Pose
from rosmini.sim.motion import Door, Walk
from rosmini.sim.shapes import reach_of
from rosmini.sim.world import Obstacle

from .trails import Leg

if TYPE_CHECKING:
    from .physics import Contacts

DELTA = 1e-4
"""Over so long a time [s] a velocity is measured."""


class Mover:
    """A walker or a door, with a clock of its own that stands while something is in its way."""

    def __init__(self, obstacle: Obstacle, motion: Walk | Door) -> None:
        self.obstacle = obstacle
        self.motion = motion
        self.reach = reach_of(obstacle.shape)
        self.clock = 0.0
        """The time of its own motion [s]."""
        self.pose: Pose = obstacle.at(0.0)
        self.room = 0.0
        """How far any point of it can move [m] before it has to be looked again whether anything is in its way."""
        self.waiting = False

    @property
    def velocity(self) -> tuple[float, float, float]:
        """How fast it moves, in the world's directions [m/s, m/s, rad/s]."""
        if self.waiting:
            return (0.0, 0.0, 0.0)
        before, after = self.obstacle.at(self.clock), self.obstacle.at(self.clock + DELTA)
        vx, vy, w = ((b - a) / DELTA for a, b in zip(before, after, strict=True))
        return (vx, vy, w)

    def way(self, dt: float) -> float:
        """How far any point of it moves at most [m] in `dt` seconds."""
        return (self.motion.max_speed + self.reach * self.motion.max_turn) * dt

    def go(self, dt: float) -> None:
        """Go on; nothing is in its way."""
        self.clock += dt
        self.pose = self.obstacle.at(self.clock)
        self.room -= self.way(dt)
        self.waiting = False

    def later(self, leg: Leg, dt: float) -> Pose:
        """Where it was so long [s] after the begin of a leg of its trail, whose state is its clock, and whose course is whether it waits."""
        _, _, clock, waiting = leg
        return self.obstacle.at(clock if waiting else clock + dt)

    def try_to_go(self, dt: float, contacts: Contacts) -> None:
        """Go on for `dt` seconds if nothing that can give way is in its way there, or where it will be a little later; else wait."""
        name, motion = self.obstacle.name, self.motion
        speed = motion.max_speed + (self.reach * motion.max_turn if isinstance(motion, Door) else 0.0)
        later = self.obstacle.at(self.clock + dt + motion.keep / speed) if motion.keep and speed else None
        pose = self.obstacle.at(self.clock + dt)
        self.waiting = contacts.stuck(name, pose) or (later is not None and contacts.stuck(name, later))
        if not self.waiting:
            self.clock += dt
            self.pose = pose
            contacts.place(name, pose)

    def state(self) -> tuple[float, Pose, float, bool]:
        """Its clock, its place, its room, and whether it waits."""
        return (self.clock, self.pose, self.room, self.waiting)

    def restore(self, state: tuple[float, Pose, float, bool]) -> None:
        """Be as it was then."""
        self.clock, self.pose, self.room, self.waiting = state

    def start(self) -> None:
        """Be where it began."""
        self.clock, self.room, self.waiting = 0.0, 0.0, False
        self.pose = self.obstacle.at(0.0)
