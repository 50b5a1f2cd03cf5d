"""Joint states and ground truth: libgazebo_ros_joint_state_publisher.so and libgazebo_ros_p3d.so."""

from __future__ import annotations

import copy
import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from rosmini.markup import Element
from rosmini.msgs import message_class
from rosmini.sim.devices import GroundTruth, JointStates
from rosmini.sim.gazebo.model import WORLD_FRAMES, Model
from rosmini.sim.gazebo.msgs import quaternion
from rosmini.sim.gazebo.plugin_tags import Tags, tag
from rosmini.sim.gazebo.plugins import ModelPlugin
from rosmini.sim.host import Device, Host, Stamp
from rosmini.sim.sdf import Pose6
from rosmini.sim.sdf.poses import compose, inverse

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
        """Advertise its topic. Raises `UnknownEntity` for a joint that is not there."""
        tags = JointStateTags.read(sdf, self.world.node.logwarn)
        names = RosNames(model, sdf, default=model.name)
        joints = [name.strip() for name in tags.joints.split(",") if name.strip()]
        for joint in joints:
            model.joint(joint)
        rate = rate_of(tags.rate, self.world.physics.time_step)
        self.device = self.add(
            _JointStates(
                self.world.host, f"{self.name}/joints", rate, model, joints, names.topic("joint_states")
            )
        )


class _JointStates(Device):
    order = JointStates.order
    always = False

    def __init__(
        self, host: Host, name: str, rate: float, model: Model, joints: list[str], topic: str
    ) -> None:
        super().__init__(host, name, rate)
        self._model, self._joints = model, joints
        self._message: Any = message_class("sensor_msgs/JointState")()
        self._message.name = joints
        self._publisher = host.node.publisher(topic, type(self._message), queue_size=1000)

    def wanted(self) -> bool:
        return bool(self._publisher.num_connections())

    def due(self, stamp: Stamp, _: int, /) -> None:
        message = self._message
        message.header.stamp.secs, message.header.stamp.nsecs = stamp
        there = [self._model.joint(name) for name in self._joints]
        message.position = [position for position, _ in there]
        message.velocity = [rate for _, rate in there]
        self._publisher.publish(message)

    def close(self) -> None:
        self._publisher.unregister()


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
    """Publishes where a link really is as `nav_msgs/Odometry`, its velocities in the frame of the world."""

    def load(self, model: Model, sdf: Element) -> None:
        """Advertise its topic. Raises `MarkupError` and `UnknownEntity`."""
        tags = GroundTruthTags.read(sdf, self.world.node.logwarn)
        names = RosNames(model, sdf)
        model.link_frame(tags.body)
        dx, dy, dz = sdf.floats(tags.xyz, 3, "xyzOffsets")
        roll, pitch, yaw = sdf.floats(tags.rpy, 3, "rpyOffsets")
        self.device = self.add(
            _Truth(
                self.world.host,
                f"{self.name}/truth",
                rate_of(tags.rate, self.world.physics.time_step),
                model,
                tags,
                names,
                (dx, dy, dz, roll, pitch, yaw),
            )
        )


class _Truth(Device):
    order = GroundTruth.order
    always = False

    def __init__(
        self,
        host: Host,
        name: str,
        rate: float,
        model: Model,
        tags: GroundTruthTags,
        names: RosNames,
        offset: Pose6,
    ) -> None:
        super().__init__(host, name, rate)
        self._model, self._tags, self._offset = model, tags, offset
        self._message: Any = message_class("nav_msgs/Odometry")()
        self._message.header.frame_id = names.frame(tags.frame)
        self._message.child_frame_id = tags.body
        self._message.pose.covariance = self._message.twist.covariance = np.diag([tags.noise**2] * 6).ravel()
        self._publisher = host.node.publisher(names.topic(tags.topic), type(self._message), queue_size=1)
        self._rng = host.rng(name)
        self._deviation = tags.noise * model.world.noise

    def wanted(self) -> bool:
        return bool(self._publisher.num_connections())

    def due(self, stamp: Stamp, _: int, /) -> None:
        model, message = self._model, self._message
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
        error = self._rng.standard_normal(6) * self._deviation if self._deviation else np.zeros(6)
        message.header.stamp.secs, message.header.stamp.nsecs = stamp
        at, way = message.pose.pose, message.twist.twist
        at.position.x, at.position.y, at.position.z = x, y, z
        to = at.orientation
        to.x, to.y, to.z, to.w = quaternion(pose[3], pose[4], pose[5])
        way.linear.x, way.linear.y, way.linear.z = vx + error[0], vy + error[1], float(error[2])
        way.angular.x, way.angular.y, way.angular.z = float(error[3]), float(error[4]), w + error[5]
        self._publisher.publish(message)

    def state(self) -> Any:
        return copy.deepcopy(self._rng)

    def restore(self, state: Any) -> None:
        self._rng = copy.deepcopy(state)

    def close(self) -> None:
        self._publisher.unregister()
