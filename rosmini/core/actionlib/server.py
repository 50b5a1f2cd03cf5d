"""Action servers with goal handles: http://wiki.ros.org/actionlib.

The server decides the outcome of each goal. It publishes the list of its goals on ``status`` after each change, and
periodically (by default at 5 Hz).
"""

from __future__ import annotations

from contextlib import nullcontext
from functools import partial
from math import inf
from typing import TYPE_CHECKING, Any

from rosmini.core.time import Duration, Time
from rosmini.msgs import message_class

from .client import queue_size_of
from .server_goal_handle import ServerGoalHandle
from .spec import ActionTypes, GoalIDGenerator, StatusTracker
from .states import Status

if TYPE_CHECKING:
    from collections.abc import Callable
    from contextlib import AbstractContextManager

    from rosmini.core.graph import Node, Publisher

    from .states import ActionException

__all__ = ["ActionServer", "ServerGoalHandle"]

STATUS_HZ = 5.0
"""Rate at which the list of goals is published [Hz]."""

STATUS_LIST_TIMEOUT = 5.0
"""How long a finished goal stays in the list [s], so that every client learns of its end."""

BATCH_DIVISOR = 16
"""A list of n goals is published after at most n / BATCH_DIVISOR changes, and once there is no other work to do."""

CANCELLED_BEFORE = "it was sent at or before the time up to which goals were cancelled"
"""Text for a goal that arrives after it was cancelled."""


