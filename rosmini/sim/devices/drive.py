"""The devices that move a robot and report its motion.

`cmd_vel` in; `odom`, `/tf`, `joint_states` and the ground truth out.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from functools import partial
from typing import Any, NamedTuple

from rosmini.core.errors import RosminiError, nearest
from rosmini.core.geometry.angles import normalize_angle
from rosmini.core.geometry.poses import Pose, compose, inverse
from rosmini.core.graph import MessageFactory
from rosmini.msgs import message_class
from rosmini.sim.engine.odometry import Odometry
from rosmini.sim.engine.robot import HolonomicRobot, Robot
from rosmini.sim.host import Device, Host, Stamp
from rosmini.sim.messages import (
    BASE,
    BASE_LINK,
    MAP,
    ODOM,
    ODOMETRY_FIELDS,
    POSE_COVARIANCE,
    MakeTransform,
    describe_odometry,
    moving_transform,
    odometry_values,
)

from .imu import ImuDevice
from .sensor import Outlet, Sensor

WHEELS = ("wheel_left_joint", "wheel_right_joint")
"""Names of TurtleBot3's wheel joints."""

SOURCES = ("encoder", "world", "start")
"""Sources of a drive's odometry: the wheel encoders, or the true pose in the world's frame or relative to the start."""


class OdometryReading(NamedTuple):
    """Odometry as reported: the pose in its frame, and the speeds ahead and aside [m/s] and to the left [rad/s]."""

    pose: Pose
    v: float
    vy: float
    w: float


