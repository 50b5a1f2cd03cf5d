"""One robot of the engine: its pose, its wheels, and how they take it along; and what has no wheels of its own."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.errors import RosminiError
from rosmini.geometry.poses import Pose, transform_points
from rosmini.sim.models import RobotModel
from rosmini.sim.sensors.imu import Motion

from .drive import (
    ROUNDING,
    Phase,
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
from .odometry import RealWheels, ticks
from .trails import Leg

Floats = NDArray[np.float64]

WheelState = tuple[float, ...]


class Robot:
    """A robot with two wheels: where it is, how fast its wheels turn, and what they were told."""

    def __init__(self, name: str, model: RobotModel, pose: Pose, wheels: RealWheels) -> None:
        self.name = name
        self.model = model
        self.pose = pose
        """The truth, in the frame map; the heading is not wrapped."""
        self.start = pose
        self.wheels = wheels
        self.stop()

    def stop(self) -> None:
        """Stand still, with encoders at zero and no command."""
        self.left = self.right = 0.0
        """How fast the wheels' rims go [m/s], if the wheels had the radius on paper."""
        self.left_target = self.right_target = 0.0
        """How fast they were told to go [m/s]."""
        self.left_way = self.right_way = 0.0
        """How far they have gone [m]."""
        self.expires = math.inf
        """When the command is too old [s]."""
        self.room = 0.0
        """How far it can move [m] before it has to be looked again whether anything is in its way."""
        self.clear = 0.0
        """How far it can move [m] before it may touch what does not move by itself."""
        self.touching = False
        """True while something keeps it from where its wheels would take it."""
        self.seen = (0.0, 0.0)
        """How fast it went, ahead [m/s] and to the left [rad/s], when that was last looked at."""
        self.seen_aside = 0.0
        """How fast it went to its left side then [m/s]: a robot on wheels does so only if it is pushed."""
        self._rates = (0.0, 0.0)

    @property
    def standing(self) -> bool:
        """True while neither wheel turns nor is told to."""
        return self.left == self.right == self.left_target == self.right_target == 0.0

    @property
    def ticks(self) -> tuple[int, int]:
        """What the encoders of the left and the right wheel show."""
        r, n = self.model.wheel_radius, self.model.ticks_per_turn
        return (ticks(self.left_way / r, n), ticks(self.right_way / r, n))

    def motion(self) -> Motion:
        """How it really moves at this moment."""
        if self.touching:
            return Motion(*self.seen, *self._rates)
        wheels = self.wheels
        left, right = self.left * wheels.left, self.right * wheels.right
        v, w = (left + right) / 2, (right - left) / wheels.separation
        if self.left == self.left_target and self.right == self.right_target:
            return tuple.__new__(Motion, (v, w, 0.0, 0.0))  # in half the time of Motion(...)
        if self.model.own_limits:
            _, dl, dr = self._phases(1.0)[0]
        else:
            a = self.model.wheel_acceleration
            dl = math.copysign(a, self.left_target - self.left) if self.left_target != self.left else 0.0
            dr = math.copysign(a, self.right_target - self.right) if self.right_target != self.right else 0.0
        return Motion(v, w, *body_velocity(dl * wheels.left, dr * wheels.right, wheels.separation))

    @property
    def velocity(self) -> Speeds:
        """How fast it really goes: ahead and to its left side [m/s], and to the left [rad/s]."""
        motion = self.motion()
        return (motion.v, self.seen_aside if self.touching else 0.0, motion.w)

    @property
    def acceleration_aside(self) -> float:
        """How fast its speed to its left side changes [m/s2], but for its turning."""
        return 0.0

    def circle(self) -> tuple[float, float, float]:
        """A small circle around its footprint where it is now: x, y and radius [m]."""
        (x, y, theta), (px, py, radius) = self.pose, self.model.girth
        c, s = math.cos(theta), math.sin(theta)
        return (x + c * px - s * py, y + s * px + c * py, radius)

    def corners(self) -> Floats:
        """The footprint (k, 2) where the robot is now."""
        return transform_points(self.pose, self.model.footprint)

    def wheel_state(self) -> WheelState:
        """What changes as its wheels turn: speeds and ways of the left and right rim [m/s, m], to come back to."""
        return (self.left, self.right, self.left_way, self.right_way)

    def set_wheel_state(self, state: WheelState) -> None:
        """Come back to a state of the wheels."""
        self.left, self.right, self.left_way, self.right_way = state

    def course(self, state: WheelState) -> tuple[Any, ...]:
        """What says how it goes on from a state of its wheels: what it was told, and how its wheels roll; and whether they turn as they were told."""
        left, right = self.left_target, self.right_target
        return (left, right, self.wheels.left, self.wheels.right, state[:2] == (left, right))

    def set_course(self, course: tuple[Any, ...]) -> None:
        """Come back to a course."""
        self.left_target, self.right_target, self.wheels.left, self.wheels.right, _ = course

    def later(self, leg: Leg, dt: float) -> Pose:
        """Where it was so long [s] after the begin of a leg of its trail."""
        pose, state = self.pose, self.wheel_state()
        course = self.course(state)
        self.pose = leg[1]
        self.set_wheel_state(leg[2])
        self.set_course(leg[3])
        found, _ = self.roll(dt)
        self.pose = pose
        self.set_wheel_state(state)
        self.set_course(course)
        return found

    # -- what it is told -----------------------------------------------------------------------------------------

    def drive(self, v: float, vy: float, w: float) -> None:  # noqa: ARG002 - nothing goes aside on two wheels
        """Be told to go ahead and to the left side [m/s], and to turn to the left [rad/s], cut to what it can do."""
        model = self.model
        v, w = limited(v, w, model.max_linear, model.max_angular)
        self.left_target, self.right_target = rim_speeds(v, w, model.wheel_separation)
        if math.isinf(model.wheel_acceleration):
            self._jump()

    def _jump(self) -> None:
        """Reach at once what has no limit."""
        model, b = self.model, self.model.wheel_separation
        v, w = body_velocity(self.left, self.right, b)
        goal_v, goal_w = body_velocity(self.left_target, self.right_target, b)
        free_v, free_w = math.isinf(model.linear_acceleration), math.isinf(model.angular_acceleration)
        if free_v and free_w:
            self.left, self.right = self.left_target, self.right_target
        elif free_v or free_w:
            self.left, self.right = rim_speeds(goal_v if free_v else v, goal_w if free_w else w, b)

    def release(self) -> None:
        """Be told to stop."""
        self.drive(0.0, 0.0, 0.0)

    def launch(self, velocity: Speeds) -> None:
        """Have this velocity at once, and be told to stop; of that to the side a robot on two wheels takes none."""
        v, _, w = velocity
        wheels = self.wheels
        left, right = rim_speeds(v, w, wheels.separation)
        self.left, self.right = left / wheels.left, right / wheels.right
        self.drive(0.0, 0.0, 0.0)
        self.expires = math.inf
        self.touching = False

    def state(self) -> dict[str, Any]:
        """Everything about it but its name and model, its wheels included."""
        kept = {key: value for key, value in vars(self).items() if key not in ("name", "model", "wheels")}
        return {**kept, "wheels": self.wheels.state()}

    def restore(self, state: dict[str, Any]) -> None:
        """Be as it was then."""
        for key, value in state.items():
            if key != "wheels":
                setattr(self, key, value)
        self.wheels.restore(state["wheels"])

    # -- for the engine ------------------------------------------------------------------------------------------

    def roll(self, dt: float) -> tuple[Pose, float]:
        """Turn the wheels for `dt` seconds; return where that takes the robot, and how far its farthest corner moves at most."""
        if self.left == self.left_target and self.right == self.right_target:
            return self._roll_on(dt)
        pose, moved = self.pose, 0.0
        wheels, reach = self.wheels, self.model.reach
        b, kl, kr = wheels.separation, wheels.left, wheels.right
        for h, al, ar in self._phases(dt):
            left, right = self.left, self.right
            v, w = (left * kl + right * kr) / 2, (right * kr - left * kl) / b
            if al or ar:
                dv, dw = (al * kl + ar * kr) / 2, (ar * kr - al * kl) / b
                self.left, self.right = left + al * h, right + ar * h
            else:
                dv = dw = 0.0
            pose = unicycle(pose, v, w, dv, dw, h)
            self.left_way += (left + self.left) / 2 * h
            self.right_way += (right + self.right) / 2 * h
            moved += max(abs(v), abs(v + dv * h)) * h + reach * max(abs(w), abs(w + dw * h)) * h
        return pose, moved

    def _roll_on(self, dt: float) -> tuple[Pose, float]:
        """Do so with speeds that stay what they are: most of the time, so in as few steps as can be. The way is that of `geometry.poses.arc`."""
        left, right = self.left, self.right
        if left == right == 0.0:
            return self.pose, 0.0
        wheels = self.wheels
        left_rim, right_rim = left * wheels.left, right * wheels.right
        v, w = (left_rim + right_rim) / 2, (right_rim - left_rim) / wheels.separation
        self.left_way += left * dt
        self.right_way += right * dt
        x, y, theta = self.pose
        half = w * dt / 2
        chord = v * dt * (math.sin(half) / half if half else 1.0)
        towards = theta + half
        pose = (x + chord * math.cos(towards), y + chord * math.sin(towards), theta + w * dt)
        return pose, abs(v) * dt + self.model.reach * abs(w) * dt

    def _phases(self, dt: float) -> list[Phase]:
        if self.left == self.left_target and self.right == self.right_target:
            return [(dt, 0.0, 0.0)]
        model = self.model
        if model.own_limits:
            return limited_phases(
                self.left,
                self.right,
                self.left_target,
                self.right_target,
                model.wheel_separation,
                (model.linear_acceleration, model.angular_acceleration, model.wheel_acceleration),
                dt,
            )
        return phases(
            self.left, self.right, self.left_target, self.right_target, model.wheel_acceleration, dt
        )

    def settle(self) -> None:
        """Make a speed that has reached its target, but for the last digits, equal to it."""
        if abs(self.left - self.left_target) < ROUNDING:
            self.left = self.left_target
        if abs(self.right - self.right_target) < ROUNDING:
            self.right = self.right_target

    def note(self) -> None:
        """Remember how it moves now, to know later how that has changed."""
        self.seen = self.motion()[:2]

    def world_velocity(self) -> Speeds:
        """How it moved when that was last noted: along x and y of the world [m/s], and to the left [rad/s]."""
        v, w = self.seen
        theta = self.pose[2]
        return (v * math.cos(theta), v * math.sin(theta), w)

    def carried(self, pose: Pose, dt: float, *, touching: bool) -> None:
        """Learn where the robot really got to while it may have touched something, and note how fast it went."""
        x, y, theta = self.pose
        middle = (theta + pose[2]) / 2
        c, s = math.cos(middle), math.sin(middle)
        v = ((pose[0] - x) * c + (pose[1] - y) * s) / dt
        w = (pose[2] - theta) / dt
        self._rates = ((v - self.seen[0]) / dt, (w - self.seen[1]) / dt)
        self.seen = (v, w)
        self.seen_aside = ((pose[1] - y) * c - (pose[0] - x) * s) / dt
        self.pose = pose
        self.touching = touching


