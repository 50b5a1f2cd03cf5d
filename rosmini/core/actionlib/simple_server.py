"""The action server that works on one goal at a time: http://wiki.ros.org/actionlib/DetailedDescription."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rosmini.core.errors import ROSInterruptException

from .server import ActionServer
from .server_goal_handle import ServerGoalHandle
from .states import ActionException, Status

if TYPE_CHECKING:
    from collections.abc import Callable

    from rosmini.core.graph import Node

PREEMPTED_TEXT = "This goal was canceled because another goal was received by the simple action server"
"""Text for a goal that the server cancels itself, as in the original."""

ACCEPTED_TEXT = "This goal has been accepted by the simple action server"
"""Text for an accepted goal, as in the original."""


class SimpleActionServer:
    """An action server that works on one goal at a time.

    If you pass ``execute_cb``, ``execute_cb(goal)`` runs for each accepted goal, in a lane of its own, and may block
    (sleep, wait, call services). It must check :meth:`is_preempt_requested` regularly, and end the goal with
    :meth:`set_succeeded`, :meth:`set_aborted` or :meth:`set_preempted`. Otherwise, register one callback with
    ``register_goal_callback``, called when :meth:`accept_new_goal` can accept a goal, and one with
    ``register_preempt_callback``, called when the goal should stop.

    A new goal requests preemption of the current one and waits for its end; only the newest waiting goal is kept. The
    other arguments are those of :class:`~rosmini.core.actionlib.ActionServer`.
    """

    def __init__(
        self,
        node: Node,
        name: str,
        ActionSpec: Any,
        execute_cb: Callable[[Any], object] | None = None,
        auto_start: bool = True,
        *,
        numpy: bool = True,
        strict: bool | None = None,
        handle_class: type[ServerGoalHandle] = ServerGoalHandle,
    ) -> None:
        self.node = node
        self.new_goal = False
        self.preempt_request = False
        self.new_goal_preempt_request = False
        self.execute_callback = execute_cb
        self.goal_callback: Callable[[], object] | None = None
        self.preempt_callback: Callable[[], object] | None = None
        self.action_server = ActionServer(
            node,
            name,
            ActionSpec,
            self.internal_goal_callback,
            self.internal_preempt_callback,
            auto_start=False,
            numpy=numpy,
            strict=strict,
            handle_class=handle_class,
        )
        self.current_goal = handle_class(None, self.action_server)
        self.next_goal = self.current_goal
        """The goal that arrived last: a waiting one, or the current one."""
        self._lane = node.spawn(f"{node.name} execute {self.action_server.ns}")
        if auto_start:
            self.start()

    def start(self) -> None:
        """Open the five topics; only needed if ``auto_start`` is False."""
        self.action_server.start()

    def stop(self) -> None:
        """Unregister from the five topics."""
        self.action_server.stop()

    def register_goal_callback(self, cb: Callable[[], object]) -> None:
        """Call ``cb()`` when a new goal can be accepted. On a server with ``execute_cb``, only log a warning."""
        if self.execute_callback is not None:
            self.node.logwarn(
                f"{self.action_server.ns} has an execute callback, which gets the goals: the goal callback is not "
                "registered"
            )
        else:
            self.goal_callback = cb

    def register_preempt_callback(self, cb: Callable[[], object]) -> None:
        """Call ``cb()`` when the current goal should stop: it was cancelled, or another one arrived."""
        self.preempt_callback = cb

    # -- incoming goals ------------------------------------------------------------------------------------------

    def is_new_goal_available(self) -> bool:
        """Return whether a goal is waiting to be accepted."""
        return self.new_goal

    def is_preempt_requested(self) -> bool:
        """Return whether the current goal should stop."""
        return self.preempt_request

    def is_active(self) -> bool:
        """Return whether the server is working on a goal."""
        return self.current_goal.state in (Status.ACTIVE, Status.PREEMPTING)

    def accept_new_goal(self) -> Any:
        """Accept the waiting goal and return it; a goal that is still active is preempted.

        If no goal is waiting: raises ``ActionException`` if strict, otherwise logs an error and returns None.
        """
        return self.node.scheduler.run_in_scheduler(self._accept)

    def _accept(self) -> Any:
        new, old = self.next_goal, self.current_goal
        if not self.new_goal:
            self._complain("accept_new_goal() was called, but no goal is waiting: check is_new_goal_available()")
            return None
        if old != new and self.is_active():
            old.set_canceled(None, PREEMPTED_TEXT)
        self.current_goal, self.new_goal = new, False
        self.preempt_request, self.new_goal_preempt_request = self.new_goal_preempt_request, False
        new.set_accepted(ACCEPTED_TEXT)
        return new.get_goal()

    # -- ending the current goal ---------------------------------------------------------------------------------

    def set_succeeded(self, result: Any = None, text: str = "") -> None:
        """Report that the current goal has been reached."""
        self._current("set_succeeded", result, text)

    def set_aborted(self, result: Any = None, text: str = "") -> None:
        """Report that the current goal cannot be reached."""
        self._current("set_aborted", result, text)

    def set_preempted(self, result: Any = None, text: str = "") -> None:
        """Report that the current goal was stopped as requested."""
        self._current("set_canceled", result, text)

    def publish_feedback(self, feedback: Any) -> None:
        """Publish feedback on the current goal, a message such as ``FibonacciFeedback``."""
        self._current("publish_feedback", feedback)

    def get_default_result(self) -> Any:
        """Return an empty result."""
        return self.action_server.get_default_result()

    def _current(self, step: str, *arguments: Any) -> None:
        if self.current_goal.goal is None:
            self._complain(f"{step}() was called before a goal was accepted")
        else:
            getattr(self.current_goal, step)(*arguments)

    def _complain(self, text: str) -> None:
        problem = f"{self.action_server.ns}: {text}"
        if self.action_server.strict:
            raise ActionException(problem)
        self.node.logerr(problem)

    # -- incoming messages ---------------------------------------------------------------------------------------

    def internal_goal_callback(self, goal: ServerGoalHandle) -> None:
        """Handle an incoming goal: it replaces the waiting goal, and requests preemption of the active one."""
        stamp = goal.get_goal_id().stamp
        rivals = [other for other in (self.current_goal, self.next_goal) if other.goal is not None]
        if any(stamp < other.get_goal_id().stamp for other in rivals):
            goal.set_canceled(None, PREEMPTED_TEXT)  # it was sent before the current goal, but arrived later
            return
        if self.next_goal.goal is not None and self.next_goal != self.current_goal:
            self.next_goal.set_canceled(None, PREEMPTED_TEXT)
        self.next_goal, self.new_goal, self.new_goal_preempt_request = goal, True, False
        if self.is_active():
            self._request_preemption()
        if self.goal_callback is not None:
            self._run_callback(self.goal_callback, "goal callback")
        if self.execute_callback is not None:
            self._lane.submit(self._execute)

    def internal_preempt_callback(self, goal: ServerGoalHandle) -> None:
        """Handle a request to cancel the current or the waiting goal."""
        if goal == self.current_goal:
            self._request_preemption()
        elif goal == self.next_goal:
            self.new_goal_preempt_request = True

    def _request_preemption(self) -> None:
        self.preempt_request = True
        if self.preempt_callback is not None:
            self._run_callback(self.preempt_callback, "preempt callback")

    def _run_callback(self, callback: Callable[[], object], what: str) -> None:
        self.node.guarded(callback, what=f"{what} of {self.action_server.ns}")

    # -- the execute callback ------------------------------------------------------------------------------------

    def _execute(self) -> None:
        """Run the execute callback for the waiting goal, unless it has been replaced. Runs in its own lane."""
        if not self.new_goal or self.execute_callback is None or self.node.is_shutdown():
            return
        goal = self._accept()
        handle = self.current_goal
        try:
            self.execute_callback(goal)
        except Exception as error:  # a goal whose callback failed is over, and its client must learn of it
            if isinstance(error, ROSInterruptException) and self.node.is_shutdown():
                return
            self._abort(handle, f"Exception in execute callback: {error}")
            self.node.callback_failed(error, self.execute_callback, f"a goal of {self.action_server.ns}", goal)
            return
        if self.is_active() and self.current_goal is handle:
            self.node.logwarn(
                f"the execute callback of {self.action_server.ns} returned without setting how the goal ended: it is "
                "ABORTED. End it with set_succeeded(), set_aborted() or set_preempted()."
            )
            self._abort(handle, "No terminal state was set.")

    def _abort(self, handle: ServerGoalHandle, text: str) -> None:
        if not handle.state.is_terminal:
            handle.set_aborted(None, text)
