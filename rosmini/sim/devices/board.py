"""What TurtleBot3's board tells beside the motion: the battery, and the state of its switches, motors and encoders."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from rosmini.msgs import message_class
from rosmini.sim.host import Device, Host, Stamp
from rosmini.sim.sensors.battery import Battery, Charge
from rosmini.sim.sensors.contact_sensor import TURTLEBOT3_BUMPER, BumperModel, bits, pressed

from .drive import DifferentialDrive
from .sensor import Outlet, Sensor

if TYPE_CHECKING:
    from rosmini.sim.engine.robot import Robot

BOARD_RATE = 30.0
"""So often TurtleBot3's firmware tells its state [Hz]: DRIVE_INFORMATION_PUBLISH_FREQUENCY."""

DRAIN_S = 1.0
"""What was drawn is added up over so long, and then taken from the battery [s]."""


class BatteryDevice(Device):
    """`sensor_msgs/BatteryState` of a battery that drains, faster while the robot drives and pushes.

    When it is empty, the motors of `drive` get no current any more.

    Args:
        host: where it happens.
        robot: the engine's name of the robot.
        battery: which one; without it a Burger's, full.
        drive: whose motors it feeds; None: nothing happens to the robot when it is empty.
        topic: where it is published; None: nowhere.
        frame: what the header says.
        rate: how often [Hz].
        name: the device's; without it robot/battery.

    """

    order = 70.0
    kept = ("battery", "shown", "_used", "_since")

    def __init__(
        self,
        host: Host,
        robot: str,
        battery: Battery | None = None,
        *,
        drive: DifferentialDrive | None = None,
        topic: str | None = "battery_state",
        frame: str = "",
        rate: float = BOARD_RATE,
        name: str | None = None,
    ) -> None:
        super().__init__(host, name or f"{robot}/battery", rate)
        self.robot: Robot = host.engine.robot(robot)
        self.battery = battery or Battery()
        self.drive = drive
        self.shown: Charge = self.battery.read()
        """What it showed last."""
        self._used, self._since = 0.0, 0.0  # [J] and [s] that are not taken from it yet
        message: Any = message_class("sensor_msgs/BatteryState")()
        message.header.frame_id = frame
        model = self.battery.model
        message.design_capacity = message.capacity = model.capacity
        message.temperature = math.nan
        message.power_supply_status = message.POWER_SUPPLY_STATUS_DISCHARGING
        message.power_supply_health = message.POWER_SUPPLY_HEALTH_GOOD
        message.power_supply_technology = message.POWER_SUPPLY_TECHNOLOGY_LIPO
        message.location = model.name
        varying = ("voltage", "current", "charge", "percentage", "present")
        self._outlet = None if topic is None else Outlet(host.node, topic, message, varying)

    def due(self, stamp: Stamp, _: int, /) -> None:
        """Drain the battery, and tell how it is."""
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
        if self._outlet is not None and self._outlet.heard():
            shown = self.shown
            self._outlet.publish(
                stamp, (shown.voltage, shown.current, shown.charge, shown.percentage, not shown.empty)
            )

    def _drain(self) -> None:
        self.shown = self.battery.drain(self._used / self._since, self._since)
        self._used = self._since = 0.0
        if self.shown.empty and self.drive is not None and self.drive.powered:
            self.drive.power(False)
            self.host.node.logwarn(
                f"the battery of {self.robot.name} is empty, and its motors stop. Charge it: battery.level = 1.0"
            )

    def charge(self, level: float = 1.0) -> None:
        """Charge it, or put in another one that is so full (0 to 1); the motors get current again.

        Raises `BatteryError`.
        """
        self.battery.level = level
        self.shown = self.battery.read()
        if self.drive is not None and not self.shown.empty:
            self.drive.power(True)

    def close(self) -> None:
        """End the topic."""
        if self._outlet is not None:
            self._outlet.close()


class SensorStateDevice(Sensor):
    """`turtlebot3_msgs/SensorState`: bumper, motors, encoders and voltage.

    There is no cliff sensor, sonar, light sensor, lamp or button: 0.

    Args:
        host: the simulated world.
        drive: whose encoders and motors.
        battery: whose voltage; None: 0.0 V.
        bumper: which switches it has; a Burger as it is sold has none in its way.
        topic: where it is published.
        frame: the frame of the header; the firmware leaves it empty.
        rate: how often [Hz].
        name: the device's; robot/sensor_state if not given.

    """

    message_type = "turtlebot3_msgs/SensorState"
    default_topic, default_rate = "sensor_state", BOARD_RATE
    order = 80.0
    varying = ("bumper", "torque", "left_encoder", "right_encoder", "battery")

    def __init__(
        self,
        host: Host,
        drive: DifferentialDrive,
        battery: BatteryDevice | None = None,
        *,
        bumper: BumperModel = TURTLEBOT3_BUMPER,
        topic: str | None = None,
        frame: str | None = None,
        rate: float | None = None,
        name: str | None = None,
    ) -> None:
        super().__init__(host, drive.robot.name, topic=topic, frame=frame, rate=rate, name=name)
        self.drive, self.battery, self.bumper = drive, battery, bumper

    def sample(self, _: int) -> tuple[int, bool, int, int, float]:
        """Return the state of the switches, the motors, the encoders and the battery."""
        robot = self.robot
        sectors = pressed(self.bumper, robot.pose, contacts(self.host, robot.name))
        left, right = (_int32(ticks) for ticks in robot.ticks)
        return (
            bits(sectors),
            self.drive.powered,
            left,
            right,
            self.battery.shown.voltage if self.battery else 0.0,
        )


class Switches:
    """TurtleBot3's topics `motor_power` (std_msgs/Bool) and `reset` (std_msgs/Empty): current for the motors.

    Odometry at zero and a calibrated gyroscope.

    Args:
        host: where they are.
        drive: whose motors and odometry.
        calibrate: what is done at a reset before the odometry begins at zero.
        motor_power: the topic that switches the motors.
        reset: the topic that resets.

    """

    def __init__(
        self,
        host: Host,
        drive: DifferentialDrive,
        calibrate: Callable[[], None] | None = None,
        *,
        motor_power: str = "motor_power",
        reset: str = "reset",
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
        """End the topics."""
        for subscriber in self._subscribers:
            subscriber.unregister()


def contacts(host: Host, robot: str) -> list[tuple[tuple[float, float], float]]:
    """Where a robot touches something, in the frame of the world [m], and how hard [N]."""
    return [((touch.x, touch.y), touch.force) for touch in host.engine.touching(robot)]


def _int32(number: int) -> int:
    """A number as 32 bits hold it: what is too large begins again below."""
    return (number + 2**31) % 2**32 - 2**31
