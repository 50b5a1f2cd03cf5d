"""State that TurtleBot3's board reports besides motion: battery, switches, motors and encoders."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from typing import Any

from rosmini.core.geometry.angles import normalize_angle
from rosmini.core.geometry.poses import Pose
from rosmini.msgs import message_class
from rosmini.sim.engine.robot import Robot
from rosmini.sim.host import Device, Host, Stamp
from rosmini.sim.sensors.battery import Battery, Charge

from .drive import DifferentialDrive
from .sensor import Outlet, Sensor

BOARD_RATE = 30.0
"""Rate at which TurtleBot3's firmware reports its state [Hz]: DRIVE_INFORMATION_PUBLISH_FREQUENCY."""

DRAIN_S = 1.0
"""Interval over which consumption is summed before it is taken from the battery [s]."""


class BatteryDevice(Device):
    """`sensor_msgs/BatteryState` of a battery that drains, faster while the robot drives and pushes.

    When the battery is empty, the motors of `drive` lose power.

    Args:
        host: the simulated world.
        robot: the engine's name of the robot.
        battery: the battery.
        drive: the drive whose motors it powers.
        topic: where it is published.

    """

    order = 70.0
    saved = ("battery", "shown", "_used", "_since")

    def __init__(self, host: Host, robot: str, battery: Battery, *, drive: DifferentialDrive, topic: str) -> None:
        super().__init__(host, f"{robot}/battery", BOARD_RATE)
        self.robot: Robot = host.engine.robot(robot)
        self.battery = battery
        self.drive = drive
        self.shown: Charge = self.battery.read()
        """The charge that was reported last."""
        self._used, self._since = 0.0, 0.0  # energy [J] and time [s] that are not taken from the battery yet
        message: Any = message_class("sensor_msgs/BatteryState")()
        model = self.battery.model
        message.design_capacity = message.capacity = model.capacity
        message.temperature = math.nan
        message.power_supply_status = message.POWER_SUPPLY_STATUS_DISCHARGING
        message.power_supply_health = message.POWER_SUPPLY_HEALTH_GOOD
        message.power_supply_technology = message.POWER_SUPPLY_TECHNOLOGY_LIPO
        message.location = model.name
        varying = ("voltage", "current", "charge", "percentage", "present")
        self._outlet = Outlet(host.node, topic, message, varying)

    def due(self, stamp: Stamp, _: int, /) -> None:
        """Drain the battery and publish its state."""
        robot = self.robot
        fastest = robot.model.max_linear
        left, right = (min(abs(speed) / fastest, 1.0) for speed in (robot.left, robot.right))
        force, speed = 0.0, 0.0
        if robot.touching:
            force = sum(how for _, how in contacts(self.host, robot.name))
            speed = robot.motion().v
        period = 1 / self.rate
        self._used += self.battery.model.draw(left, right, force, speed) * period
        self._since += period
        if self._since >= DRAIN_S:
            self._drain()
        if self._outlet.num_connections():
            shown = self.shown
            self._outlet.publish(stamp, (shown.voltage, shown.current, shown.charge, shown.percentage, not shown.empty))

    def _drain(self) -> None:
        self.shown = self.battery.drain(self._used / self._since, self._since)
        self._used = self._since = 0.0
        if self.shown.empty and self.drive.powered:
            self.drive.power(False)
            self.host.node.logwarn(f"the battery of {self.robot.name} is empty, and its motors stop")

    def close(self) -> None:
        """Close the topic."""
        self._outlet.close()


class SensorStateDevice(Sensor):
    """`turtlebot3_msgs/SensorState`: bumper, motors, encoders and voltage.

    The cliff sensor, sonar, light sensor, lamp and button do not exist and read 0.

    Args:
        host: the simulated world.
        drive: the drive whose encoders and motors are reported.
        battery: the battery whose voltage is reported.
        topic: where it is published.

    """

    message_type = "turtlebot3_msgs/SensorState"
    default_topic, default_rate = "sensor_state", BOARD_RATE
    order = 80.0
    varying = ("bumper", "torque", "left_encoder", "right_encoder", "battery")

    def __init__(self, host: Host, drive: DifferentialDrive, battery: BatteryDevice, *, topic: str) -> None:
        super().__init__(host, drive.robot.name, topic=topic)
        self.drive, self.battery = drive, battery

    def sample(self, _: int) -> tuple[int, bool, int, int, float]:
        """Return the state of the switches, the motors, the encoders and the battery."""
        robot = self.robot
        bumper = bumper_bits(robot.pose, [point for point, _ in contacts(self.host, robot.name)])
        left, right = (_int32(ticks) for ticks in robot.ticks)
        return (bumper, self.drive.powered, left, right, self.battery.shown.voltage)


class Switches:
    """TurtleBot3's topics `motor_power` (std_msgs/Bool) and `reset` (std_msgs/Empty).

    The first switches the motors' power; the second sets the odometry to zero and calibrates the gyroscope.

    Args:
        host: the simulated world.
        drive: the drive whose motors and odometry they control.
        calibrate: called at a reset, before the odometry is set to zero.
        motor_power: the topic that switches the motors.
        reset: the topic that resets.

    """

    def __init__(
        self,
        host: Host,
        drive: DifferentialDrive,
        calibrate: Callable[[], None] | None = None,
        *,
        motor_power: str,
        reset: str,
    ) -> None:
        self._drive, self._calibrate = drive, calibrate
        node = host.node
        self._host = host
        self._subscribers = [
            node.subscriber(motor_power, message_class("std_msgs/Bool"), self._power, queue_size=1),
            node.subscriber(reset, message_class("std_msgs/Empty"), self._reset, queue_size=1),
        ]

    def _power(self, message: Any) -> None:
        self._drive.power(bool(message.data))

    def _reset(self, _: Any) -> None:
        self._host.catch_up()
        if self._calibrate is not None:
            self._calibrate()
        self._drive.reset_odometry()

    def close(self) -> None:
        """Close the topics."""
        for subscriber in self._subscribers:
            subscriber.unregister()


def bumper_bits(pose: Pose, points: Iterable[tuple[float, float]]) -> int:
    """Return `bumper` of a `turtlebot3_msgs/SensorState` for points of contact: 1 for the front, 2 for the back."""
    x, y, theta = pose
    off = [abs(normalize_angle(math.atan2(py - y, px - x) - theta)) for px, py in points]
    return any(angle <= math.pi / 2 for angle in off) + 2 * any(angle > math.pi / 2 for angle in off)


def contacts(host: Host, robot: str) -> list[tuple[tuple[float, float], float]]:
    """Return the points at which a robot touches something, in the world's frame [m], with their forces [N]."""
    return [((touch.x, touch.y), touch.force) for touch in host.engine.touching(robot)]


def _int32(number: int) -> int:
    """Return a number as a signed 32-bit integer, with wrap-around."""
    return (number + 2**31) % 2**32 - 2**31
