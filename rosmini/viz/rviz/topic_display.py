"""Displays of a topic: messages wait for their transform, are stored as long as requested, and are drawn once each."""

from __future__ import annotations

import math
from abc import abstractmethod
from collections import deque
from collections.abc import Iterable
from typing import Any, ClassVar

import numpy as np

from rosmini.core.errors import RosminiError
from rosmini.core.geometry.products import matrix_product
from rosmini.core.tf import ConnectivityException, LookupException, TransformException
from rosmini.core.tf.rigid import IDENTITY, Floats, Rigid, matrix, transform_points

from .context import Context
from .display import Display, Level
from .primitives import INVALID, DisplayError, Primitive
from .properties import Property

MAX_STORED = 10_000
"""Maximum number of messages that a display stores, whatever its history or decay time."""
MAX_WAITING = 1000
LENGTH_TOLERANCE = 0.01
"""Deviation of a quaternion's length from 1 that is tolerated without a warning."""


class Received:
    """A message, and the pose of its frame in the fixed frame.

    `pose` and `points` transform its contents to the fixed frame, and validate them.
    """

    def __init__(self, message: Any, arrived_ns: int) -> None:
        self.message = message
        self.arrived_ns = arrived_ns
        """Time of arrival [ns]."""
        header = getattr(message, "header", None)
        self.frame = "" if header is None else str(header.frame_id)
        self.stamp_ns = 0 if header is None else header.stamp.to_nsec()
        self.sender = str((getattr(message, "_connection_header", None) or {}).get("callerid", "unknown_publisher"))
        self.place: Rigid = IDENTITY
        """The pose of the message's frame in the fixed frame."""
        self.notes: list[str] = []
        """Irregularities of the message, in words; they become a warning."""
        self.drawn: tuple[Primitive, ...] | None = None
        self.version = -1

    def points(self, points: Any) -> Floats:
        """Transform points (n, 3) of the message's frame to the fixed frame: an array, or messages with x, y, z."""
        if len(points) and hasattr(points[0], "x"):
            points = [(each.x, each.y, getattr(each, "z", 0.0)) for each in points]
        array = np.asarray(points, dtype=float).reshape(-1, 3)
        return transform_points(self.place, array)

    def pose(self, pose: Any) -> Floats:
        """Return a `geometry_msgs/Pose` of the message's frame as a transform (4, 4) in the fixed frame.

        A quaternion of zeros means no rotation, as in RViz, with a note. Raises `DisplayError` for nan.
        """
        return matrix_product(matrix(self.place), matrix(self.local(pose)))

    def local(self, pose: Any) -> Rigid:
        """Return a `geometry_msgs/Pose` in the message's own frame; validated like in `pose`."""
        at, turned = pose.position, pose.orientation
        values = (at.x, at.y, at.z, turned.x, turned.y, turned.z, turned.w)
        if not all(math.isfinite(value) for value in values):
            raise DisplayError(INVALID)
        x, y, z, *quaternion = values
        length = math.hypot(*quaternion)
        if length == 0.0:
            self.note("a quaternion is all zeros; it is drawn as no rotation")
            return (x, y, z, 0.0, 0.0, 0.0, 1.0)
        if abs(length - 1.0) > LENGTH_TOLERANCE:
            self.note("a quaternion is not of length 1")
        i, j, k, w = (part / length for part in quaternion)
        return (x, y, z, i, j, k, w)

    def note(self, text: str) -> None:
        """Add a note about an irregularity of the message, once."""
        if text not in self.notes:
            self.notes.append(text)


