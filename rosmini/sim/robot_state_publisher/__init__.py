"""`robot_state_publisher`: publishes transforms of a robot's links (http://wiki.ros.org/robot_state_publisher)."""

from __future__ import annotations

from .chain import Chain, joint_transform
from .description import read_description
from .node import RobotStatePublisher

__all__ = ["Chain", "RobotStatePublisher", "joint_transform", "read_description"]
