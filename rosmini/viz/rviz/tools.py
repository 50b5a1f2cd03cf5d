"""Tools: reactions to a press, a drag and a click in the scene (http://wiki.ros.org/rviz/UserGuide).

A live view or a script gives a tool points of the fixed frame: `click` and `drag` do the same as a mouse.

>>> from rosmini import Graph
>>> from rosmini.viz.rviz import Scene
>>> with Graph() as graph, Scene(graph, fixed_frame="map") as scene:
...     tools = Tools(scene)
...     print(tools["Measure"].click((0, 0)), tools["Measure"].click((3, 4)), sep=" | ")
Click on two points to measure their distance. | [Length: 5m] Click on two points to measure their distance.
"""

from __future__ import annotations

import math
from abc import ABC
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, ClassVar

import numpy as np

from rosmini.core.errors import nearest
from rosmini.core.geometry.angles import quaternion_from_yaw
from rosmini.core.geometry.products import norm
from rosmini.core.plugins import Plugin, PluginError
from rosmini.core.time import Time
from rosmini.viz.view import ViewError

from .config import Config, kind_of
from .displays.interactive_markers import InteractiveMarkers
from .primitives import DisplayError, Floats, Lines, Primitive, finite
from .properties import Properties, Property
from .rays import Ray, ray_from_above
from .scene import Scene
from .shapes import arrow

Point = Sequence[float]
"""x and y, or x, y and z, in the fixed frame [m]."""

GREEN = np.array([0.0, 1.0, 0.0, 1.0])


class Tool(Plugin, ABC):
    """The base of tools: the mouse button is pressed at a point, the mouse moves, and the button is released."""

    label: ClassVar[str] = ""
    """The label in the tool bar."""
    key: ClassVar[str] = ""
    """The key that selects the tool."""
    hint: ClassVar[str] = ""
    """The text in the status bar before anything is done."""
    needs_object: ClassVar[bool] = False
    """True if it accepts only points of drawn objects, not of the empty ground."""
    properties: ClassVar[tuple[Property, ...]] = ()

    def __init__(self, scene: Scene, tree: Mapping[str, Any] | None = None) -> None:
        self.scene = scene
        self._values = Properties(self.properties, tree)
        self.is_finished = False
        """True if the tool has done its work; a view then selects the first tool again."""
        self.ray: Ray | None = None
        """The line of sight of the mouse, if a live view knows it; otherwise points are seen from above."""

    def __getitem__(self, name: str) -> Any:
        return self._values[name]

    def __setitem__(self, name: str, value: Any) -> None:
        self._values[name] = value

    @property
    def errors(self) -> list[str]:
        """Errors in its part of a file, in words."""
        return self._values.errors

    def tree(self) -> dict[str, Any]:
        """Return its part of a `.rviz` file."""
        return {**self._values.tree(), "Class": self.plugin_name}

    # -- to be overridden: each receives a point (3,) of the fixed frame, and returns the text of the status bar ----

    def press(self, at: Floats) -> str:
        """Handle a press of the mouse button."""
        del at
        return self.hint

    def move(self, at: Floats) -> str:
        """Handle a move of the mouse while the button is pressed."""
        del at
        return self.hint

    def release(self, at: Floats) -> str:
        """Handle the release of the mouse button."""
        del at
        return self.hint

    def primitives(self) -> Iterator[Primitive]:
        """Yield the primitives that it draws into the scene while it is used."""
        yield from ()

    # -- for scripts ---------------------------------------------------------------------------------------------

    def click(self, at: Point) -> str:
        """Press and release at a point. Raises `DisplayError` if it is not a point."""
        return self.drag(at, at)

    def drag(self, start: Point, end: Point) -> str:
        """Press at one point and release at another. Raises `DisplayError` if one is not a point."""
        first, last = point(start), point(end)
        self.is_finished = False
        self.press(first)
        if not np.array_equal(first, last):
            self.move(last)
        return self.release(last)


