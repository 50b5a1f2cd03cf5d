"""`fault` and its options."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from rosmini import Graph
from rosmini.core.errors import ServiceException, UsageError
from rosmini.core.graph.observers.faults import FaultError
from rosmini.msgs.std_msgs.msg import String
from rosmini.msgs.std_srvs.srv import Trigger
from rosmini.tools.fault import TOOL


@pytest.fixture
def graph() -> Iterator[Graph]:
    with Graph() as made:
        made.node("listener").subscriber("chatter", String, lambda _: None)
        talker = made.node("talker")
        publisher = talker.publisher("chatter", String)
        talker.timer(0.1, lambda _: publisher.publish("tick"))
        talker.service("it", Trigger, lambda _: (True, ""))
        yield made


def fault(graph: Graph, line: str) -> str:
    return str(TOOL.run(*line.split(), graph=graph))


def test_a_topic_is_disturbed_listed_and_cleared(graph: Graph) -> None:
    before = graph.now()
    told = fault(graph, "chatter --lose 0.5 --double 0.1 --delay 0.1 --jitter 0.2 --seed 3 --to listener")
    for part in ("/chatter to /listener: ", "50% lost", "10% doubled", "0.1 to 0.3 s", "seed 3"):
        assert part in told
    assert graph.now() == before
    graph.run(2.05)
    line = fault(graph, "list")
    assert line.startswith("/chatter to /listener: 50% lost")
    assert ": 20 messages, " in line
    assert fault(graph, "clear /chatter") == "1 fault cleared"
    assert fault(graph, "list") == "no faults"
    assert fault(graph, "clear") == "0 faults cleared"


def test_nodes_services_and_clocks(graph: Graph) -> None:
    assert fault(graph, "/it --cut") == "/it is cut off"
    with pytest.raises(ServiceException):
        graph.node("client").service_client("it", Trigger)()
    for line, parts in (("--jump -5 --to /listener", ("/listener", " -5 s")), ("--jump 1", ("every node", " +1 s"))):
        told = fault(graph, f"clock {line}")
        assert all(part in told for part in parts)
    assert "/listener: its clock is -4 s off" in fault(graph, "list")
    assert fault(graph, "talker --kill").startswith("/talker was killed")
    assert graph.unreachable == ("/talker",)


@pytest.mark.parametrize(
    "line",
    [
        "", "/chatter", "--lose 0.5", "/chatter /it --lose 0.5", "/chatter --lose 0.5 --kill",
        "/chatter --lose much", "/talker --jump 3", "clear /chatter /it", "list --cut",
    ],
)  # fmt: skip
def test_words_that_make_no_sense(graph: Graph, line: str) -> None:
    with pytest.raises((UsageError, FaultError)):
        fault(graph, line)


def test_a_misspelt_topic_is_answered_with_the_nearest(graph: Graph) -> None:
    with pytest.raises(FaultError, match=r"there is no topic /chater: .*/chatter"):
        fault(graph, "/chater --lose 1")
