"""What a robot measures: the laser and the inertial measurement unit."""

from __future__ import annotations

import copy
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.geometry.poses import Pose
from rosmini.sim.host import Device, Host, Stamp
from rosmini.sim.messages import ImuMessage, ScanMessage
from rosmini.sim.models import ImuModel, LidarModel
from rosmini.sim.sensors.imu import Imu
from rosmini.sim.sensors.lidar import unmeasured

from .names import order

Floats = NDArray[np.float64]


class RangeDevice(Device):
    """What publishes a laser's `sensor_msgs/LaserScan`, whichever simulator's it is. Derive from it, and override `due`.

    Args:
        host: where it happens.
        robot: the engine's name of the robot.
        name: the device's.
        lidar: which laser, and where it sits.
        topic: where it is published.
        frame: what the header says.
        rate: how often; without it as often as the laser's model says [Hz].
        queue_size: the publisher's.

    """

    order = order("laser")

    def __init__(
        self,
        host: Host,
        robot: str,
        name: str,
        lidar: LidarModel,
        *,
        topic: str,
        frame: str,
        rate: float | None = None,
        queue_size: int = 5,
    ) -> None:
        super().__init__(host, name, rate or lidar.rate)
        self.robot = host.engine.robot(robot)
        self.lidar = lidar
        self.pose: Pose = self.robot.pose
        """Where the robot was when it measured last."""
        self.ranges: Floats | None = None
        """What it measured last, as it was published; None before the first time."""
        self.poses: Floats | None = None
        """Where it was at each beam of that (beams, 3), of a laser that sweeps; None where all beams are measured at once."""
        self._rng = host.rng(name)
        self._told = ScanMessage(lidar, frame, self.rate)
        self._publisher = host.node.publisher(topic, type(self._told.message), queue_size=queue_size)
        self.topic: str = self._publisher.topic
        """Where it is published, as a global name."""

    @property
    def seen_from(self) -> Floats:
        """Where the robot was at each beam of what it measured last (beams, 3); (1, 3) if all beams were measured at once."""
        return np.array([self.pose]) if self.poses is None else self.poses

    @property
    def message(self) -> Any:
        """A copy of the last message, whether anybody heard it or not; None before the first."""
        if self.ranges is None:
            return None
        cls = type(self._told.message)
        return cls._thaw_numpy(cls._freeze(self._told.message))

    def state(self) -> Any:
        """The noise that is still to come, and what was measured last."""
        return copy.deepcopy(self._rng), self.pose, self.ranges, self.poses

    def restore(self, state: Any) -> None:
        """Draw the noise that was drawn after that."""
        rng, self.pose, self.ranges, self.poses = state
        self._rng = copy.deepcopy(rng)
        if self.ranges is not None:
            self._told.fill(self.ranges)

    def close(self) -> None:
        """End the topic."""
        self._publisher.unregister()


