"""Support for verbs that listen for a while: how long they run, and the node they use."""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from typing import Self

    from rosmini.core.graph import Graph, Node
SECOND = 1_000_000_000
"""One second [ns]."""


class Span(NamedTuple):
    """The period in which a verb listens, until the graph time `end_ns`; None for no end."""

    graph: Graph
    end_ns: int | None

    @classmethod
    def of(cls, graph: Graph, duration_ns: int | None) -> Self:
        """Return the period that starts now and lasts `duration_ns`, or has no end for None."""
        return cls(graph, None if duration_ns is None else graph.scheduler.now_ns() + duration_ns)

    def is_over(self) -> bool:
        """Return whether the period is over."""
        return self.end_ns is not None and self.graph.scheduler.now_ns() >= self.end_ns

    def every(self, period_ns: int) -> Iterator[None]:
        """Let time pass and yield after each period, until the end or Ctrl-C."""
        clock = self.graph.scheduler
        due = clock.now_ns()
        try:
            while not self.is_over():
                due += period_ns
                clock.sleep_until(due if self.end_ns is None else min(due, self.end_ns))
                if self.end_ns is None or due <= self.end_ns:
                    clock.yield_to_others()  # deliver messages published at this time
                    yield
        except KeyboardInterrupt:
            return

    def wait(self, node: Node, reason: str, begin: Callable[[Callable[[], None]], object]) -> None:
        """Call ``begin(stop)``, then let time pass until ``stop()`` is called, or until the end or Ctrl-C."""
        waiter = node.waiter(reason)
        begin(waiter.wake)
        left = None if self.end_ns is None else max(self.end_ns - self.graph.scheduler.now_ns(), 0)
        try:
            node.wait(waiter, timeout_ns=left)
            if not waiter.done:
                self.graph.scheduler.yield_to_others()
        except KeyboardInterrupt:
            return


@contextmanager
def tool_node(graph: Graph, name: str = "rostopic") -> Iterator[Node]:
    """Start a node for a tool, with a unique name that begins with ``name``, and shut it down at the end.

    Raises ``MasterUnreachable`` at once if no Master responds, whereas a node would wait for the Master.
    """
    graph.ask_as(f"/{name}").ask("getPid")
    node = graph.node(name, anonymous=True)
    try:
        yield node
    finally:
        node.shutdown()
