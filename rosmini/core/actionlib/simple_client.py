"""The action client that tracks one goal at a time: http://wiki.ros.org/actionlib."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from .client import ActionClient, ClientGoalHandle
from .spec import Timeout, wait_on
from .states import ActionException, CommState, SimpleGoalState, Status

if TYPE_CHECKING:
    from collections.abc import Callable

    from rosmini.core.graph import Node, Waiter
    from rosmini.core.time import Time


class SimpleActionClient:
    """Sends goals to an action server, and tracks only the latest one.

    Arguments and errors are those of ``ActionClient``. With ``strict`` (the graph's setting by default) a query
    before the first goal raises ``ActionException``; otherwise an error is logged, as in rospy.
    """

    def __init__(self, node: Node, ns: str, ActionSpec: Any, *, numpy: bool = True, strict: bool | None = None) -> None:
        self.node = node
        self.strict = node.graph.strict if strict is None else strict
        self.action_client = ActionClient(node, ns, ActionSpec, numpy=numpy)
        self.simple_state = SimpleGoalState.DONE
        self.gh: ClientGoalHandle | None = None
        self._done_cb: Callable[[int, Any], object] | None = None
        self._active_cb: Callable[[], object] | None = None
        self._feedback_cb: Callable[[Any], object] | None = None
        self._waiting: list[Waiter] = []

    def wait_for_server(self, timeout: Timeout = None) -> bool:
        """Block until a server is running and all five topics are connected; return True then.

        Returns False after ``timeout`` (None or 0: no limit), or if the node shuts down first.
        """
        return self.action_client.wait_for_server(timeout)

    # -- the goal ------------------------------------------------------------------------------------------------

    def send_goal(
        self,
        goal: Any,
        done_cb: Callable[[int, Any], object] | None = None,
        active_cb: Callable[[], object] | None = None,
        feedback_cb: Callable[[Any], object] | None = None,
    ) -> None:
        """Send a goal and track it in place of the previous one, which the server may continue or preempt.

        ``active_cb()`` is called when the server accepts the goal, ``feedback_cb(feedback)`` on feedback, and
        ``done_cb(state, result)`` once, at the end. Raises ``ActionException`` if ``goal`` is not a message of the
        action's goal type.
        """
        self.node.scheduler.run_in_scheduler(lambda: self._send(goal, done_cb, active_cb, feedback_cb))

    def _send(self, goal: Any, done_cb: Any, active_cb: Any, feedback_cb: Any) -> None:
        """Send a goal in the scheduler's thread, so that it cannot end before ``gh`` and the callbacks are set."""
        self.stop_tracking_goal()
        self._done_cb, self._active_cb, self._feedback_cb = done_cb, active_cb, feedback_cb
        self.simple_state = SimpleGoalState.PENDING
        self.gh = self.action_client.send_goal(goal, self._moved, self._feed)

    def send_goal_and_wait(self, goal: Any, execute_timeout: Timeout = None, preempt_timeout: Timeout = None) -> Status:
        """Send a goal, wait for its end, and return its final status.

        After ``execute_timeout`` the goal is cancelled; the server then has ``preempt_timeout`` to end it
        (None or 0: no limit).
        """
        self.send_goal(goal)
        if not self.wait_for_result(execute_timeout):
            self.node.logdebug(f"{self.action_client.ns}: the time for the goal is over: cancelling it")
            self.cancel_goal()
            if not self.wait_for_result(preempt_timeout):
                self.node.logdebug(f"{self.action_client.ns}: the goal was not preempted in time")
        return self.get_state()

    def wait_for_result(self, timeout: Timeout = None) -> bool:
        """Block until the goal has ended and ``done_cb`` has returned; return True then.

        Returns False after ``timeout`` (None or 0: no limit), or if the node shuts down first.
        """
        if self.gh is None:
            self._complain("wait_for_result() was called before any goal was sent")
            return False
        waiter = self.node.waiter(f"the result of {self.gh.id} from {self.action_client.ns}")
        self._waiting.append(waiter)
        try:
            return wait_on(self.node, waiter, timeout, lambda: self.simple_state is SimpleGoalState.DONE)
        finally:
            self._waiting.remove(waiter)

    def get_result(self) -> Any:
        """Return the goal's result, or None if it has not arrived."""
        if self.gh is None:
            self._complain("get_result() was called before any goal was sent")
            return None
        return self.gh.get_result()

    def get_state(self) -> Status:
        """Return the goal's status, such as ``PENDING``, ``ACTIVE`` or its final status; ``LOST`` without a goal.

        As in actionlib, a goal that is being recalled counts as ``PENDING``, and one being preempted as ``ACTIVE``.
        """
        if self.gh is None:
            return Status.LOST
        status = self.gh.get_goal_status()
        return {Status.RECALLING: Status.PENDING, Status.PREEMPTING: Status.ACTIVE}.get(status, status)

    def get_goal_status_text(self) -> str:
        """Return the server's explanation of the goal's status."""
        if self.gh is None:
            self._complain("get_goal_status_text() was called before any goal was sent")
            return "ERROR: get_goal_status_text() was called before any goal was sent"
        return self.gh.get_goal_status_text()

    # -- cancelling ----------------------------------------------------------------------------------------------

    def cancel_all_goals(self) -> None:
        """Ask the server to cancel all its goals, including those of other clients."""
        self.action_client.cancel_all_goals()

    def cancel_goals_at_and_before_time(self, time: Time) -> None:
        """Ask the server to cancel all goals that were sent at ``time`` or before, including those of other clients."""
        self.action_client.cancel_goals_at_and_before_time(time)

    def cancel_goal(self) -> None:
        """Ask the server to cancel the goal; no effect if there is none or it is over."""
        if self.gh is not None:
            self.gh.cancel()

    def stop_tracking_goal(self) -> None:
        """Stop tracking the goal: its callbacks are no longer called. The goal itself continues."""
        handle, self.gh = self.gh, None
        if handle is not None:
            handle.reset()

    # -- events --------------------------------------------------------------------------------------------------

    def _moved(self, handle: ClientGoalHandle) -> None:
        state = handle.get_comm_state()
        if state in (CommState.ACTIVE, CommState.PREEMPTING) and self.simple_state is SimpleGoalState.PENDING:
            self.simple_state = SimpleGoalState.ACTIVE
            self._run_callback(self._active_cb, "active_cb")
        elif state is CommState.DONE:
            self._run_callback(self._done_cb, "done_cb", handle.get_goal_status(), handle.get_result())
            if self.gh is handle:  # the callback may have sent the next goal
                self.simple_state = SimpleGoalState.DONE
                for waiter in list(self._waiting):
                    waiter.wake()

    def _feed(self, _: ClientGoalHandle, feedback: Any) -> None:
        self._run_callback(self._feedback_cb, "feedback_cb", feedback)

    def _run_callback(self, callback: Callable[..., object] | None, what: str, *arguments: Any) -> None:
        if callback is not None:
            self.node.guarded(callback, *arguments, what=f"{what} of {self.action_client.ns}")

    def _complain(self, text: str) -> None:
        problem = f"{text} by this client of {self.action_client.ns}: send_goal() first."
        if self.strict:
            raise ActionException(problem)
        self.node.logerr(problem)
