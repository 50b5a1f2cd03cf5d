"""MarkerArray: markers that arrive in arrays."""

from __future__ import annotations

from typing import Any

from rosmini.viz.rviz.context import Context
from rosmini.viz.rviz.properties import Property

from .marker import ARRAY, Marker


class MarkerArray(Marker, plugin="rviz/MarkerArray"):
    """Markers of a topic of arrays."""

    message = ARRAY
    properties = (Property("Marker Topic", "visualization_marker_array", "the topic to subscribe to"),)

    def subscribe_to_arrays(self, context: Context) -> None:
        """Do nothing: the topic itself has arrays."""

    def receive(self, message: Any, context: Context) -> None:
        """Process an array, or one of its markers."""
        if hasattr(message, "markers"):
            self.receive_array(message, context)
        else:
            super().receive(message, context)
