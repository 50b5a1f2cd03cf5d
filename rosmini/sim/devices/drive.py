"""What moves a robot, and what tells how it moved: `cmd_vel` in.

`odom`, `/tf`, `joint_states` and the ground truth out.
"""

from __future__ import annotations

import copy
import math
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from rosmini.core.errors import RosminiError, nearest
from rosmini.core.geometry.angles import normalize_angle
from rosmini.core.geometry.poses import Pose, compose, inverse
from rosmini.msgs import message_class
from rosmini.sim.engine.odometry import Odometry
from rosmini.sim.engine.robot import HolonomicRobot
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

if TYPE_CHECKING:
    from rosmini.sim.engine.robot import Robot

WHEELS = ("wheel_left_joint", "wheel_right_joint")
"""The joints of TurtleBot3's wheels."""

SOURCES = ("encoder", "world", "start")
"""From where a drive takes its odometry: the encoders of its wheels; the truth in the frame of the world.

The truth seen from where it started.
"""


class Reckoned(NamedTuple):
    """What odometry reports: the pose in its frame, and the speeds ahead and aside [m/s] and to the left [rad/s]."""

    pose: Pose
    v: float
    vy: float
    w: float


class DifferentialDrive(Device):
    """Two driven wheels: a `geometry_msgs/Twist` in, `nav_msgs/Odometry` and a transform out.

    Args:
        host: where it happens.
        robot: the engine's name of the robot.
        cmd_vel: the topic of the commands; None: nobody can command it by a topic.
        odom: the topic of the odometry; None: it is not published.
        odom_frame: the frame that the odometry is told in.
        base_frame: the robot's own frame.
        tf: the topic of the transform between the two, as a rule "/tf"; None: it is not published.
        rate: how often; without it as often as the robot's model says [Hz].
        timeout: how long a command holds [s]; 0: until the next one, as in Gazebo. TurtleBot3 has 0.5, Stage 0.2.
        source: from where the odometry is taken: "encoder", "world" or "start", see `SOURCES`.
        imu: what says how far the robot has turned, for an odometry from encoders: TurtleBot3's firmware asks its IMU.
            None: the wheels do.
        covariance: of x, y, z and the turns about them, as the odometry's messages state it.
        name: the device's; without it robot/drive.

    """

    order = 10.0
    sideways = False
    """Whether it can go to the side as well."""

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
        """What the encoders show, and the IMU if it is asked, whatever is told of it."""
        self._imu = imu
        self._heading = 0.0
        self.powered = True
        """False: the motors get no current, and commands have no effect."""
        self.reckoned = Reckoned((0.0, 0.0, 0.0), 0.0, 0.0, 0.0)
        """What was told last."""
        self._zero: Pose = self.robot.start
        self._complained: set[str] = set()
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
        """Publish, from now on, where the robot's frame is in that of the odometry."""
        name = f"transforms of {topic} at {self.rate:g} Hz"
        there = next((device for device in self.host.devices if device.name == name), None)
        if there is None:
            there = self.host.add(OdometryTransforms(self.host, topic, self.rate, name))
        if isinstance(there, OdometryTransforms):
            self._transforms = there
            there.join(self)

    steered = False
    """Whether what it is told to turn is the angle of a wheel, as in a car."""

    @property
    def commanded_by(self) -> str | None:
        """The topic of its commands, as a global name; None: there is none."""
        return None if self._commands is None else self._commands.topic

    # -- commands ------------------------------------------------------------------------------------------------

    def command(self, v: float, w: float, vy: float = 0.0) -> None:
        """Let the robot go ahead and to the side [m/s] and turn to the left [rad/s] until the time-out.

        Raises `RosminiError` for no finite number.
        """
        if not self.powered:
            v = w = vy = 0.0
        self.host.catch_up()
        if self.sideways:
            self.host.engine.command(self.robot.name, v, w, self.timeout, vy=vy)
        else:
            self.host.engine.command(self.robot.name, v, w, self.timeout)

    def power(self, on: bool) -> None:
        """Give the motors current, or not: a robot whose motors get none stops, and no command moves it."""
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
                    self._refuse(message, field, value)
            v = vy = w = 0.0
        self.command(v, w, vy)

    def _refuse(self, message: Any, field: str, value: float) -> None:
        sender = (message._connection_header or {}).get("callerid", "somebody")
        if sender not in self._complained and self._commands is not None:
            self._complained.add(sender)
            self.host.node.logwarn(
                f"{sender} published {field} = {value} on {self._commands.topic}: a velocity has to be a finite "
                f"number. The robot stops instead, and so it will at each such message of {sender}, without another "
                "warning."
            )

    # -- odometry ------------------------------------------------------------------------------------------------

    def due(self, stamp: Stamp, _: int, /) -> None:
        """Learn what the encoders show now, and tell it."""
        self._update()
        if self._outlet is not None and self._outlet.heard():
            self._outlet.publish(stamp, odometry_values(*self.reckoned))

    def _update(self) -> None:
        robot = self.robot
        odometry = self.odometry
        odometry.update(*robot.ticks, 1 / self.rate, self._turn())
        if self.source == "encoder":
            self.reckoned = Reckoned(odometry.pose, odometry.v, 0.0, odometry.w)
        else:
            self.reckoned = self._true()

    def _turn(self) -> float | None:
        """How far the robot has turned since the last time as the IMU has it [rad]; None if none is asked."""
        if self._imu is None:
            return None
        before, self._heading = self._heading, self._imu.heading
        return float(normalize_angle(self._heading - before))

    def _true(self) -> Reckoned:
        robot = self.robot
        v, vy, w = robot.velocity
        pose = robot.pose if self.source == "world" else compose(inverse(self._zero), robot.pose)
        return Reckoned(pose, v, vy, w)

    def reset(self) -> None:
        """Begin with an odometry of zero, at the place where the robot is put back to."""
        self.odometry = Odometry(self.model)
        self.reckoned = Reckoned((0.0, 0.0, 0.0), 0.0, 0.0, 0.0)
        self._zero = self.robot.start
        self._turn()

    def reset_odometry(self) -> None:
        """Let the odometry be zero here and now, with wheels turned as far as they are: TurtleBot3's topic `reset`."""
        self._update()
        self.odometry.pose = (0.0, 0.0, 0.0)
        self._zero = self.robot.pose

    def state(self) -> Any:
        """The odometry, and whether the motors have current."""
        return copy.copy(self.odometry), self.reckoned, self._zero, self.powered, self._heading

    def restore(self, state: Any) -> None:
        """Believe what was believed then."""
        odometry, self.reckoned, self._zero, self.powered, self._heading = state
        self.odometry = copy.copy(odometry)

    def close(self) -> None:
        """End the topics."""
        if self._transforms is not None:
            self._transforms.leave(self)
        if self._outlet is not None:
            self._outlet.close()
        if self._commands is not None:
            self._commands.unregister()


