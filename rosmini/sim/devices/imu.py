"""Inertial measurement units: `sensor_msgs/Imu` (REP 145)."""

from __future__ import annotations

import math
from typing import Any

from rosmini.sim.host import Host
from rosmini.sim.messages import diagonal
from rosmini.sim.models import ImuModel
from rosmini.sim.sensors.imu import Imu

from .sensor import Sensor

ORIENTATION_COVARIANCE, GYRO_COVARIANCE, ACCEL_COVARIANCE = 0.0025, 0.02, 0.04
"""Variances as TurtleBot3's firmware states them."""

STILL = (0.0, 0.0)


class ImuDevice(Sensor):
    """An inertial measurement unit on a robot; its heading counts from the robot's start.

    Args:
        host: the simulated world.
        robot: the engine's name of the robot.
        model: the unit's model and mount; the robot model's if not given.
        topic: where it is published.
        frame: the frame of the header; the unit model's if not given.
        rate: messages per second [Hz]; the unit model's if not given.
        noise: scales the noise and the biases of the unit's model; 0: no noise.
        name: the device's name; robot/imu if not given.

    """

    message_type = "sensor_msgs/Imu"
    default_topic = "imu"
    order = 60.0
    queue_size = 50
    saved = ("_imu", "_heading")
    varying = tuple(
        f"{field}.{axis}"
        for field, axes in (("orientation", "xyzw"), ("angular_velocity", "xyz"), ("linear_acceleration", "xyz"))
        for axis in axes
    )

    def __init__(
        self,
        host: Host,
        robot: str,
        model: ImuModel | None = None,
        *,
        topic: str | None = None,
        frame: str | None = None,
        rate: float | None = None,
        noise: float = 1.0,
        name: str | None = None,
    ) -> None:
        self.model = host.engine.robot(robot).model.unit if model is None else model
        super().__init__(
            host, robot, topic=topic, frame=frame or self.model.frame, rate=rate or self.model.rate, name=name
        )
        self._imu = Imu(self.model, host.rng(self.name), noise)
        self._heading = self.robot.start[2]
        self._rolls = self.robot.model.drive == "differential"

    def describe(self, message: Any) -> None:
        """Fill in the covariances."""
        message.orientation_covariance = diagonal((ORIENTATION_COVARIANCE,) * 3)
        message.angular_velocity_covariance = diagonal((GYRO_COVARIANCE,) * 3)
        message.linear_acceleration_covariance = diagonal((ACCEL_COVARIANCE,) * 3)

    def sample(self, number: int) -> tuple[float, ...]:
        """Return the orientation as a quaternion, the angular velocity and the acceleration."""
        robot, imu = self.robot, self._imu
        theta, motion = robot.turning()
        aside = STILL if self._rolls else (robot.velocity[1], robot.acceleration_aside)
        heading, *rest = imu.sample(number, theta - self._heading, *motion, aside)
        return (0.0, 0.0, math.sin(heading / 2), math.cos(heading / 2), *rest)

    @property
    def heading(self) -> float:
        """The robot's heading now [rad, not wrapped], as estimated since the unit's last sample."""
        turned = self.robot.pose[2] - self._heading
        return self._imu.heading(self.host.count(self), turned)

    def calibrate(self) -> None:
        """Take the gyroscope's current rate as its zero: TurtleBot3's topic `reset`. The heading stays."""
        self._imu.calibrate(self.host.count(self), self.robot.motion().w)

    def reset(self) -> None:
        """Count the heading from the robot's start pose again."""
        self._heading = self.robot.start[2]
