"""The server: manages a node's interactive markers, publishes their changes, and calls back on user actions.

Topics of the server ``NAME`` (http://wiki.ros.org/rviz/DisplayTypes/InteractiveMarker): ``NAME/update`` has numbered
changes and a keep-alive twice a second; ``NAME/update_full`` is latched and has all markers up to a number;
``NAME/feedback`` reports the user's actions from RViz.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from enum import Enum, auto
from typing import TYPE_CHECKING, Any

from rosmini.core.time import Time
from rosmini.msgs import message_class

if TYPE_CHECKING:
    from rosmini.core.graph import Node

Header = message_class("std_msgs/Header")
InteractiveMarker = message_class("visualization_msgs/InteractiveMarker")
InteractiveMarkerFeedback = message_class("visualization_msgs/InteractiveMarkerFeedback")
InteractiveMarkerInit = message_class("visualization_msgs/InteractiveMarkerInit")
InteractiveMarkerPose = message_class("visualization_msgs/InteractiveMarkerPose")
InteractiveMarkerUpdate = message_class("visualization_msgs/InteractiveMarkerUpdate")

FeedbackCallback = Callable[[Any], object]

_KEEP_ALIVE = 0.5
_IN_USE = 1.0
_AS_BEFORE = -1
"""Leaves the callback of a marker unchanged; the real server uses the same value."""


@dataclass
class _Callbacks:
    """Callbacks of a marker: by the type of feedback, otherwise the default one."""

    default: FeedbackCallback | None = None
    by_type: dict[int, FeedbackCallback] = field(default_factory=dict)

    def set(self, callback: FeedbackCallback | None, kind: int | None) -> None:
        if kind is None:
            self.default = callback
        elif callback is None:
            self.by_type.pop(kind, None)
        else:
            self.by_type[kind] = callback


@dataclass
class _State:
    """A marker that clients know."""

    marker: Any
    callbacks: _Callbacks
    last_feedback: Time
    client: str = ""


class _Kind(Enum):
    FULL = auto()
    POSE = auto()
    ERASE = auto()


@dataclass
class _Change:
    """A pending change of one marker, applied by `applyChanges`."""

    kind: _Kind
    marker: Any = field(default_factory=InteractiveMarker)
    callbacks: _Callbacks = field(default_factory=_Callbacks)


class InteractiveMarkerServer:
    """Shows interactive markers under the name ``topic_ns`` and calls back on user actions.

    ``server_id`` is needed only if one node has several servers with the same name; ``q_size`` is the length of the
    feedback queue. Changes by `insert`, `setPose`, `erase` and `clear` take effect at `applyChanges`. Names and return
    values are those of the Python server of ROS's ``interactive_markers`` 1.12.
    """

    DEFAULT_FEEDBACK_CB = 255
    """Type of feedback with which `setCallback` sets the default callback."""

    def __init__(self, node: Node, topic_ns: str, server_id: str = "", q_size: int = 100) -> None:
        self.node = node
        self.topic_ns = topic_ns
        self.server_id = node.name + server_id
        self.seq_num = 0
        self._states: dict[str, _State] = {}
        self._pending: dict[str, _Change] = {}
        self.init_pub = node.publisher(topic_ns + "/update_full", InteractiveMarkerInit, latch=True, queue_size=100)
        self.update_pub = node.publisher(topic_ns + "/update", InteractiveMarkerUpdate, queue_size=100)
        self.update_pub.expect_nobody()
        self.feedback_sub = node.subscriber(
            topic_ns + "/feedback", InteractiveMarkerFeedback, self.processFeedback, queue_size=q_size, numpy=False
        )
        self._timer = node.timer(_KEEP_ALIVE, self.keepAlive, reset=True)
        self.publishInit()

    def insert(
        self,
        marker: Any,
        feedback_cb: FeedbackCallback | int | None = _AS_BEFORE,
        feedback_type: int = DEFAULT_FEEDBACK_CB,
    ) -> None:
        """Add the ``visualization_msgs/InteractiveMarker``, or replace the one of the same name.

        ``feedback_cb(feedback)`` is called for feedback of ``feedback_type``, or for all; -1 keeps the callbacks.
        """
        change = self._pending.setdefault(marker.name, _Change(_Kind.FULL))
        change.kind, change.marker = _Kind.FULL, marker
        if not isinstance(feedback_cb, int):
            self.setCallback(marker.name, feedback_cb, feedback_type)

    def setPose(self, name: str, pose: Any, header: Any = None) -> bool:
        """Move a marker to the ``geometry_msgs/Pose``, in the frame of ``header`` if it names one, else as before.

        Return True if the marker exists; a marker inserted since the last `applyChanges` is not moved.
        """
        state, change = self._states.get(name), self._pending.get(name)
        if state is None or (change is not None and change.kind is _Kind.FULL):
            return False
        self._move(name, pose, header if header is not None and header.frame_id else state.marker.header)
        return True

    def erase(self, name: str) -> bool:
        """Remove a marker; return True if it existed."""
        change = self._pending.get(name)
        if change is not None:
            change.kind = _Kind.ERASE
        elif name in self._states:
            self._pending[name] = _Change(_Kind.ERASE)
        else:
            return False
        return True

    def clear(self) -> None:
        """Remove all markers and discard pending changes."""
        self._pending = {name: _Change(_Kind.ERASE) for name in self._states}

    def setCallback(
        self, name: str, feedback_cb: FeedbackCallback | None, feedback_type: int = DEFAULT_FEEDBACK_CB
    ) -> bool:
        """Set ``feedback_cb(feedback)`` as the callback for feedback of this type, or for all.

        None removes the callback. Return True if the marker exists.
        """
        kind = None if feedback_type == self.DEFAULT_FEEDBACK_CB else feedback_type
        found = [one for one in (self._states.get(name), self._pending.get(name)) if one is not None]
        for one in found:
            one.callbacks.set(feedback_cb, kind)
        return bool(found)

    def applyChanges(self) -> None:
        """Publish the changes since the last call, if any, with the next sequence number."""
        if not self._pending:
            return
        pending, self._pending = self._pending, {}
        update = InteractiveMarkerUpdate(type=InteractiveMarkerUpdate.UPDATE)
        for name, change in pending.items():
            if change.kind is _Kind.ERASE:
                if self._states.pop(name, None) is not None:
                    update.erases.append(name)
                continue
            state = self._states.get(name)
            if change.kind is _Kind.FULL:
                if state is None:
                    state = _State(change.marker, change.callbacks, self.node.now())
                    self._states[name] = state
                state.marker = change.marker
                update.markers.append(change.marker)
            elif state is not None:
                marker = state.marker
                marker.pose, marker.header = change.marker.pose, change.marker.header
                update.poses.append(InteractiveMarkerPose(marker.header, marker.pose, marker.name))
        self.seq_num += 1
        self._publish(update)
        self.publishInit()

    def get(self, name: str) -> Any:
        """Return the marker of this name as it will be after `applyChanges`, or None.

        It is the server's own object: change it and `insert` it again.
        """
        state, change = self._states.get(name), self._pending.get(name)
        if change is None:
            return None if state is None else state.marker
        if change.kind is _Kind.FULL:
            return change.marker
        if change.kind is _Kind.ERASE or state is None:
            return None
        state.marker.pose = change.marker.pose
        return state.marker

    def processFeedback(self, feedback: Any) -> None:
        """Process a ``visualization_msgs/InteractiveMarkerFeedback``: move the marker and call its callback.

        While one client controls a marker (its last feedback is less than 1 s old), feedback from others is ignored.
        """
        name = feedback.marker_name
        state = self._states.get(name)
        if state is None:
            return
        now = self.node.now()
        if state.client != feedback.client_id and (now - state.last_feedback).to_sec() < _IN_USE:
            self.node.logdebug(
                f"feedback of {feedback.client_id} for the marker {name} is ignored: {state.client or 'nobody'} has "
                "hold of it"
            )
            return
        state.last_feedback, state.client = now, feedback.client_id
        if feedback.event_type == feedback.POSE_UPDATE:
            follows_frame = state.marker.header.stamp == Time()
            self._move(name, feedback.pose, state.marker.header if follows_frame else feedback.header)
        callback = state.callbacks.by_type.get(feedback.event_type, state.callbacks.default)
        if callback is not None:
            callback(feedback)

    def keepAlive(self, event: Any = None) -> None:  # noqa: ARG002 - called by a timer
        """Publish an update without changes, as a sign of life for clients."""
        self._publish(InteractiveMarkerUpdate(type=InteractiveMarkerUpdate.KEEP_ALIVE))

    def publishInit(self) -> None:
        """Publish all markers, so that late clients receive them."""
        markers = [state.marker for state in list(self._states.values())]
        self.init_pub.publish(InteractiveMarkerInit(server_id=self.server_id, seq_num=self.seq_num, markers=markers))

    def _publish(self, update: Any) -> None:
        update.server_id, update.seq_num = self.server_id, self.seq_num
        self.update_pub.publish(update)

    def _move(self, name: str, pose: Any, header: Any) -> None:
        change = self._pending.setdefault(name, _Change(_Kind.POSE))
        if change.kind is not _Kind.FULL:
            change.kind = _Kind.POSE
        change.marker.pose, change.marker.header = pose, header
