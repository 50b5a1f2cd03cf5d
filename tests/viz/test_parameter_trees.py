"""The tree of parameters: text, picture, errors."""

import pytest

from rosmini import Graph
from rosmini.viz import ViewError, parameter_tree

TREE = {
    "robot": {"wheel": {"radius": 0.033, "names": ["l", "r"]}, "name": "a<b"},
    "on": True,
    "empty": {},
    "raw": b"x" * 99,
}


def test_the_text_is_the_tree():
    assert parameter_tree(TREE, title="Figure 1").text == (
        "Figure 1: 5 parameters in 4 namespaces\n"
        "/\n"
        "  empty/\n"
        "  on: True (bool)\n"
        "  raw: b'xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx... (bytes)\n"
        "  robot/\n"
        "    name: 'a<b' (str)\n"
        "    wheel/\n"
        "      names: ['l', 'r'] (list)\n"
        "      radius: 0.033 (float)"
    )


def test_a_graphs_parameters_without_roscores_own():
    with Graph() as graph:
        node = graph.node("node", namespace="/robot")
        node.set_param("speed", 2.0)
        node.set_param("~rate", 10)
        assert parameter_tree(graph).text.splitlines()[1:] == [
            "/",
            "  robot/",
            "    node/",
            "      rate: 10 (int)",
            "    speed: 2.0 (float)",
        ]
        assert "rosdistro" in parameter_tree(graph.master, hide=()).text
        assert parameter_tree(graph, "/robot/node").text.splitlines()[1:] == ["/robot/node", "  rate: 10 (int)"]
        assert "speed is 2.0" in parameter_tree(graph).alt
        with pytest.raises(ViewError, match=r"\[/nothing\] is not set"):
            parameter_tree(graph, "/nothing")
        with pytest.raises(ViewError, match=r"/robot/speed is a parameter, 2\.0, not a namespace"):
            parameter_tree(graph, "/robot/speed")
    with pytest.raises(ViewError, match="int has no parameters"):
        parameter_tree(5)
