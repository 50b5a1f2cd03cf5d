"""A graph in each clock, and over a wire of bytes; an action server whose goals are driven by the test."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

from rosmini.core.actionlib import ActionServer, SimpleActionServer
from rosmini.core.graph import Graph
from rosmini.core.graph.local_transport import LocalTransport
from rosmini.msgs.actionlib_tutorials.msg import FibonacciAction, FibonacciFeedback, FibonacciResult
from tests.core.graph.byte_transport import ByteTransport

from ...processes import PATIENCE

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

KINDS = {
    "simulated": {"transports": [LocalTransport]},
    "wall": {"transports": [LocalTransport], "simulated": False, "rate": 50.0},
    "bytes": {"transports": [ByteTransport]},
}


def until(graph: Graph, condition: Callable[[], object]) -> None:
    """Drive the graph until the condition holds; fail if it never does."""
    assert graph.run(50.0 * PATIENCE, until=lambda: bool(condition())).reason == "condition"


@pytest.fixture(params=KINDS)
def graph(request: pytest.FixtureRequest) -> Iterator[Graph]:
    """A strict graph."""
    made = Graph(**KINDS[request.param])
    made.notebook = False
    yield made
    made.shutdown("the test is over")
    assert made.scheduler.waiting() == ()


@pytest.fixture
def sim() -> Iterator[Graph]:
    """A strict graph in simulated time."""
    made = Graph()
    made.notebook = False
    yield made
    made.shutdown("the test is over")
    assert made.scheduler.waiting() == ()


@pytest.fixture
def lenient() -> Iterator[Graph]:
    """A graph in simulated time that logs errors."""
    made = Graph(strict=False)
    made.notebook = False
    yield made
    made.shutdown("the test is over")


class Desk:
    """An action server that takes goals, keeps them, and waits for the test to say what becomes of each."""

    def __init__(self, graph: Graph, name: str = "server", **options: Any) -> None:
        self.node = graph.node(name)
        self.goals: list[Any] = []
        self.cancelled: list[str] = []
        self.server = ActionServer(
            self.node,
            "work",
            FibonacciAction,
            self.goals.append,
            lambda handle: self.cancelled.append(handle.id),
            **options,
        )


class Fibonacci:
    """The tutorial's server: a term every 0.1 s."""

    def __init__(self, graph: Graph, name: str = "server", **options: Any) -> None:
        self.node = graph.node(name)
        self.server = SimpleActionServer(self.node, "fibonacci", FibonacciAction, self.execute, **options)

    def execute(self, goal: Any) -> None:
        terms = [0, 1]
        for _ in range(goal.order):
            if self.server.is_preempt_requested():
                self.server.set_preempted(FibonacciResult(terms), "stopped")
                return
            self.server.publish_feedback(FibonacciFeedback(terms))
            terms.append(terms[-1] + terms[-2])
            self.node.sleep(0.1)
        self.server.set_succeeded(FibonacciResult(terms), "there")


@pytest.fixture
def log(capsys: pytest.CaptureFixture[str]) -> Callable[[], str]:
    """What was logged since the last call."""

    def read() -> str:
        out, err = capsys.readouterr()
        return out + err

    return read
