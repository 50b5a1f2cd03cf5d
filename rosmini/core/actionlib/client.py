"""Action clients with goal handles: http://wiki.ros.org/actionlib.

A client talks to its server over five topics under the action's name: it publishes ``goal`` and ``cancel``, and
subscribes to ``status``, ``feedback`` and ``result``. An action consists of these topics only; it calls no service.
"""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

from rosmini.core.errors import TransportException
from rosmini.core.time import Time
from rosmini.msgs import message_class

from .client_machine import CANCELLABLE, ClientMachine
from .spec import ActionTypes, Timeout, numbers_of, wait_on
from .states import ActionException, CommState, IllegalTransition, Status

if TYPE_CHECKING:
    from collections.abc import Callable

    from rosmini.core.graph import Node

POLL_NS = 10_000_000
MAX_POLLS = 100
"""Interval [ns] and maximum number of the checks whether a server counts a client among its subscribers."""


def new_goal_id(node: Node, now: Time) -> str:
    """Return a new goal id in rospy's form, ``/node-number-seconds``; all clients of a node share one counter."""
    return f"{node.name}-{next(numbers_of(node, 'goal'))}-{now.to_sec():.3f}"


def queue_size_of(node: Node, parameter: str, default: int | None) -> int | None:
    """Return the queue size set by a parameter of actionlib, or ``default`` if it is missing or negative."""
    size = node.get_param(parameter, -1, expect=int)
    return default if size < 0 else int(size)


class ClientGoalHandle:
    """A client's view of one goal that it sent. Made by :meth:`ActionClient.send_goal`."""

    def __init__(
        self,
        client: ActionClient,
        action_goal: Any,
        transition_cb: Callable[[ClientGoalHandle], object] | None,
        feedback_cb: Callable[[ClientGoalHandle, Any], object] | None,
    ) -> None:
        self._client = client
        self.action_goal = action_goal
        self.machine = ClientMachine(self._moved)
        self._transition_cb = transition_cb
        self._feedback_cb = feedback_cb
        self._result: Any = None
        self._following = True

    @property
    def id(self) -> str:
        """The goal's id."""
        return str(self.action_goal.goal_id.id)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, ClientGoalHandle) and self.id == other.id

    def __hash__(self) -> int:
        return hash(self.id)

    # -- queries -------------------------------------------------------------------------------------------------

    def get_comm_state(self) -> CommState:
        """Return the state of the client's machine; ``LOST`` after :meth:`reset`."""
        return self.machine.state if self._following else CommState.LOST

    def get_goal_status(self) -> Status:
        """Return the status that the server reported last; ``PENDING`` before that, ``LOST`` if it is invalid."""
        return Status(self.machine.status) if self.machine.status in _STATUSES else Status.LOST

    def get_goal_status_text(self) -> str:
        """Return the server's explanation of the status."""
        return self.machine.text

    def get_result(self) -> Any:
        """Return the result, or None if it has not arrived."""
        return self._result

    def get_terminal_state(self) -> Status:
        """Return the final status of the goal; before its end, log a warning and return ``LOST``."""
        client, status = self._client, self.get_goal_status()
        if self.machine.state is not CommState.DONE:
            client.node.logwarn(f"goal {self.id} has not ended: its client is {self.machine.state.name}")
        return status if status.is_terminal else Status.LOST

    # -- actions -------------------------------------------------------------------------------------------------

    def cancel(self) -> None:
        """Ask the server to cancel this goal; no effect if it is over or being cancelled."""
        self._client.node.scheduler.run_in_scheduler(self._cancel)

    def _cancel(self) -> None:
        client = self._client
        if self._following and self.machine.state in CANCELLABLE:
            client.send_cancel(Time(), self.id)
            self.machine.cancel()
        else:
            client.node.logdebug(f"goal {self.id} is {self.get_comm_state().name}: cancel() has no effect")

    def reset(self) -> None:
        """Stop tracking this goal: its callbacks are no longer called. The goal itself continues."""
        self._following = False
        self._client.forget(self)

    # -- events --------------------------------------------------------------------------------------------------

    def _moved(self, state: CommState) -> None:
        client = self._client
        if state is CommState.DONE:
            client.forget(self)
        client.node.logdebug(f"goal {self.id}: {state.name}")
        self._run_callback(self._transition_cb, "transitions", self)

    def _run_callback(self, callback: Callable[..., object] | None, what: str, *arguments: Any) -> None:
        if callback is not None and self._following:
            self._client.node.guarded(callback, *arguments, what=f"{what} of {self._client.ns}")

    def hear(self, status: Any) -> None:
        """Handle a ``GoalStatus``, or None if the server's list lacks the goal. Called by the client."""
        if status is not None:
            self._try(self.machine.hear, status)
        elif self.machine.miss():
            self._client.node.logwarn(
                f"{self._client.ns} no longer knows goal {self.id}: it is LOST. Was the server started again?"
            )

    def finish(self, action_result: Any) -> None:
        """Handle the action result, which contains the goal's final status. Called by the client."""
        if self.machine.state is not CommState.DONE:
            self._result = action_result.result
        self._try(self.machine.finish, action_result.status)

    def _try(self, step: Callable[[int, str], None], status: Any) -> None:
        try:
            step(status.status, status.text)
        except IllegalTransition as error:
            self._client.node.logerr(f"goal {self.id}: {error}")

    def feed(self, feedback: Any) -> None:
        """Pass feedback to the callback unless the goal is done. Called by the client."""
        if self.machine.state is not CommState.DONE:
            self._run_callback(self._feedback_cb, "feedback", self, feedback)


