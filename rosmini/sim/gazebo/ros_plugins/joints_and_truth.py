"""Joint states and ground truth: libgazebo_ros_joint_state_publisher.so and libgazebo_ros_p3d.so."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from rosmini.core.markup import Element
from rosmini.sim.devices.drive import GroundTruth, JointStates
from rosmini.sim.devices.sensor import Sensor
from rosmini.sim.gazebo.model import WORLD_FRAMES, Model
from rosmini.sim.gazebo.plugin_tags import Tags, tag
from rosmini.sim.gazebo.plugins import ModelPlugin
from rosmini.sim.sdf.document import Pose6
from rosmini.sim.sdf.poses import compose, inverse, quaternion

from .drives import rate_of
from .ros_names import RosNames


@dataclass(frozen=True, kw_only=True)
class JointStateTags(Tags):
    """The tags of libgazebo_ros_joint_state_publisher.so."""

    joints: str = tag("jointName", meaning="the joints, with commas between")
    rate: float = tag("updateRate", 100.0, "how often", unit="Hz")


class JointStatePublisher(ModelPlugin, filename="libgazebo_ros_joint_state_publisher.so"):
    """Publishes `sensor_msgs/JointState` on `joint_states`, by default in a namespace of the model's name."""

    def load(self, model: Model, sdf: Element) -> None:
        """Advertise its topic. Raises `UnknownEntity` for a joint that does not exist."""
        tags = JointStateTags.read(sdf, self.world.node.logwarn)
        names = RosNames(model, sdf, default=model.name)
        joints = [name.strip() for name in tags.joints.split(",") if name.strip()]
        for joint in joints:
            model.joint(joint)
        self.device = self.add(
            _JointStates(
                model,
                joints,
                topic=names.topic("joint_states"),
                rate=rate_of(tags.rate, self.world.physics.time_step),
                name=f"{self.name}/joints",
            )
        )


class _JointStates(Sensor):
    message_type = "sensor_msgs/JointState"
    order = JointStates.order
    queue_size = 1000
    varying = ("position", "velocity")

    def __init__(self, model: Model, joints: list[str], **options: Any) -> None:
        self._model, self._joints = model, joints
        super().__init__(model.world.host, None, **options)

    def describe(self, message: Any) -> None:
        message.name = self._joints

    def sample(self, _: int) -> tuple[tuple[float, ...], ...]:
        there = [self._model.joint(name) for name in self._joints]
        return tuple(position for position, _ in there), tuple(rate for _, rate in there)


@dataclass(frozen=True, kw_only=True)
class GroundTruthTags(Tags):
    """The tags of libgazebo_ros_p3d.so."""

    body: str = tag("bodyName", meaning="the link that is told of")
    topic: str = tag("topicName", meaning="where it is published")
    frame: str = tag("frameName", "world", "the frame of its messages: world, map, or a link")
    noise: float = tag("gaussianNoise", 0.0, "standard deviation of the velocities", unit="m/s, rad/s")
    rate: float = tag("updateRate", 0.0, "how often; 0: in each step", unit="Hz")
    xyz: str = tag("xyzOffsets", "0 0 0", "added to the position", unit="m")
    rpy: str = tag("rpyOffsets", "0 0 0", "turns the orientation", unit="rad")


class GroundTruthPlugin(ModelPlugin, filename="libgazebo_ros_p3d.so"):
    """Publishes the true pose of a link as `nav_msgs/Odometry`, with velocities in the world's frame."""

    def load(self, model: Model, sdf: Element) -> None:
        """Advertise its topic. Raises `MarkupError` and `UnknownEntity`."""
        tags = GroundTruthTags.read(sdf, self.world.node.logwarn)
        names = RosNames(model, sdf)
        model.link_frame(tags.body)
        dx, dy, dz = sdf.floats(tags.xyz, 3, "xyzOffsets")
        roll, pitch, yaw = sdf.floats(tags.rpy, 3, "rpyOffsets")
        self.device = self.add(
            _Truth(
                model,
                tags,
                (dx, dy, dz, roll, pitch, yaw),
                topic=names.topic(tags.topic),
                frame=names.frame(tags.frame),
                rate=rate_of(tags.rate, self.world.physics.time_step),
                name=f"{self.name}/truth",
            )
        )


class _Truth(Sensor):
    message_type = "nav_msgs/Odometry"
    order = GroundTruth.order
    queue_size = 1
    varying = (
        *(f"pose.pose.position.{axis}" for axis in "xyz"),
        *(f"pose.pose.orientation.{axis}" for axis in "xyzw"),
        *(f"twist.twist.{kind}.{axis}" for kind in ("linear", "angular") for axis in "xyz"),
    )

    def __init__(self, model: Model, tags: GroundTruthTags, offset: Pose6, **options: Any) -> None:
        self._model, self._tags, self._offset = model, tags, offset
        self._deviation = tags.noise * model.world.noise
        super().__init__(model.world.host, None, **options)
        self._rng = self.host.rng(self.name)

    def describe(self, message: Any) -> None:
        message.child_frame_id = self._tags.body
        message.pose.covariance = message.twist.covariance = np.diag([self._tags.noise**2] * 6).ravel()

    def sample(self, _: int) -> tuple[float, ...]:
        model = self._model
        pose, (vx, vy, w) = model.link_pose(self._tags.body), model.link_velocity(self._tags.body)
        if self._tags.frame not in (*WORLD_FRAMES, "/world"):
            frame = model.link_pose(self._tags.frame)
            fx, fy, fw = model.link_velocity(self._tags.frame)
            pose = compose(inverse(frame), pose)
            c, s = math.cos(frame[5]), math.sin(frame[5])
            vx, vy, w = c * (vx - fx) + s * (vy - fy), c * (vy - fy) - s * (vx - fx), w - fw
        dx, dy, dz, *turn = self._offset
        x, y, z = pose[0] + dx, pose[1] + dy, pose[2] + dz
        if any(turn):
            pose = compose((0.0, 0.0, 0.0, turn[0], turn[1], turn[2]), (0.0, 0.0, 0.0, *pose[3:]))
        speeds = np.array([vx, vy, 0.0, 0.0, 0.0, w])
        if self._deviation:
            speeds += self._rng.standard_normal(6) * self._deviation
        return (x, y, z, *quaternion(pose[3], pose[4], pose[5]), *speeds.tolist())