def point(given: Point) -> Floats:
    """Return a point (3,) from two or three numbers [m]; z is 0 by default. Raises `DisplayError` for anything else."""
    try:
        found = [float(each) for each in given]
    except (TypeError, ValueError):
        found = []
    if len(found) not in (2, 3):
        raise DisplayError(f"a point must be two or three numbers, x, y and z [m], not {given!r:.60}")
    checked: Floats = finite([[*found, 0.0][:3]], 3)[0]
    return checked


class PublishingTool(Tool):
    """A tool that publishes on a topic. Its `publisher` exists from the beginning, as in RViz."""

    message: ClassVar[str] = ""

    def __init__(self, scene: Scene, tree: Mapping[str, Any] | None = None) -> None:
        super().__init__(scene, tree)
        self._advertise()

    def _advertise(self) -> None:
        from rosmini.msgs import message_class

        self.type = message_class(self.message)
        self.publisher = self.scene.node.publisher(self["Topic"], self.type, queue_size=1)

    def __setitem__(self, name: str, value: Any) -> None:
        super().__setitem__(name, value)
        if name == "Topic":
            self.publisher.unregister()
            self._advertise()

    def stamped(self) -> Any:
        """Return a new message in the fixed frame, with the current time as its stamp."""
        message = self.type()
        message.header.frame_id = self.scene.fixed_frame
        message.header.stamp = Time.from_nsec(self.scene.context.now_ns)
        return message

    def publish(self, message: Any) -> None:
        """Publish a message."""
        self.publisher.publish(message)


class PoseTool(PublishingTool):
    """Sets the position with the press of the mouse, and the heading with its release; a click heads along x."""

    hint = "Click and drag mouse to set position/orientation."

    _start: Floats | None = None
    _end: Floats | None = None

    def press(self, at: Floats) -> str:
        """Store the position, on the ground."""
        self._start, self._end = at * (1, 1, 0), None
        return self.hint

    def move(self, at: Floats) -> str:
        """Rotate the arrow."""
        self._end = at * (1, 1, 0)
        return self.hint

    def release(self, at: Floats) -> str:
        """Publish the pose. Does nothing without a press before."""
        if self._start is None:
            return self.hint
        (x, y, _), (to_x, to_y, _) = self._start, at
        self._start = self._end = None
        self.is_finished = True
        return self.set_pose(float(x), float(y), math.atan2(to_y - y, to_x - x))

    def set_pose(self, x: float, y: float, yaw: float) -> str:
        """Publish a pose of the fixed frame [m, rad], and return a text that describes it."""
        raise NotImplementedError

    def primitives(self) -> Iterator[Primitive]:
        """Yield the arrow, after the mouse was pressed and moved: RViz's is 2.5 m long."""
        if self._start is not None and self._end is not None:
            (x, y, _), (to_x, to_y, _) = self._start, self._end
            c, s = np.cos(yaw := math.atan2(to_y - y, to_x - x)), np.sin(yaw)
            pose = np.array([[c, -s, 0, x], [s, c, 0, y], [0, 0, 1, 0], [0, 0, 0, 1]], dtype=float)
            yield arrow(pose, GREEN, 2.0, 0.2, 0.5, 0.35)


def _set_pose(pose: Any, x: float, y: float, yaw: float) -> None:
    pose.position.x, pose.position.y = x, y
    turned = quaternion_from_yaw(yaw)
    pose.orientation.x, pose.orientation.y, pose.orientation.z, pose.orientation.w = turned


class SetInitialPose(PoseTool, plugin="rviz/SetInitialPose"):
    """2D Pose Estimate: tells a localisation such as amcl the pose of the robot and its uncertainty."""

    label, key, message = "2D Pose Estimate", "p", "geometry_msgs/PoseWithCovarianceStamped"
    properties = (
        Property("Topic", "initialpose", "the topic of the poses"),
        Property("X std deviation", 0.5, "standard deviation of x", unit="m", minimum=0.0),
        Property("Y std deviation", 0.5, "standard deviation of y", unit="m", minimum=0.0),
        Property("Theta std deviation", math.pi / 12, "standard deviation of yaw", unit="rad", minimum=0.0),
    )

    def set_pose(self, x: float, y: float, yaw: float) -> str:
        """Publish the estimate, with the squares of the deviations as its covariance."""
        message = self.stamped()
        _set_pose(message.pose.pose, x, y, yaw)
        covariance = [0.0] * 36
        for place, axis in ((0, "X"), (7, "Y"), (35, "Theta")):
            covariance[place] = self[f"{axis} std deviation"] ** 2
        message.pose.covariance = covariance
        self.publish(message)
        return f"Setting pose: {x:.3f} {y:.3f} {yaw:.3f} [frame={self.scene.fixed_frame}]"