class ActionServer:
    """Accepts any number of goals at a time, and passes each to ``goal_cb(handle)``.

    Args:
        node: the server's node.
        ns: the action's name; the five topics are below it.
        ActionSpec: the action's type, such as ``actionlib_tutorials.msg.FibonacciAction``.
        goal_cb: called with the handle of each new goal; accepts or rejects it, and later ends it.
        cancel_cb: called with the handle of each goal that a client asks to cancel.
        auto_start: start at once; otherwise call :meth:`start`.
        numpy: deliver numeric arrays in goals as numpy arrays; if False, as rospy's tuples.
        strict: raise on illegal transitions; the graph's setting by default.
        handle_class: the class of the handles.

    Parameters (http://wiki.ros.org/actionlib): ``actionlib_status_frequency``, searched upwards from the node [Hz, 5; 0
    for changes only]; ``<ns>/status_list_timeout`` [s, 5]. Raises ``ActionException`` if the type is not an action.

    A finished goal is removed from the list ``status_list_timeout`` after its end.

    """

    def __init__(
        self,
        node: Node,
        ns: str,
        ActionSpec: Any,
        goal_cb: Callable[[ServerGoalHandle], object],
        cancel_cb: Callable[[ServerGoalHandle], object] | None = None,
        auto_start: bool = True,
        *,
        numpy: bool = True,
        strict: bool | None = None,
        handle_class: type[ServerGoalHandle] = ServerGoalHandle,
    ) -> None:
        self.node = node
        self.types = ActionTypes.of(ActionSpec)
        self.ActionSpec, self.ActionResultType = ActionSpec, self.types.result
        self.ActionGoal, self.ActionResult, self.ActionFeedback = self.types[:3]
        self.ns = node.resolve(ns)
        self.strict = node.graph.strict if strict is None else strict
        self.started = False
        self.handle_class = handle_class
        self.goal_callback = goal_cb
        self.cancel_callback = cancel_cb
        self._numpy = numpy
        self.lock: AbstractContextManager[Any] = nullcontext()
        """Held while an incoming goal or cancellation is handled. Only servers in rospy's style set a real lock."""
        self.status_list: list[StatusTracker] = []
        self._by_id: dict[str, StatusTracker] = {}
        self._unpublished = 0
        self._catching_up = False
        self._stale_from = inf
        self.status_list_timeout = Duration()
        self.last_cancel = Time()
        """Goals up to this stamp are cancelled, including those that arrive later with an older stamp."""
        self.id_generator = GoalIDGenerator(node)
        if auto_start:
            self.start()

    def register_goal_callback(self, cb: Callable[[ServerGoalHandle], object]) -> None:
        """Pass new goals to ``cb`` from now on."""
        self.goal_callback = cb

    def register_cancel_callback(self, cancel_cb: Callable[[ServerGoalHandle], object]) -> None:
        """Pass cancellations to ``cancel_cb`` from now on."""
        self.cancel_callback = cancel_cb

    @property
    def goals(self) -> tuple[ServerGoalHandle, ...]:
        """The goals in the list, in the order of their arrival."""
        return tuple(self._handle(tracker) for tracker in self.status_list if tracker.goal is not None)

    def get_default_result(self) -> Any:
        """Return an empty result."""
        return self.types.result()

    # -- start and stop ------------------------------------------------------------------------------------------

    def start(self) -> None:
        """Open the five topics. Safe to call again."""
        self.node.scheduler.run_in_scheduler(self._start)

    def _start(self) -> None:
        if self.started:
            return
        node, ns, types = self.node, self.ns, self.types
        out = queue_size_of(node, "actionlib_server_pub_queue_size", 50)
        into = queue_size_of(node, "actionlib_server_sub_queue_size", None)
        statuses = message_class("actionlib_msgs/GoalStatusArray")
        self.status_pub = node.publisher(f"{ns}/status", statuses, queue_size=out, latch=True)
        self.result_pub = node.publisher(f"{ns}/result", types.action_result, queue_size=out)
        self.feedback_pub = node.publisher(f"{ns}/feedback", types.action_feedback, queue_size=out)
        hear = partial(node.subscriber, queue_size=into, numpy=self._numpy)
        self.goal_sub = hear(f"{ns}/goal", types.action_goal, self.internal_goal_callback)
        self.cancel_sub = hear(f"{ns}/cancel", message_class("actionlib_msgs/GoalID"), self.internal_cancel_callback)
        keep = node.get_param(f"{ns}/status_list_timeout", STATUS_LIST_TIMEOUT, expect=float)
        self.status_list_timeout = Duration.from_sec(keep)
        frequency = self._status_frequency()
        self.status_timer = (
            node.timer(1 / frequency, lambda _: self.publish_status(), reset=True) if frequency > 0 else None
        )
        self.started = True
        self.publish_status()

    def _status_frequency(self) -> float:
        node = self.node
        old = f"{self.ns}/status_frequency"
        if node.has_param(old):
            node.logwarn(f"the parameter {old} is deprecated: set actionlib_status_frequency instead")
            return float(node.get_param(old, expect=float))
        found = node.search_param("actionlib_status_frequency")
        return STATUS_HZ if found is None else float(node.get_param(found, expect=float))

    def stop(self) -> None:
        """Unregister from the five topics; goals keep their status, which is no longer published."""
        self.node.scheduler.run_in_scheduler(self._stop)

    def _stop(self) -> None:
        if not self.started:
            return
        self.started = False
        if self.status_timer is not None:
            self.status_timer.shutdown()
        for end in (self.goal_sub, self.cancel_sub, self.status_pub, self.feedback_pub, self.result_pub):
            end.unregister()

    # -- outgoing messages ---------------------------------------------------------------------------------------

    def complain(self, error: ActionException) -> None:
        """Raise ``error`` if the server is strict; otherwise log it, as rospy does. Called by the handles."""
        if self.strict:
            raise error
        self.node.logerr(error)

    def publish_status(self) -> None:
        """Publish the list of goals now, without those that ended more than ``status_list_timeout`` ago."""
        now = self.node.now()
        self._drop_stale(now)
        self._unpublished = 0
        if self._open:
            message = self.status_pub.message_class(status_list=[one.status for one in self.status_list])
            message.header.stamp = now
            self.status_pub.publish(message)

    def publish_change(self) -> None:
        """Publish the list of goals after a change: at once, or, if the list is long, together with further changes.

        The cost of each publication grows with the length of the list. The list is therefore published after a fixed
        share of it has changed, so that the cost per goal does not depend on the number of goals.
        """
        self._unpublished += 1
        if self._unpublished * BATCH_DIVISOR >= len(self.status_list):
            self.publish_status()
        elif not self._catching_up:
            self._catching_up = True
            self.node.scheduler.call_last(self._catch_up)

    def _catch_up(self) -> None:
        self._catching_up = False
        if self._unpublished:
            self.publish_status()

    def _drop_stale(self, now: Time) -> None:
        """Drop the goals that ended more than ``status_list_timeout`` before ``now``."""
        limit = now.to_nsec() - self.status_list_timeout.to_nsec()
        if limit <= self._stale_from:
            return
        ends = [(tracker, tracker.handle_destruction_time.to_nsec()) for tracker in self.status_list]
        self.status_list[:] = [tracker for tracker, end in ends if not 0 < end < limit]
        self._by_id = {tracker.status.goal_id.id: tracker for tracker in self.status_list}
        self._stale_from = min((end for _, end in ends if end >= limit), default=inf)

    def end(self, tracker: StatusTracker) -> None:
        """Record the time at which a goal ended. Called by the handles."""
        tracker.handle_destruction_time = now = self.node.now()
        self._stale_from = min(self._stale_from, now.to_nsec())

    def publish_result(self, status: Any, result: Any) -> None:
        """Publish a result, and the list of goals after it. Called by the handles."""
        self._publish_on_goal("result", status, result)
        self.publish_change()

    def publish_feedback(self, status: Any, feedback: Any) -> None:
        """Publish feedback on the goal of ``status``. Called by the handles."""
        self._publish_on_goal("feedback", status, feedback)

    def _publish_on_goal(self, part: str, status: Any, content: Any) -> None:
        if not self._open:
            return
        end: Publisher = self.result_pub if part == "result" else self.feedback_pub
        message = end.message_class(status=status, **{part: content})
        message.header.stamp = self.node.now()
        if end.num_connections():  # a client that has left is no reason to warn of lost messages
            end.publish(message)

    @property
    def _open(self) -> bool:
        return self.started and not self.node.is_shutdown()

    # -- incoming messages ---------------------------------------------------------------------------------------

    def _handle(self, tracker: StatusTracker) -> ServerGoalHandle:
        return self.handle_class(tracker, self, tracker.handle_tracker)

    def internal_goal_callback(self, action_goal: Any) -> None:
        """Handle a message on ``goal``: add the goal to the list, and pass its handle to the goal callback."""
        with self.lock:
            self._take(action_goal)

    def _take(self, action_goal: Any) -> None:
        known = self._by_id.get(action_goal.goal_id.id)
        if known is not None:
            self._take_again(known)
            return
        tracker = StatusTracker(self.id_generator, self.node.now(), goal=action_goal)
        self._list(tracker)
        handle = tracker.handle_tracker = self._handle(tracker)
        stamp = action_goal.goal_id.stamp
        if stamp and stamp <= self.last_cancel:
            handle.set_canceled(None, CANCELLED_BEFORE)
        else:
            self.node.guarded(self.goal_callback, handle, what=f"a goal of {self.ns}")

    def _list(self, tracker: StatusTracker) -> None:
        self.status_list.append(tracker)
        self._by_id[tracker.status.goal_id.id] = tracker

    def _take_again(self, known: StatusTracker) -> None:
        """Handle a goal whose id is already listed: it was sent twice, or cancelled before it arrived."""
        if known.status.status == Status.RECALLING:
            known.status.status = Status.RECALLED
            self.end(known)  # actionlib does not, and lists the goal for ever
            self.publish_result(known.status, self.get_default_result())
        elif known.handle_tracker is None:
            self.end(known)

    def internal_cancel_callback(self, request: Any) -> None:
        """Handle a message on ``cancel``: pass the handle of each matching goal to the cancel callback."""
        with self.lock:
            self._cancel(request)

    def _cancel(self, request: Any) -> None:
        everything = not request.id and not request.stamp
        found = False
        named = self._by_id.get(request.id)
        for tracker in list(self.status_list) if named is None or request.stamp else [named]:
            goal_id = tracker.status.goal_id
            before = request.stamp and goal_id.stamp <= request.stamp
            if everything or before or goal_id.id == request.id:
                found = found or goal_id.id == request.id
                self._request_cancel(tracker)
        if request.id and not found:
            self._note_early(request)
        self.last_cancel = max(self.last_cancel, request.stamp)

    def _request_cancel(self, tracker: StatusTracker) -> None:
        handle = self._handle(tracker)
        if tracker.handle_tracker is None:
            tracker.handle_tracker = handle
            self.end(tracker)
        if handle.set_cancel_requested() and self.cancel_callback is not None:
            self.node.guarded(self.cancel_callback, handle, what=f"a cancellation of {self.ns}")

    def _note_early(self, request: Any) -> None:
        """Record the cancellation of a goal that has not arrived yet: messages on two topics may change order."""
        note = StatusTracker(self.id_generator, self.node.now(), request, Status.RECALLING)
        self.end(note)
        self._list(note)
