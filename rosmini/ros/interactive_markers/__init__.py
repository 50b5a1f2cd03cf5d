"""Markers that the user of RViz can move and click (http://wiki.ros.org/interactive_markers).

The object API, on a :class:`rosmini.core.graph.Node`. What scripts import as ``interactive_markers`` is the same in
rospy's style, :mod:`rosmini.ros.rospy.aliases.interactive_markers`.
"""

from __future__ import annotations

from .client import InteractiveMarkerClient
from .completion import auto_complete, title_control
from .errors import InteractiveMarkerException
from .menu_handler import MenuHandler
from .server import InteractiveMarkerServer

__all__ = [
    "InteractiveMarkerClient",
    "InteractiveMarkerException",
    "InteractiveMarkerServer",
    "MenuHandler",
    "auto_complete",
    "title_control",
]
