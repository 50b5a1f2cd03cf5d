"""The tree of parameters: text, picture, errors."""

from __future__ import annotations

import xml.etree.ElementTree as ET

import pytest

from rosmini import Graph
from rosmini.viz import ViewError, parameter_tree

TREE = {
    "robot": {"wheel": {"radius": 0.033, "names": ["l", "r"]}, "name": "a<b"},
    "on": True,
    "empty": {},
    "raw": b"x" * 99,
}


def test_the_text_is_the_tree() -> None:
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


def test_the_picture_has_a_line_from_each_entry_to_its_namespace() -> None:
    picture = parameter_tree(TREE)
    root = ET.fromstring(picture.svg or "")
    space = "{http://www.w3.org/2000/svg}"
    rows = {
        (element.text or ""): float(element.get("y") or 0)
        for element in root.iter(f"{space}text")
        if element.get("class") in ("pt-namespace", "pt-name")
    }
    starts = {}
    for path in root.iter(f"{space}path"):
        _, _, rest = (path.get("d") or "").partition(",")
        top, _, below = rest.partition("V")
        starts[float(below.partition("H")[0])] = float(top)
    parents = {
        name: next(other for other, height in rows.items() if abs(height - 4.5 - (starts[y - 4.5] - 9)) < 0.2)
        for name, y in rows.items()
        if y - 4.5 in starts
    }
    assert parents == {
        "empty/": "/", "on": "/", "raw": "/", "robot/": "/", "name": "robot/", "wheel/": "robot/",
        "names": "wheel/", "radius": "wheel/",
    }  # fmt: skip


def test_a_graphs_parameters_without_roscores_own() -> None:
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
