"""A running Gazebo for the verbs."""

from __future__ import annotations

from ..gazebo.conftest import bench, graph

__all__ = ["bench", "graph"]
