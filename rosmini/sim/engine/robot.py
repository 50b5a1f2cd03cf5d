"""A robot of the engine: its pose, its wheels and its motion; also models without wheels.

A robot follows its `Trajectory`, a path in closed form, from the last time at which anything about it changed (a
command, a slip, a push). Its current pose is computed from there on request, and not stored, so a query never
changes the last bit of it. In a physics step in which a contact keeps it from its path, it moves straight from its
pose at the beginning to the pose at the end, and then follows a new path.
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
from .wheel_drives import (
    DifferentialDrive,
    Drive,
    HolonomicDrive,
    Numbers,
    Trajectory,
    TrajectoryPoint,
    WheelState,
    first_three,
)

Floats = NDArray[np.float64]


class Step(NamedTuple):
    """A physics step in which a contact kept a robot from its path."""

    begin_ns: int
    begin: Pose
    end_ns: int
    end: Pose
    following: Trajectory
    """The path that it follows afterwards."""


class Robot:
    """A robot's pose, wheel speeds and commands; for a differential drive, and the base class for the other drives."""

    drive: Drive
    _point: TrajectoryPoint

    def __init__(self, name: str, model: RobotModel, pose: Pose, wheels: RealWheels, instant: Instant) -> None:
        self.name = name
        self.model = model
        self.start = pose
        self.wheels = wheels
        self.drive = HolonomicDrive(model) if model.drive == "holonomic" else DifferentialDrive(model)
        self._instant = instant
        self.stop(pose)
        self._past: tuple[Leg | None, Trajectory] = (None, self._trajectory)
        """The leg that was last passed to `pose_on_leg`, and the path on it."""

    def stop(self, pose: Pose) -> None:
        """Reset it to rest at `pose`, with encoders at zero and without a command."""
        self._set_trajectory(self._instant.ns, self._new_trajectory(pose, self.drive.initial_state, self.drive.targets))
        self.expires_ns: float = math.inf
        """Time at which the command expires [ns]."""
        self.touching = False
        """True while a contact keeps it from its path."""
        self.contact_velocity: Speeds = (0.0, 0.0, 0.0)
        """Its velocity (ahead, left [m/s], rate of turn [rad/s]) in the last step with a contact."""
        self.slip = (0.0, 0.0)
        """Slip velocity of its wheels over the ground in that step [m/s], in the map frame."""
        self._rates = (0.0, 0.0)

    # -- trajectory ----------------------------------------------------------------------------------------------

    def _set_trajectory(self, ns: int, trajectory: Trajectory) -> None:
        """Follow another path from time `ns` on."""
        self._since_ns, self._trajectory = ns, trajectory
        self._step: Step | None = None
        self._point_ns = -1
        self.clearance = 0.0
        """Distance it can move [m], measured at `clearance_ns`, before its clearance must be measured again."""
        self.clearance_ns = ns
        self.top_speed = self.drive.top_speed(trajectory.state, trajectory.targets, trajectory.wheel_factors)
        """Maximum speed of any of its corners [m/s]."""

    def _new_trajectory(self, pose: Pose, state: WheelState, targets: Numbers) -> Trajectory:
        return Trajectory(self.drive, pose, state, targets, self.drive.wheel_factors(self.wheels))

    def _change(self, state: WheelState, targets: Numbers) -> None:
        """Change its path: now, or at the end of the step if a contact keeps it from its path."""
        ns, pose, clearance = self._instant.ns, self.pose, self.clearance_at(self._instant.ns)
        step = self._step
        if step is None:
            self._set_trajectory(ns, self._new_trajectory(pose, state, targets))
            self.clearance = clearance
        else:
            self._step = Step(*step[:4], self._new_trajectory(step.end, state, targets))
            self.top_speed = max(
                self.top_speed, self.drive.top_speed(state, targets, self._step.following.wheel_factors)
            )

    def _current(self) -> TrajectoryPoint:
        ns = self._instant.ns
        if self._point_ns != ns:
            step = self._step
            if step is not None and ns >= step.end_ns:
                self._set_trajectory(step.end_ns, step.following)
            self._point, self._point_ns = self.at(ns), ns
        return self._point

    def at(self, ns: int) -> TrajectoryPoint:
        """Return its pose and wheel state at time `ns`, assuming that its path does not change before then."""
        step = self._step
        if step is None:
            return self._trajectory.at((ns - self._since_ns) / SECOND)
        if ns >= step.end_ns:
            return step.following.at((ns - step.end_ns) / SECOND)
        point = self._trajectory.at((ns - self._since_ns) / SECOND)
        part = (ns - step.begin_ns) / (step.end_ns - step.begin_ns)
        return TrajectoryPoint(between_poses(step.begin, step.end, part), point.state, point.rates)

    def clearance_at(self, ns: int) -> float:
        """Return the distance [m] that any of its corners can still move from time `ns` on."""
        return self.clearance - self.top_speed * (ns - self.clearance_ns) / SECOND

    def leg(self) -> tuple[float, Pose, WheelState, tuple[Numbers, Numbers]]:
        """Return the latest leg of its trail: start time [s], pose, wheel state, and (targets, wheel factors).

        During a step with a contact, this is the leg that begins at the end of the step.
        """
        if self._step is None:
            since, trajectory = self._since_ns, self._trajectory
        else:
            since, trajectory = self._step.end_ns, self._step.following
        return (since / SECOND, trajectory.pose, trajectory.state, (trajectory.targets, trajectory.wheel_factors))

    def pose_on_leg(self, leg: Leg, dt: float) -> Pose:
        """Return its pose `dt` seconds after the beginning of a leg of its trail."""
        if leg is not self._past[0]:
            _, pose, state, (targets, wheel_factors) = leg
            self._past = (leg, Trajectory(self.drive, pose, state, targets, wheel_factors))
        return self._past[1].at(dt).pose

    # -- current state -------------------------------------------------------------------------------------------

    @property
    def pose(self) -> Pose:
        """Its true pose in the map frame; the heading is not wrapped."""
        return self._point.pose if self._point_ns == self._instant.ns else self._current().pose

    @property
    def left(self) -> float:
        """Speed of the left wheel's rim [m/s], with the nominal radius."""
        return self._current().state[0]

    @property
    def right(self) -> float:
        """Speed of the right wheel's rim [m/s], with the nominal radius."""
        return self._current().state[1]

    @property
    def left_distance(self) -> float:
        """Distance rolled by the left rim since the last `stop` [m]; negative backwards."""
        return self._current().state[2]

    @property
    def right_distance(self) -> float:
        """Distance rolled by the right rim since the last `stop` [m]; negative backwards."""
        return self._current().state[3]

    @property
    def ticks(self) -> tuple[int, int]:
        """Counts of the left and the right wheel encoder."""
        r, n = self.model.wheel_radius, self.model.ticks_per_turn
        _, _, left, right = self._current().state
        return (ticks(left / r, n), ticks(right / r, n))

    def motion(self) -> Motion:
        """Return its true current motion; for the sideways part see `velocity` and `acceleration_aside`."""
        if self.touching:
            return Motion(self.contact_velocity[0], self.contact_velocity[2], *self._rates)
        _, state, rates = self._current()
        v, _, w = self.drive.velocity(state, self._trajectory.wheel_factors)
        if not any(rates):
            return tuple.__new__(Motion, (v, w, 0.0, 0.0))  # half the time of Motion(...)
        dv, _, dw = self.drive.velocity(rates, self._trajectory.wheel_factors)
        return Motion(v, w, dv, dw)

    def turning(self) -> tuple[float, Motion]:
        """Return its heading, not wrapped, and `motion`: the input of an IMU, without computing its position."""
        cruise, ns = self._trajectory.cruise, self._instant.ns
        if cruise is not None and self._step is None and not self.touching:
            dt = (ns - self._since_ns) / SECOND - cruise.begin
            if dt >= 0:
                return cruise.theta + cruise.motion.w * dt, cruise.motion
        return self.pose[2], self.motion()

    @property
    def velocity(self) -> Speeds:
        """Its true velocity: ahead and to its left side [m/s], and rate of turn to the left [rad/s]."""
        return (
            self.contact_velocity
            if self.touching
            else self.drive.velocity(self._current().state, self._trajectory.wheel_factors)
        )

    @property
    def acceleration_aside(self) -> float:
        """Rate of change of its speed to the left side [m/s2], without the effect of turning."""
        return 0.0 if self.touching else self.drive.velocity(self._current().rates, self._trajectory.wheel_factors)[1]

    def world_velocity(self) -> Speeds:
        """Return its current velocity: along x and y of the map frame [m/s], and rate of turn to the left [rad/s]."""
        v, vy, w = self.velocity
        c, s = math.cos(self.pose[2]), math.sin(self.pose[2])
        return (c * v - s * vy, s * v + c * vy, w)

    def corners(self) -> Floats:
        """Return the footprint (k, 2) at the robot's current pose."""
        return transform_points(self.pose, self.model.footprint)

    # -- commands ------------------------------------------------------------------------------------------------

    def command(self, v: float, vy: float, w: float) -> None:
        """Command speeds ahead and to the left side [m/s] and a rate of turn to the left [rad/s], within its limits.

        An equal command changes nothing. During a contact, the command takes effect at the end of the step.
        """
        pose_now = self._current()
        trajectory, old = (self._trajectory, pose_now.state) if self._step is None else (self._step.following, None)
        state, targets = self.drive.apply_command(trajectory.state if old is None else old, (v, vy, w))
        if targets != trajectory.targets:
            self._change(state, targets)

    def launch(self, pose: Pose, velocity: Speeds) -> None:
        """Move to a pose at once with this velocity, and command a stop."""
        point = self._current()
        wheel_factors = self._trajectory.wheel_factors
        moving = self.drive.state_for_velocity(velocity, wheel_factors)
        state, targets = self.drive.apply_command((*moving, *point.state[len(moving) :]), (0.0, 0.0, 0.0))
        self._set_trajectory(self._instant.ns, self._new_trajectory(pose, state, targets))
        self.expires_ns = math.inf
        self.touching = False

    def draw_slip(self) -> None:
        """Draw the wheel slip of the next period."""
        self.wheels.slip()
        point = self._current()
        if self.drive.wheel_factors(self.wheels) != self._trajectory.wheel_factors:
            self._change(point.state, self._trajectory.targets)

    def set_contact_step(self, begin_ns: int, end_ns: int, wheels: TrajectoryPoint, end: Pose) -> None:
        """Record a step in which a contact keeps the robot from its path.

        The step ends at `end` instead of `wheels`, the point that the wheels alone would reach. Also updates the
        velocity and the slip of the wheels.
        """
        begin = self.pose
        dt = (end_ns - begin_ns) / SECOND
        before = self.velocity
        middle = (begin[2] + end[2]) / 2
        c, s = math.cos(middle), math.sin(middle)
        dx, dy = (end[0] - begin[0]) / dt, (end[1] - begin[1]) / dt
        self.contact_velocity = (dx * c + dy * s, dy * c - dx * s, (end[2] - begin[2]) / dt)
        self._rates = ((self.contact_velocity[0] - before[0]) / dt, (self.contact_velocity[2] - before[2]) / dt)
        self.slip = ((wheels.pose[0] - end[0]) / dt, (wheels.pose[1] - end[1]) / dt)
        following = self._new_trajectory(end, wheels.state, self._trajectory.targets)
        self._step = Step(begin_ns, begin, end_ns, end, following)
        self._point_ns = -1
        self.touching = True
        self.clearance = 0.0

    def end_contact(self) -> None:
        """Record that the contact has ended."""
        self.touching = False
        self.slip = (0.0, 0.0)

    # -- saving and restoring -------------------------------------------------------------------------------------

    saved: tuple[str, ...] = ("start", "expires_ns", "touching", "contact_velocity", "slip", "_rates", "_since_ns")

    def state(self) -> dict[str, Any]:
        """Return its complete state, including its wheels, except its name and model."""
        step = self._step
        return {
            **{name: getattr(self, name) for name in self.saved},
            "pose": self.pose,  # not used by `restore`; for code that inspects a saved state
            "trajectory": self._trajectory.inputs(),
            "step": None if step is None else (*step[:4], step.following.inputs()),
            "wheels": self.wheels.state(),
        }

    def restore(self, state: dict[str, Any]) -> None:
        """Restore what `state` returned."""
        self.wheels.restore(state["wheels"])
        self._set_trajectory(self._instant.ns, Trajectory(self.drive, *state["trajectory"]))
        if state["step"] is not None:
            *step, following = state["step"]
            begin_ns, begin, end_ns, end = step
            self._step = Step(begin_ns, begin, end_ns, end, Trajectory(self.drive, *following))
        for name in self.saved:
            setattr(self, name, state[name])


