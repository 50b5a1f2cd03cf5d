"""The devices that publish a robot's topics once per step, in the form of stageros."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry.angles import normalize_angle
from rosmini.core.geometry.poses import Pose
from rosmini.core.graph import MessageFactory
from rosmini.msgs import message_class
from rosmini.sim.devices.drive import DifferentialDrive, GroundTruth, OdometryReading, OdometryTransforms
from rosmini.sim.devices.laser import RangeDevice
from rosmini.sim.host import Device, Host, Stamp
from rosmini.sim.messages import MakeTransform, fixed_transform, moving_transform, odometry_values
from rosmini.sim.models import LidarModel
from rosmini.sim.sensors.lidar import unmeasured

from .odometry import STILL, StageOdometry, Velocity
from .robot_names import Names
from .robots import StageLaser, StageRobot

Floats = NDArray[np.float64]

NO_COVARIANCE = (0.0,) * 6

LATE = 1e-9
"""Times that differ by less [s] count as equal."""


class StageBase(DifferentialDrive):
    """A position model: subscribes to `cmd_vel`, publishes `odom`.

    It reaches the commanded velocity at once, within its bounds; "diff" ignores linear.y. `commanded` is called at each
    command.
    """

    def __init__(self, host: Host, name: str, robot: StageRobot, names: Names, commanded: Callable[[], None]) -> None:
        self.stage_robot = robot
        self.sideways = robot.drive == "omni"
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
        """Return the velocity for a command."""
        robot = self.stage_robot
        if not self.sideways:
            aside = 0.0
        told = (v, aside, w)
        ahead, left, turn = (
            max(low, min(high, each)) for each, (low, high) in zip(told, robot.velocity_bounds, strict=True)
        )
        return (ahead, left if self.sideways else 0.0, turn)

    def command(self, v: float, w: float, vy: float = 0.0) -> None:
        """Drive ahead and to the side [m/s] and turn left [rad/s]. Raises `RosminiError` unless all are finite."""
        self._commanded()
        self.go(self.velocity(v, vy, w))

    def go(self, velocity: Velocity) -> None:
        """Continue at this velocity."""
        self.host.catch_up()
        self.reckoning.set_velocity(velocity, self.host.engine.now)
        v, aside, w = velocity
        super().command(v, w, aside)

    def _update(self) -> None:
        self.reckoning.advance(self.host.engine.now)
        v, aside, w = self.reckoning.velocity
        self.reckoned = OdometryReading(self.reckoning.pose(self.robot.pose), v, aside, w)

    def reset(self) -> None:
        """Stop. The estimated pose stays the same, as in Stage."""
        self.reckoning.set_velocity(STILL, self.host.engine.now)


class StageTruth(GroundTruth):
    """The topic `base_pose_ground_truth`: pose and velocity of a base in the world's frame, between two steps.

    Its frame has the topic's name, as in stageros; no transform connects that frame to others.
    """

    always = True

    def __init__(self, host: Host, name: str, names: Names) -> None:
        what = "base_pose_ground_truth"
        frame, child = names.frame(what), names.frame("base_footprint")
        super().__init__(host, name, topic=names.topic(what), frame=frame, child=child, covariance=NO_COVARIANCE)
        self._before: Pose = self.robot.pose

    def due(self, stamp: Stamp, number: int, /) -> None:
        """Publish the pose, and remember it for the next step."""
        if self.wanted():
            super().due(stamp, number)
        self._before = self.robot.pose

    def sample(self, _: int) -> tuple[float, ...]:
        """Return the pose, and the velocity since the last step."""
        pose, before = self.robot.pose, self._before
        vx, vy = (pose[0] - before[0]) * self.rate, (pose[1] - before[1]) * self.rate
        return odometry_values(pose, vx, vy, normalize_angle(pose[2] - before[2]) * self.rate)


class StageLaserDevice(RangeDevice):
    """`base_scan`. A ray without a hit reports the maximum range, as in Stage, and too near objects are measured.

    Stage's noise: a range r becomes r + r p u + n, with u uniform between -1 and 1 and n normal, where `noise [n p ..]`
    in the file gives p, and the standard deviation of n, which Stage 4.3's code uses as a variance. Intensities are
    1 for a hit, the default of Stage's `ranger_return`.
    """

    queue_size = 10

    def __init__(
        self, host: Host, robot: str, name: str, laser: StageLaser, model: LidarModel, *, topic: str, frame: str
    ) -> None:
        self._noise = laser.noise
        self._near, self._far = laser.range_min, laser.range_max
        super().__init__(host, robot, model, topic=topic, frame=frame, name=name)

    def describe(self, message: Any) -> None:
        """Fill in the laser's constants."""
        super().describe(message)
        message.range_min = self._near

    def sample(self, _: int) -> tuple[Floats, Floats]:
        """Return ranges and intensities. Noise is drawn even without subscribers, and so does not depend on them."""
        engine, model = self.host.engine, self.lidar
        exact = engine.scan(self.robot.name, lidar=model)
        hit = np.isfinite(exact)
        ranges = unmeasured(exact, self._far)
        constant, part = self._noise
        if constant or part:
            even = self._rng.uniform(-1.0, 1.0, model.beams)
            normal = self._rng.standard_normal(model.beams)
            ranges = np.where(hit, ranges + ranges * part * even + constant * normal, ranges)
        self.pose = self.robot.pose
        return ranges, hit.astype(np.float64)