class DifferentialDrive(Device):
    """Two driven wheels: a `geometry_msgs/Twist` in, `nav_msgs/Odometry` and a transform out.

    Args:
        host: the simulated world.
        robot: the engine's name of the robot.
        cmd_vel: the topic of the commands; None: commands by topic are not accepted.
        odom: the topic of the odometry; None: not published.
        odom_frame: the frame of the odometry.
        base_frame: the robot's frame.
        tf: the topic of the transform between the two, usually "/tf"; None: not published.
        rate: messages per second [Hz]; the robot model's if not given.
        timeout: duration of a command [s]; 0: until the next one, as in Gazebo. TurtleBot3 has 0.5, Stage 0.2.
        source: the source of the odometry: "encoder", "world" or "start", see `SOURCES`.
        imu: the source of the heading for odometry from encoders: TurtleBot3's firmware uses its IMU. None: the
            wheels.
        covariance: of x, y, z and the rotations about them, as stated in the messages.
        name: the device's name; robot/drive if not given.

    """

    order = 10.0
    saved = ("odometry", "reckoned", "_zero", "powered", "_heading")
    sideways = False
    """True if it can also move sideways."""

    def __init__(
        self,
        host: Host,
        robot: str,
        *,
        cmd_vel: str | None = "cmd_vel",
        odom: str | None = "odom",
        odom_frame: str = ODOM,
        base_frame: str = BASE,
        tf: str | None = None,
        rate: float | None = None,
        timeout: float = 0.0,
        source: str = "encoder",
        imu: ImuDevice | None = None,
        covariance: Sequence[float] = POSE_COVARIANCE,
        name: str | None = None,
    ) -> None:
        self.robot: Robot = host.engine.robot(robot)
        self.model = self.robot.model
        super().__init__(host, name or f"{robot}/drive", rate or self.model.rate)
        self.source = one_of("odometry source", source, SOURCES)
        self.timeout = timeout
        self.odom_frame, self.base_frame = odom_frame, base_frame
        self.odometry = Odometry(self.model)
        """Odometry from the encoders, and the IMU if used; computed even if the true pose is reported."""
        self._imu = imu
        self._heading = 0.0
        self.powered = True
        """False: the motors have no power, and commands have no effect."""
        self.reckoned = OdometryReading((0.0, 0.0, 0.0), 0.0, 0.0, 0.0)
        """The odometry that was reported last."""
        self._zero: Pose = self.robot.start
        self._warned: set[str] = set()
        self._outlet: Outlet | None = None
        if odom is not None:
            message = message_class("nav_msgs/Odometry")()
            describe_odometry(message, odom_frame, base_frame, covariance)
            self._outlet = Outlet(host.node, odom, message, ODOMETRY_FIELDS, queue_size=30)
        self._commands = None
        if cmd_vel is not None:
            twist = message_class("geometry_msgs/Twist")
            self._commands = host.node.subscriber(cmd_vel, twist, self._command, queue_size=1)
        self._transforms: OdometryTransforms | None = None
        if tf is not None:
            self.publish_transform(tf)

    def publish_transform(self, topic: str = "/tf") -> None:
        """Start publishing the transform from the odometry's frame to the robot's."""
        name = f"transforms of {topic} at {self.rate:g} Hz"
        there = next((device for device in self.host.devices if device.name == name), None)
        if there is None:
            there = self.host.add(OdometryTransforms(self.host, topic, self.rate, name))
        if isinstance(there, OdometryTransforms):
            self._transforms = there
            there.join(self)

    @property
    def commanded_by(self) -> str | None:
        """The topic of its commands, as a global name; None if it has none."""
        return None if self._commands is None else self._commands.topic

    # -- commands ------------------------------------------------------------------------------------------------

    def command(self, v: float, w: float, vy: float = 0.0) -> None:
        """Command the speeds ahead and to the side [m/s] and the turn to the left [rad/s] until the timeout.

        Raises `RosminiError` for a number that is not finite.
        """
        if not self.powered:
            v = w = vy = 0.0
        self.host.catch_up()
        if self.sideways:
            self.host.engine.command(self.robot.name, v, w, self.timeout, vy=vy)
        else:
            self.host.engine.command(self.robot.name, v, w, self.timeout)

    def power(self, on: bool) -> None:
        """Switch the motors' power: without power the robot stops, and no command moves it."""
        self.powered = on
        if not on:
            self.command(0.0, 0.0)

    def _command(self, message: Any) -> None:
        v, vy, w = message.linear.x, message.linear.y, message.angular.z
        if not self.sideways:
            vy = 0.0
        if not math.isfinite(v + vy + w):
            for field, value in (("linear.x", v), ("linear.y", vy), ("angular.z", w)):
                if not math.isfinite(value):
                    self._warn_invalid(message, field, value)
            v = vy = w = 0.0
        self.command(v, w, vy)

    def _warn_invalid(self, message: Any, field: str, value: float) -> None:
        sender = (message._connection_header or {}).get("callerid", "somebody")
        if sender not in self._warned and self._commands is not None:
            self._warned.add(sender)
            self.host.node.logwarn(
                f"{sender} published {field} = {value} on {self._commands.topic}: a velocity must be a finite "
                f"number. The robot stops instead, and so it will at each such message of {sender}, without another "
                "warning."
            )

    # -- odometry ------------------------------------------------------------------------------------------------

    def due(self, stamp: Stamp, _: int, /) -> None:
        """Update the odometry from the encoders and publish it."""
        self._update()
        if self._outlet is not None and self._outlet.num_connections():
            self._outlet.publish(stamp, odometry_values(*self.reckoned))

    def _update(self) -> None:
        robot = self.robot
        odometry = self.odometry
        odometry.update(*robot.ticks, 1 / self.rate, self._turn())
        if self.source == "encoder":
            self.reckoned = OdometryReading(odometry.pose, odometry.v, 0.0, odometry.w)
        else:
            self.reckoned = self._true()

    def _turn(self) -> float | None:
        """Return the robot's rotation since the last call according to the IMU [rad]; None without an IMU."""
        if self._imu is None:
            return None
        before, self._heading = self._heading, self._imu.heading
        return float(normalize_angle(self._heading - before))

    def _true(self) -> OdometryReading:
        robot = self.robot
        v, vy, w = robot.velocity
        pose = robot.pose if self.source == "world" else compose(inverse(self._zero), robot.pose)
        return OdometryReading(pose, v, vy, w)

    def reset(self) -> None:
        """Restart with zero odometry at the robot's start pose."""
        self.odometry = Odometry(self.model)
        self.reckoned = OdometryReading((0.0, 0.0, 0.0), 0.0, 0.0, 0.0)
        self._zero = self.robot.start
        self._turn()

    def reset_odometry(self) -> None:
        """Set the odometry to zero here and now, and keep the wheel angles: TurtleBot3's topic `reset`."""
        self._update()
        self.odometry.pose = (0.0, 0.0, 0.0)
        self._zero = self.robot.pose

    def close(self) -> None:
        """Close the topics."""
        if self._transforms is not None:
            self._transforms.leave(self)
        if self._outlet is not None:
            self._outlet.close()
        if self._commands is not None:
            self._commands.unregister()


class PlanarMove(DifferentialDrive):
    """A base that moves ahead, sideways and turns as commanded: Gazebo's planar move, Stage's drive "omni".

    Arguments as for `DifferentialDrive`.
    """

    sideways = True
    _reckoned_from: Pose = (0.0, 0.0, 0.0)

    def _update(self) -> None:
        robot = self.robot
        if self.source == "encoder" and isinstance(robot, HolonomicRobot):
            v, vy, w = robot.speeds
            self.reckoned = OdometryReading(compose(inverse(self._reckoned_from), robot.reckoned), v, vy, w)
        else:
            self.reckoned = self._true()

    def reset(self) -> None:
        """Restart with zero odometry at the robot's start pose."""
        super().reset()
        self._reckoned_from = (0.0, 0.0, 0.0)

    def reset_odometry(self) -> None:
        """Set the odometry to zero here and now."""
        super().reset_odometry()
        if isinstance(self.robot, HolonomicRobot):
            self._reckoned_from = self.robot.reckoned