class HolonomicRobot(Robot):
    """A robot that goes to any side. Its speeds and ways are those on paper: each is really `factors` times that, for no wheel is perfect."""

    def stop(self) -> None:
        """Stand still, with no command, and where it was switched on."""
        super().stop()
        self.speeds: Speeds = (0.0, 0.0, 0.0)
        """Ahead and to the left side [m/s], and to the left [rad/s]."""
        self.targets: Speeds = (0.0, 0.0, 0.0)
        """The same as it was told."""
        self.reckoned: Pose = (0.0, 0.0, 0.0)
        """Where it believes to be: what follows from its wheels, from where it was switched on."""

    @property
    def factors(self) -> Speeds:
        """By how much it goes farther ahead and to the side, and turns more, than its wheels tell."""
        wheels = self.wheels
        return (wheels.left, wheels.right, self.model.wheel_separation / wheels.separation)

    @property
    def standing(self) -> bool:
        """True while it neither moves by itself nor is told to."""
        return self.speeds == self.targets == (0.0, 0.0, 0.0)

    @property
    def ticks(self) -> tuple[int, int]:
        """Nothing: it has no two wheels whose turns could be counted."""
        return (0, 0)

    def motion(self) -> Motion:
        """How it really moves at this moment; for its motion to the side see `velocity` and `acceleration_aside`."""
        if self.touching:
            return Motion(*self.seen, *self._rates)
        (v, _, w), (dv, _, dw) = self._real(self.speeds), self._real(self._rates_now())
        return Motion(v, w, dv, dw)

    @property
    def velocity(self) -> Speeds:
        """How fast it really goes: ahead and to its left side [m/s], and to the left [rad/s]."""
        if self.touching:
            return (self.seen[0], self.seen_aside, self.seen[1])
        return self._real(self.speeds)

    @property
    def acceleration_aside(self) -> float:
        """How fast its speed to its left side changes [m/s2], but for its turning."""
        return 0.0 if self.touching else self._real(self._rates_now())[1]

    def wheel_state(self) -> WheelState:
        """What changes as it goes: its speeds, and where it believes to be."""
        return (*self.speeds, *self.reckoned)

    def set_wheel_state(self, state: WheelState) -> None:
        """Come back to a state of its wheels."""
        v, vy, w, x, y, theta = state
        self.speeds, self.reckoned = (v, vy, w), (x, y, theta)

    def course(self, state: WheelState) -> tuple[Any, ...]:  # noqa: ARG002
        """What says how it goes on from a state of its wheels: what it was told, and how its wheels roll."""
        return (self.targets, self.wheels.left, self.wheels.right)

    def set_course(self, course: tuple[Any, ...]) -> None:
        """Come back to a course."""
        self.targets, self.wheels.left, self.wheels.right = course

    def drive(self, v: float, vy: float, w: float) -> None:
        """Be told to go ahead and to the left side [m/s], and to turn to the left [rad/s], cut to what it can do."""
        model = self.model
        aside = model.max_linear if model.max_lateral is None else model.max_lateral
        v, w = limited(v, w, model.max_linear, model.max_angular)
        self.targets = (v, max(-aside, min(aside, vy)), w)
        a, b, c = (
            target if math.isinf(limit) else speed
            for speed, target, limit in zip(self.speeds, self.targets, self._limits(), strict=True)
        )
        self.speeds = (a, b, c)

    def launch(self, velocity: Speeds) -> None:
        """Have this velocity at once, and be told to stop."""
        v, vy, w = (speed / factor for speed, factor in zip(velocity, self.factors, strict=True))
        self.speeds = (v, vy, w)
        self.drive(0.0, 0.0, 0.0)
        self.expires = math.inf
        self.touching = False

    def roll(self, dt: float) -> tuple[Pose, float]:
        """Go on for `dt` seconds; return where that takes the robot, and how far its farthest corner moves at most."""
        pose, moved = self.pose, 0.0
        if self.standing:
            return pose, moved
        for h, rates in self._legs(dt):
            before = self.speeds
            after = tuple(speed + rate * h for speed, rate in zip(before, rates, strict=True))
            real, real_rates = self._real(before), self._real(rates)
            pose = glide(pose, real, real_rates, h)
            self.reckoned = glide(self.reckoned, before, rates, h)
            self.speeds = (after[0], after[1], after[2])
            end = self._real(self.speeds)
            speed = max(math.hypot(*real[:2]), math.hypot(*end[:2]))
            moved += (speed + self.model.reach * max(abs(real[2]), abs(end[2]))) * h
        return pose, moved

    def settle(self) -> None:
        """Make a speed that has reached its target, but for the last digits, equal to it."""
        if self.speeds != self.targets:
            a, b, c = (
                target if abs(speed - target) < ROUNDING else speed
                for speed, target in zip(self.speeds, self.targets, strict=True)
            )
            self.speeds = (a, b, c)

    def note(self) -> None:
        """Remember how it moves now, to know later how that has changed."""
        v, self.seen_aside, w = self.velocity
        self.seen = (v, w)

    def world_velocity(self) -> Speeds:
        """How it moved when that was last noted: along x and y of the world [m/s], and to the left [rad/s]."""
        v, w = self.seen
        c, s = math.cos(self.pose[2]), math.sin(self.pose[2])
        return (c * v - s * self.seen_aside, s * v + c * self.seen_aside, w)

    def _limits(self) -> Speeds:
        model = self.model
        return (model.linear_acceleration, model.linear_acceleration, model.angular_acceleration)

    def _legs(self, dt: float) -> list[tuple[float, Speeds]]:
        if self.speeds == self.targets:
            return [(dt, (0.0, 0.0, 0.0))]
        return ramps(self.speeds, self.targets, self._limits(), dt)

    def _rates_now(self) -> Speeds:
        return self._legs(1.0)[0][1]

    def _real(self, speeds: Speeds) -> Speeds:
        a, b, c = self.factors
        return (a * speeds[0], b * speeds[1], c * speeds[2])


