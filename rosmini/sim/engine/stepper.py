"""Advances the time of an engine on a fixed grid of steps, which queries do not change.

Time is counted in whole nanoseconds since the engine was created; step k always lasts from k * STEP_NS to
(k + 1) * STEP_NS.

*Free motion* needs no steps. A robot follows a path in closed form from the time of its last change
(`rosmini.sim.engine.robot`), no matter how often its pose is queried. A command, a change of slip or the expiry of a
command changes the path at exactly its time.

*Contacts* are resolved in steps. Each step first moves the objects that slide or are pushed, by impulses computed from
the poses at the beginning of the step. It then finds the robots whose wheels would drive them into an obstacle by the
end of the step, and pushes them out. Such a robot leaves its path for that step and moves straight to the new pose;
after the step it follows a new path. A step is computed once, when time first passes its beginning, and only from the
state at its beginning. Therefore:

- within a step, a body in contact moves straight from its pose at the beginning to its pose at the end; poses in
  between are not stored;
- a command within a step takes effect at the end of the step if a contact keeps the robot from its path;
- an object placed within a step appears at once and moves at constant velocity; contacts and friction act on it from
  the next step on;
- a change of friction or gravity within a step takes effect from the next step on;
- the solver keeps no data between steps, so a state consists of poses and velocities only.

*The selection of bodies to check* affects only the computing time. Each robot and each mover has a `clearance`, the
distance that it can move before a contact is possible; of the gap between two moving bodies, each gets half. At least
every `PLAN` steps while contacts are possible, the bodies that may have contacts are determined, and those near them;
only these bodies are checked. Checking more robots than necessary changes nothing: a robot without a contact stays on
its path.
"""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np

from rosmini.core.geometry.poses import Pose

from .bodies import AT_REST, Body, Crate
from .instant import SECOND, STEP, STEP_NS
from .kernels import CENTRE_X, CENTRE_Y
from .movers import Mover
from .odometry import SLIP_PERIOD
from .population import Population
from .robot import PassiveRobot, Robot
from .scene import Near
from .wheel_drives import TrajectoryPoint

PLAN = 10
"""Number of steps for which the bodies that may have contacts are determined."""

HORIZON = PLAN * STEP
"""Duration of `PLAN` steps [s]."""

VIEW = 0.5
"""Distance to which a robot's surroundings are checked [m]; farther bodies do not matter yet."""

SAFE = 1e-4
"""Gap below which a robot is checked in every step [m]."""

NEAR = 0.02
"""Gap to a checked body below which another one is included [m]."""

SLIP_NS = round(SLIP_PERIOD * SECOND)


