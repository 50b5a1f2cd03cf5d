"""Panels beside the scene in RViz's window, as text. The text form of a still is that of the Displays panel."""

from __future__ import annotations

from collections.abc import Iterable

from .scene import Scene
from .selection import Picked


class TimePanel:
    """ROS time, and the time since the scene started or was reset."""

    def __init__(self, scene: Scene) -> None:
        self.scene = scene
        self._begin()

    def _begin(self) -> None:
        self._ros_ns = self.scene.context.now_ns

    def reset(self) -> None:
        """Restart: all displays discard what they received."""
        self.scene.root.attach(self.scene.context)
        self._begin()

    def words(self) -> str:
        """Return the panel's text, without wall time, so that it is the same in each run."""
        now = self.scene.context.now_ns
        return f"ROS Time: {now / 1e9:.2f}\nROS Elapsed: {(now - self._ros_ns) / 1e9:.2f}"


def selection(found: Iterable[Picked]) -> str:
    """Return the text of the Selection panel."""
    return "\n".join(each.words() for each in found) or "nothing is selected"
