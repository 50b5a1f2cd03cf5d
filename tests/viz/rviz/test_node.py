"""The node `rviz/rviz`: what launch files start."""

import urllib.request

import pytest

from rosmini import Graph
from rosmini.core.errors import UsageError
from rosmini.core.packages import PackageIndex
from rosmini.ros.net import connect
from rosmini.viz.live import loopback
from rosmini.viz.rviz import node as rviz_node
from rosmini.viz.rviz.config import ConfigError
from rosmini.viz.rviz.node import RViz

FILE = str(PackageIndex().resolve("package://turtlebot3_navigation/rviz/turtlebot3_navigation.rviz"))


def test_in_a_graph_with_others_it_opens_nothing_and_says_how_to_look(capsys):
    with Graph() as graph:
        made = RViz(graph.node("rviz"), "-d", FILE, "-f", "odom")
        graph.run(0.1)
    assert made.window is None
    said = capsys.readouterr().out
    assert (
        "This graph opens no window. To see RViz, run: "
        "%rviz -d package://turtlebot3_navigation/rviz/turtlebot3_navigation.rviz -f odom\n" in said
    )


@pytest.mark.parametrize(
    ("words", "error", "said"),
    [
        (("-d", "absent.rviz"), ConfigError, r"absent\.rviz cannot be read"),
        (("-d", "package://turtlebot3_navigation/rviz/absent.rviz"), ConfigError, r"absent\.rviz is not there"),
        (("--ogre",), UsageError, "no such option: --ogre"),
    ],
)
def test_what_is_wrong_is_said_at_once(words, error, said):
    with Graph() as graph, pytest.raises(error, match=said):
        RViz(graph.node("rviz"), *words)


def test_only_one_of_many_processes_has_a_window():
    with Graph() as simulated, Graph(simulated=False) as alone, connect(announce=False) as process:
        graphs = (simulated, alone, process)
        assert [rviz_node.has_own_process(graph) for graph in graphs] == [False, False, True]


def test_in_a_process_of_its_own_it_is_a_page_that_ends_with_the_node(capsys, monkeypatch):
    monkeypatch.setattr(rviz_node, "has_own_process", lambda graph: True)
    opened = []
    monkeypatch.setattr(loopback.webbrowser, "open", opened.append)
    monkeypatch.setattr(loopback, "has_screen", lambda: False)
    with Graph(simulated=False) as graph:
        node = graph.node("rviz")
        made = RViz(node, "-d", FILE)
        assert made.window is not None
        assert made.window.node is node
        assert list(graph.nodes) == ["/rosout", "/rviz"]
        url = capsys.readouterr().err.split()[-1]
        with urllib.request.urlopen(url) as answer:
            assert b"<title>RViz</title>" in answer.read()
        assert opened == []
        node.shutdown("closed")
        with pytest.raises(OSError, match="refused"):
            urllib.request.urlopen(url)
