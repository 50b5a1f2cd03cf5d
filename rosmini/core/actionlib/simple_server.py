"""The server for one goal at a time; a new goal preempts it (http://wiki.ros.org/actionlib/DetailedDescription)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rosmini.core.errors import ROSInterruptException

from .errors import ActionException
from .server import ActionServer
from .server_goal_handle import ServerGoalHandle
from .states import Status

if TYPE_CHECKING:
    from collections.abc import Callable

    from rosmini.core.graph import Node

__all__ = ["SimpleActionServer"]

BUMPED = "This goal was canceled because another goal was received by the simple action server"
"""Why a goal is cancelled by the server itself, in the words that clients of real servers know."""

ACCEPTED = "This goal has been accepted by the simple action server"
"""The status of a goal that is worked on, in the same words."""


class SimpleActionServer:
    """Works on one goal at a time.

    With ``execute_cb`` each goal is worked on by ``execute_cb(goal)``, which may block (sleep, wait, call services): it
    has a lane of its own. It looks at :meth:`is_preempt_requested` now and then, and ends with one of
    :meth:`set_succeeded`, :meth:`set_aborted` and :meth:`set_preempted`. Without it, ``register_goal_callback`` names
    what is called when a goal can be taken with :meth:`accept_new_goal`, and ``register_preempt_callback`` what is
    called when the goal shall stop.

    A new goal waits until the current one has ended, and asks it to end; of several that wait, the newest is kept. The
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
        """The goal that arrived last: one that waits, or the current one itself."""
        self._lane = node.spawn(f"{node.name} execute {self.action_server.ns}")
        if auto_start:
            self.start()

    def __repr__(self) -> str:
        return f"<{type(self).__name__} of {self.action_server.ns} in {self.node.name}>"

    def start(self) -> None:
        """Open the five topics, unless ``auto_start`` has done so."""
        self.action_server.start()

    def stop(self) -> None:
        """Leave the five topics."""
        self.action_server.stop()

    def register_goal_callback(self, cb: Callable[[], object]) -> None:
        """Call ``cb()`` when a new goal is there to be accepted.

        Without effect beside ``execute_cb``, which a warning says.
        """
        if self.execute_callback is not None:
            self.node.logwarn(
                f"{self.action_server.ns} has an execute callback, which gets the goals: the goal callback is not "
                "registered"
            )
        else:
            self.goal_callback = cb

    def register_preempt_callback(self, cb: Callable[[], object]) -> None:
        """Call ``cb()`` when the current goal shall stop: it was cancelled, or another one arrived."""
        self.preempt_callback = cb

    # -- the goals -----------------------------------------------------------------------------------------------

    def is_new_goal_available(self) -> bool:
        """Tell whether a goal waits to be accepted."""
        return self.new_goal

    def is_preempt_requested(self) -> bool:
        """Tell whether the current goal shall stop."""
        return self.preempt_request

    def is_active(self) -> bool:
        """Tell whether a goal is being worked on."""
        return self.current_goal.state in (Status.ACTIVE, Status.PREEMPTING)

    def accept_new_goal(self) -> Any:
        """Begin with the goal that waits, and return it; a goal that is still being worked on is preempted.

        None, and an error (``ActionException`` if strict, else logged), when no goal waits.
        """
        return self.node.scheduler.on_hub(self._accept)

    def _accept(self) -> Any:
        new, old = self.next_goal, self.current_goal
        if not self.new_goal:
            self._complain(
                "accept_new_goal() was called, and no new goal is there: ask is_new_goal_available()"
            )
            return None
        if old != new and self.is_active():
            old.set_canceled(None, BUMPED)
        self.current_goal, self.new_goal = new, False
        self.preempt_request, self.new_goal_preempt_request = self.new_goal_preempt_request, False
        new.set_accepted(ACCEPTED)
        return new.get_goal()

    # -- how the current goal ends -------------------------------------------------------------------------------

    def set_succeeded(self, result: Any = None, text: str = "") -> None:
        """Say that the goal is reached."""
        self._current("set_succeeded", result, text)

    def set_aborted(self, result: Any = None, text: str = "") -> None:
        """Give the goal up."""
        self._current("set_aborted", result, text)

    def set_preempted(self, result: Any = None, text: str = "") -> None:
        """Stop as asked."""
        self._current("set_canceled", result, text)

    def publish_feedback(self, feedback: Any) -> None:
        """Tell how far the goal has come."""
        self._current("publish_feedback", feedback)

    def get_default_result(self) -> Any:
        """Return an empty result."""
        return self.action_server.get_default_result()

    def _current(self, step: str, *arguments: Any) -> None:
        if self.current_goal.goal is None:
            self._complain(f"{step}() was called, and no goal was accepted")
        else:
            getattr(self.current_goal, step)(*arguments)

    def _complain(self, text: str) -> None:
        problem = f"{self.action_server.ns}: {text}"
        if self.action_server.strict:
            raise ActionException(problem)
        self.node.logerr(problem)

    # -- what arrives --------------------------------------------------------------------------------------------

    def internal_goal_callback(self, goal: ServerGoalHandle) -> None:
        """Take a goal that arrives."""
        stamp = goal.get_goal_id().stamp
        rivals = [other for other in (self.current_goal, self.next_goal) if other.goal is not None]
        if any(stamp < other.get_goal_id().stamp for other in rivals):
            goal.set_canceled(None, BUMPED)  # it was sent before what is here, and overtaken
            return
        if self.next_goal.goal is not None and self.next_goal != self.current_goal:
            self.next_goal.set_canceled(None, BUMPED)
        self.next_goal, self.new_goal, self.new_goal_preempt_request = goal, True, False
        if self.is_active():
            self._request_preemption()
        if self.goal_callback is not None:
            self._tell(self.goal_callback, "goal callback")
        if self.execute_callback is not None:
            self._lane.submit(self._execute)

    def internal_preempt_callback(self, goal: ServerGoalHandle) -> None:
        """Take a cancellation that arrives."""
        if goal == self.current_goal:
            self._request_preemption()
        elif goal == self.next_goal:
            self.new_goal_preempt_request = True

    def _request_preemption(self) -> None:
        self.preempt_request = True
        if self.preempt_callback is not None:
            self._tell(self.preempt_callback, "preempt callback")

    def _tell(self, callback: Callable[[], object], what: str) -> None:
        self.node.guarded(callback, what=f"{what} of {self.action_server.ns}")

    # -- the execute callback ------------------------------------------------------------------------------------

    def _execute(self) -> None:
        """Work on the goal that waits, if it has not been replaced meanwhile. In a lane of its own."""
        if not self.new_goal or self.execute_callback is None or self.node.is_shutdown():
            return
        goal = self._accept()
        handle = self.current_goal
        try:
            self.execute_callback(goal)
        except Exception as error:  # a goal whose work failed is over, and its client has to hear of it
            if isinstance(error, ROSInterruptException) and self.node.is_shutdown():
                return
            self._abort(handle, f"Exception in execute callback: {error}")
            self.node.callback_failed(
                error, self.execute_callback, f"a goal of {self.action_server.ns}", goal
            )
            return
        if self.is_active() and self.current_goal is handle:
            self.node.logwarn(
                f"the execute callback of {self.action_server.ns} returned and has not said how the goal ended: it is "
                "ABORTED. End it with set_succeeded(), set_aborted() or set_preempted()."
            )
            self._abort(handle, "No terminal state was set.")

    def _abort(self, handle: ServerGoalHandle, text: str) -> None:
        if not handle.state.is_terminal:
            handle.set_aborted(None, text)