class SetGoal(PoseTool, plugin="rviz/SetGoal"):
    """2D Nav Goal: sends a robot to a goal."""

    label, key, message = "2D Nav Goal", "g", "geometry_msgs/PoseStamped"
    properties = (Property("Topic", "goal", "the topic of the goals"),)

    def set_pose(self, x: float, y: float, yaw: float) -> str:
        """Publish the goal."""
        message = self.stamped()
        _set_pose(message.pose, x, y, yaw)
        self.publish(message)
        turned = message.pose.orientation
        return (
            f"Setting goal: Frame:{self.scene.fixed_frame}, Position({x:.3f}, {y:.3f}, 0.000), "
            f"Orientation({turned.x:.3f}, {turned.y:.3f}, {turned.z:.3f}, {turned.w:.3f}) = Angle: {yaw:.3f}"
        )


class PublishPoint(PublishingTool, plugin="rviz/PublishPoint"):
    """Publish Point: publishes a point that was clicked."""

    label, key, message = "Publish Point", "u", "geometry_msgs/PointStamped"
    needs_object = True
    hint = "Move over an object to select the target point."
    properties = (
        Property("Topic", "/clicked_point", "the topic of the points"),
        Property("Single click", True, "end after one click"),
    )

    def move(self, at: Floats) -> str:
        """Return a text with the point that a click would select."""
        return f"Left-Click: Select this point. [{at[0]:.3g},{at[1]:.3g},{at[2]:.3g}]"

    def release(self, at: Floats) -> str:
        """Publish the point."""
        message = self.stamped()
        message.point.x, message.point.y, message.point.z = map(float, at)
        self.publish(message)
        self.is_finished = self["Single click"]
        return f"Published point [{at[0]:.3g},{at[1]:.3g},{at[2]:.3g}]"


class Measure(Tool, plugin="rviz/Measure"):
    """Measure: measures the distance between two points."""

    label, key = "Measure", "n"
    needs_object = True
    hint = "Click on two points to measure their distance."

    def __init__(self, scene: Scene, tree: Mapping[str, Any] | None = None) -> None:
        super().__init__(scene, tree)
        self.points: list[Floats] = []
        """The points clicked since the last pair."""

    @property
    def length(self) -> float | None:
        """The distance [m], once two points have been clicked."""
        return norm(self.points[1] - self.points[0]) if len(self.points) == 2 else None

    def release(self, at: Floats) -> str:
        """Add a point; the third one starts another line."""
        self.points = [*(self.points if len(self.points) < 2 else []), at]
        return self.hint if self.length is None else f"[Length: {self.length:.6g}m] {self.hint}"

    def primitives(self) -> Iterator[Primitive]:
        """Yield the line between the points."""
        if len(self.points) == 2:
            yield Lines(np.array(self.points), GREEN)


class FocusCamera(Tool, plugin="rviz/FocusCamera"):
    """Focus Camera: moves the clicked point to the middle of the view."""

    label, key = "Focus Camera", "c"
    hint = "Left-Click: Focus on this point."

    def release(self, at: Floats) -> str:
        """Move the view there, if there is a view."""
        if self.scene.view is None:
            return "there is no view to turn; the picture is drawn around everything"
        self.scene.view.centre_on(at, self.scene.context)
        self.is_finished = True
        return f"Focused on [{at[0]:.3g},{at[1]:.3g},{at[2]:.3g}]"


