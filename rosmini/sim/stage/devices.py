"""What stageros publishes of a robot, once a step, in the form that Stage gives it."""

from __future__ import annotations

import copy
import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.geometry.angles import normalize_angle
from rosmini.geometry.poses import Pose
from rosmini.msgs import message_class
from rosmini.sim.devices import DifferentialDrive, GroundTruth, RangeDevice, order
from rosmini.sim.devices.drive import Reckoned
from rosmini.sim.host import Device, Host, Stamp
from rosmini.sim.messages import TransformMessage
from rosmini.sim.models import LidarModel
from rosmini.sim.sensors.lidar import unmeasured

from .names import Names
from .odometry import STILL, StageOdometry, Velocity
from .robots import StageLaser, StageRobot

Floats = NDArray[np.float64]

NO_COVARIANCE = (0.0,) * 6

LATE = 1e-9
"""Times that differ by less [s] are the same."""


class StageBase(DifferentialDrive):
    """A position: `cmd_vel` in, `odom` out.

    It has at once the velocity it is told, cut to its bounds. Of a car linear.x is the speed of its steered wheel and angular.z the angle that this
    wheel is turned by; "diff" leaves linear.y out. `commanded` is called at each command.
    """

    def __init__(
        self, host: Host, name: str, robot: StageRobot, names: Names, commanded: Callable[[], None]
    ) -> None:
        self.stage_robot = robot
        self.sideways = robot.drive == "omni"
        self.steered = robot.drive == "car"
        self._commanded = commanded
        super().__init__(
            host,
            name,
            cmd_vel=names.topic("cmd_vel"),
            odom=names.topic("odom"),
            odom_frame=names.frame("odom"),
            base_frame=names.frame("base_footprint"),
            source="world",
            covariance=NO_COVARIANCE,
        )
        self.reckoning = StageOdometry(robot, host.rng(f"{name}/odometry"))
        self._update()

    def velocity(self, v: float, aside: float, w: float) -> Velocity:
        """What the base makes of a command."""
        robot = self.stage_robot
        if robot.drive == "car":
            v, w = v * math.cos(w), v * math.sin(w) / robot.wheelbase
        if not self.sideways:
            aside = 0.0
        told = (v, aside, w)
        ahead, left, turn = (
            max(low, min(high, each)) for each, (low, high) in zip(told, robot.velocity_bounds, strict=True)
        )
        return (ahead, left if self.sideways else 0.0, turn)

    def command(self, v: float, w: float, vy: float = 0.0) -> None:
        """Let the base go ahead and to the side [m/s] and turn to the left [rad/s]. Raises `RosminiError` for no finite number."""
        self._commanded()
        self.go(self.velocity(v, vy, w))

    def go(self, velocity: Velocity) -> None:
        """Go on with this velocity."""
        self.host.catch_up()
        self.reckoning.told(velocity, self.host.engine.now)
        v, aside, w = velocity
        super().command(v, w, aside)

    def _update(self) -> None:
        self.reckoning.advance(self.host.engine.now)
        v, aside, w = self.reckoning.velocity
        self.reckoned = Reckoned(self.reckoning.pose(self.robot.pose), v, aside, w)

    def reset(self) -> None:
        """Stand. What the base believes of where it is stays, as in Stage."""
        self.reckoning.told(STILL, self.host.engine.now)

    def state(self) -> Any:
        """The odometry, and whether the motors have current."""
        return super().state(), copy.copy(self.reckoning)

    def restore(self, state: Any) -> None:
        """Believe what was believed then."""
        own, reckoning = state
        super().restore(own)
        self.reckoning = copy.copy(reckoning)


class StageTruth(GroundTruth):
    """`base_pose_ground_truth`: where a base really is, and its velocity along the axes of the world, from one step to the next.

    Its frame has the name of the topic, as stageros has it: nobody knows where that frame is.
    """

    def __init__(self, host: Host, name: str, names: Names) -> None:
        what = "base_pose_ground_truth"
        frame, child = names.frame(what), names.frame("base_footprint")
        super().__init__(
            host, name, topic=names.topic(what), frame=frame, child=child, covariance=NO_COVARIANCE
        )
        self._before: Pose = self.robot.pose

    def due(self, stamp: Stamp, _: int, /) -> None:
        """Tell where it is."""
        pose, before = self.robot.pose, self._before
        self._before = pose
        if self._publisher.num_connections():
            vx, vy = (pose[0] - before[0]) * self.rate, (pose[1] - before[1]) * self.rate
            turn = normalize_angle(pose[2] - before[2]) * self.rate
            self._message.stamp(*stamp)
            self._publisher.publish(self._message.fill(pose, vx, vy, turn))

    def state(self) -> Any:
        """Where it was a step ago."""
        return self._before

    def restore(self, state: Any) -> None:
        """Remember where it was."""
        self._before = state


