"""The Master's notices: in order for each node, and a node that hangs delays nobody."""

from __future__ import annotations

import threading
from typing import Any

from rosmini.core.errors import TransportException
from rosmini.core.graph import Graph
from rosmini.core.graph import notices as module
from rosmini.core.graph.lanes import Waiter
from rosmini.core.graph.notices import Notices


class Nodes:
    """Stands for all nodes: keeps what each is told; those in `hung` answer when they are let."""

    def __init__(self, hung: tuple[str, ...] = (), gone: tuple[str, ...] = ()) -> None:
        self.graph = Graph(rosout=False)
        self.told: dict[str, list[tuple[Any, ...]]] = {}
        self.problems: list[BaseException] = []
        self._hung = {uri: self.graph.scheduler.waiter(f"{uri} to wake up") for uri in hung}
        self._gone = gone
        self.notices = Notices(self.graph.scheduler, self.graph.changes, self._call, self.problems.append)

    def _call(self, uri: str, method: str, caller_id: str, *arguments: Any) -> None:
        assert caller_id == "/master"
        if uri in self._gone:
            raise TransportException("it has gone")
        waiter: Waiter | None = self._hung.get(uri)
        if waiter is not None:
            waiter.wait()
        self.told.setdefault(uri, []).append((method, *arguments))

    def wake(self, uri: str) -> None:
        """Let a node that hangs answer."""
        self._hung.pop(uri).wake()


def test_a_node_that_hangs_delays_nobody() -> None:
    nodes = Nodes(hung=("http://hung/",), gone=("http://gone/",))
    for uri in ("http://hung/", "http://gone/", "http://well/"):
        nodes.notices.publisher_update(uri, "/scan", ["http://laser/"])
        nodes.notices.param_update(uri, "/rate/", 5)
    nodes.graph.run(1)
    assert nodes.told == {
        "http://well/": [("publisherUpdate", "/scan", ["http://laser/"]), ("paramUpdate", "/rate/", 5)]
    }
    nodes.wake("http://hung/")
    nodes.graph.run(1)
    assert nodes.told["http://hung/"] == nodes.told["http://well/"]
    assert nodes.problems == []


def test_for_a_node_that_hangs_for_long_only_the_latest_is_kept() -> None:
    nodes = Nodes(hung=("http://hung/",))
    last = module.LIMIT + 5
    nodes.notices.publisher_update("http://hung/", "/scan", ["http://laser/"])
    for number in range(last + 1):
        nodes.notices.param_update("http://hung/", "/key/", number)
    nodes.graph.run(1)
    nodes.wake("http://hung/")
    nodes.graph.run(1)
    told = nodes.told["http://hung/"]
    assert len(told) < module.LIMIT
    assert ("publisherUpdate", "/scan", ["http://laser/"]) in told
    assert told[-1] == ("paramUpdate", "/key/", last)


def test_other_threads_may_post_and_what_fails_is_reported() -> None:
    nodes = Nodes()
    threads = [
        threading.Thread(target=lambda uri=uri: [nodes.notices.shutdown(uri, f"{n}") for n in range(50)])
        for uri in "ab"
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    nodes.graph.run(1)
    assert nodes.told == {uri: [("shutdown", f"{n}") for n in range(50)] for uri in "ab"}


def test_an_error_that_is_not_the_node_s_is_reported_and_the_next_notice_arrives() -> None:
    nodes = Nodes()
    told: list[str] = []

    def call(_uri: str, method: str, _caller: str, *_arguments: Any) -> None:
        told.append(method)
        if method == "shutdown":
            raise ZeroDivisionError

    notices = Notices(nodes.graph.scheduler, nodes.graph.changes, call, nodes.problems.append)
    notices.shutdown("http://well/", "why not")
    notices.param_update("http://well/", "/key/", 1)
    nodes.graph.run(1)
    assert told == ["shutdown", "paramUpdate"]
    assert [type(error) for error in nodes.problems] == [ZeroDivisionError]


def test_after_the_end_of_a_graph_notices_arrive_again() -> None:
    with Graph() as graph:
        graph.node("first")
    nodes = Nodes(hung=("http://hung/",))
    nodes.notices.shutdown("http://hung/", "first")
    nodes.graph.run(1)
    nodes.graph.scheduler.close()
    nodes.notices.clear()
    nodes.wake("http://hung/")
    nodes.notices.shutdown("http://hung/", "second")
    nodes.graph.run(1)
    assert nodes.told["http://hung/"] == [("shutdown", "second")]
