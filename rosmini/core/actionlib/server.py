"""Action servers with goal handles: http://wiki.ros.org/actionlib.

The server decides what becomes of a goal, and publishes the list of its goals on ``status``: on each change, and five
times a second.
"""

from __future__ import annotations

from contextlib import nullcontext
from functools import partial
from math import inf
from typing import TYPE_CHECKING, Any

from rosmini.core.time import Duration, Time
from rosmini.msgs import message_class

from .client import queue_size_of
from .goal_id_generator import GoalIDGenerator
from .server_goal_handle import ServerGoalHandle
from .spec import ActionTypes
from .states import Status
from .status_tracker import StatusTracker

if TYPE_CHECKING:
    from collections.abc import Callable
    from contextlib import AbstractContextManager

    from rosmini.core.graph import Node, Publisher

    from .errors import ActionException

__all__ = ["ActionServer", "ServerGoalHandle"]

STATUS_HZ = 5.0
"""How often the list of goals is published."""

STATUS_LIST_TIMEOUT = 5.0
"""How long a goal that is over stays in the list [s], so that every client hears of its end."""

SHARE = 16
"""A list of n goals is published after n/16 changes at the latest; after each change if nothing else is due."""

STALE = "it was sent at or before the time up to which goals were cancelled"
"""Why a goal is refused that arrives after its own cancellation."""


