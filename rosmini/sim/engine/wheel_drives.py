"""Drives: a robot's path in closed form, computed from a wheel state and targets."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from typing import NamedTuple

from rosmini.core.geometry.poses import Pose
from rosmini.sim.models import RobotModel
from rosmini.sim.sensors.imu import Motion

from .free_motion import (
    ROUNDING,
    Speeds,
    body_velocity,
    glide,
    limited,
    limited_phases,
    phases,
    ramps,
    rim_speeds,
    unicycle,
)
from .odometry import RealWheels

WheelState = tuple[float, ...]
"""The quantities that change as a robot's wheels turn."""

Numbers = tuple[float, ...]


class TrajectoryPoint(NamedTuple):
    """A point on a robot's path: its pose, its wheel state, and the rates of its wheel speeds."""

    pose: Pose
    state: WheelState
    rates: Numbers


class Cruise(NamedTuple):
    """The last phase of a path, with constant speeds: its start [s], and the heading and the motion then."""

    begin: float
    theta: float
    motion: Motion


class Trajectory:
    """A robot's path from a pose and a wheel state.

    Phases of constant acceleration until the wheel speeds reach their targets, then one of constant speed.
    """

    def __init__(self, robot: Drive, pose: Pose, state: WheelState, targets: Numbers, wheel_factors: Numbers) -> None:
        self.pose, self.state, self.targets, self.wheel_factors = pose, state, targets, wheel_factors
        self._robot = robot
        (self._end, rates), *self._later = robot.phases(state, targets)
        self._phases = [(0.0, TrajectoryPoint(pose, state, rates))]
        self._last: Cruise | None = None

    def at(self, dt: float) -> TrajectoryPoint:
        """Return the point after `dt` seconds."""
        while dt >= self._end:
            begin, (pose, state, rates) = self._phases[-1]
            pose, state = self._robot.after(pose, state, rates, self._end - begin, self.wheel_factors)
            (length, rates), *self._later = self._later
            state = self._robot.snap_to_targets(state, self.targets)
            self._phases.append((self._end, TrajectoryPoint(pose, state, rates)))
            self._end += length
        begin, point = self._phases[-1]
        if dt < begin:
            begin, point = next(each for each in reversed(self._phases) if dt >= each[0])
        if dt == begin:
            return point
        pose, state, rates = point
        pose, state = self._robot.after(pose, state, rates, dt - begin, self.wheel_factors)
        return tuple.__new__(TrajectoryPoint, (pose, state, rates))  # half the time of TrajectoryPoint(...)

    @property
    def cruise(self) -> Cruise | None:
        """Its last phase; None until a point in it has been computed."""
        if self._last is None and self._end == math.inf:
            begin, (pose, state, _) = self._phases[-1]
            v, _, w = self._robot.velocity(state, self.wheel_factors)
            self._last = Cruise(begin, pose[2], Motion(v, w, 0.0, 0.0))
        return self._last

    def inputs(self) -> tuple[Pose, WheelState, Numbers, Numbers]:
        """Return all inputs of the path."""
        return (self.pose, self.state, self.targets, self.wheel_factors)


class Drive(ABC):
    """Kinematics of a robot's wheels: pure functions of its model."""

    def __init__(self, model: RobotModel) -> None:
        self.model = model

    initial_state: WheelState
    """State of wheels that have not turned yet."""
    targets: Numbers
    """Initial targets: zero speeds."""

    @abstractmethod
    def phases(self, state: WheelState, targets: Numbers) -> list[tuple[float, Numbers]]:
        """Return the phases in which the speeds reach their targets: durations [s], the last one inf, and rates."""

    @abstractmethod
    def after(
        self, pose: Pose, state: WheelState, rates: Numbers, dt: float, wheel_factors: Numbers
    ) -> tuple[Pose, WheelState]:
        """Return the pose and state after `dt` seconds with these rates."""

    @abstractmethod
    def snap_to_targets(self, state: WheelState, targets: Numbers) -> WheelState:
        """Return the state with speeds set to their targets where they differ only by rounding."""

    @abstractmethod
    def apply_command(self, state: WheelState, velocity: Speeds) -> tuple[WheelState, Numbers]:
        """Return the state and targets after a command (ahead, left, turn); speeds without a limit change at once."""

    @abstractmethod
    def state_for_velocity(self, velocity: Speeds, wheel_factors: Numbers) -> WheelState:
        """Return the state of wheels that roll with a velocity."""

    @abstractmethod
    def wheel_factors(self, wheels: RealWheels) -> Numbers:
        """Return the factors that convert nominal motion to that of the real wheels."""

    @abstractmethod
    def velocity(self, state: Numbers, wheel_factors: Numbers) -> Speeds:
        """Return the true velocity (ahead, left, turn) for wheel speeds, or the acceleration for their rates."""

    @abstractmethod
    def top_speed(self, state: WheelState, targets: Numbers, wheel_factors: Numbers) -> float:
        """Return the maximum speed of any corner between these speeds and their targets [m/s]."""

    def _speed(self, velocity: Speeds) -> float:
        return math.hypot(velocity[0], velocity[1]) + self.model.reach * abs(velocity[2])


