"""The graph that goes on: switches, highlights, and a new drawing when something changes."""

import pytest

from rosmini.msgs.std_msgs.msg import String
from rosmini.viz.rqt.graph import NodeGraph
from rosmini.viz.view import ViewError


@pytest.fixture
def talker(graph):
    node = graph.node("talker")
    node.publisher("/chatter", String)
    graph.node("listener").subscriber("/chatter", String, lambda _: None)
    return node


@pytest.fixture
def panel(graph, talker):
    return NodeGraph(graph)


FLOW = "/talker -> /chatter [std_msgs/String] -> /listener"


def test_a_new_node_is_drawn_when_time_has_passed(panel, graph):
    assert FLOW in panel.text
    graph.node("late").subscriber("/chatter", String, lambda _: None)
    graph.run(1.1)
    assert f"{FLOW.replace('/listener', '/late, /listener')}" in panel.text


def test_the_page_switches(panel):
    panel.set("mode", "nodes_topics_all")
    panel.set("hide/debug", False)
    panel.set("hide/dead_sinks", False)
    panel.set("hide/leaf_topics", False)
    assert "/rosout_agg" in panel.text
    panel.set("hide/debug", True)
    assert "/rosout_agg" not in panel.text
    panel.set("group/tf", False)
    panel.set("namespaces", "0")
    panel.set("topics", "-/chatter")
    assert FLOW not in panel.text
    assert panel.options["group"] == ("actions", "images")
    assert panel.options["namespaces"] == 0


def test_a_click_highlights_and_a_second_one_does_not(panel, talker):
    panel.set("highlight", "/talker")
    assert "highlighted: /talker; it is heard by /listener" in panel.text
    assert "rm-chosen" in panel.markup(live=True)
    panel.set("highlight", "/talker")
    assert "highlighted" not in panel.text


def test_what_makes_no_sense_is_refused(panel, graph):
    for key, value in (("mode", "most"), ("namespaces", "-1"), ("namespace", "("), ("hide/all", True)):
        with pytest.raises(ViewError):
            panel.set(key, value)
    with pytest.raises(ViewError, match="no option colour"):
        NodeGraph(graph, colour="red")
    assert FLOW in panel.text or panel.gone
