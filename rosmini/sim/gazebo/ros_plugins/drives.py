"""Drives: libgazebo_ros_diff_drive.so, libgazebo_ros_skid_steer_drive.so and libgazebo_ros_planar_move.so."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, ClassVar

from rosmini.core.markup import Element
from rosmini.msgs import message_class
from rosmini.sim.devices.drive import DifferentialDrive, JointStates, OdometryTransforms, one_of
from rosmini.sim.devices.drive import PlanarMove as PlanarMoveDevice
from rosmini.sim.gazebo.body import Body
from rosmini.sim.gazebo.model import Model
from rosmini.sim.gazebo.plugin_tags import Tags, tag
from rosmini.sim.gazebo.plugins import ModelPlugin
from rosmini.sim.host import Device, Host, Stamp
from rosmini.sim.messages import UNMEASURED
from rosmini.sim.sdf.poses import quaternion

from .ros_names import RosNames


@dataclass(frozen=True, kw_only=True)
class DriveTags(Tags):
    """The tags of all drives."""

    command_topic: str = tag("commandTopic", "cmd_vel", "the topic of commands")
    odometry_topic: str = tag("odometryTopic", "odom", "where the odometry is published")
    odometry_frame: str = tag("odometryFrame", "odom", "the frame of its messages")
    base_frame: str = tag("robotBaseFrame", "base_footprint", "the robot's own frame")
    rate: float = tag("updateRate", 100.0, "how often it publishes", unit="Hz")


class Drive(ModelPlugin):
    """The base of the plugins that drive a model."""

    needs_robot = True

    def options(self, names: RosNames, tags: DriveTags) -> dict[str, Any]:
        """Return the options of its device, including all topics."""
        return {
            "cmd_vel": names.topic(tags.command_topic),
            "odom": names.topic(tags.odometry_topic),
            "odom_frame": names.frame(tags.odometry_frame),
            "base_frame": names.frame(tags.base_frame),
            "tf": "/tf",
            "rate": rate_of(tags.rate),
            "source": "world",
            "name": f"{self.name}/drive",
        }


@dataclass(frozen=True, kw_only=True)
class DiffDriveTags(DriveTags):
    """The tags of libgazebo_ros_diff_drive.so."""

    ignored: ClassVar[tuple[str, ...]] = ("wheelTorque",)

    odometry_source: str = tag("odometrySource", "world", "encoder: what the wheels' turns tell; world: the truth")
    publish_odom_tf: bool = tag("publishOdomTF", True, "publish the transform between the two frames")
    publish_tf: bool = tag("publishTf", True, "publish the odometry at all")
    publish_wheel_tf: bool = tag("publishWheelTF", False, "publish the transforms of the wheels")
    legacy: bool = tag(
        "legacyMode",
        True,
        "left and right are exchanged, as they once were by mistake; here it is seen where the wheels are",
    )
    publish_joints: bool = tag("publishWheelJointState", False, "publish how far the wheels have turned")
    separation: float = tag("wheelSeparation", 0.34, "how far the wheels are apart", unit="m")
    diameter: float = tag("wheelDiameter", 0.15, "of the wheels", unit="m")
    acceleration: float = tag("wheelAcceleration", 0.0, "how fast a rim's speed changes; 0: at once", unit="m/s2")
    left: str = tag("leftJoint", "left_joint", "the left wheel's joint")
    right: str = tag("rightJoint", "right_joint", "the right wheel's joint")


class DiffDrive(Drive, filename="libgazebo_ros_diff_drive.so"):
    """Two driven wheels. A command holds until the next one, as in Gazebo."""

    @classmethod
    def prepare(cls, body: Body, sdf: Element, complain: Callable[[str], object]) -> None:
        """Set up the wheels."""
        tags = DiffDriveTags.read(sdf, complain)
        _check_wheels(sdf, tags.separation, tags.diameter)
        one_of("odometrySource", tags.odometry_source, ("encoder", "world"))
        body.set_wheels(tags.left, tags.right, tags.separation, tags.diameter / 2)
        exchanged = body.wheels == (tags.right, tags.left)
        if tags.legacy != exchanged:
            where = f"{sdf.path}:{sdf.line}"
            word = "false" if tags.legacy else "true"
            complain(
                f"{where}: in Gazebo this robot would turn the other way round, for its joint {tags.left!r} is on the "
                f"{'right' if exchanged else 'left'}: say <legacyMode>{word}</legacyMode>"
            )
        body.wheel_acceleration = tags.acceleration or math.inf
        body.rate = rate_of(tags.rate)

    def load(self, model: Model, sdf: Element) -> None:
        """Advertise its topics."""
        tags = DiffDriveTags.read(sdf, lambda _: None)
        names = RosNames(model, sdf)
        host, options = self.world.host, self.options(names, tags)
        if not tags.publish_tf:
            options |= {"odom": None, "tf": None}
        if not tags.publish_odom_tf:
            options["tf"] = None
        options["source"] = tags.odometry_source
        drive = self.add(DifferentialDrive(host, model.name, **options))
        if tags.publish_wheel_tf:
            name = f"{self.name}/wheels"
            self.add(WheelTransforms(host, name, rate_of(tags.rate), model, names))
        if tags.publish_joints:
            self.add(
                JointStates(
                    host,
                    drive,
                    topic=names.topic("joint_states"),
                    joints=(model.body.wheels if model.body is not None else None) or (tags.left, tags.right),
                    frame="",
                    name=f"{self.name}/joints",
                )
            )


@dataclass(frozen=True, kw_only=True)
class SkidSteerTags(DriveTags):
    """The tags of libgazebo_ros_skid_steer_drive.so."""

    ignored: ClassVar[tuple[str, ...]] = ("torque",)

    broadcast_tf: bool = tag("broadcastTF", False, "publish the transform between the two frames")
    separation: float = tag("wheelSeparation", 0.4, "how far left and right wheels are apart", unit="m")
    diameter: float = tag("wheelDiameter", 0.15, "of the wheels", unit="m")
    left_front: str = tag("leftFrontJoint", "left_front_joint", "the joint of a wheel")
    right_front: str = tag("rightFrontJoint", "right_front_joint", "the joint of a wheel")
    left_rear: str = tag("leftRearJoint", "left_rear_joint", "the joint of a wheel")
    right_rear: str = tag("rightRearJoint", "right_rear_joint", "the joint of a wheel")
    covariance_x: float = tag("covariance_x", 1e-4, "of the odometry", unit="m2")
    covariance_y: float = tag("covariance_y", 1e-4, "of the odometry", unit="m2")
    covariance_yaw: float = tag("covariance_yaw", 0.01, "of the odometry", unit="rad2")


class SkidSteerDrive(Drive, filename="libgazebo_ros_skid_steer_drive.so"):
    """Four driven wheels, as on a Husky: the two on a side turn alike.

    It moves like a robot on two wheels `wheelSeparation` apart in the middle of the four: the skidding of real wheels
    in a turn is not simulated. Its odometry is the true pose.
    """

    @classmethod
    def prepare(cls, body: Body, sdf: Element, complain: Callable[[str], object]) -> None:
        """Set up the wheels."""
        tags = SkidSteerTags.read(sdf, complain)
        _check_wheels(sdf, tags.separation, tags.diameter)
        rear = (tags.left_rear, tags.right_rear)
        body.set_wheels(tags.left_front, tags.right_front, tags.separation, tags.diameter / 2, rear)
        body.rate = rate_of(tags.rate)

    def load(self, model: Model, sdf: Element) -> None:
        """Advertise its topics."""
        tags = SkidSteerTags.read(sdf, lambda _: None)
        names = RosNames(model, sdf)
        options = self.options(names, tags)
        if not tags.broadcast_tf:
            options["tf"] = None
        covariance = (tags.covariance_x, tags.covariance_y, *(UNMEASURED,) * 3, tags.covariance_yaw)
        self.add(DifferentialDrive(self.world.host, model.name, covariance=covariance, **options))


def _check_wheels(sdf: Element, separation: float, diameter: float) -> None:
    for name, value in (("wheelSeparation", separation), ("wheelDiameter", diameter)):
        if value <= 0:
            raise sdf.need(name).error(f"<{name}> is more than 0 m, not {value:g}")


class WheelTransforms(Device):
    """The transforms from a drive's base to its wheels, on /tf: `<publishWheelTF>`."""

    order = OdometryTransforms.order
    always = False

    def __init__(self, host: Host, name: str, rate: float, model: Model, names: RosNames) -> None:
        super().__init__(host, name, rate)
        self._model = model
        self._message: Any = message_class("tf2_msgs/TFMessage")()
        self._links: list[str] = []
        for joint in model.sdf.joints:
            if model.body is not None and joint.name in model.body.sides:
                told = message_class("geometry_msgs/TransformStamped")()
                told.header.frame_id, told.child_frame_id = (names.frame(joint.parent), names.frame(joint.child))
                self._message.transforms.append(told)
                self._links.append(joint.child)
        self._publisher = host.node.publisher("/tf", type(self._message), queue_size=100)

    def wanted(self) -> bool:
        """Return True if the topic has a subscriber."""
        return self._publisher.num_connections() > 0

    def due(self, stamp: Stamp, _: int, /) -> None:
        """Publish the poses of the wheels."""
        for link, told in zip(self._links, self._message.transforms, strict=True):
            told.header.stamp.secs, told.header.stamp.nsecs = stamp
            way, turn = told.transform.translation, told.transform.rotation
            way.x, way.y, way.z, roll, pitch, yaw = self._model.link_in_model(link)
            turn.x, turn.y, turn.z, turn.w = quaternion(roll, pitch, yaw)
        self._publisher.publish(self._message)

    def close(self) -> None:
        """Close the topic."""
        self._publisher.unregister()