class DifferentialDrive(Drive):
    """Two driven wheels. Targets: nominal speeds of the left and right rim [m/s].

    State: these speeds, then the distances that the two rims have travelled [m].
    """

    initial_state = (0.0, 0.0, 0.0, 0.0)
    targets = (0.0, 0.0)

    def phases(self, state: WheelState, targets: Numbers) -> list[tuple[float, Numbers]]:
        """See `Drive.phases`."""
        (left, right, _, _), (left_target, right_target), model = state, targets, self.model
        if left == left_target and right == right_target:
            return [(math.inf, (0.0, 0.0))]
        if model.own_limits:
            limits = (model.linear_acceleration, model.angular_acceleration, model.wheel_acceleration)
            b = model.wheel_separation
            found = limited_phases(left, right, left_target, right_target, b, limits, math.inf)
        else:
            found = phases(left, right, left_target, right_target, model.wheel_acceleration, math.inf)
        return [(h, (al, ar)) for h, al, ar in found]

    def after(
        self, pose: Pose, state: WheelState, rates: Numbers, dt: float, wheel_factors: Numbers
    ) -> tuple[Pose, WheelState]:
        """See `Drive.after`."""
        left, right, left_distance, right_distance = state
        al, ar = rates
        kl, kr, b = wheel_factors
        v, w = (left * kl + right * kr) / 2, (right * kr - left * kl) / b
        if al or ar:
            pose = unicycle(pose, v, w, (al * kl + ar * kr) / 2, (ar * kr - al * kl) / b, dt)
            u_left, u_right = left + al * dt, right + ar * dt
            return pose, (
                u_left,
                u_right,
                left_distance + (left + u_left) / 2 * dt,
                right_distance + (right + u_right) / 2 * dt,
            )
        if left == right == 0.0:
            return pose, state
        # the same as `geometry.poses.arc` in as few operations as possible, because this is the usual case
        x, y, theta = pose
        half = w * dt / 2
        chord = v * dt * (math.sin(half) / half if half else 1.0)
        towards = theta + half
        return (
            (x + chord * math.cos(towards), y + chord * math.sin(towards), theta + w * dt),
            (left, right, left_distance + left * dt, right_distance + right * dt),
        )

    def snap_to_targets(self, state: WheelState, targets: Numbers) -> WheelState:
        """See `Drive.snap_to_targets`."""
        return (*_snap_to_targets(state[:2], targets), *state[2:])

    def apply_command(self, state: WheelState, velocity: Speeds) -> tuple[WheelState, Numbers]:
        """See `Drive.apply_command`."""
        model, b = self.model, self.model.wheel_separation
        v, w = limited(velocity[0], velocity[2], model.max_linear, model.max_angular)
        targets = rim_speeds(v, w, b)
        if math.isinf(model.wheel_acceleration):
            free_v, free_w = math.isinf(model.linear_acceleration), math.isinf(model.angular_acceleration)
            if free_v and free_w:
                state = (*targets, *state[2:])
            elif free_v or free_w:
                old_v, old_w = body_velocity(state[0], state[1], b)
                state = (*rim_speeds(v if free_v else old_v, w if free_w else old_w, b), *state[2:])
        return state, targets

    def state_for_velocity(self, velocity: Speeds, wheel_factors: Numbers) -> WheelState:
        """See `Drive.state_for_velocity`; a robot on two wheels ignores a sideways velocity."""
        left, right = rim_speeds(velocity[0], velocity[2], wheel_factors[2])
        return (left / wheel_factors[0], right / wheel_factors[1])

    def wheel_factors(self, wheels: RealWheels) -> Numbers:
        """Return metres on the ground per metre of each rim, and the wheel separation [m]."""
        return (wheels.left, wheels.right, wheels.separation)

    def velocity(self, state: Numbers, wheel_factors: Numbers) -> Speeds:
        """See `Drive.velocity`."""
        left, right = state[0] * wheel_factors[0], state[1] * wheel_factors[1]
        return ((left + right) / 2, 0.0, (right - left) / wheel_factors[2])

    def top_speed(self, state: WheelState, targets: Numbers, wheel_factors: Numbers) -> float:
        """See `Drive.top_speed`."""
        if state[:2] == targets:
            return self._speed(self.velocity(targets, wheel_factors))
        lefts, rights = (state[0], targets[0]), (state[1], targets[1])
        return max(self._speed(self.velocity((a, b), wheel_factors)) for a in lefts for b in rights)


