"""`joint_state_publisher`: joint positions for a robot without motors (http://wiki.ros.org/joint_state_publisher)."""

from __future__ import annotations

from .node import JointStatePublisher
from .positions import Positions

__all__ = ["JointStatePublisher", "Positions"]
