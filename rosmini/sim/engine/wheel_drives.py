"""Drives: from a wheel state and targets to a robot's path in closed form."""

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
"""The quantities that change as its wheels turn."""

Numbers = tuple[float, ...]


class Spot(NamedTuple):
    """A point on a robot's path: its pose, its wheel state, and the rates of its wheel speeds."""

    pose: Pose
    state: WheelState
    rates: Numbers


class Cruise(NamedTuple):
    """The last phase of a path, with constant speeds: its start [s], and the heading and the motion then."""

    begin: float
    theta: float
    motion: Motion


class Way:
    """A robot's path from a pose and a wheel state to its targets and beyond: phases with constant rates."""

    def __init__(
        self, robot: Drive, pose: Pose, state: WheelState, targets: Numbers, rolling: Numbers
    ) -> None:
        self.pose, self.state, self.targets, self.rolling = pose, state, targets, rolling
        self._robot = robot
        (self._end, rates), *self._later = robot.phases(state, targets)
        self._phases = [(0.0, Spot(pose, state, rates))]
        self._last: Cruise | None = None

    def at(self, dt: float) -> Spot:
        """Return the point after `dt` seconds."""
        while dt >= self._end:
            begin, (pose, state, rates) = self._phases[-1]
            pose, state = self._robot.after(pose, state, rates, self._end - begin, self.rolling)
            (length, rates), *self._later = self._later
            state = self._robot.settled(state, self.targets)
            self._phases.append((self._end, Spot(pose, state, rates)))
            self._end += length
        begin, spot = self._phases[-1]
        if dt < begin:
            begin, spot = next(each for each in reversed(self._phases) if dt >= each[0])
        if dt == begin:
            return spot
        pose, state, rates = spot
        pose, state = self._robot.after(pose, state, rates, dt - begin, self.rolling)
        return tuple.__new__(Spot, (pose, state, rates))  # half the time of Spot(...)

    @property
    def cruise(self) -> Cruise | None:
        """Its last phase; None until a point in it has been computed."""
        if self._last is None and self._end == math.inf:
            begin, (pose, state, _) = self._phases[-1]
            v, _, w = self._robot.velocity(state, self.rolling)
            self._last = Cruise(begin, pose[2], Motion(v, w, 0.0, 0.0))
        return self._last

    def plain(self) -> tuple[Pose, WheelState, Numbers, Numbers]:
        """Return all inputs of the path."""
        return (self.pose, self.state, self.targets, self.rolling)


class Drive(ABC):
    """Kinematics of a robot's wheels: pure functions of its model."""

    def __init__(self, model: RobotModel) -> None:
        self.model = model

    still: WheelState
    """State of wheels that have not turned yet."""
    targets: Numbers
    """Initial targets: zero speeds."""

    @abstractmethod
    def phases(self, state: WheelState, targets: Numbers) -> list[tuple[float, Numbers]]:
        """Return how speeds reach their targets: each phase's duration [s], the last one infinite, and its rates."""

    @abstractmethod
    def after(
        self, pose: Pose, state: WheelState, rates: Numbers, dt: float, rolling: Numbers
    ) -> tuple[Pose, WheelState]:
        """Return the pose and state after `dt` seconds with these rates."""

    @abstractmethod
    def settled(self, state: WheelState, targets: Numbers) -> WheelState:
        """Return the state with speeds set to their targets where they differ only by rounding."""

    @abstractmethod
    def told(self, state: WheelState, velocity: Speeds) -> tuple[WheelState, Numbers]:
        """Return the state and targets after a command (ahead, left, turn); speeds without a limit change at once."""

    @abstractmethod
    def launched(self, velocity: Speeds, rolling: Numbers) -> WheelState:
        """Return the state of wheels that roll with a velocity."""

    @abstractmethod
    def rolling(self, wheels: RealWheels) -> Numbers:
        """Return the real wheels' factors for the motion."""

    @abstractmethod
    def velocity(self, state: Numbers, rolling: Numbers) -> Speeds:
        """Return the true velocity (ahead, left, turn) for wheel speeds, or the acceleration for their rates."""

    @abstractmethod
    def haste(self, state: WheelState, targets: Numbers, rolling: Numbers) -> float:
        """Return the maximum speed of any corner between these speeds and their targets [m/s]."""

    def _speed(self, velocity: Speeds) -> float:
        return math.hypot(velocity[0], velocity[1]) + self.model.reach * abs(velocity[2])


