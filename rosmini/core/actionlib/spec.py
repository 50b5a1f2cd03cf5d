"""Common parts of clients and servers: the types of an action, ids and records of goals, and timeouts."""

from __future__ import annotations

from itertools import count
from typing import TYPE_CHECKING, Any, NamedTuple

from rosmini.core.errors import ROSInterruptException
from rosmini.core.time import Duration, Time
from rosmini.msgs import message_class
from rosmini.msgs.importer import how_to_import

from .states import ActionException, Status

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from rosmini.core.graph import Node, Waiter


class ActionTypes(NamedTuple):
    """The message classes behind an action class such as ``FibonacciAction``."""

    action_goal: Any
    action_result: Any
    action_feedback: Any
    goal: Any
    result: Any
    feedback: Any

    @classmethod
    def of(cls, spec: Any) -> ActionTypes:
        """Return the types of the action class ``spec``. Raises ``ActionException`` if it is not an action class."""
        try:
            action = spec()
            parts = [type(getattr(action, f"action_{part}")) for part in ("goal", "result", "feedback")]
            inner = [
                type(getattr(part(), name)) for part, name in zip(parts, ("goal", "result", "feedback"), strict=True)
            ]
        except (AttributeError, TypeError) as error:
            name = getattr(spec, "__name__", repr(spec))
            ends = [end for end in ("Goal", "Result", "Feedback") if name.endswith(end)]
            hint = f"give {name.removesuffix(ends[0]).removesuffix('Action')}Action" if ends else how_to_import(spec)
            advice = f": {hint}" if hint else ""
            raise ActionException(f"{name} is not an action type, such as FibonacciAction{advice}") from error
        return cls(*parts, *inner)


def numbers_of(node: Node, of: str) -> Iterator[int]:
    """Return a node's counter (1, 2, ...) of one kind of id, shared by all its clients and servers."""
    numbers: Iterator[int] = vars(node).setdefault(f"_{of}_numbers", count(1))
    return numbers


class GoalIDGenerator:
    """Makes ids of the form ``name-number-secs.nsecs``, stamped with the node's time.

    ``name`` is the node's name by default.
    """

    def __init__(self, node: Node, name: str | None = None) -> None:
        self._node = node
        self.name = node.name if name is None else name

    def set_name(self, name: str) -> None:
        """Start ids with ``name`` from now on."""
        self.name = name

    def generate_ID(self) -> Any:
        """Return a new ``actionlib_msgs/GoalID``."""
        now = self._node.now()
        number = next(numbers_of(self._node, "made_goal"))
        goal_id = message_class("actionlib_msgs/GoalID")(stamp=now)
        goal_id.id = f"{self.name}-{number}-{now.secs}.{now.nsecs}"
        return goal_id


class StatusTracker:
    """A server's record of one goal: its message, its status, and the time it ended.

    Create it either from an action goal (``FibonacciActionGoal``), which becomes ``PENDING`` and gets an id and a stamp
    if it has none, or from an id and a status, for a goal that was cancelled before it arrived.
    """

    def __init__(
        self, id_generator: GoalIDGenerator, now: Time, goal_id: Any = None, status: int | None = None, goal: Any = None
    ) -> None:
        self.id_generator = id_generator
        self.goal: Any = None
        self.handle_tracker: Any = None
        """The first handle that the server made for the goal; None before that."""
        self.handle_destruction_time = Time()
        """When the goal ended; 0 before that."""
        self.status = message_class("actionlib_msgs/GoalStatus")()
        if goal_id is not None:
            self.status.goal_id, self.status.status = goal_id, status
            return
        self.goal = goal
        self.status.goal_id = goal.goal_id if goal.goal_id.id else id_generator.generate_ID()
        self.status.status = Status.PENDING
        if not self.status.goal_id.stamp:
            self.status.goal_id.stamp = now


Timeout = float | Duration | None
"""A timeout, as a number of seconds or a duration; None and zero (rospy's default) mean no limit."""
WAIT_AFTER_SHUTDOWN_NS = 10_000_000
"""Duration of a wait on a node that has been shut down [ns]."""


def seconds_of(timeout: Timeout) -> float | None:
    """Return a timeout in seconds, or None for no limit."""
    seconds = timeout.to_sec() if isinstance(timeout, Duration) else timeout
    return seconds or None


def wait_on(node: Node, waiter: Waiter, timeout: Timeout, holds: Callable[[], bool]) -> bool:
    """Block until ``waiter`` is woken, for at most ``timeout`` of the node's time; return ``holds()``.

    If the node shuts down meanwhile, the wait ends, as in rospy. A wait that begins after the shutdown lasts
    ``WAIT_AFTER_SHUTDOWN_NS``: a loop around it (``while not client.wait_for_server(timeout)``) does not notice the
    shutdown, and the thread that ends the loop must be able to run.
    """
    is_over = node.is_shutdown()
    seconds = seconds_of(timeout)
    cancel = None
    if seconds is not None:
        when = node.clock.now_ns() + max(int(seconds * 1e9), 0)
        cancel = node.scheduler.run_in_scheduler(lambda: node.clock.call_at(when, waiter.wake))
    try:
        if not holds():
            node.wait(waiter)
    except ROSInterruptException:
        if is_over:
            node.scheduler.waiter(f"the end of {node.name}").wait(WAIT_AFTER_SHUTDOWN_NS)
        return holds()
    finally:
        if cancel is not None:
            cancel()
    return holds()
