"""``import rosnode``, as public scripts use it."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from rosmini import Graph, set_default_graph
from rosmini.ros.rospy.aliases import rosnode
from rosmini.ros.scripts import ScriptSpec, run_scripts

SCRIPT = """
import rospy, rosnode
rospy.init_node("looker")
assert "/looker" in rosnode.get_node_names()
print(rosnode.rosnode_ping("/looker", max_count=1, verbose=False))
print(rosnode.rosnode_ping("/nobody", max_count=1))
master = rosnode.rosgraph.Master(rosnode.ID)
print(rosnode.get_api_uri(master, "/looker") == master.lookupNode("/looker"))
rosnode.kill_nodes([rospy.get_name()])
rospy.spin()
print("killed")
"""


@pytest.fixture
def graph() -> Iterator[Graph]:
    with Graph() as made:
        before = set_default_graph(made)
        made.node("talker")
        made.node("lost")
        made.run(0.1)
        yield made
        set_default_graph(before)


def lose(graph: Graph) -> None:
    """The node is gone, and the Master has not heard of it."""
    node = graph.nodes["/lost"]
    graph.transport.detach(node.uri)
    graph.remove_node(node)


def test_a_script_imports_it(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "looker.py"
    path.write_text(SCRIPT, encoding="utf-8")
    assert run_scripts([ScriptSpec(str(path))], simulated=True, duration=5.0).status == 0
    done = capsys.readouterr()
    printed = [line.removeprefix("[looker] ") for line in done.out.splitlines()]
    assert printed == ["True", "False", "True", "killed"]
    assert "cannot ping [/nobody]: unknown node" in done.err


def test_names(graph: Graph) -> None:
    assert rosnode.get_node_names() == ["/lost", "/rosout", "/talker"]
    assert rosnode.get_node_names("/talker") == ["/talker"]


def test_pings(graph: Graph, capsys: pytest.CaptureFixture[str]) -> None:
    uri = graph.nodes["/lost"].uri
    lose(graph)
    assert rosnode.rosnode_ping("/talker", max_count=2, verbose=True)
    assert capsys.readouterr().out.count(f"xmlrpc reply from {graph.nodes['/talker'].uri}") == 2
    assert not rosnode.rosnode_ping("/lost", max_count=1)
    assert f"ERROR: connection refused to [{uri}]" in capsys.readouterr().err


def test_killing(graph: Graph) -> None:
    assert rosnode.kill_nodes(["/talker", "/nobody"]) == (["/talker"], ["/nobody"])
    graph.run(0.1)
    assert "/talker" not in graph.nodes
