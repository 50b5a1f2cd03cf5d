from types import SimpleNamespace

import pytest

from rosmini.core.graph import Graph
from rosmini.navigation.costmap_2d.inflation_layer import InflationLayer
from rosmini.navigation.move_base.checks import inflation_warnings, unread_namespaces


def costmap(radius, inscribed=0.105, circumscribed=0.11, name="global_costmap"):
    layer = InflationLayer()
    layer.radius = radius
    layers = [] if radius is None else [layer]
    return SimpleNamespace(name=name, layers=layers, inscribed_radius=inscribed, circumscribed_radius=circumscribed)


@pytest.mark.parametrize(
    ("made", "words"),
    [
        (costmap(0.5), []),
        (costmap(None), ["has no inflation layer"]),
        (costmap(0.05), ["inflation_radius is 0.05 m, and the inscribed radius of the footprint 0.105 m"]),
        (costmap(1.0, 0.041, 0.149), ["inscribed radius is 4.1 cm, its circumscribed radius 14.9 cm"]),
        (costmap(1.0, 0.041, 0.149, "local_costmap"), []),
    ],
)
def test_what_lets_a_robot_get_stuck_is_said(made, words):
    found = inflation_warnings(made)
    assert len(found) == len(words)
    assert all(part in text for part, text in zip(words, found, strict=True))


def test_namespaces_that_nobody_reads():
    with Graph() as graph:
        node = graph.node("move_base")
        node.set_param("~", {"global_costmp": {"width": 3}, "global_costmap": {}, "mine": {}, "rate": 1})
        (text,) = unread_namespaces(node, ["global_costmap", "local_costmap"])
    assert text.startswith("nothing reads the parameters in /move_base/global_costmp; did you mean global_costmap")
