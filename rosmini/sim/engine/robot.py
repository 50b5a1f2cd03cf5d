"""One robot of the engine: its pose, its wheels, and how they take it along; and what has no wheels of its own.

A robot goes its `Way` from the last time at which anything about it changed (a command, a slip, a push), in
closed form. Where it is now is computed when somebody asks, from there, and not stored: nobody's asking
changes the last bit of it. In a step of the physics that keeps it from its way it goes straight from where it
was to where it gets, and then on a new way.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from rosmini.core.errors import RosminiError
from rosmini.core.geometry.poses import Pose, transform_points
from rosmini.sim.models import RobotModel
from rosmini.sim.sensors.imu import Motion

from .free_motion import Speeds
from .instant import SECOND, STEP, Instant, Placed, between_poses
from .odometry import RealWheels, ticks
from .trails import Leg
from .wheel_drives import AnySide, Drive, Numbers, Spot, TwoWheels, Way, WheelState, three

Floats = NDArray[np.float64]


class Step(NamedTuple):
    """A step of the physics in which a robot was kept from its way."""

    begin_ns: int
    begin: Pose
    end_ns: int
    end: Pose
    following: Way
    """On which it goes on."""


class Robot:
    """A robot with two wheels: where it is, how fast its wheels turn, and what they were told."""

    drive: Drive
    _spot: Spot

    def __init__(
        self, name: str, model: RobotModel, pose: Pose, wheels: RealWheels, instant: Instant
    ) -> None:
        self.name = name
        self.model = model
        self.start = pose
        self.wheels = wheels
        self.drive = AnySide(model) if model.drive == "holonomic" else TwoWheels(model)
        self._instant = instant
        self.stop(pose)
        self._past: tuple[Leg | None, Way] = (None, self._way)
        """The leg of its trail that was asked for last, and the way on it."""

    def stop(self, pose: Pose) -> None:
        """Stand still there, with encoders at zero and no command."""
        self._set_out(self._instant.ns, self._new_way(pose, self.drive.still, self.drive.targets))
        self.expires_ns: float = math.inf
        """When the command is too old."""
        self.touching = False
        """True while something keeps it from where its wheels would take it."""
        self.seen: Speeds = (0.0, 0.0, 0.0)
        """Its velocity (ahead, left [m/s], around [rad/s]) in the last step that kept it from its way."""
        self.slip = (0.0, 0.0)
        """How fast its wheels slid over the ground in that step [m/s], in the world's directions."""
        self._rates = (0.0, 0.0)

    # -- its way -------------------------------------------------------------------------------------------------

    def _set_out(self, ns: int, way: Way) -> None:
        """Go another way from then on."""
        self._since_ns, self._way = ns, way
        self._step: Step | None = None
        self._spot_ns = -1
        self.room = 0.0
        """How far it could move [m] at `room_ns`, before it has to be looked again whether anything is in its way."""
        self.room_ns = ns
        self.haste = self.drive.haste(way.state, way.targets, way.rolling)
        """How fast any of its corners can go [m/s]."""

    def _new_way(self, pose: Pose, state: WheelState, targets: Numbers) -> Way:
        return Way(self.drive, pose, state, targets, self.drive.rolling(self.wheels))

    def _change(self, state: WheelState, targets: Numbers) -> None:
        """Change its way: now, or at the end of the step if something keeps it from its way."""
        ns, pose, room = self._instant.ns, self.pose, self.room_left(self._instant.ns)
        step = self._step
        if step is None:
            self._set_out(ns, self._new_way(pose, state, targets))
            self.room = room
        else:
            self._step = Step(*step[:4], self._new_way(step.end, state, targets))
            self.haste = max(self.haste, self.drive.haste(state, targets, self._step.following.rolling))

    def _here(self) -> Spot:
        ns = self._instant.ns
        if self._spot_ns != ns:
            step = self._step
            if step is not None and ns >= step.end_ns:
                self._set_out(step.end_ns, step.following)
            self._spot, self._spot_ns = self.at(ns), ns
        return self._spot

    def at(self, ns: int) -> Spot:
        """Where it is then, unless anything changes until then."""
        step = self._step
        if step is None:
            return self._way.at((ns - self._since_ns) / SECOND)
        if ns >= step.end_ns:
            return step.following.at((ns - step.end_ns) / SECOND)
        spot = self._way.at((ns - self._since_ns) / SECOND)
        part = (ns - step.begin_ns) / (step.end_ns - step.begin_ns)
        return Spot(between_poses(step.begin, step.end, part), spot.state, spot.rates)

    def room_left(self, ns: int) -> float:
        """How far it can still move then [m]."""
        return self.room - self.haste * (ns - self.room_ns) / SECOND

    def leg(self) -> tuple[float, Pose, WheelState, tuple[Numbers, Numbers]]:
        """The current leg of its trail: start time [s], pose, wheel state, and what the way follows from."""
        if self._step is None:
            since, way = self._since_ns, self._way
        else:
            since, way = self._step.end_ns, self._step.following
        return (since / SECOND, way.pose, way.state, (way.targets, way.rolling))

    def later(self, leg: Leg, dt: float) -> Pose:
        """Where it was so long [s] after the begin of a leg of its trail."""
        if leg is not self._past[0]:
            _, pose, state, (targets, rolling) = leg
            self._past = (leg, Way(self.drive, pose, state, targets, rolling))
        return self._past[1].at(dt).pose

    # -- where it is ---------------------------------------------------------------------------------------------

    @property
    def pose(self) -> Pose:
        """The truth, in the frame map; the heading is not wrapped."""
        return self._spot.pose if self._spot_ns == self._instant.ns else self._here().pose

    @property
    def standing(self) -> bool:
        """True while no wheel turns nor is told to."""
        state = self._here().state
        targets = self._way.targets
        return not any(targets) and state[: len(targets)] == targets

    @property
    def left(self) -> float:
        """How fast the left wheel's rim goes [m/s], if the wheel had the radius on paper."""
        return self._here().state[0]

    @property
    def right(self) -> float:
        """The same of the right wheel."""
        return self._here().state[1]

    @property
    def left_way(self) -> float:
        """How far the left rim has gone [m]."""
        return self._here().state[2]

    @property
    def right_way(self) -> float:
        """How far the right rim has gone [m]."""
        return self._here().state[3]

    @property
    def ticks(self) -> tuple[int, int]:
        """What the encoders of the left and the right wheel show."""
        r, n = self.model.wheel_radius, self.model.ticks_per_turn
        _, _, left, right = self._here().state
        return (ticks(left / r, n), ticks(right / r, n))

    def motion(self) -> Motion:
        """How it really moves at this moment; for its motion to the side see `velocity` and `acceleration_aside`."""
        if self.touching:
            return Motion(self.seen[0], self.seen[2], *self._rates)
        _, state, rates = self._here()
        v, _, w = self.drive.velocity(state, self._way.rolling)
        if not any(rates):
            return tuple.__new__(Motion, (v, w, 0.0, 0.0))  # in half the time of Motion(...)
        dv, _, dw = self.drive.velocity(rates, self._way.rolling)
        return Motion(v, w, dv, dw)

    def turning(self) -> tuple[float, Motion]:
        """Return its heading, not wrapped, and `motion`: all that an IMU needs, without finding its position."""
        cruise, ns = self._way.cruise, self._instant.ns
        if cruise is not None and self._step is None and not self.touching:
            dt = (ns - self._since_ns) / SECOND - cruise.begin
            if dt >= 0:
                return cruise.theta + cruise.motion.w * dt, cruise.motion
        return self.pose[2], self.motion()

    @property
    def velocity(self) -> Speeds:
        """How fast it really goes: ahead and to its left side [m/s], and to the left [rad/s]."""
        return self.seen if self.touching else self.drive.velocity(self._here().state, self._way.rolling)

    @property
    def acceleration_aside(self) -> float:
        """How fast its speed to its left side changes [m/s2], but for its turning."""
        return 0.0 if self.touching else self.drive.velocity(self._here().rates, self._way.rolling)[1]

    def world_velocity(self) -> Speeds:
        """How it moves now: along x and y of the world [m/s], and to the left [rad/s]."""
        v, vy, w = self.velocity
        c, s = math.cos(self.pose[2]), math.sin(self.pose[2])
        return (c * v - s * vy, s * v + c * vy, w)

    def corners(self) -> Floats:
        """The footprint (k, 2) where the robot is now."""
        return transform_points(self.pose, self.model.footprint)

    # -- what it is told -----------------------------------------------------------------------------------------

    def command(self, v: float, vy: float, w: float) -> None:
        """Be told to go ahead and to the left side [m/s], and to turn to the left [rad/s], cut to what it can do.

        Told the same again it goes on as it does. One that is kept from its way takes notice at the end of the step.
        """
        pose_now = self._here()
        way, old = (self._way, pose_now.state) if self._step is None else (self._step.following, None)
        state, targets = self.drive.told(way.state if old is None else old, (v, vy, w))
        if targets != way.targets:
            self._change(state, targets)

    def launch(self, pose: Pose, velocity: Speeds) -> None:
        """Be there at once with this velocity, and be told to stop."""
        spot = self._here()
        rolling = self._way.rolling
        moving = self.drive.launched(velocity, rolling)
        state, targets = self.drive.told((*moving, *spot.state[len(moving) :]), (0.0, 0.0, 0.0))
        self._set_out(self._instant.ns, self._new_way(pose, state, targets))
        self.expires_ns = math.inf
        self.touching = False

    def draw_slip(self) -> None:
        """Begin the next period of slip."""
        self.wheels.slip()
        spot = self._here()
        if self.drive.rolling(self.wheels) != self._way.rolling:
            self._change(spot.state, self._way.targets)

    def carried(self, begin_ns: int, end_ns: int, wheels: Spot, end: Pose) -> None:
        """Learn where a step takes it, whose wheels would take it to `wheels`, and note how fast it goes."""
        begin = self.pose
        dt = (end_ns - begin_ns) / SECOND
        before = self.velocity
        middle = (begin[2] + end[2]) / 2
        c, s = math.cos(middle), math.sin(middle)
        dx, dy = (end[0] - begin[0]) / dt, (end[1] - begin[1]) / dt
        self.seen = (dx * c + dy * s, dy * c - dx * s, (end[2] - begin[2]) / dt)
        self._rates = ((self.seen[0] - before[0]) / dt, (self.seen[2] - before[2]) / dt)
        self.slip = ((wheels.pose[0] - end[0]) / dt, (wheels.pose[1] - end[1]) / dt)
        following = self._new_way(end, wheels.state, self._way.targets)
        self._step = Step(begin_ns, begin, end_ns, end, following)
        self._spot_ns = -1
        self.touching = True
        self.room = 0.0

    def freed(self) -> None:
        """Learn that nothing keeps it from its way in a step."""
        self.touching = False
        self.slip = (0.0, 0.0)

    # -- the same again ------------------------------------------------------------------------------------------

    kept: tuple[str, ...] = ("start", "expires_ns", "touching", "seen", "slip", "_rates", "_since_ns")

    def state(self) -> dict[str, Any]:
        """Everything about it but its name and model, its wheels included."""
        step = self._step
        return {
            **{name: getattr(self, name) for name in self.kept},
            "pose": self.pose,  # for who reads a state
            "way": self._way.plain(),
            "step": None if step is None else (*step[:4], step.following.plain()),
            "wheels": self.wheels.state(),
        }

    def restore(self, state: dict[str, Any]) -> None:
        """Be as it was then."""
        self.wheels.restore(state["wheels"])
        self._set_out(self._instant.ns, Way(self.drive, *state["way"]))
        if state["step"] is not None:
            *step, following = state["step"]
            begin_ns, begin, end_ns, end = step
            self._step = Step(begin_ns, begin, end_ns, end, Way(self.drive, *following))
        for name in self.kept:
            setattr(self, name, state[name])