@dataclass(frozen=True, kw_only=True)
class PlanarMoveTags(DriveTags):
    """The tags of libgazebo_ros_planar_move.so."""

    rate: float = tag("odometryRate", 20.0, "how often it publishes", unit="Hz")
    timeout: float = tag("cmdTimeout", -1.0, "how long a command holds; below 0: until the next", unit="s")


class PlanarMove(Drive, filename="libgazebo_ros_planar_move.so"):
    """A model that moves in any direction on the ground as commanded. Its odometry is the true pose."""

    @classmethod
    def prepare(cls, body: Body, sdf: Element, complain: Callable[[str], object]) -> None:
        """Set a holonomic drive."""
        body.drive = "holonomic"
        body.rate = rate_of(PlanarMoveTags.read(sdf, complain).rate)

    def load(self, model: Model, sdf: Element) -> None:
        """Advertise its topics."""
        tags = PlanarMoveTags.read(sdf, lambda _: None)
        names = RosNames(model, sdf)
        options = self.options(names, tags)
        move = PlanarMoveDevice(self.world.host, model.name, timeout=max(0.0, tags.timeout), **options)
        self.device = self.add(move)


def rate_of(rate: float, step: float = 0.001) -> float:
    """Return the rate [Hz] for a plugin's value: 0 means once in each physics step."""
    return rate if rate > 0 else 1 / step
