"""Fixtures of the verbs' tests: a Gazebo server to act on."""

from ..sim.conftest import graph  # noqa: F401 - a fixture
from ..sim.gazebo.conftest import bench  # noqa: F401 - a fixture