class HolonomicRobot(Robot):
    """A holonomic robot. Its speeds are nominal; it has no wheel encoders."""

    @property
    def speeds(self) -> Speeds:
        """Ahead and to the left side [m/s], and to the left [rad/s]."""
        return three(self._here().state)

    @property
    def reckoned(self) -> Pose:
        """Where it believes to be: what follows from its wheels, from where it was switched on."""
        return three(self._here().state[3:])

    @property
    def ticks(self) -> tuple[int, int]:
        """Nothing is counted."""
        return (0, 0)


class Thing(Robot):
    """What has no drive: it stands, or is pushed. It is where its body is."""

    body: Placed
    kept = (*Robot.kept, "_followed_ns")

    @property
    def pose(self) -> Pose:
        """The truth, in the frame map; the heading is not wrapped."""
        return self.body.pose

    def motion(self) -> Motion:
        """How it really moves at this moment."""
        rates = self._rates if self._instant.ns <= self._followed_ns else (0.0, 0.0)
        return Motion(self.seen[0], self.seen[2], *rates)

    def turning(self) -> tuple[float, Motion]:
        """Return its heading, not wrapped, and `motion`."""
        return self.pose[2], self.motion()

    @property
    def velocity(self) -> Speeds:
        """How fast it really goes: ahead and to its left side [m/s], and to the left [rad/s]."""
        return self.seen

    def command(self, v: float, vy: float, w: float) -> None:
        """Refuse: it cannot. Raises `RosminiError`."""
        if v or vy or w:
            msg = f"{self.name!r} cannot go {v} m/s, {vy} m/s to its side and {w} rad/s: it has no drive"
            raise RosminiError(msg)

    _followed_ns = -1

    def follow(self, pose: Pose, velocity: Speeds, end_ns: int) -> None:
        """Record where a step takes it, and its velocity then, in world axes [m/s, m/s, rad/s]."""
        (vx, vy, w), c, s = velocity, math.cos(pose[2]), math.sin(pose[2])
        before, self.seen = self.seen, (c * vx + s * vy, c * vy - s * vx, w)
        self._rates = ((self.seen[0] - before[0]) / STEP, (w - before[2]) / STEP)
        self._followed_ns = end_ns

    def launch(self, pose: Pose, velocity: Speeds) -> None:  # noqa: ARG002 - its body is put there
        """Note that it has this velocity."""
        self.seen, self._rates = velocity, (0.0, 0.0)


def make_robot(name: str, model: RobotModel, pose: Pose, wheels: RealWheels, instant: Instant) -> Robot:
    """A robot as its model's drive says."""
    kinds = {"differential": Robot, "holonomic": HolonomicRobot, None: Thing}
    return kinds[model.drive](name, model, pose, wheels, instant)
