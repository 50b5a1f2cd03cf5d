"""Small graphs on a thousand Masters that take their time, lose calls and lose answers (see restless_master.py)."""

from __future__ import annotations

from typing import Any

import pytest

from rosmini.core.errors import ServiceException
from rosmini.core.graph import Graph, Node
from rosmini.msgs import message_class, service_class

from ...conftest import nightly
from .conftest import close
from .restless_master import RestlessMaster

String = message_class("std_msgs/String")
Trigger = service_class("std_srvs/Trigger")

SEEDS, CHUNKS = 1_000, 10
PATIENCE_S = 60.0
"""Graph time, of which there is enough: a call that is lost costs 0.2 s."""


def insistent(node: Node, service: str) -> str:
    """Call a service until the Master answers the question where it is."""
    client = node.service_client(service, Trigger)
    while True:
        try:
            node.wait_for_service(service, PATIENCE_S)
            return str(client().message)
        except ServiceException as error:
            if "does not answer" not in str(error):
                raise
            node.sleep(0.1)


class Crossing:
    """Two nodes that talk to each other.

    The callback of each calls a service of the other, whose handler calls back.
    """

    def __init__(self, graph: Graph) -> None:
        self.heard: dict[str, list[str]] = {}
        self.answers: list[str] = []
        self.lanes = [graph.scheduler.spawn(name, lambda name=name: self._start(graph, name)) for name in "ab"]
        self.nodes: list[Node] = []

    def _start(self, graph: Graph, name: str) -> None:
        other = "b" if name == "a" else "a"
        node = graph.node(name)
        self.nodes.append(node)
        heard = self.heard[name] = []

        def ask_back(_: Any) -> tuple[bool, str]:
            return True, insistent(node, f"/{other}/leaf")

        def hear(message: Any) -> None:
            heard.append(message.data)
            self.answers.append(insistent(node, f"/{other}/ask_back"))

        node.service("~leaf", Trigger, lambda _: (True, f"leaf of {name}"))
        node.service("~ask_back", Trigger, ask_back)
        node.subscriber("talk", String, hear)
        publisher = node.publisher("talk", String, latch=True)
        publisher.publish(f"from {name}")

    def is_over(self) -> bool:
        """Return whether each has heard both and all answers have come."""
        return [sorted(heard) for heard in self.heard.values()] == [["from a", "from b"]] * 2 and len(self.answers) == 4


def play(seed: int) -> tuple[list[str], int]:
    """Return the answers and how many calls were lost, having checked that all ends well."""
    graph = Graph(rosout=False)
    master = RestlessMaster(graph, seed, any_call=True)
    crossing = Crossing(graph)
    report = graph.run(PATIENCE_S, until=crossing.is_over)
    assert report.reason == "condition", f"seed {seed}: {crossing.heard} {crossing.answers}\n{report.waiting}"
    close(graph)
    assert master.behind.getParamNames("/test")[2] == ["/rosdistro", "/rosversion", "/run_id"]
    return crossing.answers, master.lost


@pytest.mark.parametrize("chunk", [0, *nightly(*range(1, CHUNKS))])
def test_nodes_find_each_other_and_crossing_calls_end(chunk: int, capsys: pytest.CaptureFixture[str]) -> None:
    lost = 0
    for seed in range(chunk, SEEDS, CHUNKS):
        answers, lost_here = play(seed)
        assert sorted(answers) == ["leaf of a"] * 2 + ["leaf of b"] * 2
        lost += lost_here
    assert lost > SEEDS // CHUNKS  # the Master is as bad as it should be
    assert "Will keep trying" in capsys.readouterr().err


def test_the_same_seed_gives_the_same_run() -> None:
    assert play(5) == play(5)
