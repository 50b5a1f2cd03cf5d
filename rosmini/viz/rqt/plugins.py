"""The plugins of rqt in the nine groups of its menu, and what does their work here (http://wiki.ros.org/rqt/Plugins)."""

from __future__ import annotations

from rosmini.viz.rqt.table import Table

COLUMNS = ("Group", "Plugin", "Package", "Here")

PLUGINS: tuple[tuple[str, str, str, str], ...] = (
    ("Actions", "Action Type Browser", "rqt_action", "rqt_action"),
    ("Configuration", "Dynamic Reconfigure", "rqt_reconfigure", "rqt_reconfigure"),
    ("Configuration", "Launch", "rqt_launch", "roslaunch"),
    ("Introspection", "Node Graph", "rqt_graph", "rqt_graph"),
    ("Introspection", "Package Graph", "rqt_dep", "rospack depends"),
    ("Introspection", "Process Monitor", "rqt_top", "top"),
    ("Logging", "Bag", "rqt_bag", "rqt_bag"),
    ("Logging", "Console", "rqt_console", "rqt_console"),
    ("Logging", "Logger Level", "rqt_logger_level", "rqt_logger_level"),
    ("Miscellaneous Tools", "Python Console", "rqt_py_console", "a cell of the notebook"),
    ("Miscellaneous Tools", "Shell", "rqt_shell", "a terminal of JupyterLab"),
    ("Miscellaneous Tools", "Web", "rqt_web", "the browser"),
    ("Robot Tools", "Controller Manager", "rqt_controller_manager", "not here"),
    ("Robot Tools", "Diagnostics Viewer", "rqt_robot_monitor", "rostopic echo /diagnostics_agg"),
    ("Robot Tools", "Joint Trajectory Controller", "rqt_joint_trajectory_controller", "not here"),
    ("Robot Tools", "MoveIt! Monitor", "rqt_moveit", "not here"),
    ("Robot Tools", "Navigation Viewer", "rqt_nav_view", "rviz"),
    ("Robot Tools", "Robot Steering", "rqt_robot_steering", "rqt_robot_steering"),
    ("Robot Tools", "Runtime Monitor", "rqt_runtime_monitor", "rostopic echo /diagnostics"),
    ("Services", "Service Caller", "rqt_service_caller", "rqt_service_caller"),
    ("Services", "Service Type Browser", "rqt_srv", "rqt_srv"),
    ("Topics", "Message Publisher", "rqt_publisher", "rqt_publisher"),
    ("Topics", "Message Type Browser", "rqt_msg", "rqt_msg"),
    ("Topics", "Topic Monitor", "rqt_topic", "rqt_topic"),
    ("Visualization", "Image View", "rqt_image_view", "rqt_image_view"),
    ("Visualization", "Plot", "rqt_plot", "rqt_plot"),
    ("Visualization", "Pose View", "rqt_pose_view", "simulator.show3d()"),
    ("Visualization", "RViz", "rqt_rviz", "rviz"),
    ("Visualization", "TF Tree", "rqt_tf_tree", "rqt_tf_tree"),
)
"""Group, name in the menu, package, and what serves here: the same tool, or another way to the same end."""


def rqt_plugins() -> Table:
    """Show the table of plugins."""
    return Table(COLUMNS, PLUGINS, title="rqt's plugins", noun="plugin")
