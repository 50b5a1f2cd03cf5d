"""What moves a robot, and what tells how it moved: `cmd_vel` in; `odom`, `/tf`, `joint_states` and the ground truth out."""

from __future__ import annotations

import copy
import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from rosmini.geometry.angles import normalize_angle
from rosmini.geometry.poses import Pose, compose, inverse
from rosmini.graph import Publisher
from rosmini.msgs import message_class
from rosmini.sim.engine.odometry import Odometry
from rosmini.sim.engine.robot import HolonomicRobot
from rosmini.sim.host import Device, Host, Stamp
from rosmini.sim.messages import (
    BASE,
    BASE_LINK,
    MAP,
    ODOM,
    POSE_COVARIANCE,
    WHEELS,
    JointStateMessage,
    OdometryMessage,
    TransformMessage,
)

from .names import one_of, order

if TYPE_CHECKING:
    from rosmini.sim.engine.robot import Robot

    from .sensors import ImuDevice

SOURCES = ("encoder", "world", "start")
"""From where a drive takes its odometry: the encoders of its wheels; the truth in the frame of the world; the truth seen from where it started."""


class Reckoned(NamedTuple):
    """What odometry tells: the pose in its frame, and the speeds ahead and to the side [m/s] and to the left [rad/s]."""

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
        imu: what says how far the robot has turned, for an odometry from encoders: TurtleBot3's firmware asks its IMU. None: the wheels do.
        covariance: of x, y, z and the turns about them, as the odometry's messages state it.
        name: the device's; without it robot/drive.

    """

    order = order("drive")
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
        self._message = OdometryMessage(odom_frame, base_frame, covariance)
        self._publisher: Publisher | None = None
        if odom is not None:
            self._publisher = host.node.publisher(odom, type(self._message.message), queue_size=30)
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
        """Let the robot go ahead and to the side [m/s] and turn to the left [rad/s] until the time-out. Raises `RosminiError` for no finite number."""
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
                f"{sender} published {field} = {value} on {self._commands.topic}: a velocity has to be a finite number. "
                f"The robot stops instead, and so it will at each such message of {sender}, without another warning."
            )

    # -- odometry ------------------------------------------------------------------------------------------------

    def due(self, stamp: Stamp, _: int, /) -> None:
        """Learn what the encoders show now, and tell it."""
        self._update()
        publisher = self._publisher
        if publisher is not None and publisher.num_connections():
            message = self._message
            message.stamp(*stamp)
            publisher.publish(message.fill(*self.reckoned))

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
        v, vy, w = speeds(robot)
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
        if self._publisher is not None:
            self._publisher.unregister()
        if self._commands is not None:
            self._commands.unregister()


class PlanarMove(DifferentialDrive):
    """A base that goes ahead, to the side and turns as it is told: Gazebo's planar move, Stage's drive "omni". Arguments as for `DifferentialDrive`."""

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
    """The transforms of all drives of one rate that go to one topic: one message tells of all of them. Made by `publish_transform`."""

    order = order("transforms")

    def __init__(self, host: Host, topic: str, rate: float, name: str) -> None:
        super().__init__(host, name, rate)
        self._drives: dict[DifferentialDrive, TransformMessage] = {}
        self._list: Any = message_class("tf2_msgs/TFMessage")()
        self._publisher = host.node.publisher(topic, type(self._list), queue_size=100)

    def join(self, drive: DifferentialDrive) -> None:
        """Tell of this drive too."""
        self._drives[drive] = TransformMessage(drive.odom_frame, drive.base_frame)
        self._gather()

    def leave(self, drive: DifferentialDrive) -> None:
        """Tell no more of this drive; with the last one the topic ends."""
        if self._drives.pop(drive, None) is not None:
            self._gather()
            if not self._drives:
                self.host.remove(self)

    def _gather(self) -> None:
        self._list.transforms = [message.message for message in self._drives.values()]

    def due(self, stamp: Stamp, _: int, /) -> None:
        """Tell where all are."""
        if self._publisher.num_connections():
            secs, nsecs = stamp
            for drive, message in self._drives.items():
                message.stamp(secs, nsecs)
                message.fill(drive.reckoned.pose)
            self._publisher.publish(self._list)

    def state(self) -> Any:
        """In which sequence it tells of them."""
        return tuple(drive.name for drive in self._drives)

    def restore(self, state: Any) -> None:
        """Tell of them in that sequence."""
        place = {name: i for i, name in enumerate(state)}
        self._drives = dict(sorted(self._drives.items(), key=lambda item: place[item[0].name]))
        self._gather()

    def close(self) -> None:
        """End the topic."""
        self._publisher.unregister()


class JointStates(Device):
    """`sensor_msgs/JointState` of a drive's two wheels, as far as the encoders show it.

    Args:
        host: where it happens.
        drive: whose wheels.
        topic: where it is published.
        joints: the names of the left and of the right wheel's joint.
        frame: what the header says; TurtleBot3's firmware writes base_link, Gazebo's plugin nothing.
        rate: how often; without it as often as the odometry [Hz].
        name: the device's; without it robot/joints.

    """

    order = order("joints")

    def __init__(
        self,
        host: Host,
        drive: DifferentialDrive,
        *,
        topic: str = "joint_states",
        joints: Sequence[str] = WHEELS,
        frame: str = BASE_LINK,
        rate: float | None = None,
        name: str | None = None,
    ) -> None:
        super().__init__(host, name or f"{drive.robot.name}/joints", rate or drive.rate)
        self.drive = drive
        self._message = JointStateMessage(joints, frame)
        self._publisher = host.node.publisher(topic, type(self._message.message), queue_size=30)

    def due(self, stamp: Stamp, _: int, /) -> None:
        """Tell how far the wheels have turned."""
        if self._publisher.num_connections():
            self._message.stamp(*stamp)
            self._publisher.publish(self._message.fill(self.drive.odometry))

    def close(self) -> None:
        """End the topic."""
        self._publisher.unregister()


class GroundTruth(Device):
    """`nav_msgs/Odometry` of where a robot really is: Stage's `base_pose_ground_truth`, Gazebo's p3d plugin.

    Args:
        host: where it happens.
        robot: the engine's name of the robot.
        topic: where it is published.
        frame: the world's frame.
        child: the robot's own frame.
        rate: how often; without it as often as the robot's model says [Hz].
        noise: standard deviation of x, y [m] and the heading [rad]; Gazebo's `gaussianNoise`.
        covariance: as the messages state it.
        name: the device's; without it robot/truth.

    """

    order = order("truth")

    def __init__(
        self,
        host: Host,
        robot: str,
        *,
        topic: str = "base_pose_ground_truth",
        frame: str = MAP,
        child: str = BASE,
        rate: float | None = None,
        noise: float = 0.0,
        covariance: Sequence[float] = POSE_COVARIANCE,
        name: str | None = None,
    ) -> None:
        self.robot = host.engine.robot(robot)
        super().__init__(host, name or f"{robot}/truth", rate or self.robot.model.rate)
        self._message = OdometryMessage(frame, child, covariance)
        self._publisher = host.node.publisher(topic, type(self._message.message), queue_size=30)
        self._noise = noise
        self._rng = host.rng(self.name) if noise else None

    def due(self, stamp: Stamp, _: int, /) -> None:
        """Tell where it is."""
        x, y, theta = self.robot.pose
        if self._rng is not None:
            ex, ey, turn = (self._noise * self._rng.standard_normal(3)).tolist()
            x, y, theta = x + ex, y + ey, theta + turn
        if self._publisher.num_connections():
            message = self._message
            message.stamp(*stamp)
            self._publisher.publish(message.fill((x, y, theta), *speeds(self.robot)))

    def state(self) -> Any:
        """The noise that is still to come."""
        return copy.deepcopy(self._rng)

    def restore(self, state: Any) -> None:
        """Draw the noise that was drawn after that."""
        self._rng = copy.deepcopy(state)

    def close(self) -> None:
        """End the topic."""
        self._publisher.unregister()


def speeds(robot: Robot) -> tuple[float, float, float]:
    """How fast a robot really goes: ahead and to its left side [m/s], and to the left [rad/s]."""
    return robot.velocity
