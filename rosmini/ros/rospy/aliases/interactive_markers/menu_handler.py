"""The module that scripts import as ``interactive_markers.menu_handler``."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from rosmini.ros import interactive_markers, rospy
from rosmini.ros.interactive_markers import InteractiveMarkerException
from rosmini.ros.interactive_markers.menu_handler import InteractiveMarkerFeedback, MenuEntry

__all__ = ["InteractiveMarkerFeedback", "MenuEntry", "MenuHandler", "rospy"]


class MenuHandler(interactive_markers.MenuHandler):
    """A context menu of interactive markers."""

    def insert(
        self,
        title: str,
        parent: int | None = None,
        command_type: int = MenuEntry.FEEDBACK,
        command: str = "",
        callback: Callable[[Any], object] | None = None,
    ) -> int | None:
        """Add an entry and return its handle; for an unknown parent, log an error and return None."""
        try:
            return super().insert(title, parent, command_type, command, callback)
        except InteractiveMarkerException as error:
            rospy.logerr(str(error))
            return None
