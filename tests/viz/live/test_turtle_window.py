"""The window of a turtlesim in a terminal: a page whose node comes when it is opened."""

import json
import sys
import threading
import time
import urllib.request
from types import SimpleNamespace

import pytest

from rosmini import Graph, rosrun
from rosmini.core.graph.show import has_own_process
from rosmini.sim.turtlesim import TurtleSim
from rosmini.sim.turtlesim import node as turtlesim_node
from rosmini.viz.live import loopback
from rosmini.viz.live.turtle_window import PadOnDemand

from ...processes import PATIENCE


@pytest.fixture
def terminal(monkeypatch):
    """Be a process of a graph, without a screen."""
    monkeypatch.setattr(turtlesim_node, "has_own_process", lambda graph: True)
    monkeypatch.setattr(loopback, "has_screen", lambda: False)


def asked(graph, url):
    """What a page is answered while the graph goes on."""
    found = []

    def ask():
        with urllib.request.urlopen(url, timeout=PATIENCE) as answer:
            found.append(answer.read())

    thread = threading.Thread(target=ask)
    thread.start()
    end = time.monotonic() + PATIENCE
    while thread.is_alive() and time.monotonic() < end:
        graph.run(0.02)
    thread.join(PATIENCE)
    return found[0]


def test_in_a_terminal_the_window_is_a_page_whose_node_comes_when_it_is_opened(terminal, capsys):
    with Graph(simulated=False) as graph:
        sim = rosrun("turtlesim", "turtlesim_node", graph=graph).instance()
        assert isinstance(sim, TurtleSim)
        said = capsys.readouterr().err
        assert said.startswith("turtlesim: its window is the page http://127.0.0.1:")
        url = said.split()[-1]
        assert list(graph.nodes) == ["/rosout", "/turtlesim"]
        assert b"<title>turtlesim</title>" in asked(graph, url)
        assert list(graph.nodes) == ["/rosout", "/turtlesim"]
        data = json.loads(asked(graph, f"{url}data.json"))
        assert data["chosen"] == "turtle1"
        assert "/teleop_pad" in graph.nodes
        graph.nodes["/teleop_pad"].shutdown("killed")
        sim.spawn(1.0, 1.0, 0.0)
        assert json.loads(asked(graph, f"{url}data.json"))["choices"] == ["turtle1", "turtle2"]
        assert "/teleop_pad" in graph.nodes
        sim.node.shutdown("closed")
        with pytest.raises(OSError, match="refused"):
            urllib.request.urlopen(url)


def test_where_only_the_output_is_a_terminal_the_address_is_written_there(terminal, capsys, monkeypatch):
    monkeypatch.setattr(sys, "__stderr__", SimpleNamespace(isatty=lambda: False))
    monkeypatch.setattr(sys, "__stdout__", SimpleNamespace(isatty=lambda: True))
    with Graph(simulated=False) as graph:
        rosrun("turtlesim", "turtlesim_node", graph=graph).instance()
    said = capsys.readouterr()
    assert "turtlesim: its window is the page http://127.0.0.1:" in said.out
    assert said.err == ""


def test_a_notebook_opens_no_window():
    with Graph() as simulated, Graph(simulated=False) as alone:
        assert [has_own_process(graph) for graph in (simulated, alone)] == [False, False]


def test_a_pad_that_cannot_be_made_is_an_error_of_the_page_only(terminal, monkeypatch):
    with Graph(simulated=False) as graph:
        sim = rosrun("turtlesim", "turtlesim_node", graph=graph).instance()
        sim.frame.turtles.clear()
        pages = PadOnDemand(sim)
        errors = []

        def ask():
            try:
                pages.state
            except Exception as error:
                errors.append(error)

        thread = threading.Thread(target=ask)
        thread.start()
        end = time.monotonic() + PATIENCE
        while thread.is_alive() and time.monotonic() < end:
            graph.run(0.02)
        thread.join(PATIENCE)
        assert "no turtle ''" in str(errors[0])
        assert not sim.node.is_shutdown()