class TopicDisplay(Display):
    """The base of displays of one topic. A subclass defines `message`, `properties` and `draw`."""

    message: ClassVar[str] = ""
    """The type of the messages, such as `sensor_msgs/LaserScan`."""
    topic_property: ClassVar[str] = "Topic"
    """The name of the property with the topic's name."""
    history: ClassVar[str] = ""
    """The property with the number of messages to store (0 for all); by default one, or according to `Decay Time`."""
    needs_transform: ClassVar[bool] = True
    """True if a message waits until its frame can be transformed to the fixed frame."""

    properties: ClassVar[tuple[Property, ...]] = (
        Property("Topic", "", "the topic to subscribe to"),
        Property(
            "Queue Size", 10, "maximum number of messages that wait for their transform", minimum=1, maximum=MAX_WAITING
        ),
        Property("Unreliable", False, "prefer UDP; not supported"),
    )

    def __init__(self, name: str = "", tree: Any = None) -> None:
        super().__init__(name, tree)
        self.message_count = 0
        """Number of messages received."""
        self._waiting: deque[Received] = deque()
        self.stored: deque[Received] = deque(maxlen=MAX_STORED)
        """The messages that are shown, the oldest first."""

    @classmethod
    def declared(cls) -> tuple[Property, ...]:
        """Return all properties; that of the topic under this class's name for it."""
        found = super().declared()
        return tuple(each for each in found if each.name != "Topic" or cls.topic_property == "Topic")

    @abstractmethod
    def draw(self, received: Received, context: Context) -> Iterable[Primitive]:
        """Return the drawing of a message, in the fixed frame; called once per message, and when a property changed.

        May raise `DisplayError`: its text becomes the status, and the message is not shown.
        """

    def accept(self, received: Received, context: Context) -> bool:
        """Return True to store a message whose frame is known; a display with its own state processes it here.

        May raise `DisplayError`.
        """
        del received, context
        return True

    def moment(self, received: Received) -> int:
        """Return the time at which a message's frame is looked up [ns]; 0 to follow the frame as it moves."""
        return received.stamp_ns

    # -- hearing -------------------------------------------------------------------------------------------------

    @property
    def topic(self) -> str:
        """The topic's name as given."""
        return str(self[self.topic_property])

    def start(self, context: Context) -> None:
        """Subscribe to the topic."""
        if not self.topic:
            self.set_status(Level.ERROR, "Topic", "Error subscribing: Empty topic name")
            return
        why = context.why_no_messages(self.topic, self.message)
        if why.is_permanent:
            self.set_status(Level.ERROR, "Topic", f"No messages received: {why.text}")
            return
        try:
            self.subscribe(context, self.topic, self.message, lambda message: self.receive(message, context))
        except RosminiError as error:
            said = str(error).partition("\n")[0]
            self.set_status(Level.ERROR, "Topic", f"Error subscribing: {said}")
            return
        self.set_status(Level.WARN, "Topic", "No messages received")

    def changed(self, name: str) -> None:
        """Subscribe to another topic."""
        if name == self.topic_property:
            self.restart()

    def reset(self) -> None:
        """Discard all messages."""
        self.message_count = 0
        self._waiting.clear()
        self.stored.clear()

    def receive(self, message: Any, context: Context) -> None:
        """Process a message; it is stored as soon as its frame can be transformed to the fixed frame."""
        self.count()
        received = Received(message, context.now_ns)
        if not self.needs_transform:
            self._store(received, context)
            return
        self._waiting.append(received)
        while len(self._waiting) > self["Queue Size"]:
            dropped = self._waiting.popleft()
            if not (context.knows(dropped.frame) and self._try_store(dropped, context)):
                self._report_transform(dropped, context, is_dropped=True)
        self._process_waiting(context)

    def count(self) -> None:
        """Count a received message in the status."""
        self.message_count += 1
        plural = "" if self.message_count == 1 else "s"
        self.set_status(Level.OK, "Topic", f"{self.message_count} message{plural} received")

    def transform_status(self, received: Received) -> str:
        """Return the name of the status of a message's transform."""
        return f"Transform [sender={received.sender}]"

    def _process_waiting(self, context: Context) -> None:
        """Store waiting messages whose transform is known now, in order of arrival; drop those that are too old."""
        still: deque[Received] = deque()
        lost: Received | None = None
        while self._waiting:
            received = self._waiting.popleft()
            if not context.knows(received.frame):
                still.append(lost := received)
                continue
            if self._try_store(received, context):
                continue
            self._report_transform(received, context)
            if not context.is_past(received.frame, self.moment(received)):
                still.append(received)
        self._waiting = still
        if lost is not None:
            self._report_transform(lost, context)

    def _try_store(self, received: Received, context: Context) -> bool:
        try:
            received.place = context.place(received.frame, self.moment(received))
        except TransformException:
            return False
        self.set_status(Level.OK, self.transform_status(received), "Transform OK")
        self._store(received, context)
        return True

    def _report_transform(self, received: Received, context: Context, *, is_dropped: bool = False) -> None:
        name = self.transform_status(received)
        if not context.knows(received.frame):
            self.set_status(Level.ERROR, name, context.problem(received.frame))
            return
        if context.is_past(received.frame, self.moment(received)):
            stamp = received.stamp_ns / 1e9
            text = f"Message removed because it is too old (frame=[{received.frame}], stamp=[{stamp:.9f}])"
            self.set_status(Level.ERROR, name, text)
            return
        try:
            context.place(received.frame, self.moment(received))
        except (LookupException, ConnectivityException) as error:
            self.set_status(Level.ERROR, name, context.problem(received.frame, error))
        except TransformException as error:
            if is_dropped or not self.stored:  # otherwise the transform will arrive soon, as usual
                level = Level.ERROR if is_dropped or not received.frame else Level.WARN
                self.set_status(level, name, context.problem(received.frame, error))

    def _store(self, received: Received, context: Context) -> None:
        try:
            if not self.accept(received, context):
                return
        except Exception as error:  # an error in one message must not stop the scene
            self.fail("Topic", error)
            return
        if not self._is_endless and not self.history:
            self.stored.clear()
        self.stored.append(received)
        self._drop_old(context)

    @property
    def _is_endless(self) -> bool:
        return "Decay Time" in self and self["Decay Time"] > 0

    def _drop_old(self, context: Context) -> None:
        """Drop messages beyond the history or the decay time."""
        if self._is_endless:
            oldest = context.now_ns - int(self["Decay Time"] * 1e9)
            while len(self.stored) > 1 and self.stored[0].arrived_ns < oldest:
                self.stored.popleft()
        elif self.history:
            most = self[self.history] or MAX_STORED
            while len(self.stored) > most:
                self.stored.popleft()

    def _update_frames(self, context: Context) -> None:
        """Update the poses of frames that the drawing follows."""
        for received in self.stored:
            if self.needs_transform and self.moment(received) == 0:
                try:
                    place = context.place(received.frame)
                except TransformException as error:
                    name = self.transform_status(received)
                    self.set_status(Level.ERROR, name, context.problem(received.frame, error))
                    continue
                if place != received.place:
                    received.place, received.drawn = place, None

    # -- drawing -------------------------------------------------------------------------------------------------

    def update(self, context: Context) -> None:
        """Check messages that wait for a transform, and report why none arrived if that is so."""
        if self._waiting:
            self._process_waiting(context)
        self._drop_old(context)
        self._update_frames(context)
        topic = self._statuses.get("Topic")
        if not self.message_count and topic is not None and topic.text.startswith("No messages"):
            why = context.why_no_messages(self.topic, self.message)
            if topic.level is Level.ERROR and not why.is_permanent:
                self.restart()
            level = Level.ERROR if why.is_permanent else Level.WARN
            self.set_status(level, "Topic", f"No messages received: {why.text}")

    def primitives(self, context: Context) -> Iterable[Primitive]:
        """Return the drawings of the stored messages."""
        found: list[Primitive] = []
        notes: list[str] = []
        for received in self.stored:
            if received.drawn is None or received.version != self.version:
                received.version, received.drawn = self.version, ()
                try:
                    received.drawn = tuple(self.draw(received, context))
                except Exception as error:  # an error in one message must not stop the scene
                    self.fail("Topic", error)
            found += received.drawn
            notes += received.notes
        if notes:
            self.set_status(Level.WARN, "Message", "; ".join(dict.fromkeys(notes)))
        else:
            self.clear_status("Message")
        return found
