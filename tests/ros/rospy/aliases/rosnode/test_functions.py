"""``import rosnode``, as public scripts use it."""

from __future__ import annotations

import io
import sys
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


def test_names_machines_and_descriptions(graph: Graph, capsys: pytest.CaptureFixture[str]) -> None:
    assert rosnode.get_node_names() == ["/lost", "/rosout", "/talker"]
    assert rosnode.get_node_names("/talker") == ["/talker"]
    assert rosnode.get_machines_by_nodes() == ["rosmini"]
    assert rosnode.get_nodes_by_machine("rosmini") == ["/lost", "/rosout", "/talker"]
    with pytest.raises(rosnode.ROSNodeException, match="cannot resolve"):
        rosnode.get_nodes_by_machine("no host")
    rosnode.rosnode_listnodes()
    rosnode.rosnode_listnodes("/talker", list_all=True)
    rosnode.rosnode_listnodes("/talker", list_uri=True)
    uri = graph.nodes["/talker"].uri
    assert capsys.readouterr().out == f"/lost\n/rosout\n/talker\n{uri} \t/talker\n{uri}\n"
    rosnode.rosnode_info("talker")
    rosnode.rosnode_info("nobody")
    done = capsys.readouterr()
    assert "Node [/talker]\nPublications: \n * /rosout [rosgraph_msgs/Log]\n" in done.out
    assert f"contacting node {uri} ...\nPid: " in done.out
    assert done.err == "cannot contact [/nobody]: unknown node\n"


def test_pings(graph: Graph, capsys: pytest.CaptureFixture[str]) -> None:
    uri = graph.nodes["/lost"].uri
    lose(graph)
    assert rosnode.rosnode_ping("/talker", max_count=2, verbose=True)
    assert capsys.readouterr().out.endswith("ping average: 0.000000ms\n")
    assert rosnode.rosnode_ping_all(verbose=True) == (["/rosout", "/talker"], ["/lost"])
    assert f"ERROR: connection refused to [{uri}]" in capsys.readouterr().err
    with pytest.raises(rosnode.ROSNodeIOException, match="Communication with node"):
        rosnode.get_node_connection_info_description(uri, None)


def test_nodes_are_forgotten(graph: Graph, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    lose(graph)
    monkeypatch.setattr(sys, "stdin", io.StringIO("what\nn\n"))
    rosnode.rosnode_cleanup()
    assert "/lost" in rosnode.get_node_names()
    assert capsys.readouterr().out.endswith("aborting\n")
    monkeypatch.setattr(sys, "stdin", io.StringIO("y\n"))
    rosnode.rosnode_cleanup()
    assert rosnode.get_node_names() == ["/rosout", "/talker"]
    rosnode.rosnode_cleanup()  # nothing to ask
    rosnode.cleanup_master_whitelist(None, ["/rosout"])
    assert rosnode.get_node_names() == ["/rosout"]


def test_killing(graph: Graph) -> None:
    assert rosnode.kill_nodes(["/talker", "/nobody"]) == (["/talker"], ["/nobody"])
    graph.run(0.1)
    assert "/talker" not in graph.nodes