class HolonomicRobot(Robot):
    """A holonomic robot. Its speeds are nominal; it has no wheel encoders."""

    @property
    def speeds(self) -> Speeds:
        """Speeds ahead and to the left side [m/s], and rate of turn to the left [rad/s]."""
        return first_three(self._current().state)

    @property
    def reckoned(self) -> Pose:
        """Its estimated pose by dead reckoning from its wheels, relative to the pose at power-on."""
        return first_three(self._current().state[3:])

    @property
    def ticks(self) -> tuple[int, int]:
        """Always zero: it has no encoders."""
        return (0, 0)


class PassiveRobot(Robot):
    """A model without a drive: it rests or is pushed. Its pose is that of its body."""

    body: Placed
    saved = (*Robot.saved, "_followed_ns")

    @property
    def pose(self) -> Pose:
        """Its true pose in the map frame; the heading is not wrapped."""
        return self.body.pose

    def motion(self) -> Motion:
        """Return its true current motion."""
        rates = self._rates if self._instant.ns <= self._followed_ns else (0.0, 0.0)
        return Motion(self.contact_velocity[0], self.contact_velocity[2], *rates)

    def turning(self) -> tuple[float, Motion]:
        """Return its heading, not wrapped, and `motion`."""
        return self.pose[2], self.motion()

    @property
    def velocity(self) -> Speeds:
        """Its true velocity: ahead and to its left side [m/s], and rate of turn to the left [rad/s]."""
        return self.contact_velocity

    def command(self, v: float, vy: float, w: float) -> None:
        """Ignore a zero command; raise `RosminiError` for any other, because it has no drive."""
        if v or vy or w:
            msg = f"{self.name!r} cannot go {v} m/s, {vy} m/s to its side and {w} rad/s: it has no drive"
            raise RosminiError(msg)

    _followed_ns = -1

    def follow(self, pose: Pose, velocity: Speeds, end_ns: int) -> None:
        """Record the pose and velocity at the end of a step, in the map frame [m/s, m/s, rad/s]."""
        (vx, vy, w), c, s = velocity, math.cos(pose[2]), math.sin(pose[2])
        before, self.contact_velocity = self.contact_velocity, (c * vx + s * vy, c * vy - s * vx, w)
        self._rates = ((self.contact_velocity[0] - before[0]) / STEP, (w - before[2]) / STEP)
        self._followed_ns = end_ns

    def launch(self, pose: Pose, velocity: Speeds) -> None:  # noqa: ARG002 - its body is put there
        """Record its velocity."""
        self.contact_velocity, self._rates = velocity, (0.0, 0.0)


def make_robot(name: str, model: RobotModel, pose: Pose, wheels: RealWheels, instant: Instant) -> Robot:
    """Return a robot of the class for its model's drive."""
    kinds = {"differential": Robot, "holonomic": HolonomicRobot, None: PassiveRobot}
    return kinds[model.drive](name, model, pose, wheels, instant)
