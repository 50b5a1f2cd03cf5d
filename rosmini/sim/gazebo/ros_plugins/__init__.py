"""The plugins of gazebo_ros_pkgs by their libraries' names, with their tags and defaults.

http://classic.gazebosim.org/tutorials?tut=ros_gzplugins
"""

from . import cameras, drives, imus, joints_and_truth, lasers

__all__ = ["cameras", "drives", "imus", "joints_and_truth", "lasers"]