class MoveCamera(Tool, plugin="rviz/MoveCamera"):
    """Move Camera: a drag moves the view."""

    label, key = "Move Camera", "m"
    hint = "Drag to move the camera; the wheel zooms."
    _held: Floats | None = None

    def press(self, at: Floats) -> str:
        """Store the point where the drag starts."""
        self._held = at
        return self.hint

    def move(self, at: Floats) -> str:
        """Move the view so that the pressed point follows the mouse. Does nothing without a press."""
        if self.scene.view is not None and self._held is not None:
            self.scene.view.pan(self._held - at, self.scene.context)
        return self.hint

    def release(self, at: Floats) -> str:
        """End the drag."""
        del at
        self._held = None
        return self.hint


class Interact(MoveCamera, plugin="rviz/Interact"):
    """Interact: operates interactive markers; elsewhere it moves the camera."""

    label, key = "Interact", "i"
    hint = "Click an interactive marker, or drag to move the camera."
    properties = (Property("Hide Inactive Objects", True, "hide the controls of other markers during a drag"),)
    _marker: InteractiveMarkers | None = None

    def press(self, at: Floats) -> str:
        """Press the mouse on the control at the point."""
        for display in self.scene:
            if not isinstance(display, InteractiveMarkers):
                continue
            found = display.under(self.ray or ray_from_above(at), self.scene.context)
            if found is not None:
                self._marker = display
                display.hides_inactive = self["Hide Inactive Objects"]
                return str(display.press(*found, at, self.ray))
        return super().press(at)

    def move(self, at: Floats) -> str:
        """Drag the control."""
        return super().move(at) if self._marker is None else str(self._marker.move(at, self.ray))

    def release(self, at: Floats) -> str:
        """Release the control."""
        held, self._marker = self._marker, None
        return super().release(at) if held is None else str(held.release(at))


class Select(Tool, plugin="rviz/Select"):
    """Select: lists the objects in a rectangle in the Selection panel."""

    label, key = "Select", "s"
    hint = "Click and drag to select objects on the screen."

    def __init__(self, scene: Scene, tree: Mapping[str, Any] | None = None) -> None:
        super().__init__(scene, tree)
        self.corners: tuple[Floats, Floats] | None = None
        """The rectangle, in the fixed frame."""

    def press(self, at: Floats) -> str:
        """Start a rectangle."""
        self.corners = (at, at)
        return self.hint

    def move(self, at: Floats) -> str:
        """Extend the rectangle."""
        self.corners = (at if self.corners is None else self.corners[0], at)
        return self.hint

    def release(self, at: Floats) -> str:
        """End the rectangle."""
        return self.move(at)


class Tools:
    """The tools of a scene, in the order of its file; the first is current.

    Raises:
        ViewError: no tool has this name, or the name of a topic is invalid.

    """

    def __init__(self, scene: Scene) -> None:
        self.scene = scene
        trees = scene.config.mappings("Tools") or Config().mappings("Tools")
        self.all: list[Tool] = []
        for tree in trees:
            try:
                self.all.append(Tool.named(kind_of(tree))(scene, tree))
            except PluginError:  # the scene's warning lists it, and the file preserves it
                continue
        if not self.all:
            self.all = [MoveCamera(scene)]
        self.current = self.all[0]
        """The tool in use."""

    def __iter__(self) -> Iterator[Tool]:
        return iter(self.all)

    def __getitem__(self, name: str) -> Tool:
        """Return a tool by its label, its class, or its key."""
        for tool in self.all:
            if name in (tool.label, tool.plugin_name, tool.plugin_name.rpartition("/")[2], tool.key):
                return tool
        labels = [tool.label for tool in self.all]
        hint = nearest(name, labels) or f"the tools are: {', '.join(labels)}"
        raise ViewError(f"there is no tool {name!r:.60}; {hint}")

    def take(self, name: str) -> Tool:
        """Select a tool. Raises `ViewError` if no tool has this name."""
        self._set_current(self[name])
        self.current.is_finished = False
        return self.current

    def _set_current(self, tool: Tool) -> None:
        """Make a tool current; controls of interactive markers are shown only with Interact, as in RViz."""
        self.current = tool
        for display in self.scene:
            if isinstance(display, InteractiveMarkers):
                display.shows_controls = isinstance(tool, Interact)

    def finish(self) -> None:
        """Select the first tool again if the current one has done its work."""
        if self.current.is_finished:
            self._set_current(self.all[0])