class OdometryTransforms(Device):
    """The transforms of all drives with the same rate and topic, in one message; created by `publish_transform`."""

    order = 20.0

    def __init__(self, host: Host, topic: str, rate: float, name: str) -> None:
        super().__init__(host, name, rate)
        self._drives: dict[DifferentialDrive, MakeTransform] = {}
        self._list: Any = message_class("tf2_msgs/TFMessage")
        self._publisher = host.node.publisher(topic, self._list, queue_size=100)

    def join(self, drive: DifferentialDrive) -> None:
        """Add a drive."""
        self._drives[drive] = moving_transform(drive.odom_frame, drive.base_frame)

    def leave(self, drive: DifferentialDrive) -> None:
        """Remove a drive; the topic ends with the last one."""
        if self._drives.pop(drive, None) is not None and not self._drives:
            self.host.remove(self)

    def due(self, stamp: Stamp, _: int, /) -> None:
        """Publish the current transforms."""
        if self._publisher.num_connections():
            made = [make(*stamp, drive.reckoned.pose) for drive, make in self._drives.items()]
            self._publisher.publish(MessageFactory(partial(self._list, transforms=made), is_frozen=True))

    def state(self) -> Any:
        """Return the order of the drives."""
        return tuple(drive.name for drive in self._drives)

    def restore(self, state: Any) -> None:
        """Put the drives into that order."""
        place = {name: i for i, name in enumerate(state)}
        self._drives = dict(sorted(self._drives.items(), key=lambda item: place[item[0].name]))

    def close(self) -> None:
        """Close the topic."""
        self._publisher.unregister()


class JointStates(Sensor):
    """`sensor_msgs/JointState` of a drive's two wheels, as measured by the encoders.

    Args:
        host: the simulated world.
        drive: the drive with the wheels.
        topic: where it is published.
        joints: the names of the left and right wheel joints.
        frame: the frame of the header; TurtleBot3's firmware writes base_link, Gazebo's plugin leaves it empty.
        rate: messages per second [Hz]; the drive's if not given.
        name: the device's name; robot/joints if not given.

    """

    message_type = "sensor_msgs/JointState"
    default_topic, default_frame, label = "joint_states", BASE_LINK, "joints"
    order = 30.0
    queue_size = 30
    varying = ("position", "velocity")

    def __init__(
        self,
        host: Host,
        drive: DifferentialDrive,
        *,
        topic: str | None = None,
        joints: Sequence[str] = WHEELS,
        frame: str | None = None,
        rate: float | None = None,
        name: str | None = None,
    ) -> None:
        self.drive, self._joints = drive, joints
        super().__init__(host, drive.robot.name, topic=topic, frame=frame, rate=rate or drive.rate, name=name)

    def describe(self, message: Any) -> None:
        """Fill in the names of the joints."""
        message.name = list(self._joints)

    def sample(self, _: int) -> tuple[tuple[float, float], tuple[float, float]]:
        """Return the angles of the wheels [rad] and their speeds [rad/s]."""
        odometry = self.drive.odometry
        return (odometry.left, odometry.right), (odometry.left_rate, odometry.right_rate)


class GroundTruth(Sensor):
    """`nav_msgs/Odometry` of a robot's true pose: Stage's `base_pose_ground_truth`, Gazebo's p3d plugin.

    Args:
        host: the simulated world.
        robot: the engine's name of the robot.
        topic: where it is published.
        frame: the world's frame.
        child: the robot's frame.
        rate: messages per second [Hz]; the robot model's if not given.
        covariance: as the messages state it.
        name: the device's name; robot/truth if not given.

    """

    message_type = "nav_msgs/Odometry"
    default_topic, default_frame, label = "base_pose_ground_truth", MAP, "truth"
    order = 40.0
    queue_size = 30
    varying = ODOMETRY_FIELDS

    def __init__(
        self,
        host: Host,
        robot: str,
        *,
        topic: str | None = None,
        frame: str = MAP,
        child: str = BASE,
        rate: float | None = None,
        covariance: Sequence[float] = POSE_COVARIANCE,
        name: str | None = None,
    ) -> None:
        self._fixed = (frame, child, covariance)
        rate = rate or host.engine.robot(robot).model.rate
        super().__init__(host, robot, topic=topic, rate=rate, name=name)

    def describe(self, message: Any) -> None:
        """Fill in the frames and the covariances."""
        describe_odometry(message, *self._fixed)

    def sample(self, _: int) -> tuple[float, ...]:
        """Return the robot's true pose and velocity."""
        return odometry_values(self.robot.pose, *self.robot.velocity)


def one_of(what: str, value: str, values: Iterable[str]) -> str:
    """Return `value`. Raises `RosminiError`, with the nearest of `values`, if it is not among them."""
    known = tuple(values)
    if value not in known:
        hint = nearest(value, known) or f"it is one of {', '.join(known)}"
        msg = f"there is no {what} {value!r}; {hint}"
        raise RosminiError(msg)
    return value
