"""Marker and MarkerArray: shapes that programs request, identified by namespace and id."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, ClassVar

from rosmini.core.errors import RosminiError
from rosmini.core.tf import TransformException
from rosmini.core.tf.rigid import Rigid
from rosmini.viz.rviz.context import Context
from rosmini.viz.rviz.display import Level
from rosmini.viz.rviz.marker_checks import Marker as MarkerMessage
from rosmini.viz.rviz.marker_checks import check
from rosmini.viz.rviz.marker_shapes import marker_primitives
from rosmini.viz.rviz.primitives import DisplayError, Primitive
from rosmini.viz.rviz.properties import Property, Tree
from rosmini.viz.rviz.topic_display import Received, TopicDisplay

MAX_MARKERS = 10_000
MAX_NAMESPACES = 500
MAX_STATUSES = 30
"""Maximum number of markers with a separate status line."""
ARRAY = "visualization_msgs/MarkerArray"


class Marker(TopicDisplay, plugin="rviz/Marker"):
    """Markers of a topic, and of the topic whose name has `_array` appended.

    A marker stays where its frame was when it arrived, or moves with it if it is `frame_locked`. It disappears after
    its `lifetime`, on DELETE, or when another one with its namespace and id arrives.
    """

    message = "visualization_msgs/Marker"
    topic_property = "Marker Topic"
    properties: ClassVar[tuple[Property, ...]] = (
        Property("Marker Topic", "visualization_marker", "the topic to subscribe to"),
        Property("Queue Size", 100, "maximum number of markers that wait for their transform", minimum=0, maximum=1000),
        Property("Namespaces", Tree(), "which namespaces are shown; unlisted ones are shown too"),
    )

    def __init__(self, name: str = "", tree: Any = None) -> None:
        super().__init__(name, tree)
        self.markers: dict[tuple[str, int], Received] = {}
        """The markers by namespace and id."""
        self._without_status: set[tuple[str, int]] = set()
        self["Namespaces"] = self["Namespaces"]  # a copy, because new namespaces are added to it

    # -- hearing -------------------------------------------------------------------------------------------------

    def start(self, context: Context) -> None:
        """Subscribe to markers, and to arrays of them."""
        super().start(context)
        if self.topic:
            self.subscribe_to_arrays(context)

    def subscribe_to_arrays(self, context: Context) -> None:
        """Subscribe to the topic of arrays."""
        try:
            self.subscribe(context, f"{self.topic}_array", ARRAY, lambda array: self.receive_array(array, context))
        except RosminiError as error:
            self.fail("Topic", error)

    def receive_array(self, array: Any, context: Context) -> None:
        """Process the markers of an array, one after another."""
        before = self.message_count
        for marker in array.markers[:MAX_MARKERS]:
            self.receive(marker, context)
        self.message_count = before
        self.count()

    def receive(self, message: Any, context: Context) -> None:
        """Process a marker; deleting needs no transform."""
        if message.action in (MarkerMessage.DELETE, MarkerMessage.DELETEALL):
            self.count()
            if message.action == MarkerMessage.DELETE:
                self._drop((message.ns, message.id))
            else:
                for each in list(self.markers):
                    self._drop(each)
            return
        super().receive(message, context)

    def transform_status(self, received: Received) -> str:
        """Return the marker's name: each marker has a separate status line."""
        return _named(received.message.ns, received.message.id)

    def accept(self, received: Received, context: Context) -> bool:
        """Accept a marker whose pose is known."""
        del context
        marker = received.message
        name = (marker.ns, marker.id)
        self.clear_status(_named(*name))
        self._without_status.discard(name)
        if marker.action != MarkerMessage.ADD:
            self._say(name, Level.ERROR, f"Unknown marker action: {marker.action}")
            return False
        level, text = check(marker)
        if text:
            self._say(name, level, text)
        self.markers.pop(name, None)
        if level is Level.ERROR:
            return False
        namespaces = self["Namespaces"]
        if len(namespaces) < MAX_NAMESPACES:
            namespaces.setdefault(marker.ns, True)
        if len(self.markers) < MAX_MARKERS:
            self.markers[name] = received
        return False

    def reset(self) -> None:
        """Discard all markers."""
        super().reset()
        self.markers = {}
        self._without_status = set()

    def _drop(self, name: tuple[str, int]) -> None:
        self.markers.pop(name, None)
        self.clear_status(_named(*name))
        self._without_status.discard(name)

    def _say(self, name: tuple[str, int], level: Level, text: str) -> None:
        """Give a marker a status line, unless there are too many already."""
        own = _named(*name)
        if own in self._statuses or len(self._statuses) < MAX_STATUSES:
            self.set_status(level, own, text)
        else:
            self._without_status.add(name)

    # -- drawing -------------------------------------------------------------------------------------------------

    def update(self, context: Context) -> None:
        """Remove markers whose lifetime has ended, and move locked ones with their frames."""
        super().update(context)
        for name, received in list(self.markers.items()):
            lifetime = received.message.lifetime.to_nsec()
            if lifetime > 0 and context.now_ns - received.arrived_ns >= lifetime:
                self._drop(name)
            elif received.message.frame_locked:
                self._follow_frame(name, received, context)

    def _follow_frame(self, name: tuple[str, int], received: Received, context: Context) -> None:
        try:
            place: Rigid = context.place(received.frame)
        except TransformException as error:
            self._say(name, Level.ERROR, context.problem(received.frame, error))
            return
        if place != received.place:
            received.place, received.drawn = place, None

    def primitives(self, context: Context) -> Iterable[Primitive]:
        """Return the primitives of the markers in visible namespaces, in the order of namespaces and ids."""
        found: list[Primitive] = []
        shown = 0
        namespaces = self["Namespaces"]
        for name, received in sorted(self.markers.items(), key=lambda item: item[0]):
            if namespaces.get(name[0], True) is False:
                continue
            if received.drawn is None:
                received.drawn = ()
                try:
                    received.drawn = tuple(self.draw(received, context))
                except DisplayError as error:
                    self._say(name, Level.ERROR, str(error).partition("\n")[0])
            shown += bool(received.drawn)
            found += received.drawn
        if self.message_count:
            names = {ns for ns, _ in self.markers}
            text = f"Showing [{shown}] of [{len(self.markers)}] markers in [{len(names)}] namespaces"
            self.set_status(Level.OK, "Markers", text)
        if self._without_status:
            self.set_status(Level.WARN, "Others", f"{len(self._without_status)} more markers have warnings or errors")
        else:
            self.clear_status("Others")
        if len(self.markers) >= MAX_MARKERS:
            self.set_status(Level.WARN, "Markers", f"Showing the first {MAX_MARKERS} markers")
        return found

    def draw(self, received: Received, context: Context) -> Iterable[Primitive]:
        """Return the primitives of a marker."""
        del context
        return marker_primitives(received.message, received.pose(received.message.pose))


def _named(ns: str, number: int) -> str:
    return f"{ns}/{number}"
