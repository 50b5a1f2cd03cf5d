"""Action servers with goal handles: http://wiki.ros.org/actionlib.

The server decides what becomes of a goal, and publishes the list of its goals on ``status``: on each change, and five times a second.
"""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

from rosmini.msgs import message_class
from rosmini.time import Time

from .client import new_goal_id, queue_size_of
from .errors import IllegalTransition
from .server_machine import GoalEvent, next_status
from .spec import ActionTypes
from .states import Status

if TYPE_CHECKING:
    from collections.abc import Callable

    from rosmini.graph import Node, Publisher

__all__ = ["ActionServer", "ServerGoalHandle"]

STATUS_HZ = 5.0
"""How often the list of goals is published."""

STATUS_LIST_TIMEOUT = 5.0
"""How long a goal that is over stays in the list [s], so that every client hears of its end."""

STALE = "it was sent at or before the time up to which goals were cancelled"
"""Why a goal is refused that arrives after its own cancellation."""


class ServerGoalHandle:
    """One goal at the server: its message, its status, and what to make of it.

    A step that the machine does not have (:mod:`rosmini.actionlib.server_machine`) raises ``IllegalTransition``; at a server of rospy's
    style it is logged as an error and nothing happens, as there.
    """

    def __init__(self, server: ActionServer, goal_id: Any, goal: Any) -> None:
        self.server = server
        self.status = message_class("actionlib_msgs/GoalStatus")(goal_id=goal_id)
        self._goal = goal
        self._holders = 0
        self.free_since: int | None = None
        """Since when nothing needs the status any more [ns]; None while something does."""

    @property
    def id(self) -> str:
        """The goal's id."""
        return str(self.status.goal_id.id)

    def __repr__(self) -> str:
        return f"<goal {self.id}: {self.state.name}>"

    def __eq__(self, other: object) -> bool:
        return isinstance(other, ServerGoalHandle) and self.id == other.id

    def __hash__(self) -> int:
        return hash(self.id)

    @property
    def state(self) -> Status:
        """The status as a name."""
        return Status(self.status.status)

    def get_goal(self) -> Any:
        """Return the goal, a message such as ``FibonacciGoal``."""
        return self._goal

    def get_goal_id(self) -> Any:
        """Return the ``actionlib_msgs/GoalID``."""
        return self.status.goal_id

    def get_goal_status(self) -> Any:
        """Return the ``actionlib_msgs/GoalStatus``."""
        return self.status

    def get_default_result(self) -> Any:
        """Return an empty result."""
        return self.server.types.result()

    # -- what the server decides ---------------------------------------------------------------------------------

    def set_accepted(self, text: str = "") -> None:
        """Begin with the goal: it is ``ACTIVE``, or ``PREEMPTING`` if its client wants it back already."""
        self._step(GoalEvent.ACCEPT, text)

    def set_rejected(self, result: Any = None, text: str = "") -> None:
        """Refuse the goal before having begun."""
        self._step(GoalEvent.REJECT, text, result)

    def set_succeeded(self, result: Any = None, text: str = "") -> None:
        """Say that the goal is reached."""
        self._step(GoalEvent.SUCCEED, text, result)

    def set_aborted(self, result: Any = None, text: str = "") -> None:
        """Give the goal up."""
        self._step(GoalEvent.ABORT, text, result)

    def set_canceled(self, result: Any = None, text: str = "") -> None:
        """Stop as asked: ``RECALLED`` if it had not begun, else ``PREEMPTED``."""
        self._step(GoalEvent.CANCEL, text, result)

    def set_cancel_requested(self) -> bool:
        """Note that a client wants the goal cancelled; False where that changes nothing. For the server."""
        try:
            self.status.status = next_status(self.state, GoalEvent.CANCEL_REQUEST)
        except IllegalTransition:
            return False
        self.server.publish_status()
        return True

    def _step(self, event: GoalEvent, text: str, result: Any = None) -> None:
        self.server.node.scheduler.on_hub(lambda: self._go(event, text, result))

    def _go(self, event: GoalEvent, text: str, result: Any) -> None:
        server = self.server
        try:
            state = next_status(self.state, event)
        except IllegalTransition as error:
            server.complain(IllegalTransition(f"goal {self.id} of {server.ns}: {error}"))
            return
        self.status.status, self.status.text = state, str(text)
        if state.is_terminal:
            self._note_use()
            server.publish_result(self.status, self.get_default_result() if result is None else result)
        else:
            server.publish_status()

    def publish_feedback(self, feedback: Any) -> None:
        """Tell how far the goal has come: a message such as ``FibonacciFeedback``."""
        self.server.publish_feedback(self.status, feedback)

    # -- how long it is listed -----------------------------------------------------------------------------------

    def hold(self) -> None:
        """Keep the goal in the list of goals also when it is over, until :meth:`release`."""
        self._holders += 1
        self._note_use()

    def release(self) -> None:
        """Undo one :meth:`hold`."""
        self._holders -= 1
        self._note_use()

    def _note_use(self) -> None:
        free = self.state.is_terminal and not self._holders
        self.free_since = self.server.node.clock.now_ns() if free else None


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

    Parameters (http://wiki.ros.org/actionlib): ``actionlib_status_frequency``, searched upwards from the node [Hz, 5; 0 for changes only];
    ``<ns>/status_list_timeout`` [s, 5]. Raises ``ActionException`` for what is no action type.

    A goal that is over leaves the list ``status_list_timeout`` after its end. In rospy this time begins when Python has collected the
    last handle, so when exactly is chance; here it is not.

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
    ) -> None:
        self.node = node
        self.types = ActionTypes.of(ActionSpec)
        self.ns = node.resolve(ns)
        self.strict = node.graph.strict if strict is None else strict
        self.started = False
        self._goal_cb = goal_cb
        self._cancel_cb = cancel_cb
        self._numpy = numpy
        self._goals: dict[str, ServerGoalHandle] = {}
        self._last_cancel = Time()
        if auto_start:
            self.start()

    def __repr__(self) -> str:
        return f"<{type(self).__name__} of {self.ns} in {self.node.name}>"

    def register_goal_callback(self, cb: Callable[[ServerGoalHandle], object]) -> None:
        """Hand new goals to ``cb`` from now on."""
        self._goal_cb = cb

    def register_cancel_callback(self, cancel_cb: Callable[[ServerGoalHandle], object]) -> None:
        """Hand cancellations to ``cancel_cb`` from now on."""
        self._cancel_cb = cancel_cb

    @property
    def goals(self) -> tuple[ServerGoalHandle, ...]:
        """The goals in the list, in the order of their arrival."""
        return tuple(self._goals.values())

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
        self._status = node.publisher(f"{ns}/status", statuses, queue_size=out, latch=True)
        self._result = node.publisher(f"{ns}/result", types.action_result, queue_size=out)
        self._feedback = node.publisher(f"{ns}/feedback", types.action_feedback, queue_size=out)
        hear = partial(node.subscriber, queue_size=into, numpy=self._numpy)
        self._goal = hear(f"{ns}/goal", types.action_goal, self._take_goal)
        self._cancel = hear(f"{ns}/cancel", message_class("actionlib_msgs/GoalID"), self._take_cancel)
        keep = node.get_param(f"{ns}/status_list_timeout", STATUS_LIST_TIMEOUT, expect=float)
        self._keep_ns = int(keep * 1e9)
        frequency = self._status_frequency()
        self._timer = (
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
        if self._timer is not None:
            self._timer.shutdown()
        for end in (self._goal, self._cancel, self._status, self._feedback, self._result):
            end.unregister()

    # -- what is said --------------------------------------------------------------------------------------------

    def complain(self, error: IllegalTransition) -> None:
        """Raise an error of whoever uses the server, or log it in rospy's style. For the handles."""
        if self.strict:
            raise error
        self.node.logerr(error)

    def publish_status(self) -> None:
        """Publish the list of goals now; those that are over for long enough leave it."""
        now = self.node.clock.now_ns()
        for key, goal in list(self._goals.items()):
            if goal.free_since is not None and now > goal.free_since + self._keep_ns:
                del self._goals[key]
        if self._open:
            message = self._status.message_class(status_list=[goal.status for goal in self._goals.values()])
            message.header.stamp = self.node.now()
            self._status.publish(message)

    def publish_result(self, status: Any, result: Any) -> None:
        """Publish a result, and the list of goals after it. For the handles."""
        self._say("result", status, result)
        self.publish_status()

    def publish_feedback(self, status: Any, feedback: Any) -> None:
        """Publish feedback on the goal of ``status``. For the handles."""
        self._say("feedback", status, feedback)

    def _say(self, part: str, status: Any, content: Any) -> None:
        if not self._open:
            return
        end: Publisher = self._result if part == "result" else self._feedback
        message = end.message_class(status=status, **{part: content})
        message.header.stamp = self.node.now()
        if end.num_connections():  # a client that has gone is no reason to warn of lost messages
            end.publish(message)

    @property
    def _open(self) -> bool:
        return self.started and not self.node.is_shutdown()

    # -- what arrives --------------------------------------------------------------------------------------------

    def _take_goal(self, action_goal: Any) -> None:
        goal_id = action_goal.goal_id
        known = self._goals.get(goal_id.id)
        if known is not None:
            self._take_again(known)
            return
        handle = self._add(goal_id, action_goal.goal)
        if goal_id.stamp and goal_id.stamp <= self._last_cancel:
            handle.set_canceled(None, STALE)
        else:
            self.node.guarded(self._goal_cb, handle, what=f"a goal of {self.ns}")

    def _take_again(self, known: ServerGoalHandle) -> None:
        """Take a goal whose id is in the list: sent twice, or cancelled before it came."""
        if known.state is Status.RECALLING and known.get_goal() is None:
            known.set_canceled(None, "it was cancelled before it arrived")
        elif known.free_since is not None:
            known.free_since = self.node.clock.now_ns()

    def _add(self, goal_id: Any, goal: Any) -> ServerGoalHandle:
        if not goal_id.id:  # sent by hand, with `rostopic pub`: actionlib names it then
            goal_id.id = new_goal_id(self.node, self.node.now())
        if not goal_id.stamp:
            goal_id.stamp = self.node.now()
        handle = self._goals[goal_id.id] = ServerGoalHandle(self, goal_id, goal)
        return handle

    def _take_cancel(self, request: Any) -> None:
        everything = not request.id and not request.stamp
        for handle in self.goals:
            before = request.stamp and handle.get_goal_id().stamp <= request.stamp
            meant = everything or before or handle.id == request.id
            if meant and handle.set_cancel_requested() and self._cancel_cb is not None:
                self.node.guarded(self._cancel_cb, handle, what=f"a cancellation of {self.ns}")
        if request.id and request.id not in self._goals:
            self._note_early(request)
        if request.stamp > self._last_cancel:
            self._last_cancel = Time(request.stamp.secs, request.stamp.nsecs)

    def _note_early(self, request: Any) -> None:
        """Remember the cancellation of a goal that has not arrived yet: topics may overtake one another."""
        handle = self._add(request, None)
        handle.status.status = Status.RECALLING
        handle.free_since = self.node.clock.now_ns()