class PlanarMove(DifferentialDrive):
    """A base that goes ahead, to the side and turns as it is told: Gazebo's planar move, Stage's drive "omni".

    Arguments as for `DifferentialDrive`.
    """

    sideways = True
    _reckoned_from: Pose = (0.0, 0.0, 0.0)

    def _update(self) -> None:
        robot = self.robot
        if self.source == "encoder" and isinstance(robot, HolonomicRobot):
            v, vy, w = robot.speeds
            self.reckoned = Reckoned(compose(inverse(self._reckoned_from), robot.reckoned), v, vy, w)
        else:
            self.reckoned = self._true()

    def reset(self) -> None:
        """Begin with an odometry of zero, at the place where the robot is put back to."""
        super().reset()
        self._reckoned_from = (0.0, 0.0, 0.0)

    def reset_odometry(self) -> None:
        """Let the odometry be zero here and now."""
        super().reset_odometry()
        if isinstance(self.robot, HolonomicRobot):
            self._reckoned_from = self.robot.reckoned

    def state(self) -> Any:
        """The odometry, and whether the motors have current."""
        return super().state(), self._reckoned_from

    def restore(self, state: Any) -> None:
        """Believe what was believed then."""
        own, self._reckoned_from = state
        super().restore(own)


class OdometryTransforms(Device):
    """The transforms of all drives of one rate on one topic, in one message. Made by `publish_transform`."""

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
        """Publish where all are."""
        if self._publisher.num_connections():
            made = [make(*stamp, drive.reckoned.pose) for drive, make in self._drives.items()]
            self._publisher.publish_frozen(self._list(transforms=made))

    def state(self) -> Any:
        """Return the order of the drives."""
        return tuple(drive.name for drive in self._drives)

    def restore(self, state: Any) -> None:
        """Put the drives into that order."""
        place = {name: i for i, name in enumerate(state)}
        self._drives = dict(sorted(self._drives.items(), key=lambda item: place[item[0].name]))

    def close(self) -> None:
        """End the topic."""
        self._publisher.unregister()


class JointStates(Sensor):
    """`sensor_msgs/JointState` of a drive's two wheels, as far as the encoders show it.

    Args:
        host: the simulated world.
        drive: whose wheels.
        topic: where it is published.
        joints: the names of the left and of the right wheel's joint.
        frame: the frame of the header; TurtleBot3's firmware writes base_link, Gazebo's plugin nothing.
        rate: how often [Hz]; as often as the odometry if not given.
        name: the device's; robot/joints if not given.

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
        """Return how far the wheels have turned [rad], and how fast they turn [rad/s]."""
        odometry = self.drive.odometry
        return (odometry.left, odometry.right), (odometry.left_rate, odometry.right_rate)


class GroundTruth(Sensor):
    """`nav_msgs/Odometry` of where a robot really is: Stage's `base_pose_ground_truth`, Gazebo's p3d plugin.

    Args:
        host: the simulated world.
        robot: the engine's name of the robot.
        topic: where it is published.
        frame: the world's frame.
        child: the robot's own frame.
        rate: how often [Hz]; as the robot's model says if not given.
        covariance: as the messages state it.
        name: the device's; robot/truth if not given.

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
        """Return where the robot is, and how fast it goes."""
        return odometry_values(self.robot.pose, *self.robot.velocity)


def one_of(what: str, value: str, values: Iterable[str]) -> str:
    """Return `value`. Raises `RosminiError`, with the nearest, if it is none of `values`."""
    known = tuple(values)
    if value not in known:
        hint = nearest(value, known) or f"it is one of {', '.join(known)}"
        msg = f"there is no {what} {value!r}; {hint}"
        raise RosminiError(msg)
    return value
