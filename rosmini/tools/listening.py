"""What the verbs do that hear messages: a node of their own, a topic that may come later, time that passes."""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, NamedTuple

from rosmini.ros.introspection.topics import ID, look_up, what_next

from .verbs import VerbError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from typing import Self

    from rosmini.core.graph import Graph, Node
    from rosmini.ros.introspection.topics import Found

    from .verbs import Call

SECOND = 1_000_000_000
LOOK_NS = SECOND // 10
"""How often the Master is asked for a topic that is not there yet."""


class Span(NamedTuple):
    """The time in which a verb listens: the end of it, None for none."""

    graph: Graph
    end_ns: int | None

    @classmethod
    def of(cls, graph: Graph, duration_ns: int | None) -> Self:
        """Return the span from now on."""
        return cls(graph, None if duration_ns is None else graph.scheduler.now_ns() + duration_ns)

    def is_over(self) -> bool:
        """Tell whether it is over."""
        return self.end_ns is not None and self.graph.scheduler.now_ns() >= self.end_ns

    def every(self, period_ns: int) -> Iterator[None]:
        """Let time pass and yield after each period, up to the end. Ctrl-C ends it, too."""
        clock = self.graph.scheduler
        due = clock.now_ns()
        try:
            while not self.is_over():
                due += period_ns
                clock.sleep_until(due if self.end_ns is None else min(due, self.end_ns))
                if self.end_ns is None or due <= self.end_ns:
                    clock.give_way()  # what was published at this moment arrives
                    yield
        except KeyboardInterrupt:
            return

    def wait(self, node: Node, reason: str, begin: Callable[[Callable[[], None]], object]) -> None:
        """Let time pass until what ``begin`` is given is called, up to the end. Ctrl-C ends it, too."""
        waiter = node.waiter(reason)
        begin(waiter.wake)
        left = None if self.end_ns is None else max(self.end_ns - self.graph.scheduler.now_ns(), 0)
        try:
            node.wait(waiter, timeout_ns=left)
            if not waiter.done:
                self.graph.scheduler.give_way()
        except KeyboardInterrupt:
            return


@contextmanager
def tool_node(graph: Graph, name: str = "rostopic") -> Iterator[Node]:
    """Start the node of a tool, under a name of its own that begins with ``name``, and shut it down in the end.

    Raises ``MasterUnreachable`` where a node would wait for the Master: a tool says so at once.
    """
    graph.ask_as(ID).ask("getPid")
    node = graph.node(name, anonymous=True)
    try:
        yield node
    finally:
        node.shutdown()


def await_topic(call: Call, name: str, span: Span) -> Found | None:
    """Return the topic of a name, when there is one; None if there is none before the end."""
    found = look_up(call.peers, name)
    if found is not None:
        return found
    call.warn(f"WARNING: topic [{name}] does not appear to be published yet")
    call.warn(what_next(call.peers, name))
    for _ in span.every(LOOK_NS):
        found = look_up(call.peers, name)
        if found is not None:
            return found
    return None


def class_for(found: Found, graph: Graph) -> Any:
    """Return the class with which to subscribe to a topic.

    For a type that is not known here it is ``AnyMsg``: each publisher elsewhere sends its definition. Raises
    ``VerbError`` where there is none such.
    """
    from rosmini.ros.introspection.fields import class_of
    from rosmini.ros.rospy.msg import AnyMsg

    cls = class_of(found.type)
    if cls is None and not graph.master.is_local:
        return AnyMsg
    if cls is None:
        raise VerbError(
            f"ERROR: Cannot load message class for [{found.type}]. Are your messages built?\n"
            f"The package {found.type.partition('/')[0]} must be in a folder on ROS_PACKAGE_PATH, with "
            f"msg/{found.type.partition('/')[2]}.msg in it."
        )
    return cls


def predicate(text: str | None) -> Callable[[str, Any], bool] | None:
    """Return ``f(topic, message)`` for an expression of ``m`` and ``topic``. Raises ``VerbError`` for one that is none.

    The function raises ``ExpressionError`` when the expression fails on a message.
    """
    from rosmini.core.expressions import ExpressionError
    from rosmini.ros.introspection.filters import message_expression

    if text is None:
        return None
    try:
        expression = message_expression(text, ("m", "topic"))
    except ExpressionError as error:
        example = "m.pose.position.x > 0"
        raise VerbError(f"ERROR: --filter {text!r}: {error}\nAn example: --filter {example!r}") from error
    return lambda topic, message: bool(expression.evaluate({"topic": topic, "m": message}))
