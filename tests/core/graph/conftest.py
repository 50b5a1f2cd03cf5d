"""A graph on each transport and each clock; closing it asserts that nothing is left behind."""

from __future__ import annotations

import os
import signal
import sys
import threading
from typing import TYPE_CHECKING, Any

import pytest

from rosmini.core.graph import Graph
from rosmini.core.graph.local_transport import LocalTransport
from rosmini.ros.net.network import tcp
from tests.core.graph.byte_transport import ByteTransport

from ...conftest import nightly
from ...processes import PATIENCE
from .restless_master import RestlessMaster
from .wire import is_under_way

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

WALL_RATE = 200.0
"""In wall time a second of the graph takes 5 ms here."""

LONG = PATIENCE * WALL_RATE
"""So long a test waits for what must come; it never waits so long when all is well."""

RESTLESS = "restless-master"
"""The kind of graph whose Master takes its time and does not always answer."""

SEED = int(os.environ.get("ROSMINI_RESTLESS_SEED", "1"))
"""What is random of that Master follows from it: another one for every run that one likes to make."""

KINDS: dict[str, tuple[Any, bool]] = {
    "local-simulated": (LocalTransport, True),
    "local-wall": (LocalTransport, False),
    "bytes-simulated": (ByteTransport, True),
    "bytes-wall": (ByteTransport, False),
    RESTLESS: (LocalTransport, True),
}

if sys.platform == "linux":  # whose /proc tells settle() what is under way on a real wire
    KINDS["tcp-wall"] = (tcp(), False)

EACH_COMMIT = ("local-simulated", "bytes-wall")
"""Both transports and both clocks; the other pairs run at night."""


def until(graph: Graph, condition: Callable[[], object]) -> None:
    """Drive the graph until the condition holds; fail if it never does."""
    report = graph.run(LONG, until=lambda: bool(condition()))
    assert report.reason == "condition", str(report)


def settle(graph: Graph) -> None:
    """Drive the graph until nothing is under way on any wire and a moment has passed."""
    has_network = any(way.protocol == "TCPROS" for way in graph.transport.transports)
    for _ in range(3):
        until(graph, lambda: not graph.scheduler._holds and not (has_network and is_under_way(graph)))
        graph.run(0.5)


def threads() -> set[str]:
    """The names of the threads that rosmini started and that are still there."""
    return {thread.name for thread in threading.enumerate() if thread.name.startswith("rosmini")}


def make(kind: str, **options: Any) -> Graph:
    """A graph of one of the KINDS."""
    transport, simulated = KINDS[kind]
    graph = Graph(transports=[transport], simulated=simulated, rate=1.0 if simulated else WALL_RATE, **options)
    if kind == RESTLESS:
        RestlessMaster(graph, SEED)
    return graph


def close(graph: Graph) -> None:
    """Shut a graph down and look whether anything is left."""
    graph.shutdown("the test is over")
    assert graph.nodes == {}
    assert graph.scheduler.waiting() == ()
    assert not graph.scheduler.driven
    assert graph.master.getSystemState("/test")[2] == [[], [], []]


@pytest.fixture(params=[*EACH_COMMIT, *nightly(*(kind for kind in KINDS if kind not in EACH_COMMIT))])
def build(request: pytest.FixtureRequest) -> Iterator[Callable[..., Graph]]:
    """Make graphs on the transport and clock of this turn; the options are those of Graph."""
    made: list[Graph] = []
    handler, before = signal.getsignal(signal.SIGINT), threads()

    def build(**options: Any) -> Graph:
        made.append(make(request.param, **options))
        return made[-1]

    yield build
    for graph in made:
        close(graph)
    assert threads() <= before
    assert signal.getsignal(signal.SIGINT) is handler


@pytest.fixture
def graph(build: Callable[..., Graph]) -> Graph:
    """A strict graph."""
    return build()


@pytest.fixture
def lenient(build: Callable[..., Graph]) -> Graph:
    """A graph that logs the errors of callbacks, as ROS does."""
    return build(strict=False)


@pytest.fixture
def simulated() -> Iterator[Graph]:
    """An in-process graph in simulated time, for what has to do with neither transports nor the wall."""
    graph = make("local-simulated")
    yield graph
    close(graph)
