"""Panels beside the scene in RViz's window, as text. The text form of a still is that of the Displays panel."""

from __future__ import annotations

import time
from collections.abc import Iterable

from .scene import Scene
from .selection import Picked
from .tools import Tools


class TimePanel:
    """ROS time and wall time, and the time since the scene started or was reset."""

    def __init__(self, scene: Scene) -> None:
        self.scene = scene
        self._begin()

    def _begin(self) -> None:
        self._ros_ns, self._wall_s = self.scene.context.now_ns, time.time()

    def reset(self) -> None:
        """Restart: all displays discard what they received."""
        self.scene.root.attach(self.scene.context)
        self._begin()

    def words(self, *, wall: bool = True) -> str:
        """Return the panel's text; without wall time it is the same in each run."""
        now = self.scene.context.now_ns
        lines = [f"ROS Time: {now / 1e9:.2f}", f"ROS Elapsed: {(now - self._ros_ns) / 1e9:.2f}"]
        if wall:
            lines += [f"Wall Time: {time.time():.2f}", f"Wall Elapsed: {time.time() - self._wall_s:.2f}"]
        return "\n".join(lines)


def tool_properties(tools: Tools) -> str:
    """Return the Tool Properties panel: the properties of each tool that has some."""
    lines = []
    for tool in tools:
        if tool.properties:
            lines.append(tool.label)
            lines += [f"  {each.name}: {_written(tool[each.name])}" for each in tool.properties]
    return "\n".join(lines)


def views(scene: Scene) -> str:
    """Return the Views panel: the current view and its properties."""
    if scene.view is None:
        return "Current View: from above, around everything"
    name = scene.view.plugin_name.rpartition("/")[2]
    lines = [f"Current View: {name} (rviz)"]
    lines += [f"  {each.name}: {_written(scene.view[each.name])}" for each in scene.view.properties]
    return "\n".join(lines)


def selection(found: Iterable[Picked]) -> str:
    """Return the text of the Selection panel."""
    return "\n".join(each.words() for each in found) or "nothing is selected"


def _written(value: object) -> str:
    if isinstance(value, float):
        return f"{value:.6g}"
    if isinstance(value, tuple):
        return "; ".join(_written(each) for each in value)
    return str(value)
