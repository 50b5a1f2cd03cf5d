"""What TurtleBot3's board tells beside the motion: the battery, and the state of its switches, motors and encoders."""

from __future__ import annotations

import copy
import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from rosmini.msgs import message_class
from rosmini.sim.host import Device, Host, Stamp
from rosmini.sim.messages import Headed
from rosmini.sim.sensors.battery import Battery, Charge
from rosmini.sim.sensors.contact_sensor import TURTLEBOT3_BUMPER, BumperModel, bits, pressed

from .drive import DifferentialDrive
from .names import order

if TYPE_CHECKING:
    from rosmini.sim.engine.robot import Robot

BOARD_RATE = 30.0
"""So often TurtleBot3's firmware tells its state [Hz]: DRIVE_INFORMATION_PUBLISH_FREQUENCY."""

DRAIN_S = 1.0
"""What was drawn is added up over so long, and then taken from the battery [s]."""


class BatteryDevice(Device):
    """`sensor_msgs/BatteryState` of a battery that drains while the robot stands, and faster while it drives and pushes.

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

    order = order("battery")

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
        self._told = Headed("sensor_msgs/BatteryState", frame)
        message = self._told.message
        model = self.battery.model
        message.design_capacity = message.capacity = model.capacity
        message.temperature = math.nan
        message.power_supply_status = message.POWER_SUPPLY_STATUS_DISCHARGING
        message.power_supply_health = message.POWER_SUPPLY_HEALTH_GOOD
        message.power_supply_technology = message.POWER_SUPPLY_TECHNOLOGY_LIPO
        message.present = True
        message.location = model.name
        self._publisher = None
        if topic is not None:
            self._publisher = host.node.publisher(topic, type(message), queue_size=10)

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
        if self._publisher is not None and self._publisher.num_connections():
            shown, message = self.shown, self._told.message
            message.voltage, message.current, message.charge = shown.voltage, shown.current, shown.charge
            message.percentage = shown.percentage
            message.present = not shown.empty
            self._told.stamp(*stamp)
            self._publisher.publish(message)

    def _drain(self) -> None:
        self.shown = self.battery.drain(self._used / self._since, self._since)
        self._used = self._since = 0.0
        if self.shown.empty and self.drive is not None and self.drive.powered:
            self.drive.power(False)
            self.host.node.logwarn(
                f"the battery of {self.robot.name} is empty, and its motors stop. Charge it: battery.level = 1.0"
            )

    def charge(self, level: float = 1.0) -> None:
        """Charge it, or put in another one that is so full (0 to 1); the motors get current again. Raises `BatteryError`."""
        self.battery.level = level
        self.shown = self.battery.read()
        if self.drive is not None and not self.shown.empty:
            self.drive.power(True)

    def state(self) -> Any:
        """The charge."""
        return copy.deepcopy(self.battery), self.shown, self._used, self._since

    def restore(self, state: Any) -> None:
        """Be as full as then."""
        battery, self.shown, self._used, self._since = state
        self.battery = copy.deepcopy(battery)

    def close(self) -> None:
        """End the topic."""
        if self._publisher is not None:
            self._publisher.unregister()


class SensorStateDevice(Device):
    """`turtlebot3_msgs/SensorState`: bumper, motors, encoders and voltage. There is no cliff sensor, sonar, light sensor, lamp or button: 0.

    Args:
        host: where it happens.
        drive: whose encoders and motors.
        battery: whose voltage; None: 0.0 V.
        bumper: which switches it has; a Burger as it is sold has none in its way.
        topic: where it is published.
        frame: what the header says; the firmware writes nothing.
        rate: how often [Hz].
        name: the device's; without it robot/sensor_state.

    """

    order = order("sensor_state")
    always = False

    def __init__(
        self,
        host: Host,
        drive: DifferentialDrive,
        battery: BatteryDevice | None = None,
        *,
        bumper: BumperModel = TURTLEBOT3_BUMPER,
        topic: str = "sensor_state",
        frame: str = "",
        rate: float = BOARD_RATE,
        name: str | None = None,
    ) -> None:
        self.robot: Robot = drive.robot
        super().__init__(host, name or f"{self.robot.name}/sensor_state", rate)
        self.drive, self.battery, self.bumper = drive, battery, bumper
        self._told = Headed("turtlebot3_msgs/SensorState", frame)
        self._publisher = host.node.publisher(topic, type(self._told.message), queue_size=10)

    def wanted(self) -> bool:
        """Tell whether anybody listens."""
        return self._publisher.num_connections() > 0

    def due(self, stamp: Stamp, _: int, /) -> None:
        """Tell the state."""
        robot, message = self.robot, self._told.message
        message.bumper = bits(pressed(self.bumper, robot.pose, contacts(self.host, robot.name)))
        message.torque = self.drive.powered
        message.left_encoder, message.right_encoder = (_int32(ticks) for ticks in robot.ticks)
        message.battery = 0.0 if self.battery is None else self.battery.shown.voltage
        self._told.stamp(*stamp)
        self._publisher.publish(message)

    def close(self) -> None:
        """End the topic."""
        self._publisher.unregister()


class Switches:
    """TurtleBot3's topics `motor_power` (std_msgs/Bool) and `reset` (std_msgs/Empty): current for the motors; odometry at zero and a calibrated gyroscope.

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