class StageTransforms(Device):
    """`/tf` of all robots: odom to base_footprint, base_footprint to base_link, and base_link to the sensors."""

    order = OdometryTransforms.order

    def __init__(self, host: Host, rate: float) -> None:
        super().__init__(host, "transforms", rate)
        self._moving: list[tuple[StageBase, MakeTransform]] = []
        self._still: list[Callable[[int, int], Any]] = []
        self._list: Any = message_class("tf2_msgs/TFMessage")
        self._publisher = host.node.publisher("/tf", self._list, queue_size=100)

    def base(self, base: StageBase, names: Names) -> None:
        """Add a base."""
        self._moving.append((base, moving_transform(base.odom_frame, base.base_frame)))
        self._still.append(fixed_transform(base.base_frame, names.frame("base_link"), (0.0, 0.0, 0.0)))

    def sensor(self, frame: str, child: str, place: tuple[float, float, float], rotation: Sequence[float]) -> None:
        """Add a sensor at a position [m], turned by a quaternion."""
        self._still.append(fixed_transform(frame, child, place, rotation))

    def due(self, stamp: Stamp, _: int, /) -> None:
        """Publish the current transforms."""
        if not self._publisher.num_connections():
            return
        made = [make(*stamp) for make in self._still]
        made += [make(*stamp, base.reckoned.pose) for base, make in self._moving]
        self._publisher.publish(MessageFactory(partial(self._list, transforms=made), is_frozen=True))

    def close(self) -> None:
        """Close the topic."""
        self._publisher.unregister()


class Watchdog(Device):
    """Stops all robots if none has received a command for `timeout` [s]; 0: never.

    All robots share it, as in stageros; it is checked once per step.
    """

    order = -1

    def __init__(self, host: Host, rate: float, timeout: float) -> None:
        super().__init__(host, "watchdog", rate)
        self.timeout = timeout
        self.bases: list[StageBase] = []
        self._fed = 0.0

    def feed(self) -> None:
        """Record that a robot received a command."""
        self._fed = self.host.engine_now

    def due(self, _stamp: Stamp, _: int, /) -> None:
        """Stop the robots if the timeout has passed."""
        if self.timeout > 0 and self.host.engine.now - self._fed >= self.timeout - LATE:
            for base in self.bases:
                if base.reckoning.velocity != STILL:
                    base.go(base.velocity(0.0, 0.0, 0.0))


class End(Device):
    """Calls a function once, at the time `when` [s]."""

    order = 100

    def __init__(self, host: Host, rate: float, when: float, call: Callable[[], object]) -> None:
        super().__init__(host, "end", rate)
        self._when = when
        self._call = call

    def due(self, _stamp: Stamp, _: int, /) -> None:
        """Call the function if it is time."""
        if self.host.engine.now >= self._when - LATE:
            self._call()
