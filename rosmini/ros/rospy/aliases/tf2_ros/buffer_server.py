"""``tf2_ros.buffer_server``: lets other nodes look up transforms in a buffer (http://wiki.ros.org/tf2_ros).

Equivalent to the server of C++'s ``tf2_ros``, since Python has none: it serves ``tf2_msgs/LookupTransformAction``.
Goals may wait for a transform; for a failed lookup the action succeeds, and its result contains the error.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rosmini.core.tf.errors import (
    ConnectivityException,
    ExtrapolationException,
    InvalidArgumentException,
    LookupException,
    TimeoutException,
    TransformException,
)
from rosmini.core.time import Duration, Time
from rosmini.msgs import message_class
from rosmini.ros.rospy.aliases.actionlib import ActionServer
from rosmini.ros.rospy.session import require_node

if TYPE_CHECKING:
    from rosmini.core import tf
    from rosmini.core.actionlib import ServerGoalHandle
    from rosmini.core.graph import Timer

ERRORS: dict[int, type[TransformException]] = {
    1: LookupException,
    2: ConnectivityException,
    3: ExtrapolationException,
    4: InvalidArgumentException,
    5: TimeoutException,
    6: TransformException,
}
"""Exceptions for the error codes of ``tf2_msgs/TF2Error``."""


class BufferServer:
    """Answers lookups of other nodes from ``buffer``, at the action ``ns``.

    A goal that cannot be answered yet is checked every ``check_period`` until its timeout. Raises
    ``ROSInitException`` before ``init_node``.
    """

    def __init__(
        self, buffer: tf.Buffer, ns: str, auto_start: bool = True, check_period: Duration | None = None
    ) -> None:
        self._node = require_node(f"a buffer server at {ns}")
        self._buffer = buffer
        self._period = 0.01 if check_period is None else check_period.to_sec()
        self._waiting: dict[str, tuple[ServerGoalHandle, Time]] = {}
        self._timer: Timer | None = None
        action = message_class("tf2_msgs/LookupTransformAction")
        self._server = ActionServer(ns, action, self._take, self._cancel, auto_start=False)
        if auto_start:
            self.start()

    def start(self) -> None:
        """Start answering."""
        self._server.start()

    def _take(self, handle: ServerGoalHandle) -> None:
        handle.set_accepted()
        end = self._node.now() + handle.get_goal().timeout
        if not self._answered(handle, end):
            self._waiting[handle.id] = handle, end
            if self._timer is None:
                self._timer = self._node.timer(self._period, lambda _: self._look())

    def _cancel(self, handle: ServerGoalHandle) -> None:
        self._waiting.pop(handle.id, None)
        handle.set_canceled()

    def _look(self) -> None:
        for name, (handle, end) in list(self._waiting.items()):
            if self._answered(handle, end):
                self._waiting.pop(name, None)
        if not self._waiting and self._timer is not None:
            self._timer.shutdown()
            self._timer = None

    def _answered(self, handle: ServerGoalHandle, end: Time) -> bool:
        """Answer a goal if its transform is available or its time is over; return True if answered."""
        result = handle.get_default_result()
        try:
            result.transform = self._lookup(handle.get_goal())
        except TransformException as error:
            if self._node.now() < end:
                return False
            result.error.error = next(number for number, kind in ERRORS.items() if isinstance(error, kind))
            result.error.error_string = str(error)
        handle.set_succeeded(result)
        return True

    def _lookup(self, goal: Any) -> Any:
        target, source = goal.target_frame, goal.source_frame
        if not goal.advanced:
            return self._buffer.lookup_transform_core(target, source, goal.source_time)
        times = goal.target_time, goal.source_time
        return self._buffer.lookup_transform_full_core(target, times[0], source, times[1], goal.fixed_frame)
