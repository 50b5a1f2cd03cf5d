"""InteractiveMarkers: markers with handles that can be dragged and clicked, and with menus."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from functools import partial
from typing import Any

import numpy as np

from rosmini.core.errors import RosminiError, nearest
from rosmini.core.geometry.products import inverse_matrix, matrix_product
from rosmini.core.graph.publisher import Publisher
from rosmini.core.tf import TransformException
from rosmini.core.time import Time
from rosmini.msgs import message_class
from rosmini.ros.interactive_markers import InteractiveMarkerClient
from rosmini.viz.rviz.context import Context
from rosmini.viz.rviz.display import Display, Level
from rosmini.viz.rviz.handles import Control, Drag, Handle, pose_message
from rosmini.viz.rviz.primitives import DisplayError, Floats, Primitive, finite
from rosmini.viz.rviz.properties import Property
from rosmini.viz.rviz.rays import Ray

Feedback = message_class("visualization_msgs/InteractiveMarkerFeedback")
MenuEntry = message_class("visualization_msgs/MenuEntry")
TYPE = "visualization_msgs/InteractiveMarkerUpdate"
UPDATE = "/update"
MAX_MARKERS = 1000


class InteractiveMarkers(Display, plugin="rviz/InteractiveMarkers"):
    """The markers of servers on a topic; `drag`, `click` and `choose` publish the same feedback as RViz's mouse."""

    properties = (
        Property("Update Topic", "", "the topic of updates, /NAME/update"),
        Property("Show Descriptions", True, "the markers' descriptions, above them"),
        Property("Show Axes", False, "the markers' axes"),
        Property("Show Visual Aids", False, "guide lines during a drag; not supported"),
        Property("Enable Transparency", True, "make handles without markers half transparent"),
    )

    def __init__(self, name: str = "", tree: Any = None) -> None:
        super().__init__(name, tree)
        self.handles: dict[tuple[str, str], Handle] = {}
        """The markers that are shown, by server id and name."""
        self.shows_controls = True
        """True if all controls are shown, as with RViz's tool Interact; False if only those that are always visible."""
        self.hides_inactive = False
        """True if a drag hides the controls of other markers."""
        self._client = InteractiveMarkerClient()
        self._changed: set[tuple[str, str]] = set()
        self._publisher: Publisher | None = None
        self._drag: Drag | None = None

    # -- hearing -------------------------------------------------------------------------------------------------

    def start(self, context: Context) -> None:
        """Subscribe to updates and to full messages."""
        topic = self["Update Topic"]
        base, found, _ = topic.partition(UPDATE)
        if not found:
            self.set_status(Level.ERROR, "Topic", f"Invalid topic name: {topic}")
            return
        try:
            for end, kind, take in (
                ("_full", "visualization_msgs/InteractiveMarkerInit", self._client.init),
                ("", TYPE, self._client.update),
            ):
                self.subscribe(context, f"{base}{UPDATE}{end}", kind, partial(self._take, take, context))
        except RosminiError as error:
            said = str(error).partition("\n")[0]
            self.set_status(Level.ERROR, "Topic", f"Error subscribing: {said}")
            return
        publisher = context.node.publisher(f"{base}/feedback", Feedback, queue_size=100)
        publisher.expect_nobody()
        self._publisher = publisher
        self._subscriptions.append(publisher.unregister)
        self.set_status(Level.WARN, "Topic", "No messages received")

    def _take(self, take: Callable[[Any, int], set[str]], context: Context, message: Any) -> None:
        self.set_status(Level.OK, "Topic", "OK")
        names = take(message, context.now_ns)
        self._changed |= {(message.server_id, name) for name in names}

    def changed(self, name: str) -> None:
        """Subscribe to another topic, or rebuild all markers."""
        if name in ("Update Topic", "Enable Transparency"):
            self.restart()

    def reset(self) -> None:
        """Discard all markers."""
        self._client = InteractiveMarkerClient()
        self.handles, self._changed, self._drag = {}, set(), None

    def update(self, context: Context) -> None:
        """Apply updates and refresh the poses of frames; a marker that is being dragged is not replaced."""
        for key in sorted(self._changed):
            if self._drag is None or self.handles.get(key) is not self._drag.handle:
                self._changed.discard(key)
                self._replace(key, context)
        for key, handle in self.handles.items():
            self._process_waiting(key[1], handle, context)
        topic = self._statuses.get("Topic")
        if topic is not None and topic.text.startswith("No messages"):
            why = context.why_no_messages(self["Update Topic"], TYPE)
            level = Level.ERROR if why.is_permanent else Level.WARN
            self.set_status(level, "Topic", f"No messages received: {why.text}")
        for server, state in self._client.servers.items():
            is_well, text = state.text(context.now_ns)
            self.set_status(Level.OK if is_well else Level.WARN, server, text)

    def _replace(self, key: tuple[str, str], context: Context) -> None:
        self.handles.pop(key, None)
        self.clear_status(key[1])
        message = self._client.servers[key[0]].markers.get(key[1])
        if message is None:
            return
        if not message.controls:
            self.set_status(Level.OK, key[1], "Marker empty.")
        elif len(self.handles) >= MAX_MARKERS:
            self.set_status(Level.WARN, "Markers", f"Showing the first {MAX_MARKERS} markers")
        else:
            try:
                handle = Handle(message, context.now_ns, transparent=self["Enable Transparency"])
            except (DisplayError, TransformException):
                self.set_status(Level.ERROR, key[1], "Marker contains invalid floats!")
            else:
                self.handles[key] = handle

    def _process_waiting(self, name: str, handle: Handle, context: Context) -> None:
        """Look up the pose of the marker's frame: always if the marker is locked to it, otherwise once."""
        received = handle.received
        if not handle.is_locked and handle.is_placed:
            return
        try:
            received.place = context.place(received.frame, received.stamp_ns)
            handle.is_placed = True
            text = f"Locked to frame {received.frame}" if handle.is_locked else "Position is fixed."
            self.set_status(Level.OK, name, text)
        except TransformException as error:
            handle.is_placed = False
            self.set_status(Level.ERROR, name, context.problem(received.frame, error))

    # -- drawing -------------------------------------------------------------------------------------------------

    def primitives(self, context: Context) -> Iterable[Primitive]:
        """Return the controls, descriptions and axes of all markers."""
        found: list[Primitive] = []
        for (_, name), handle in sorted(self.handles.items()):
            if not handle.is_placed:
                continue
            try:
                found += self._drawn(handle, context)
                if handle.received.notes:
                    self.set_status(Level.WARN, name, "; ".join(handle.received.notes))
            except (DisplayError, TransformException) as error:
                self.set_status(Level.ERROR, name, str(error).partition("\n")[0])
        return found

    def _drawn(self, handle: Handle, context: Context) -> list[Primitive]:
        found: list[Primitive] = []
        is_beside = self.hides_inactive and self._drag is not None and self._drag.handle is not handle
        for control in handle.message.controls:
            if control.always_visible or (self.shows_controls and not is_beside):
                found += handle.shapes(control, context)
        if self["Show Descriptions"]:
            found += handle.title()
        if self["Show Axes"]:
            found += handle.axes()
        return found

    # -- pointer --------------------------------------------------------------------------------------------------

    def handle(self, name: str) -> Handle:
        """Return the marker with this name. Raises `DisplayError` if it is not shown."""
        for (_, each), handle in self.handles.items():
            if each == name:
                return handle
        names = [each for _, each in self.handles]
        hint = nearest(name, names) or f"there are {', '.join(names) or 'none'}"
        raise DisplayError(f"no interactive marker {name!r:.60} is shown; {hint}")

    def under(self, ray: Ray, context: Context) -> tuple[Handle, Any] | None:
        """Return the marker and its control that a line of sight in the fixed frame meets first, or None."""
        found: list[tuple[float, Handle, Any]] = []
        for handle in self.handles.values():
            if handle.is_placed:
                found += [(depth, handle, control) for depth, control in handle.under(ray, context)]
        return min(found, key=lambda each: each[0])[1:] if found else None

    def press(self, handle: Handle, control: Any, at: Floats, ray: Ray | None = None) -> str:
        """Press the mouse on a control, at a point (3,) of the fixed frame or along a line of sight; return a hint."""
        self._drag = Drag(handle, control, at, ray)
        self._say(Feedback.MOUSE_DOWN, handle, control, self._drag.cursor(at, ray))
        return str(control.description or _hint(control.interaction_mode))

    def move(self, at: Floats, ray: Ray | None = None) -> str:
        """Move the mouse to a point (3,) of the fixed frame or along a line of sight; the marker follows."""
        drag = self._drag
        if drag is None:
            return ""
        moved = drag.move(at, ray)
        self._say(Feedback.POSE_UPDATE if moved else Feedback.KEEP_ALIVE, drag.handle, drag.control)
        return _where(drag.handle)

    def release(self, at: Floats) -> str:
        """Release the mouse, and return the text for the status bar: the menu's entries if a menu opens."""
        drag, self._drag = self._drag, None
        if drag is None:
            return ""
        handle, control = drag.handle, drag.control
        if control.interaction_mode == Control.BUTTON:
            self._say(Feedback.BUTTON_CLICK, handle, control, at)
        self._say(Feedback.MOUSE_UP, handle, control, at)
        if control.interaction_mode == Control.MENU:
            return "; ".join(_titles(handle.message.menu_entries).values())
        return _where(handle)

    def drag(self, marker: str, to: Sequence[float], control: str = "", start: Sequence[float] | None = None) -> str:
        """Drag a control of a marker to a point (3) of the fixed frame, by default from the marker's origin.

        Without a name, drag the first control that reacts. Raises `DisplayError` if there is none, or if a point is
        invalid.
        """
        handle = self.handle(marker)
        origin = matrix_product(handle.frame, handle.pose)[:3, 3]
        first = origin if start is None else finite([list(start)], 3)[0]
        last = finite([list(to)], 3)[0]
        self.press(handle, handle.control(control), first)
        if not np.array_equal(first, last):
            self.move(last)
        return self.release(last)

    def click(self, marker: str, control: str = "") -> str:
        """Click a control of a marker. Raises `DisplayError` if it does not exist."""
        handle = self.handle(marker)
        return self.drag(marker, matrix_product(handle.frame, handle.pose)[:3, 3].tolist(), control)

    def choose(self, marker: str, entry: int | str) -> None:
        """Choose an entry of a marker's menu, by its number or by its titles, `Mode/Fast`.

        Raises `DisplayError` if it does not exist, or would run a program, which only the real RViz does.
        """
        handle = self.handle(marker)
        entries = {one.id: one for one in handle.message.menu_entries}
        titles = _titles(handle.message.menu_entries)
        found = entry if isinstance(entry, int) else next((i for i, each in titles.items() if each == entry), 0)
        if found not in entries:
            raise DisplayError(
                f"the menu of {marker!r} has no entry {entry!r:.60}; it has {', '.join(titles.values()) or 'none'}"
            )
        chosen = entries[found]
        if chosen.command_type != MenuEntry.FEEDBACK:
            tool = "rosrun" if chosen.command_type == MenuEntry.ROSRUN else "roslaunch"
            raise DisplayError(
                f"in real ROS this runs {tool} {chosen.command!r:.80}; rosmini runs no program named in a message"
            )
        self._say(Feedback.MENU_SELECT, handle, None, menu_entry_id=found)

    def _say(self, event: int, handle: Handle, control: Any, at: Floats | None = None, menu_entry_id: int = 0) -> None:
        """Publish feedback: in the marker's frame if it is locked to it, otherwise in the fixed frame."""
        if self._publisher is None or self._context is None:
            return
        context = self._context
        feedback = Feedback(
            client_id=f"{context.node.name}/{self.name}",
            marker_name=handle.message.name,
            control_name="" if control is None else control.name,
            event_type=event,
            menu_entry_id=menu_entry_id,
        )
        base = np.eye(4) if handle.is_locked else handle.frame
        feedback.header.frame_id = handle.received.frame if handle.is_locked else context.fixed_frame
        if handle.is_locked and handle.received.frame.lstrip("/") != context.fixed_frame:
            stamp_ns = context.tree.latest_common_time(context.fixed_frame, handle.received.frame.lstrip("/"))
            feedback.header.stamp = Time.from_nsec(stamp_ns)
        feedback.pose = pose_message(matrix_product(base, handle.pose))
        if at is not None:
            x, y, z = matrix_product(inverse_matrix(handle.frame), np.append(at, 1.0))[:3] if handle.is_locked else at
            feedback.mouse_point.x, feedback.mouse_point.y, feedback.mouse_point.z = (float(x), float(y), float(z))
            feedback.mouse_point_valid = True
        self._publisher.publish(feedback)


def _where(handle: Handle) -> str:
    at = ", ".join(f"{each:g}" for each in np.round(handle.pose[:3, 3], 3) + 0.0)
    return f"{handle.message.name}: {at} in {handle.received.frame}"


def _hint(mode: int) -> str:
    """Return the hint for a control, by its mode."""
    hints = {
        Control.MENU: "Click to open the menu.",
        Control.BUTTON: "Click.",
        Control.MOVE_AXIS: "Drag to move along the axis.",
        Control.MOVE_PLANE: "Drag to move in the plane.",
        Control.ROTATE_AXIS: "Drag to turn.",
        Control.MOVE_ROTATE: "Drag to move and turn.",
        Control.MOVE_3D: "Drag to move.",
    }
    return hints.get(mode, "Drag.")


def _titles(entries: Sequence[Any]) -> dict[int, str]:
    """Return the titles of a menu's entries, without checkboxes, each with its parents: `Mode/Fast`."""
    found: dict[int, str] = {}
    for entry in entries:
        title = entry.title.removeprefix("[x] ").removeprefix("[ ] ")
        found[entry.id] = f"{found[entry.parent_id]}/{title}" if entry.parent_id in found else title
    return found
