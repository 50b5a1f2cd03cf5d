"""The plugins of rqt in the nine groups of its menu, and their counterparts here (http://wiki.ros.org/rqt/Plugins)."""

from __future__ import annotations

from functools import cache
from typing import NamedTuple

from .parts import Row, Rows
from .plugin import plugins
from .table import Table


class Entry(NamedTuple):
    """A line of the menu: group, name, package, and the counterpart here: the same tool or a replacement."""

    group: str
    name: str
    package: str
    here: str


OTHERS = (
    Entry("Configuration", "Launch", "rqt_launch", "roslaunch"),
    Entry("Introspection", "Package Graph", "rqt_dep", "rospack depends"),
    Entry("Introspection", "Process Monitor", "rqt_top", "top"),
    Entry("Miscellaneous Tools", "Python Console", "rqt_py_console", "a cell of the notebook"),
    Entry("Miscellaneous Tools", "Shell", "rqt_shell", "a terminal of JupyterLab"),
    Entry("Miscellaneous Tools", "Web", "rqt_web", "the browser"),
    Entry("Robot Tools", "Controller Manager", "rqt_controller_manager", "not here"),
    Entry("Robot Tools", "Diagnostics Viewer", "rqt_robot_monitor", "rostopic echo /diagnostics_agg"),
    Entry("Robot Tools", "Joint Trajectory Controller", "rqt_joint_trajectory_controller", "not here"),
    Entry("Robot Tools", "MoveIt! Monitor", "rqt_moveit", "not here"),
    Entry("Robot Tools", "Navigation Viewer", "rqt_nav_view", "rviz"),
    Entry("Robot Tools", "Runtime Monitor", "rqt_runtime_monitor", "rostopic echo /diagnostics"),
    Entry("Visualization", "Pose View", "rqt_pose_view", "simulator.show3d()"),
    Entry("Visualization", "RViz", "rqt_rviz", "rviz"),
)
"""Plugins of the real rqt that are not in this package."""


@cache
def menu() -> tuple[Entry, ...]:
    """Return all plugins, sorted by group and name."""
    own = (Entry(each.group, each.heading, each.tool, each.tool) for each in plugins() if each.group)
    return tuple(sorted((*OTHERS, *own)))


def rqt_plugins() -> Table:
    """Show the table of plugins."""
    rows = tuple(Row(entry) for entry in menu())
    part = Rows(("Group", "Plugin", "Package", "Here"), rows, "Plugins of rqt")
    return Table(part, title="rqt's plugins", noun="plugin")
