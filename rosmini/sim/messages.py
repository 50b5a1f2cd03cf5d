"""From what a robot does and measures to the messages that say so. Each is made once and filled again and again: publishing takes a snapshot."""

from __future__ import annotations

import math
import struct
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.geometry.poses import Pose
from rosmini.msgs import message_class

from .engine.odometry import Odometry
from .engine.robot import Robot
from .models import LidarModel
from .sensors.imu import Imu

Floats = NDArray[np.float64]

ODOM, BASE, MAP, BASE_LINK = "odom", "base_footprint", "map", "base_link"
"""REP 105's frames, and the one that TurtleBot3's firmware writes into its joint states."""

WHEELS = ["wheel_left_joint", "wheel_right_joint"]

STILL = (0.0, 0.0)

UNMEASURED = 1e12
POSE_COVARIANCE = (1e-5, 1e-5, UNMEASURED, UNMEASURED, UNMEASURED, 1e-3)
"""Of x, y, z and the turns about them, as Gazebo's differential drive states them; the robot's firmware leaves them at 0."""

ORIENTATION_COVARIANCE, GYRO_COVARIANCE, ACCEL_COVARIANCE = 0.0025, 0.02, 0.04
"""As TurtleBot3's firmware states them."""


_pair = struct.Struct("<2d").pack


def diagonal(values: Sequence[float]) -> Floats:
    """A matrix with these values on its diagonal, row by row, as messages hold covariances.

    The array lies over bytes, so that nobody can write to it, and publishing need not copy it.
    """
    return np.frombuffer(np.diag(values).tobytes())


def quick(part: Any) -> Any:
    """Return a message within a message as one that is filled faster: its layer without the check of field names."""
    part.__class__ = type(part)._fields_class
    return part


class Headed:
    """A message with a header."""

    def __init__(self, type_name: str, frame: str) -> None:
        self.message: Any = message_class(type_name)()
        self.message.header.frame_id = frame
        self._stamp = self.message.header.stamp

    def stamp(self, secs: int, nsecs: int) -> None:
        """Say when it was so."""
        stamp = self._stamp
        stamp.secs, stamp.nsecs = secs, nsecs


class OdometryMessage(Headed):
    """`nav_msgs/Odometry`: a pose, and the speeds in the robot's own frame."""

    def __init__(self, frame: str, child: str, covariance: Sequence[float] = POSE_COVARIANCE) -> None:
        super().__init__("nav_msgs/Odometry", frame)
        self.message.child_frame_id = child
        self.message.pose.covariance = diagonal(covariance)
        self.message.twist.covariance = diagonal(covariance)
        pose, twist = self.message.pose.pose, self.message.twist.twist
        self._position, self._orientation = quick(pose.position), quick(pose.orientation)
        self._linear, self._angular = quick(twist.linear), quick(twist.angular)

    def fill(self, pose: Pose, v: float, vy: float, w: float) -> Any:
        """Say where it is, and how fast it goes ahead and to its left side [m/s] and turns to the left [rad/s]."""
        self._position.x, self._position.y = pose[0], pose[1]
        half = pose[2] / 2
        self._orientation.z, self._orientation.w = math.sin(half), math.cos(half)
        self._linear.x, self._linear.y, self._angular.z = v, vy, w
        return self.message


class TransformMessage(Headed):
    """`geometry_msgs/TransformStamped`, one of those that a `tf2_msgs/TFMessage` lists."""

    def __init__(self, frame: str, child: str) -> None:
        super().__init__("geometry_msgs/TransformStamped", frame)
        self.message.child_frame_id = child
        self._translation = quick(self.message.transform.translation)
        self._rotation = quick(self.message.transform.rotation)

    def fill(self, pose: Pose) -> Any:
        """Say where it is."""
        self._translation.x, self._translation.y = pose[0], pose[1]
        half = pose[2] / 2
        self._rotation.z, self._rotation.w = math.sin(half), math.cos(half)
        return self.message


class JointStateMessage(Headed):
    """`sensor_msgs/JointState`: how far two wheels have turned, and how fast they do."""

    def __init__(self, joints: Sequence[str] = WHEELS, frame: str = BASE_LINK) -> None:
        super().__init__("sensor_msgs/JointState", frame)
        self.message.name = list(joints)
        self.message.effort = np.frombuffer(b"")

    def fill(self, odometry: Odometry) -> Any:
        """Say what the encoders showed."""
        self.message.position = np.frombuffer(_pair(odometry.left, odometry.right))
        self.message.velocity = np.frombuffer(_pair(odometry.left_rate, odometry.right_rate))
        return self.message


class ImuMessage(Headed):
    """`sensor_msgs/Imu` (REP 145)."""

    def __init__(self, frame: str) -> None:
        super().__init__("sensor_msgs/Imu", frame)
        message = self.message
        message.orientation_covariance = diagonal((ORIENTATION_COVARIANCE,) * 3)
        message.angular_velocity_covariance = diagonal((GYRO_COVARIANCE,) * 3)
        message.linear_acceleration_covariance = diagonal((ACCEL_COVARIANCE,) * 3)
        self._orientation = quick(message.orientation)
        self._gyro, self._accel = quick(message.angular_velocity), quick(message.linear_acceleration)

    def fill(self, imu: Imu, number: int, robot: Robot, heading: float) -> Any:
        """Say what sample `number` shows, if the robot had this heading [rad] when the unit was switched on."""
        v, w, dv, dw = robot.motion()
        aside = STILL
        if robot.model.drive != "differential":
            aside = (robot.velocity[1], robot.acceleration_aside)
        gyro, accel = self._gyro, self._accel
        gyro.x, gyro.y, gyro.z, accel.x, accel.y, accel.z = imu.read(number, v, w, dv, dw, aside)
        half = imu.heading(number, robot.pose[2] - heading) / 2
        self._orientation.z, self._orientation.w = math.sin(half), math.cos(half)
        return self.message


class ScanMessage(Headed):
    """`sensor_msgs/LaserScan`."""

    def __init__(self, lidar: LidarModel, frame: str, rate: float) -> None:
        super().__init__("sensor_msgs/LaserScan", frame)
        message = self.message
        message.angle_min, message.angle_max = lidar.angle_min, lidar.last_angle
        message.angle_increment = lidar.increment
        message.scan_time = 1 / rate
        message.range_min, message.range_max = lidar.range_min, lidar.range_max

    def fill(self, ranges: Floats) -> Any:
        """Say what the laser measured."""
        self.message.ranges = ranges.astype(np.float32)
        return self.message