class Stepper:
    """Advances the time of one engine."""

    def __init__(self, population: Population) -> None:
        self._population = population
        self._instant = population.instant
        self.slips_ns = SLIP_NS
        """Time of the next change of the wheels' slip [ns]."""
        self._change_ns: float | None = None
        self._drivers: list[Robot] = []
        self._group: Near | None = None
        self._robots: list[tuple[int, Robot]] = []
        self._movers: list[tuple[int, Mover]] = []
        self._crates: list[tuple[int, Crate]] = []
        self._disturbed = False
        self._top_speed = 0.0
        self._remembers = False
        self.invalidate_clearance()

    # -- time ----------------------------------------------------------------------------------------------------

    def advance(self, until_ns: int) -> None:
        """Advance time to `until_ns`; a time in the past has no effect."""
        instant = self._instant
        if not self._remembers and self._population.trails.span:
            self._remembers = True
            for each in self._population.moving:
                self._population.record_leg(each)
        while True:
            tick_ns = self._tick * STEP_NS
            if self._change_ns is None:
                self._change_ns = min([self.slips_ns, *(robot.expires_ns for robot in self._drivers)])
            if self._change_ns <= until_ns and self._change_ns <= tick_ns:
                instant.ns = max(instant.ns, int(self._change_ns))
                self._apply_changes()
            elif tick_ns < until_ns:
                instant.ns = tick_ns
                self._advance_step(self._tick)
            else:
                break
        instant.ns = max(instant.ns, until_ns)

    def _apply_changes(self) -> None:
        """Apply the changes that are due now."""
        now = self._instant.ns
        for robot in self._drivers:
            if robot.expires_ns <= now:
                robot.expires_ns = math.inf
                robot.command(0.0, 0.0, 0.0)
                self.commanded(robot)
        if self.slips_ns <= now:
            self.slips_ns += SLIP_NS
            for robot in self._drivers:
                robot.draw_slip()
                self.commanded(robot)
        self._change_ns = None

    def commanded(self, robot: Robot) -> None:
        """Update the plan after a new command to a robot."""
        self._change_ns = None
        self._population.record_leg(robot)
        left = max(self._planned * STEP_NS - self._instant.ns, 0) / SECOND
        if robot.top_speed > self._top_speed or robot.clearance_at(self._instant.ns) < robot.top_speed * left:
            self._plan_next()

    def invalidate_clearance(self) -> None:
        """Plan again, because a body was added, removed or put elsewhere."""
        self._drivers = self._population.drivers
        self._change_ns = None
        self._plan_next()

    def _plan_next(self) -> None:
        """Determine at the next point of the grid which bodies may have contacts."""
        self._planned = self._tick = -(-self._instant.ns // STEP_NS)

    def discard_clearances(self) -> None:
        """Discard all clearances, because any body may have moved."""
        self._group = None
        for each in self._population.moving:
            each.clearance = 0.0
        self.invalidate_clearance()

    # -- contact prediction --------------------------------------------------------------------------------------

    def _advance_step(self, tick: int) -> None:
        """Advance from a point of the grid."""
        if tick >= self._planned:
            self._plan(tick)
        if self._group is None:
            self._tick = self._planned
        else:
            self._step(self._group)
            self._tick = tick + 1

    def _plan(self, tick: int) -> None:
        """Determine which bodies may have contacts from now on, and until when this holds."""
        now, drivers, movers = self._instant.ns, self._drivers, list(self._population.movers.values())
        self._limit_clearances_outside()
        checked: set[Robot] = set()
        while short := [r for r in drivers if r not in checked and r.clearance_at(now) < r.top_speed * HORIZON]:
            # also measure robots whose clearance will soon be short, so that measurements are rare and batched
            short += [r for r in drivers if r not in checked and r.clearance_at(now) < 3 * r.top_speed * HORIZON]
            checked.update(short)
            self._measure_clearances(list(dict.fromkeys(short)))
        for mover in movers:
            if mover.free_distance_at(now) < mover.top_speed * HORIZON:
                self._measure_mover_clearance(mover)
        bodies = self._population.contacts.bodies
        active = [bodies[r.name] for r in drivers if r.touching or r.clearance_at(now) < r.top_speed * HORIZON]
        active += [
            bodies[m.obstacle.name] for m in movers if m.waiting or m.free_distance_at(now) < m.top_speed * HORIZON
        ]
        active += [bodies[c.obstacle.name] for c in self._population.contacts.crates if c.sliding]
        moving = self._population.moving
        self._top_speed = max((each.top_speed for each in moving), default=0.0)
        self._disturbed = False
        if active:
            self._make_group(active)
            self._planned = tick + PLAN
        else:
            self._group = None
            steps = [each.clearance_at(now) / (each.top_speed * STEP) for each in drivers if each.top_speed > 0]
            steps += [each.free_distance_at(now) / (each.top_speed * STEP) for each in movers if each.top_speed > 0]
            self._planned = tick + max(int(min(steps, default=1e9)), PLAN)

    def _make_group(self, active: list[Body]) -> None:
        """Make tables of the bodies that may have contacts, and of those near them."""
        contacts = self._population.contacts
        speeds = [math.hypot(*c.velocity[:2]) + c.reach * abs(c.velocity[2]) for c in contacts.crates]
        farthest = max([self._top_speed, *speeds]) * HORIZON
        margin = farthest + NEAR / 2
        members = dict.fromkeys(active)
        fresh = active
        while fresh:
            fresh = [body for body in contacts.neighbours(fresh, 2 * margin) if body not in members]
            members.update(dict.fromkeys(fresh))
        group = self._group = contacts.scene(members, margin)
        self._robots, self._movers, self._crates = [], [], []
        for i, body in enumerate(group.bodies):
            if isinstance(body.owner, Robot):
                self._robots.append((i, body.owner))
            elif isinstance(body.owner, Mover):
                self._movers.append((i, body.owner))
            elif isinstance(body.owner, Crate) and body.owner.obstacle.movable:
                self._crates.append((i, body.owner))

    def _limit_clearances_outside(self) -> None:
        """Update the clearances of robots and movers outside the group, using bounding circles around the members."""
        if self._group is None:
            return
        now, members = self._instant.ns, self._group.bodies
        inside = {body.name for body in members}
        outside: list[tuple[Robot | Mover, float]] = [
            (each, each.model.reach) for each in self._drivers if each.name not in inside
        ]
        outside += [(each, each.reach) for name, each in self._population.movers.items() if name not in inside]
        if outside:
            mine = np.array([(*body.owner.pose[:2], body.reach) for body in members])
            table = np.array([(*each.pose[:2], reach) for each, reach in outside])
            apart = np.hypot(table[:, :1] - mine[:, 0], table[:, 1:2] - mine[:, 1]) - (table[:, 2:] + mine[:, 2])
            for (each, _), gap in zip(outside, apart.min(axis=1).tolist(), strict=True):
                if gap - SAFE < each.clearance_at(now):
                    each.clearance, each.clearance_ns = max(gap - SAFE, 0.0), now

    def _measure_clearances(self, robots: list[Robot]) -> None:
        """Measure how far robots can move without a contact; of the gap between two moving bodies, each gets half."""
        now, contacts = self._instant.ns, self._population.contacts
        bodies = [contacts.bodies[robot.name] for robot in robots]
        scene = contacts.scene(dict.fromkeys([*bodies, *contacts.neighbours(bodies, VIEW)]), VIEW)
        index = [scene.index[body.name] for body in bodies]
        clearances = scene.clearances(index, VIEW)
        fresh = set(index)
        for i, body in enumerate(scene.bodies):
            owner, clearance = body.owner, clearances[i] - SAFE
            if isinstance(owner, (Robot, Mover)) and (i in fresh or clearance < owner.clearance_at(now)):
                owner.clearance, owner.clearance_ns = clearance, now

    def _measure_mover_clearance(self, mover: Mover) -> None:
        """Measure how far a mover can move without coming near another body, using bounding circles."""
        now, contacts = self._instant.ns, self._population.contacts
        own = contacts.bodies[mover.obstacle.name]
        x, y, _ = mover.pose
        clearance = VIEW
        for body in contacts.near(x, y, mover.reach + VIEW):
            if body is own:
                continue
            px, py, _ = body.owner.pose
            gap = math.hypot(px - x, py - y) - body.reach - mover.reach
            if isinstance(body.owner, (Robot, Mover)):
                gap /= 2
                if gap < body.owner.clearance_at(now):
                    body.owner.clearance, body.owner.clearance_ns = max(gap, 0.0), now
            clearance = min(clearance, gap)
        mover.clearance, mover.clearance_ns = clearance - SAFE, now

    # -- a step --------------------------------------------------------------------------------------------------

    def _step(self, group: Near) -> None:
        """Advance the members of the group by a step."""
        now = self._instant.ns
        for _, mover in self._movers:
            self._advance_mover(mover)
        sliding = any(crate.sliding for _, crate in self._crates)
        restless = self._disturbed or sliding or bool(self._movers)
        watched = [
            i
            for i, robot in self._robots
            if restless or robot.touching or robot.clearance_at(now) < robot.top_speed * STEP
        ]
        if not watched and not sliding:
            return
        end_ns = now + STEP_NS
        ahead = [robot.at(end_ns) for _, robot in self._robots]
        if self._crates:
            self._slide(group, ahead, end_ns)
        for (i, _), point in zip(self._robots, ahead, strict=True):
            group.poses[i] = point.pose
        for i, mover in self._movers:
            group.poses[i] = mover.predict(STEP)
        moved = set(group.resolve_overlaps(watched))
        self._disturbed = bool(moved)
        for (i, robot), point in zip(self._robots, ahead, strict=True):
            if i in moved:
                x, y, theta = group.poses[i].tolist()
                if self._remembers:
                    self._population.trails.add_pose(robot.name, now / SECOND, robot.pose)
                robot.set_contact_step(now, end_ns, point, (x, y, theta))
            elif robot.touching:
                robot.end_contact()
                self._population.record_leg(robot)

    def _advance_mover(self, mover: Mover) -> None:
        """Let a mover continue unless a body that is not fixed is in its path; then let it turn back if it can."""
        mover.wait(waiting=self._is_stuck(mover, mover.clock, mover.pace))
        if mover.waiting:
            back = mover.return_course
            if back is not None and not self._is_stuck(mover, *back):
                mover.turn_back(*back)
        self._population.record_leg(mover)

    def _is_stuck(self, mover: Mover, clock: float, pace: int) -> bool:
        """Return True if a mover would come too close to a body in a step from its `clock` [s] on: see `is_blocked`."""
        return self._population.contacts.is_blocked(
            mover.obstacle.name, mover.obstacle.at(clock + pace * STEP), mover.keep
        )

    def _slide(self, group: Near, ahead: list[TrajectoryPoint], end_ns: int) -> None:
        """Let obstacles slide, collide and be pushed for a step."""
        contacts = self._population.contacts
        motion = np.zeros((len(group.bodies), 6))
        for i, body in enumerate(group.bodies):
            group.poses[i] = body.owner.pose
        for (i, robot), point in zip(self._robots, ahead, strict=True):
            (x, y, theta), (u, v, turned) = robot.pose, point.pose
            motion[i] = (*robot.world_velocity(), (u - x) / STEP, (v - y) / STEP, (turned - theta) / STEP)
        for i, crate in self._crates:
            if crate.sliding:
                (vx, vy, w), (dx, dy) = crate.velocity, self._lever(group, i)
                motion[i, :3] = (vx - w * dy, vy + w * dx, w)
        contacts.forces = (end_ns, group.slide(STEP, motion))
        for i, crate in self._crates:
            vx, vy, w = motion[i, :3].tolist()
            if crate.sliding or (vx, vy, w) != AT_REST:
                dx, dy = self._lever(group, i)
                x, y, theta = group.poses[i].tolist()
                self._move_crate(crate, end_ns, (x, y, theta), (vx + w * dy, vy - w * dx, w))

    @staticmethod
    def _lever(group: Near, i: int) -> tuple[float, float]:
        """Return the vector from a body's origin to its centre of mass."""
        theta, (x, y) = float(group.poses[i, 2]), group.scene[1][i, [CENTRE_X, CENTRE_Y]].tolist()
        c, s = math.cos(theta), math.sin(theta)
        return c * x - s * y, s * x + c * y

    def _move_crate(self, crate: Crate, end_ns: int, end: Pose, velocity: tuple[float, float, float]) -> None:
        population, now, name = self._population, self._instant.ns, crate.obstacle.name
        if self._remembers:
            population.trails.add_pose(name, now / SECOND, crate.pose)
            population.trails.add_pose(name, end_ns / SECOND, end)
        crate.carry(now, end_ns, end, velocity)
        population.contacts.update_cells(crate)
        thing = population.robots.get(name)
        if isinstance(thing, PassiveRobot):
            thing.follow(end, velocity, end_ns)

    # -- prediction ----------------------------------------------------------------------------------------------

    def predict_pose(self, robot: Robot, when_ns: int) -> Pose:
        """Return a robot's pose at a time if nothing can be in its way by then; otherwise its current pose."""
        now = self._instant.ns
        if when_ns <= now or (self._change_ns is not None and when_ns > self._change_ns):
            return robot.pose
        return robot.at(when_ns).pose if robot.clearance_at(when_ns) >= 0 else robot.pose

    def reset_clearances(self, bodies: Iterable[Body]) -> None:
        """Reset the clearances of these bodies, because a body was added or moved near them."""
        for body in bodies:
            if isinstance(body.owner, (Robot, Mover)):
                body.owner.clearance = 0.0
        self.invalidate_clearance()