class StageLaserDevice(RangeDevice):
    """`base_scan`. A ray that hits nothing has the largest range, as in Stage, and what is too near has its own.

    Stage's noise: a range r becomes r + r p u + n, with u even between -1 and 1 and n normal, where `noise [n p ..]` in the file gives p, and the standard
    deviation of n, which Stage 4.3's code takes as a variance. Intensities are 1 where something was hit, Stage's `ranger_return` if none is given.
    """

    def __init__(
        self,
        host: Host,
        robot: str,
        name: str,
        laser: StageLaser,
        model: LidarModel,
        *,
        topic: str,
        frame: str,
    ) -> None:
        super().__init__(host, robot, name, model, topic=topic, frame=frame, queue_size=10)
        self._noise = laser.noise
        self._far = laser.range_max
        self._told.message.range_min = laser.range_min

    def due(self, stamp: Stamp, _: int, /) -> None:
        """Measure. Noise is drawn even if nobody listens, so that it does not depend on who does."""
        engine, model = self.host.engine, self.lidar
        exact = engine.scan(self.robot.name, lidar=model)
        hit = np.isfinite(exact)
        ranges = unmeasured(exact, self._far)
        constant, part = self._noise
        if constant or part:
            even = self._rng.uniform(-1.0, 1.0, model.beams)
            normal = self._rng.standard_normal(model.beams)
            ranges = np.where(hit, ranges + ranges * part * even + constant * normal, ranges)
        self.pose, self.ranges = self.robot.pose, ranges
        message = self._told.fill(ranges)
        message.intensities = hit.astype(np.float64)
        self._told.stamp(*stamp)
        if self._publisher.num_connections():
            self._publisher.publish(message)


class StageTransforms(Device):
    """`/tf` of all robots: odom to base_footprint, which is base_link, and from there to the sensors."""

    order = order("transforms")

    def __init__(self, host: Host, rate: float) -> None:
        super().__init__(host, "transforms", rate)
        self._moving: list[tuple[StageBase, TransformMessage]] = []
        self._still: list[TransformMessage] = []
        self._sometimes: list[tuple[Callable[[], bool], TransformMessage]] = []
        self._list: Any = message_class("tf2_msgs/TFMessage")()
        self._publisher = host.node.publisher("/tf", type(self._list), queue_size=100)

    def base(self, base: StageBase, names: Names) -> None:
        """Tell of a base."""
        self._moving.append((base, TransformMessage(base.odom_frame, base.base_frame)))
        self._still.append(_fixed(base.base_frame, names.frame("base_link"), (0.0, 0.0, 0.0)))

    def sensor(
        self,
        frame: str,
        child: str,
        place: tuple[float, float, float],
        rotation: Sequence[float],
        wanted: Callable[[], bool] | None = None,
    ) -> None:
        """Tell of a sensor that sits there [m], turned by a quaternion; `wanted` tells whether just now."""
        message = _fixed(frame, child, place, rotation)
        if wanted is None:
            self._still.append(message)
        else:
            self._sometimes.append((wanted, message))

    def due(self, stamp: Stamp, _: int, /) -> None:
        """Tell where all are."""
        if not self._publisher.num_connections():
            return
        shown = [*self._still, *(message for wanted, message in self._sometimes if wanted())]
        for base, message in self._moving:
            message.fill(base.reckoned.pose)
            shown.append(message)
        for message in shown:
            message.stamp(*stamp)
        self._list.transforms = [message.message for message in shown]
        self._publisher.publish(self._list)

    def close(self) -> None:
        """End the topic."""
        self._publisher.unregister()


def _fixed(
    frame: str,
    child: str,
    place: tuple[float, float, float],
    rotation: Sequence[float] = (0.0, 0.0, 0.0, 1.0),
) -> TransformMessage:
    told = TransformMessage(frame, child)
    transform = told.message.transform
    transform.translation.x, transform.translation.y, transform.translation.z = place
    turn = transform.rotation
    turn.x, turn.y, turn.z, turn.w = rotation
    return told


class Watchdog(Device):
    """Stops all robots when none was told anything for `timeout` [s]; 0: never. One for all, as in stageros, and looked at once a step."""

    order = -1

    def __init__(self, host: Host, rate: float, timeout: float) -> None:
        super().__init__(host, "watchdog", rate)
        self.timeout = timeout
        self.bases: list[StageBase] = []
        self._fed = 0.0

    def feed(self) -> None:
        """A robot was told something."""
        self._fed = self.host.engine_now

    def due(self, _stamp: Stamp, _: int, /) -> None:
        """Look whether it is time."""
        if self.timeout > 0 and self.host.engine.now - self._fed >= self.timeout - LATE:
            for base in self.bases:
                if base.reckoning.velocity != STILL:
                    base.go(base.velocity(0.0, 0.0, 0.0))

    def state(self) -> Any:
        """When it was told something."""
        return self._fed

    def restore(self, state: Any) -> None:
        """Remember when that was."""
        self._fed = state


class End(Device):
    """Calls something once, when it is `when` [s]."""

    order = 100

    def __init__(self, host: Host, rate: float, when: float, call: Callable[[], object]) -> None:
        super().__init__(host, "end", rate)
        self._when = when
        self._call = call

    def due(self, _stamp: Stamp, _: int, /) -> None:
        """Look whether it is time."""
        if self.host.engine.now >= self._when - LATE:
            self._call()