class TwoWheels(Drive):
    """Two wheels: nominal speeds of the left and right rim [m/s], and their distances [m]."""

    still = (0.0, 0.0, 0.0, 0.0)
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
        self, pose: Pose, state: WheelState, rates: Numbers, dt: float, rolling: Numbers
    ) -> tuple[Pose, WheelState]:
        """See `Drive.after`."""
        left, right, left_way, right_way = state
        al, ar = rates
        kl, kr, b = rolling
        v, w = (left * kl + right * kr) / 2, (right * kr - left * kl) / b
        if al or ar:
            pose = unicycle(pose, v, w, (al * kl + ar * kr) / 2, (ar * kr - al * kl) / b, dt)
            u_left, u_right = left + al * dt, right + ar * dt
            return pose, (
                u_left,
                u_right,
                left_way + (left + u_left) / 2 * dt,
                right_way + (right + u_right) / 2 * dt,
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
            (left, right, left_way + left * dt, right_way + right * dt),
        )

    def settled(self, state: WheelState, targets: Numbers) -> WheelState:
        """See `Drive.settled`."""
        return (*_settled(state[:2], targets), *state[2:])

    def told(self, state: WheelState, velocity: Speeds) -> tuple[WheelState, Numbers]:
        """See `Drive.told`."""
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

    def launched(self, velocity: Speeds, rolling: Numbers) -> WheelState:
        """See `Drive.launched`; a robot on two wheels ignores a sideways velocity."""
        left, right = rim_speeds(velocity[0], velocity[2], rolling[2])
        return (left / rolling[0], right / rolling[1])

    def rolling(self, wheels: RealWheels) -> Numbers:
        """Return metres on the ground per metre of each rim, and the wheel separation [m]."""
        return (wheels.left, wheels.right, wheels.separation)

    def velocity(self, state: Numbers, rolling: Numbers) -> Speeds:
        """See `Drive.velocity`."""
        left, right = state[0] * rolling[0], state[1] * rolling[1]
        return ((left + right) / 2, 0.0, (right - left) / rolling[2])

    def haste(self, state: WheelState, targets: Numbers, rolling: Numbers) -> float:
        """See `Drive.haste`."""
        if state[:2] == targets:
            return self._speed(self.velocity(targets, rolling))
        lefts, rights = (state[0], targets[0]), (state[1], targets[1])
        return max(self._speed(self.velocity((a, b), rolling)) for a in lefts for b in rights)


class AnySide(Drive):
    """A holonomic drive: nominal speeds ahead, to the left and of the turn, and the pose reckoned from them."""

    still = (0.0,) * 6
    targets = (0.0, 0.0, 0.0)

    def phases(self, state: WheelState, targets: Numbers) -> list[tuple[float, Numbers]]:
        """See `Drive.phases`."""
        speeds = state[:3]
        if speeds == targets:
            return [(math.inf, (0.0, 0.0, 0.0))]
        model = self.model
        limits = (model.linear_acceleration, model.linear_acceleration, model.angular_acceleration)
        return list(ramps(three(speeds), three(targets), limits, math.inf))

    def after(
        self, pose: Pose, state: WheelState, rates: Numbers, dt: float, rolling: Numbers
    ) -> tuple[Pose, WheelState]:
        """See `Drive.after`."""
        speeds = three(state)
        if speeds == rates == (0.0, 0.0, 0.0):
            return pose, state
        changes = three(rates)
        v, vy, w = (speed + rate * dt for speed, rate in zip(speeds, changes, strict=True))
        believed = glide(three(state[3:]), speeds, changes, dt)
        real = glide(pose, self.velocity(speeds, rolling), self.velocity(changes, rolling), dt)
        return real, (v, vy, w, *believed)

    def settled(self, state: WheelState, targets: Numbers) -> WheelState:
        """See `Drive.settled`."""
        return (*_settled(state[:3], targets), *state[3:])

    def told(self, state: WheelState, velocity: Speeds) -> tuple[WheelState, Numbers]:
        """See `Drive.told`."""
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

    def launched(self, velocity: Speeds, rolling: Numbers) -> WheelState:
        """See `Drive.launched`."""
        return tuple(speed / factor for speed, factor in zip(velocity, rolling, strict=True))

    def rolling(self, wheels: RealWheels) -> Numbers:
        """Return the ratios of real to nominal motion ahead, to the side, and in turns."""
        return (wheels.left, wheels.right, self.model.wheel_separation / wheels.separation)

    def velocity(self, state: Numbers, rolling: Numbers) -> Speeds:
        """See `Drive.velocity`."""
        return (state[0] * rolling[0], state[1] * rolling[1], state[2] * rolling[2])

    def haste(self, state: WheelState, targets: Numbers, rolling: Numbers) -> float:
        """See `Drive.haste`."""
        v, vy, w = (max(abs(a), abs(b)) for a, b in zip(state[:3], targets, strict=True))
        return self._speed(self.velocity((v, vy, w), rolling))


def _settled(speeds: Numbers, targets: Numbers) -> Numbers:
    return tuple(
        target if abs(speed - target) < ROUNDING else speed
        for speed, target in zip(speeds, targets, strict=True)
    )


def three(numbers: Numbers) -> tuple[float, float, float]:
    """Return the first three numbers."""
    return (numbers[0], numbers[1], numbers[2])
