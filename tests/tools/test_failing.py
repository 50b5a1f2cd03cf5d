"""A cell that fails, and what roswtf knows about it."""

from __future__ import annotations

from collections.abc import Iterator
from types import SimpleNamespace

import pytest
from IPython.core.events import EventManager, available_events

from rosmini import Graph, set_default_graph
from rosmini.core.errors import ROSException, RosminiError
from rosmini.msgs.std_msgs.msg import String
from rosmini.tools import failing

ERROR = ROSException("timeout exceeded while waiting for message on topic /chater: nothing came")


@pytest.fixture
def graph() -> Iterator[Graph]:
    with Graph(strict=False) as made:
        before = set_default_graph(made)
        yield made
        set_default_graph(before)


def told(error: BaseException | None, capsys: pytest.CaptureFixture[str]) -> str:
    failing.look(SimpleNamespace(error_in_exec=error))
    return capsys.readouterr().out


def test_one_finding_is_printed_and_no_time_passes(graph: Graph, capsys: pytest.CaptureFixture[str]) -> None:
    graph.node("talker").publisher("chatter", String)
    before, nodes = graph.now(), list(graph.nodes)
    assert told(ERROR, capsys) == ("roswtf: ERROR Nothing in the graph is called /chater; did you mean /chatter?\n")
    assert graph.now() == before
    assert list(graph.nodes) == nodes


def test_what_nothing_explains_is_left_alone(graph: Graph, capsys: pytest.CaptureFixture[str]) -> None:
    graph.node("talker").publisher("chatter", String)
    assert told(None, capsys) == ""
    assert told(KeyError("/chater"), capsys) == ""
    assert told(RosminiError("something else"), capsys) == ""


def test_a_graph_with_nodes_elsewhere_is_not_asked(graph: Graph, capsys: pytest.CaptureFixture[str]) -> None:
    graph.node("talker").publisher("chatter", String)
    graph.ask_as("/far").ask("registerPublisher", "/far", "std_msgs/String", "http://far:1/")
    assert told(ERROR, capsys) == ""


def test_without_a_graph_none_is_made(capsys: pytest.CaptureFixture[str]) -> None:
    before = set_default_graph(None)
    assert told(ERROR, capsys) == ""
    assert set_default_graph(before) is None


def test_it_never_fails_itself(graph: Graph, capsys: pytest.CaptureFixture[str]) -> None:
    graph.shutdown()

    class Broken(RosminiError):
        def __str__(self) -> str:
            raise ValueError("no text")

    assert told(Broken(), capsys) == ""


def test_it_is_registered_once() -> None:
    shell = SimpleNamespace(events=EventManager(None, available_events))
    failing.register(shell)
    failing.register(shell)
    assert shell.events.callbacks["post_run_cell"] == [failing.look]
