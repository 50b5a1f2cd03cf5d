"""`joint_state_publisher`: positions of joints for a robot that has none to tell (http://wiki.ros.org/joint_state_publisher)."""

from __future__ import annotations

from .node import JointStatePublisher
from .positions import Positions

__all__ = ["JointStatePublisher", "Positions"]