class HolonomicDrive(Drive):
    """A holonomic drive. Targets: nominal speeds ahead and to the left [m/s], and the rate of turn [rad/s].

    State: these speeds, then the pose estimated from them by dead reckoning.
    """

    initial_state = (0.0,) * 6
    targets = (0.0, 0.0, 0.0)

    def phases(self, state: WheelState, targets: Numbers) -> list[tuple[float, Numbers]]:
        """See `Drive.phases`."""
        speeds = state[:3]
        if speeds == targets:
            return [(math.inf, (0.0, 0.0, 0.0))]
        model = self.model
        limits = (model.linear_acceleration, model.linear_acceleration, model.angular_acceleration)
        return list(ramps(first_three(speeds), first_three(targets), limits, math.inf))

    def after(
        self, pose: Pose, state: WheelState, rates: Numbers, dt: float, wheel_factors: Numbers
    ) -> tuple[Pose, WheelState]:
        """See `Drive.after`."""
        speeds = first_three(state)
        if speeds == rates == (0.0, 0.0, 0.0):
            return pose, state
        changes = first_three(rates)
        v, vy, w = (speed + rate * dt for speed, rate in zip(speeds, changes, strict=True))
        believed = glide(first_three(state[3:]), speeds, changes, dt)
        real = glide(pose, self.velocity(speeds, wheel_factors), self.velocity(changes, wheel_factors), dt)
        return real, (v, vy, w, *believed)

    def snap_to_targets(self, state: WheelState, targets: Numbers) -> WheelState:
        """See `Drive.snap_to_targets`."""
        return (*_snap_to_targets(state[:3], targets), *state[3:])

    def apply_command(self, state: WheelState, velocity: Speeds) -> tuple[WheelState, Numbers]:
        """See `Drive.apply_command`."""
        model = self.model
        v, w = limited(velocity[0], velocity[2], model.max_linear, model.max_angular)
        aside = model.max_linear if model.max_lateral is None else model.max_lateral
        targets = (v, max(-aside, min(aside, velocity[1])), w)
        limits = (model.linear_acceleration, model.linear_acceleration, model.angular_acceleration)
        speeds = tuple(
            target if math.isinf(limit) else speed
            for speed, target, limit in zip(state[:3], targets, limits, strict=True)
        )
        return (*speeds, *state[3:]), targets

    def state_for_velocity(self, velocity: Speeds, wheel_factors: Numbers) -> WheelState:
        """See `Drive.state_for_velocity`."""
        return tuple(speed / factor for speed, factor in zip(velocity, wheel_factors, strict=True))

    def wheel_factors(self, wheels: RealWheels) -> Numbers:
        """Return the ratios of real to nominal motion ahead, to the side, and in turns."""
        return (wheels.left, wheels.right, self.model.wheel_separation / wheels.separation)

    def velocity(self, state: Numbers, wheel_factors: Numbers) -> Speeds:
        """See `Drive.velocity`."""
        return (state[0] * wheel_factors[0], state[1] * wheel_factors[1], state[2] * wheel_factors[2])

    def top_speed(self, state: WheelState, targets: Numbers, wheel_factors: Numbers) -> float:
        """See `Drive.top_speed`."""
        v, vy, w = (max(abs(a), abs(b)) for a, b in zip(state[:3], targets, strict=True))
        return self._speed(self.velocity((v, vy, w), wheel_factors))


def _snap_to_targets(speeds: Numbers, targets: Numbers) -> Numbers:
    return tuple(
        target if abs(speed - target) < ROUNDING else speed for speed, target in zip(speeds, targets, strict=True)
    )


def first_three(numbers: Numbers) -> tuple[float, float, float]:
    """Return the first three numbers."""
    return (numbers[0], numbers[1], numbers[2])