class ActionServer:
    """Takes goals, any number at a time, and hands each to ``goal_cb(handle)``.

    Args:
        node: whose server it is.
        ns: the action's name; the five topics are below it.
        ActionSpec: the action's type, such as ``actionlib_tutorials.msg.FibonacciAction``.
        goal_cb: gets the handle of each new goal, and sooner or later decides: accepted, rejected, and how it ends.
        cancel_cb: gets the handle of each goal of which cancellation is asked.
        auto_start: start at once; else :meth:`start` does.
        numpy: how numeric arrays in goals arrive: as numpy arrays, or as rospy's tuples.
        strict: whether illegal steps raise; as the graph if not given.
        handle_class: of which class the handles are.

    Parameters (http://wiki.ros.org/actionlib): ``actionlib_status_frequency``, searched upwards from the node [Hz, 5; 0
    for changes only]; ``<ns>/status_list_timeout`` [s, 5]. Raises ``ActionException`` for what is no action type.

    A goal that is over leaves the list ``status_list_timeout`` after its end.

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
        """Held while a goal or a cancellation that arrives is taken; scripts get a lock here (actionlib's ``lock``)."""
        self.status_list: list[StatusTracker] = []
        self._by_id: dict[str, StatusTracker] = {}
        self._unpublished = 0
        self._catching_up = False
        self._stale_from = inf
        self.status_list_timeout = Duration()
        self.last_cancel = Time()
        """Up to which stamp goals were cancelled: one that comes later with an older stamp is cancelled, too."""
        self.id_generator = GoalIDGenerator(node)
        if auto_start:
            self.start()

    def __repr__(self) -> str:
        return f"<{type(self).__name__} of {self.ns} in {self.node.name}>"

    def register_goal_callback(self, cb: Callable[[ServerGoalHandle], object]) -> None:
        """Hand new goals to ``cb`` from now on."""
        self.goal_callback = cb

    def register_cancel_callback(self, cancel_cb: Callable[[ServerGoalHandle], object]) -> None:
        """Hand cancellations to ``cancel_cb`` from now on."""
        self.cancel_callback = cancel_cb

    @property
    def goals(self) -> tuple[ServerGoalHandle, ...]:
        """The goals in the list, in the order of their arrival."""
        return tuple(self._handle(tracker) for tracker in self.status_list if tracker.goal is not None)

    def get_default_result(self) -> Any:
        """Return an empty result."""
        return self.types.result()

    # -- beginning and end ---------------------------------------------------------------------------------------

    def start(self) -> None:
        """Open the five topics. Harmless when repeated."""
        self.node.scheduler.on_hub(self._start)

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
        self.cancel_sub = hear(
            f"{ns}/cancel", message_class("actionlib_msgs/GoalID"), self.internal_cancel_callback
        )
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
            node.logwarn(f"the parameter {old} is out of use: set actionlib_status_frequency instead")
            return float(node.get_param(old, expect=float))
        found = node.search_param("actionlib_status_frequency")
        return STATUS_HZ if found is None else float(node.get_param(found, expect=float))

    def stop(self) -> None:
        """Leave the five topics; goals stay as they are, and nobody hears of them any more."""
        self.node.scheduler.on_hub(self._stop)

    def _stop(self) -> None:
        if not self.started:
            return
        self.started = False
        if self.status_timer is not None:
            self.status_timer.shutdown()
        for end in (self.goal_sub, self.cancel_sub, self.status_pub, self.feedback_pub, self.result_pub):
            end.unregister()

    # -- what is said --------------------------------------------------------------------------------------------

    def complain(self, error: ActionException) -> None:
        """Raise an error of whoever uses the server, or log it in rospy's style. For the handles."""
        if self.strict:
            raise error
        self.node.logerr(error)

    def publish_status(self) -> None:
        """Publish the list of goals now; those that are over for long enough leave it."""
        now = self.node.now()
        self._drop_stale(now)
        self._unpublished = 0
        if self._open:
            message = self.status_pub.message_class(status_list=[one.status for one in self.status_list])
            message.header.stamp = now
            self.status_pub.publish(message)

    def publish_change(self) -> None:
        """Publish the list of goals because one has changed: at once, or, if it is long, with further changes.

        Each publication costs as much as the list is long. A list that is published after a fixed share of its length
        has changed costs the same for each goal, however many there are.
        """
        self._unpublished += 1
        if self._unpublished * SHARE >= len(self.status_list):
            self.publish_status()
        elif not self._catching_up:
            self._catching_up = True
            self.node.scheduler.call_last(self._catch_up)

    def _catch_up(self) -> None:
        self._catching_up = False
        if self._unpublished:
            self.publish_status()

    def _drop_stale(self, now: Time) -> None:
        """Drop the goals that have been over for long enough."""
        limit = now.to_nsec() - self.status_list_timeout.to_nsec()
        if limit <= self._stale_from:
            return
        ends = [(tracker, tracker.handle_destruction_time.to_nsec()) for tracker in self.status_list]
        self.status_list[:] = [tracker for tracker, end in ends if not 0 < end < limit]
        self._by_id = {tracker.status.goal_id.id: tracker for tracker in self.status_list}
        self._stale_from = min((end for _, end in ends if end >= limit), default=inf)

    def end(self, tracker: StatusTracker) -> None:
        """Note that nothing more is to be told of a goal. For the handles."""
        tracker.handle_destruction_time = now = self.node.now()
        self._stale_from = min(self._stale_from, now.to_nsec())

    def publish_result(self, status: Any, result: Any) -> None:
        """Publish a result, and the list of goals after it. For the handles."""
        self._say("result", status, result)
        self.publish_change()

    def publish_feedback(self, status: Any, feedback: Any) -> None:
        """Publish feedback on the goal of ``status``. For the handles."""
        self._say("feedback", status, feedback)

    def _say(self, part: str, status: Any, content: Any) -> None:
        if not self._open:
            return
        end: Publisher = self.result_pub if part == "result" else self.feedback_pub
        message = end.message_class(status=status, **{part: content})
        message.header.stamp = self.node.now()
        if end.num_connections():  # a client that has gone is no reason to warn of lost messages
            end.publish(message)

    @property
    def _open(self) -> bool:
        return self.started and not self.node.is_shutdown()

    # -- what arrives --------------------------------------------------------------------------------------------

    def _handle(self, tracker: StatusTracker) -> ServerGoalHandle:
        return self.handle_class(tracker, self, tracker.handle_tracker)

    def internal_goal_callback(self, action_goal: Any) -> None:
        """Take what arrives on ``goal``."""
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
            handle.set_canceled(None, STALE)
        else:
            self.node.guarded(self.goal_callback, handle, what=f"a goal of {self.ns}")

    def _list(self, tracker: StatusTracker) -> None:
        self.status_list.append(tracker)
        self._by_id[tracker.status.goal_id.id] = tracker

    def _take_again(self, known: StatusTracker) -> None:
        """Take a goal whose id is in the list: sent twice, or cancelled before it came."""
        if known.status.status == Status.RECALLING:
            known.status.status = Status.RECALLED
            self.end(known)  # actionlib forgets to, and lists the goal for ever
            self.publish_result(known.status, self.get_default_result())
        elif known.handle_tracker is None:
            self.end(known)

    def internal_cancel_callback(self, request: Any) -> None:
        """Take what arrives on ``cancel``."""
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
        """Remember the cancellation of a goal that has not arrived yet: topics may overtake one another."""
        note = StatusTracker(self.id_generator, self.node.now(), request, Status.RECALLING)
        self.end(note)
        self._list(note)
