"""How time goes on in an engine: in one go where nothing is near, in small steps where something may touch.

Each robot, and each thing that moves by itself, has some room: so far it can move, and the others with it, before anything can touch. Between two that move
the gap is shared. Who has no room left is looked at, and whoever may touch something goes on in steps, together with all that is near; the others
go on in closed form meanwhile. So the cost grows with the robots, and with who touches whom, and not with the pairs of them.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from rosmini.geometry.poses import Pose

from .movers import Mover
from .odometry import SLIP_PERIOD
from .robot import Robot, Thing, WheelState

if TYPE_CHECKING:
    from .bodies import Crate
    from .engine import Engine

STEP = 0.005
"""How long one step of the physics is [s]."""

SLICE = 0.05
"""After so long at most [s] it is looked again who is near to what touches."""

SAFE = 1e-4
"""From so near [m] on, a robot is looked at step by step."""

NEAR = 0.02
"""What comes so near [m] to what is gone on with in steps, goes on in steps too."""

FEW = 5
"""From so many robots on that go in steps together, it is asked first who may touch anything at all."""

CLOSE = 0.005
"""So near [m] are circles around robots that may touch in a step."""

AROUND = 0.5
"""So far [m] a robot looks around itself (`rosmini.sim.engine.bodies.VIEW`)."""

EPSILON = 1e-9
"""Times that differ by less [s] are the same."""

Rolled = list[tuple[Robot, WheelState, Pose, float]]
"""Robots, the states of their wheels before, and where that takes them, and how far their corners move at most."""


class Clockwork:
    """The time of one engine."""

    def __init__(self, engine: Engine) -> None:
        self.engine = engine
        self.moving = False
        """True while something that was pushed still moves."""
        self.slips = SLIP_PERIOD
        """When the wheels' slip changes next [s]."""
        self._next_change: float | None = None
        self._drivers: list[Robot] | None = None
        self._places: tuple[tuple[float, int], NDArray[np.float64]] | None = None

    @property
    def drivers(self) -> list[Robot]:
        """The robots that have a drive."""
        if self._drivers is None:
            self._drivers = [each for each in self.engine.robots.values() if not isinstance(each, Thing)]
        return self._drivers

    @property
    def next_change(self) -> float:
        """When somebody's mind changes next [s]: a command gets too old, or the slip of the next second begins."""
        if self._next_change is None:
            self._next_change = min([self.slips, *(robot.expires for robot in self.drivers)])
        return self._next_change

    def plan(self) -> None:
        """Learn that somebody may change his mind at another time than before."""
        self._next_change = None

    def advance(self, until: float) -> None:
        """Let time go on until then."""
        engine = self.engine
        while until - engine.now > EPSILON:
            if until < self.next_change:
                self._go(until)
            else:
                self._go(self.next_change)
                self._changes()

    def _changes(self) -> None:
        """Let happen what is due now."""
        now = self.engine.now
        for robot in self.drivers:
            if robot.expires - now <= EPSILON:
                robot.release()
                robot.expires = math.inf
        if self.slips - now <= EPSILON:
            self.slips += SLIP_PERIOD
            for robot in self.drivers:
                robot.wheels.slip()
        self.plan()

    def _go(self, until: float) -> None:
        """Let time go on while nobody's mind changes."""
        engine = self.engine
        end = engine.now
        while end < until:
            end = until
            rolled, stuck, movers = self._try(end)
            in_steps = bool(stuck or movers or self.moving)
            if in_steps and until - engine.now > SLICE + EPSILON:
                for robot, before, _, _ in rolled:
                    robot.set_wheel_state(before)
                end = engine.now + SLICE
                rolled, stuck, movers = self._try(end)
            names, blocked, crates = self._together(rolled, stuck, movers, end)
            self._commit(rolled, names, blocked, end)
            if names or blocked or self.moving:
                self._slice(end, [r for r, _, _, _ in rolled if r.name in names], blocked, crates)
            else:
                engine.now = end

    def _try(self, end: float) -> tuple[Rolled, set[str], list[Mover]]:
        """Roll all robots until `end`; return that, the names of those that may touch something on the way, and the movers that may."""
        dt = end - self.engine.now
        rolled: Rolled = []
        for robot in self.drivers:
            before = robot.wheel_state()
            pose, moved = robot.roll(dt)
            rolled.append((robot, before, pose, moved))
        self._look_where_short([(robot, moved) for robot, _, _, moved in rolled if moved > 0])
        movers = [mover for mover in self.engine.movers.values() if mover.way(dt) > mover.room]
        movers = [mover for mover in movers if mover.way(dt) > self._look_around(mover)]
        # only now, for whoever looked has told the others how near they are
        return (
            rolled,
            {robot.name for robot, _, _, moved in rolled if moved > robot.room and moved > 0},
            movers,
        )

    def _commit(self, rolled: Rolled, names: set[str], blocked: list[Mover], end: float) -> None:
        """Let those go where they rolled that touch nothing on the way; the others have not moved yet."""
        trails, now = self.engine.trails, self.engine.now
        for robot, before, pose, moved in rolled:
            if robot.name in names:
                robot.set_wheel_state(before)
            else:
                if trails.span:
                    trails.goes(robot.name, now, robot.pose, before, robot.course(before))
                robot.settle()
                robot.pose = pose
                robot.room -= moved
                robot.clear -= moved
                robot.touching = False
        dt = end - self.engine.now
        for mover in self.engine.movers.values():
            if mover not in blocked:
                if trails.span:
                    trails.goes(mover.obstacle.name, now, mover.pose, mover.clock, False)
                mover.go(dt)

    def _together(
        self, rolled: Rolled, stuck: set[str], movers: list[Mover], end: float
    ) -> tuple[set[str], list[Mover], list[Crate]]:
        """Whoever may touch something until `end`, and all that is near to them: robots by name, movers and things."""
        if not (stuck or movers or self.moving):
            return set(), [], []
        engine = self.engine
        crates, every = engine.contacts.crates, list(engine.movers.values())
        if not crates and not every and len(rolled) == 1:
            return stuck, [], []
        dt = end - engine.now
        places = [robot.circle() for robot, _, _, _ in rolled]
        places += [(*mover.pose[:2], mover.reach) for mover in every]
        places += [(*crate.pose[:2], crate.reach) for crate in crates]
        speeds = [math.hypot(*crate.velocity[:2]) + crate.reach * abs(crate.velocity[2]) for crate in crates]
        farthest = max(
            [moved for _, _, _, moved in rolled]
            + [mover.way(dt) for mover in every]
            + [speed * dt for speed in speeds]
        )
        table = np.array(places)
        first, second = len(rolled), len(rolled) + len(every)
        taken = np.zeros(len(table), dtype=bool)
        taken[: len(rolled)] = [robot.name in stuck for robot, _, _, _ in rolled]
        taken[first:second] = [mover in movers for mover in every]
        taken[second:] = [crate in engine.contacts.sliding() for crate in crates] if self.moving else False
        fresh = np.flatnonzero(taken)
        while len(fresh):
            apart = np.hypot(table[:, None, 0] - table[fresh, 0], table[:, None, 1] - table[fresh, 1]) - (
                table[:, None, 2] + table[fresh, 2]
            )
            near = (apart < 2 * farthest + NEAR).any(axis=1) & ~taken
            taken |= near
            fresh = np.flatnonzero(near)
        return (
            {entry[0].name for entry, take in zip(rolled, taken[:first], strict=True) if take},
            [mover for mover, take in zip(every, taken[first:second], strict=True) if take],
            [crate for crate, take in zip(crates, taken[second:], strict=True) if take],
        )

    # -- in steps ------------------------------------------------------------------------------------------------

    def _slice(self, end: float, robots: list[Robot], movers: list[Mover], crates: list[Crate]) -> None:
        """Let those go on in steps that may touch something."""
        engine = self.engine
        engine.contacts.wake(robot.name for robot in robots)
        begin, places = engine.now, [crate.pose for crate in crates]
        for mover in movers:
            engine.contacts.place(mover.obstacle.name, mover.pose)
        while end - engine.now > EPSILON:
            grid = (math.floor(engine.now / engine.step + 1e-6) + 1) * engine.step
            if engine.trails.span:
                for robot in robots:
                    engine.trails.carried(robot.name, engine.now, robot.pose)
            self._step(min(grid, end), robots, movers)
        for crate, before in zip(crates, places, strict=True):
            if crate.pose != before:
                self._crate_moved(crate)
                if engine.trails.span:
                    engine.trails.carried(crate.obstacle.name, begin, before)
                    engine.trails.carried(crate.obstacle.name, engine.now, crate.pose)
            if not crate.shown:
                thing = engine.robots[crate.obstacle.name]
                if isinstance(thing, Thing):
                    thing.follow(crate.pose, crate.velocity, end - begin)
        self._keep_apart(robots)

    def _step(self, until: float, robots: list[Robot], movers: list[Mover]) -> None:
        """Let time go on by a step, with an eye on what touches."""
        engine = self.engine
        contacts = engine.contacts
        dt = until - engine.now
        if movers:
            self._tell(robots)
            for mover in movers:
                pose, clock = mover.pose, mover.clock
                mover.try_to_go(dt, contacts)
                if engine.trails.span:
                    engine.trails.goes(mover.obstacle.name, engine.now, pose, clock, mover.waiting)
        ways, free = {}, not (self.moving or movers)
        for robot in robots:
            if not robot.touching:
                robot.note()
            pose, moved = robot.roll(dt)
            robot.settle()
            ways[robot.name] = (robot.pose, pose)
            robot.room -= moved
            robot.clear -= moved
            free = free and (robot.room > 0 or moved == 0)
        engine.now = until
        if free:
            for robot in robots:
                robot.pose = ways[robot.name][1]
                robot.touching = False
            return
        for robot in robots:
            if not robot.touching:
                contacts.speed(robot.name, robot.world_velocity())
        watched = None
        if not self.moving and len(robots) >= FEW:
            watched = set(ways) if contacts.quick else self._watched(robots, ways)
        for name, (pose, touching) in contacts.step(ways, dt, watched).items():
            robot = engine.robots[name]
            robot.carried(pose, dt, touching=touching)
            if touching:
                robot.clear = 0.0
        self.moving = contacts.moving
        if not self.moving:
            self._look_where_short([(robot, 0.0) for robot in robots if not robot.touching])

    def _watched(self, robots: list[Robot], ways: dict[str, tuple[Pose, Pose]]) -> set[str]:
        """Who of many robots may touch anything at the end of a step: the others need not be asked."""
        poses = np.array([ways[robot.name][1] for robot in robots])
        girths = np.array([robot.model.girth for robot in robots])
        c, s = np.cos(poses[:, 2]), np.sin(poses[:, 2])
        x = poses[:, 0] + c * girths[:, 0] - s * girths[:, 1]
        y = poses[:, 1] + s * girths[:, 0] + c * girths[:, 1]
        apart = np.hypot(x[:, None] - x, y[:, None] - y) - (girths[:, 2:] + girths[:, 2])
        np.fill_diagonal(apart, np.inf)
        near = (apart.min(axis=1) < CLOSE).tolist()
        return {robot.name for robot, close in zip(robots, near, strict=True) if close or robot.clear <= 0}

    def _keep_apart(self, robots: list[Robot]) -> None:
        """Let nobody else come nearer to those that went in steps than they are now, by circles; they themselves look before they move."""
        steppers = set(robots)
        others: list[Robot | Mover] = [each for each in self.drivers if each not in steppers]
        others += self.engine.movers.values()
        for robot in robots:
            robot.room = 0.0
        if others and robots:
            table = np.array([(*each.pose[:2], reach_of(each)) for each in others])
            steps = np.array([(*each.pose[:2], reach_of(each)) for each in robots])
            apart = np.hypot(table[:, :1] - steps[:, 0], table[:, 1:2] - steps[:, 1]) - (
                table[:, 2:] + steps[:, 2]
            )
            for each, gap in zip(others, apart.min(axis=1).tolist(), strict=True):
                each.room = min(each.room, max(gap - SAFE, 0.0))

    def _crate_moved(self, crate: Crate) -> None:
        """Let those look again that a thing came near to."""
        x, y, _ = crate.pose
        for robot in self.drivers:
            if (
                math.hypot(robot.pose[0] - x, robot.pose[1] - y)
                < robot.model.reach + crate.reach + 2 * AROUND
            ):
                robot.room = robot.clear = 0.0
        for mover in self.engine.movers.values():
            mover.room = 0.0

    # -- what is near --------------------------------------------------------------------------------------------

    def look_again(self) -> None:
        """Forget how much room there is, and who there is."""
        self._drivers = None
        for robot in self.engine.robots.values():
            robot.room = robot.clear = 0.0
        for mover in self.engine.movers.values():
            mover.room = 0.0
        self.plan()

    def _look_where_short(self, ways: list[tuple[Robot, float]]) -> None:
        """Let those robots look around that have no more room than they need for such a way [m]."""
        several = len(ways) >= FEW and self.engine.contacts.at_once
        while several:  # again, for whoever looks tells others that they have less room
            short = [robot for robot, moved in ways if robot.room <= moved]
            if len(short) < FEW:
                break
            self.engine.contacts.crowd.look(
                self.engine.contacts, self.engine.robots, [robot.name for robot in short], SAFE
            )
            looked = set(short)
            ways = [(robot, moved) for robot, moved in ways if robot not in looked]
        for robot, moved in ways:
            if robot.room <= moved:
                self.look(robot)

    def look(self, robot: Robot) -> float:
        """Measure, and return, how far a robot can move without touching anything; of a gap to another that moves each has half."""
        engine, contacts = self.engine, self.engine.contacts
        x, y, _ = robot.pose
        reach = robot.model.reach + AROUND
        near: dict[str, Robot | Mover] = {each.name: each for each in self._robots_around(robot, reach)}
        for mover in engine.movers.values():
            if math.hypot(mover.pose[0] - x, mover.pose[1] - y) < reach + mover.reach:
                near[mover.obstacle.name] = mover
                contacts.place(mover.obstacle.name, mover.pose)
        self._tell([each for each in near.values() if isinstance(each, Robot)])
        room = clear = AROUND
        for gap, name, moves in contacts.around(robot.name):
            if not moves:
                clear = min(clear, gap)
            else:
                if name not in near:
                    continue  # it is elsewhere by now
                gap /= 2
                near[name].room = min(near[name].room, gap - SAFE)
            room = min(room, gap)
        robot.clear = clear - SAFE
        robot.room = room - SAFE
        return robot.room

    def _robots_around(self, robot: Robot, reach: float) -> list[Robot]:
        """The robots, itself among them, whose circles come nearer [m] than that."""
        every = list(self.engine.robots.values())
        if len(every) == 1:
            return every
        moment = (self.engine.now, self.engine.changed)
        if self._places is None or self._places[0] != moment:
            table = np.array([(*each.pose[:2], each.model.reach) for each in every])
            self._places = (moment, table)
        x, y, reaches = self._places[1].T
        near = np.hypot(x - robot.pose[0], y - robot.pose[1]) < reach + reaches
        return [every[i] for i in np.flatnonzero(near).tolist()]

    def _look_around(self, mover: Mover) -> float:
        """Measure, and return, how far a thing that moves by itself can move without coming near to anything; by circles around all."""
        x, y, _ = mover.pose
        room = AROUND
        others: list[Robot | Mover] = [*self.drivers, *self.engine.movers.values()]
        for other in others:
            if other is not mover:
                gap = (math.hypot(other.pose[0] - x, other.pose[1] - y) - reach_of(other) - mover.reach) / 2
                room = min(room, gap)
                if 0 < gap < other.room:
                    other.room = gap
        for crate in self.engine.contacts.crates:
            cx, cy, _ = crate.pose
            room = min(room, math.hypot(cx - x, cy - y) - crate.reach - mover.reach)
        mover.room = room - SAFE
        return mover.room

    def tell_places(self) -> None:
        """Tell the bodies where everything is that moved by itself."""
        self._tell(self.drivers)
        for mover in self.engine.movers.values():
            self.engine.contacts.place(mover.obstacle.name, mover.pose)

    def _tell(self, robots: list[Robot]) -> None:
        """Tell the bodies where robots are that have moved by themselves, and how fast these go."""
        contacts = self.engine.contacts
        for robot in robots:
            if not robot.touching and not isinstance(robot, Thing):
                contacts.move(robot.name, robot.pose, robot.world_velocity())

    def peek(self, robot: Robot, when: float) -> Pose:
        """Where a robot will be then, if nothing can be in its way; else where it is."""
        now = self.engine.now
        if when <= now or when > self.next_change or self.moving:
            return robot.pose
        kept = robot.wheel_state()
        pose, moved = robot.roll(when - now)
        robot.set_wheel_state(kept)
        return pose if moved <= robot.room else robot.pose


def reach_of(each: Robot | Mover) -> float:
    """The radius of the circle around what moves [m]."""
    return each.model.reach if isinstance(each, Robot) else each.reach
