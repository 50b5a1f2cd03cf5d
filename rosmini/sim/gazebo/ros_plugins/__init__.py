"""The plugins of gazebo_ros_pkgs by their libraries' names, with their tags and defaults.

http://classic.gazebosim.org/tutorials?tut=ros_gzplugins
"""

from __future__ import annotations

from .cameras import BumperPlugin, CameraPlugin, DepthCameraPlugin
from .drives import DiffDrive, PlanarMove, SkidSteerDrive
from .imus import ImuModelPlugin, ImuSensorPlugin
from .joints_and_truth import GroundTruthPlugin, JointStatePublisher
from .lasers import LaserPlugin

__all__ = [
    "BumperPlugin",
    "CameraPlugin",
    "DepthCameraPlugin",
    "DiffDrive",
    "GroundTruthPlugin",
    "ImuModelPlugin",
    "ImuSensorPlugin",
    "JointStatePublisher",
    "LaserPlugin",
    "PlanarMove",
    "SkidSteerDrive",
]