_STATUSES = frozenset(int(status) for status in Status)


class ActionClient:
    """Sends goals to an action server, any number at a time, and tracks each with a handle.

    Args:
        node: the client's node.
        ns: the action's name, a graph resource name; the five topics are below it.
        ActionSpec: the action's type, such as ``actionlib_tutorials.msg.FibonacciAction``.
        numpy: deliver numeric arrays in feedback and results as numpy arrays; if False, as rospy's tuples.

    Raises ``ActionException`` if ``ActionSpec`` is not an action type. Goals are tracked until they are done, or until
    ``handle.reset()``.

    """

    def __init__(self, node: Node, ns: str, ActionSpec: Any, *, numpy: bool = True) -> None:
        self.node = node
        self.types = ActionTypes.of(ActionSpec)
        self.ActionSpec = ActionSpec
        self.ActionGoal, self.ActionResult, self.ActionFeedback = self.types[:3]
        self.ns = node.resolve(ns)
        self._goals: dict[str, ClientGoalHandle] = {}
        self._server = ""
        node.scheduler.run_in_scheduler(lambda: self._connect(numpy))

    def _connect(self, numpy: bool) -> None:
        node, ns, types = self.node, self.ns, self.types
        goal_id = message_class("actionlib_msgs/GoalID")
        statuses = message_class("actionlib_msgs/GoalStatusArray")
        out = queue_size_of(node, "actionlib_client_pub_queue_size", 10)
        into = queue_size_of(node, "actionlib_client_sub_queue_size", None)
        self._goal = node.publisher(f"{ns}/goal", types.action_goal, queue_size=out)
        self._cancel = node.publisher(f"{ns}/cancel", goal_id, queue_size=out)
        hear = partial(node.subscriber, queue_size=into, numpy=numpy)
        self._status = hear(f"{ns}/status", statuses, self._on_statuses, on_disconnect=self._disconnected)
        self._result = hear(f"{ns}/result", types.action_result, self._finish)
        self._feedback = hear(f"{ns}/feedback", types.action_feedback, self._feed)

    def stop(self) -> None:
        """Unregister from the five topics, and stop tracking all goals."""
        self._goals.clear()
        for end in (self._goal, self._cancel, self._status, self._result, self._feedback):
            end.unregister()

    # -- goals ---------------------------------------------------------------------------------------------------

    def send_goal(
        self,
        goal: Any,
        transition_cb: Callable[[ClientGoalHandle], object] | None = None,
        feedback_cb: Callable[[ClientGoalHandle, Any], object] | None = None,
    ) -> ClientGoalHandle:
        """Send a goal and return its handle.

        ``transition_cb(handle)`` is called for each state that the client enters, ``feedback_cb(handle, feedback)`` on
        feedback. Raises ``ActionException`` if ``goal`` is not a message of the action's goal type.
        """
        return self.node.scheduler.run_in_scheduler(lambda: self._send(goal, transition_cb, feedback_cb))

    def _send(self, goal: Any, *callbacks: Any) -> ClientGoalHandle:
        goal_class = self.types.goal
        if not isinstance(goal, goal_class):
            given = getattr(goal, "_type", type(goal).__name__)
            raise ActionException(f"{self.ns} takes goals of type {goal_class._type}, not {given}")
        now = self.node.now()
        action_goal = self.types.action_goal(goal=goal)
        action_goal.header.stamp = now
        action_goal.goal_id.stamp = Time(now.secs, now.nsecs)
        action_goal.goal_id.id = new_goal_id(self.node, now)
        handle = ClientGoalHandle(self, action_goal, *callbacks)
        self._goals[handle.id] = handle
        self._goal.publish(action_goal)
        return handle

    def forget(self, handle: ClientGoalHandle) -> None:
        """Stop tracking a goal. Called by its handle."""
        self._goals.pop(handle.id, None)

    def send_cancel(self, stamp: Time, goal_id: str) -> None:
        """Ask the server to cancel the goal ``goal_id`` and all goals sent up to ``stamp``; if both are empty, all."""
        message = self._cancel.message_class()
        message.stamp, message.id = stamp, goal_id
        self._cancel.publish(message)

    def cancel_all_goals(self) -> None:
        """Ask the server to cancel all its goals, including those of other clients."""
        self.send_cancel(Time(), "")

    def cancel_goals_at_and_before_time(self, time: Time) -> None:
        """Ask the server to cancel all goals that were sent at ``time`` or before, including those of other clients."""
        self.send_cancel(time, "")

    # -- the server ----------------------------------------------------------------------------------------------

    def wait_for_server(self, timeout: Timeout = None) -> bool:
        """Block until a server is running and all five topics are connected at both ends; return True then.

        Returns False after ``timeout`` (None or 0: no limit), or if the node shuts down first.
        """
        node = self.node
        waiter = node.waiter(f"an action server on {self.ns}")
        node.scheduler.run_in_scheduler(lambda: node.graph.changes.watch(self._connected, waiter))
        try:
            found = wait_on(node, waiter, timeout, self._connected)
            return found and node.scheduler.run_in_scheduler(self._wait_until_counted)
        finally:
            waiter.wake()

    wait_for_action_server_to_start = wait_for_server

    def _connected(self) -> bool:
        """Return whether the node that sent the latest status is connected on all five topics."""
        node, server = self.node, self._server
        out = [node.publications.get(end.topic) for end in (self._goal, self._cancel)]
        into = [node.subscriptions.get(end.topic) for end in (self._status, self._result, self._feedback)]
        return bool(
            server
            and all(end and any(sender.destination == server for sender in end.senders.values()) for end in out)
            and all(
                end and any(link.is_open and link.peer == server for link in end.connections.values()) for end in into
            )
        )

    def _wait_until_counted(self) -> bool:
        """Wait until the server counts this client among its subscribers; return whether it is still connected.

        rospy accepts a subscriber a moment before it sends messages to it. A message published in between is lost; it
        may be the result of a goal that ended at once.
        """
        scheduler = self.node.scheduler
        for _ in range(MAX_POLLS):
            if not self._connected() or self._is_counted():
                break
            scheduler.sleep_until(scheduler.now_ns() + POLL_NS, f"the action server of {self.ns} to count its clients")
        return self._connected()

    def _is_counted(self) -> bool:
        """Return whether the server's node reports that it sends to this client; True if it does not respond."""
        node = self.node
        topics = {end.topic for end in (self._status, self._result, self._feedback)}
        links = node.subscriptions[self._status.topic].connections.values()
        uri = next(link.uri for link in links if link.peer == self._server)
        try:
            code, _, rows = node.graph.transport.call(uri, "getBusInfo", node.name)
        except TransportException:
            return True  # the node has gone or does not respond: there is nothing to wait for
        return code != 1 or topics <= {row[4] for row in rows if row[1:3] == [node.name, "o"]}

    def _disconnected(self, peer: str) -> None:
        if peer != self._server:
            return
        self._server = ""
        ends = self.node.shutdown_reason is not None or self.node.graph.closing
        if self._goals and not ends:
            count = len(self._goals)
            self.node.logwarn(
                f"the action server {peer} of {self.ns} has ended, with {count} goal{'s' * (count > 1)} open. "
                "As in ROS, nothing reports how such a goal ends, unless a new server starts that does not know it "
                "(LOST): wait with a timeout."
            )

    # -- incoming messages ---------------------------------------------------------------------------------------

    def _on_statuses(self, statuses: Any) -> None:
        server = (statuses._connection_header or {}).get("callerid", "")
        if server != self._server:
            self._server = server
            self.node.connections_changed()
        known = {status.goal_id.id: status for status in statuses.status_list}
        for handle in list(self._goals.values()):
            handle.hear(known.get(handle.id))

    def _finish(self, action_result: Any) -> None:
        handle = self._goals.get(action_result.status.goal_id.id)
        if handle is not None:
            handle.finish(action_result)

    def _feed(self, action_feedback: Any) -> None:
        handle = self._goals.get(action_feedback.status.goal_id.id)
        if handle is not None:
            handle.feed(action_feedback.feedback)
