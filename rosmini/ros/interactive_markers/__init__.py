"""Markers that the user can move and click in RViz (http://wiki.ros.org/interactive_markers).

This is the object API, based on :class:`rosmini.core.graph.Node`. The module that scripts import as
``interactive_markers`` wraps it in rospy's style: :mod:`rosmini.ros.rospy.aliases.interactive_markers`.
"""

from __future__ import annotations

from .client import InteractiveMarkerClient
from .completion import auto_complete, title_control
from .menu_handler import InteractiveMarkerException, MenuHandler
from .server import InteractiveMarkerServer

__all__ = [
    "InteractiveMarkerClient",
    "InteractiveMarkerException",
    "InteractiveMarkerServer",
    "MenuHandler",
    "auto_complete",
    "title_control",
]
