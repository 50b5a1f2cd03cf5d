"""Path: the path that a planner chose or that a robot followed."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import numpy as np

from rosmini.viz.rviz.context import Context
from rosmini.viz.rviz.display import Level
from rosmini.viz.rviz.pose_style import length_property
from rosmini.viz.rviz.primitives import DisplayError, Floats, Lines, Primitive
from rosmini.viz.rviz.properties import Colour, Property, Vector
from rosmini.viz.rviz.shapes import arrow, axes
from rosmini.viz.rviz.topic_display import Received, TopicDisplay

MAX_POSES, MAX_SHAPES = 200_000, 500


class Path(TopicDisplay, plugin="rviz/Path"):
    """A `nav_msgs/Path` as a line, optionally with its poses."""

    message = "nav_msgs/Path"
    history = "Buffer Length"
    properties = (
        Property("Line Style", "Lines", "thin lines or wide ones", choices=("Lines", "Billboards")),
        Property("Line Width", 0.03, "width of wide lines", unit="m", minimum=0.001, maximum=1e4),
        Property("Color", Colour(25, 255, 0), "colour of the line"),
        Property("Alpha", 1.0, "opacity", minimum=0.0, maximum=1.0),
        Property("Buffer Length", 1, "number of paths shown", minimum=1, maximum=1000),
        Property("Offset", Vector(0.0, 0.0, 0.0), "displacement", unit="m"),
        Property("Pose Style", "None", "how its poses are drawn", choices=("None", "Axes", "Arrows")),
        Property("Pose Color", Colour(255, 85, 255), "colour of the arrows"),
        length_property("Length", 0.3), length_property("Radius", 0.03), length_property("Shaft Length", 0.1),
        length_property("Head Length", 0.2), length_property("Shaft Diameter", 0.1),
        length_property("Head Diameter", 0.3),
    )  # fmt: skip

    def draw(self, received: Received, context: Context) -> Iterable[Primitive]:
        """Yield the line and the poses."""
        del context
        poses = received.message.poses
        if len(poses) > MAX_POSES:
            raise DisplayError(f"a path of {len(poses)} poses is too long: at most {MAX_POSES}")
        points = received.points([each.pose.position for each in poses]) + np.array(self["Offset"])
        width = self["Line Width"] if self["Line Style"] == "Billboards" else 0.0
        self.set_status(Level.OK if len(points) else Level.WARN, "Path", f"{len(points)} poses")
        yield Lines(points, self["Color"].rgba(self["Alpha"]), width)
        if self["Pose Style"] != "None":
            step = -(-len(poses) // MAX_SHAPES) or 1
            for each in poses[::step]:
                yield from self._shape(received.pose(each.pose))

    def _shape(self, pose: Floats) -> Iterator[Primitive]:
        pose = pose.copy()
        pose[:3, 3] += self["Offset"]
        if self["Pose Style"] == "Axes":
            yield from axes(pose, self["Length"], self["Radius"])
            return
        colour = self["Pose Color"].rgba(self["Alpha"])
        shaft, head = self["Shaft Diameter"] / 2, self["Head Diameter"] / 2
        yield arrow(pose, colour, self["Shaft Length"], shaft, self["Head Length"], head)