class Laser(RangeDevice):
    """`sensor_msgs/LaserScan` of a laser on a robot.

    Args:
        host: where it happens.
        robot: the engine's name of the robot.
        lidar: which laser, and where it sits; without it the one of the robot's model.
        topic: where it is published.
        frame: what the header says; without it what the laser's model says.
        rate: how often; without it as often as the laser's model says [Hz].
        noise: scales the noise of the laser's model; 0: none.
        rep_117: tell inf of what is too far and -inf of what is too near; else 0.0, as a real LDS-01 does.
        always: measure even if nobody listens, so that `last` is there.
        sweep: measure one beam after the other, as a laser that spins does, and each from where the robot is then; see `rosmini.sim.sensors.lidar`.
        name: the device's; without it robot/lidar.

    """

    def __init__(
        self,
        host: Host,
        robot: str,
        lidar: LidarModel | None = None,
        *,
        topic: str = "scan",
        frame: str | None = None,
        rate: float | None = None,
        noise: float = 1.0,
        rep_117: bool = True,
        always: bool = False,
        sweep: bool = False,
        name: str | None = None,
    ) -> None:
        if lidar is None:
            lidar = host.engine.robot(robot).model.laser
        super().__init__(
            host, robot, name or f"{robot}/lidar", lidar, topic=topic, frame=frame or lidar.frame, rate=rate
        )
        self.measures = always
        self._deviation = lidar.noise * noise
        self._rep_117 = rep_117
        self._beam_time = lidar.beam_time / (self.rate / lidar.rate) if sweep else 0.0
        if sweep:
            # its stamp is the time of the first beam in the message, which is measured last
            self._told.message.time_increment = -self._beam_time
            host.engine.trails.remember(1.01 * self._beam_time * lidar.beams)

    def due(self, stamp: Stamp, _: int, /) -> None:
        """Measure. Noise is drawn even if nobody listens, so that it does not depend on who does."""
        noise = None
        if self._deviation:
            noise = self._rng.standard_normal(self.lidar.beams) * self._deviation
        heard = self._publisher.num_connections()
        if not heard and not self.measures:
            return
        engine, name = self.host.engine, self.robot.name
        if self._beam_time:
            ranges, self.poses = engine.sweep(name, self._beam_time, noise, self.lidar)
        else:
            ranges = engine.scan(name, noise, self.lidar)
        self.pose = self.robot.pose
        self.ranges = ranges if self._rep_117 else unmeasured(ranges)
        message = self._told.fill(self.ranges)
        self._told.stamp(*stamp)
        if heard:
            self._publisher.publish(message)


class ImuDevice(Device):
    """`sensor_msgs/Imu` of a unit on a robot: its heading counts from where the robot started.

    Args:
        host: where it happens.
        robot: the engine's name of the robot.
        model: which unit, and where it sits; without it the one of the robot's model.
        topic: where it is published.
        frame: what the header says; without it what the unit's model says.
        rate: how often; without it as often as the unit's model says [Hz].
        noise: scales the noise and the biases of the unit's model; 0: none.
        name: the device's; without it robot/imu.

    """

    order = order("imu")
    always = False

    def __init__(
        self,
        host: Host,
        robot: str,
        model: ImuModel | None = None,
        *,
        topic: str = "imu",
        frame: str | None = None,
        rate: float | None = None,
        noise: float = 1.0,
        name: str | None = None,
    ) -> None:
        self.robot = host.engine.robot(robot)
        self.model = self.robot.model.unit if model is None else model
        super().__init__(host, name or f"{robot}/imu", rate or self.model.rate)
        self._imu = Imu(self.model, host.rng(self.name), noise)
        self._heading = self.robot.start[2]
        self._told = ImuMessage(frame or self.model.frame)
        self._publisher = host.node.publisher(topic, type(self._told.message), queue_size=50)

    def wanted(self) -> bool:
        """Tell whether anybody listens."""
        return self._publisher.num_connections() > 0

    def due(self, stamp: Stamp, number: int, /) -> None:
        """Tell what the sample of this number shows."""
        told = self._told
        told.stamp(*stamp)
        self._publisher.publish(told.fill(self._imu, number, self.robot, self._heading))

    @property
    def heading(self) -> float:
        """What the unit makes of the robot's heading now [rad, not wrapped], as far as its last sample shows it."""
        turned = self.robot.pose[2] - self._heading
        return self._imu.heading(self.host.count(self), turned)

    def calibrate(self) -> None:
        """Take for the gyroscope's zero what it shows here and now: TurtleBot3's topic `reset`. The heading stays what it is."""
        self._imu.calibrate(self.host.count(self), self.robot.motion().w)

    def reset(self) -> None:
        """Count the heading from where the robot is put back to."""
        self._heading = self.robot.start[2]

    def state(self) -> Any:
        """The biases, and the noise that is still to come."""
        return copy.deepcopy(self._imu), self._heading

    def restore(self, state: Any) -> None:
        """Measure what was measured after that."""
        imu, self._heading = state
        self._imu = copy.deepcopy(imu)

    def close(self) -> None:
        """End the topic."""
        self._publisher.unregister()
