"""The robot and its world in three dimensions, through meshcat's API and without a server."""

from __future__ import annotations

from rosmini.viz.meshcat.gazebo import gazebo_3d
from rosmini.viz.meshcat.runs import replay_3d
from rosmini.viz.meshcat.urdf import urdf_3d
from rosmini.viz.meshcat.view import MeshcatView, robot_3d, simulation_3d

__all__ = ["MeshcatView", "gazebo_3d", "replay_3d", "robot_3d", "simulation_3d", "urdf_3d"]