class Thing(Robot):
    """What has no drive: it stands, or is pushed."""

    @property
    def standing(self) -> bool:
        """Always: it does nothing by itself."""
        return True

    def motion(self) -> Motion:
        """How it really moves at this moment."""
        return Motion(*self.seen, *self._rates)

    @property
    def velocity(self) -> Speeds:
        """How fast it really goes: ahead and to its left side [m/s], and to the left [rad/s]."""
        return (self.seen[0], self.seen_aside, self.seen[1])

    def drive(self, v: float, vy: float, w: float) -> None:
        """Refuse: it cannot. Raises `RosminiError`."""
        if v or vy or w:
            msg = f"{self.name!r} cannot go {v} m/s, {vy} m/s to its side and {w} rad/s: it has no drive"
            raise RosminiError(msg)

    def follow(self, pose: Pose, velocity: Speeds, dt: float) -> None:
        """Learn where it was pushed to in `dt` seconds, and how fast it goes: along x and y of the world [m/s], and to the left [rad/s]."""
        self.pose = pose
        (vx, vy, w), c, s = velocity, math.cos(pose[2]), math.sin(pose[2])
        v = c * vx + s * vy
        self._rates = ((v - self.seen[0]) / dt, (w - self.seen[1]) / dt)
        self.seen, self.seen_aside = (v, w), c * vy - s * vx

    def launch(self, velocity: Speeds) -> None:
        """Note that it has this velocity."""
        self.seen, self.seen_aside = (velocity[0], velocity[2]), velocity[1]
        self.touching = False


def make_robot(name: str, model: RobotModel, pose: Pose, wheels: RealWheels) -> Robot:
    """A robot as its model's drive says."""
    kinds = {"differential": Robot, "holonomic": HolonomicRobot, None: Thing}
    return kinds[model.drive](name, model, pose, wheels)
