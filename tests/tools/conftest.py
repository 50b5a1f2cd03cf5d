"""Fixtures of the verbs' tests: a Gazebo server to act on."""

from ..sim.gazebo.conftest import bench, graph  # noqa: F401 - fixtures
