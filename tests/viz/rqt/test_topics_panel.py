"""The topic monitor: what is ticked is heard."""

import pytest

from rosmini.msgs.geometry_msgs.msg import Point
from rosmini.viz.rqt.topics import TopicMonitor


@pytest.fixture
def source(graph):
    node = graph.node("source")
    publisher = node.publisher("/point", Point)
    node.timer(0.1, lambda _: publisher.publish(Point(x=1.5)))
    return publisher


def row(panel, name):
    return next(line.split() for line in panel.text.splitlines() if line.split()[0] == name)


def test_a_topic_that_is_ticked_is_heard(graph, source):
    panel = TopicMonitor(graph)
    assert row(panel, "/point") == ["/point", "[", "]", "geometry_msgs/Point"]
    panel.set("hear//point", True)
    graph.run(3.0)
    assert row(panel, "/point") == ["/point", "[x]", "geometry_msgs/Point", "240.00B/s", "10.00"]
    assert row(panel, "x") == ["x", "float64", "1.5"]
    panel.set("hear//point", False)
    graph.run(0.1)
    assert source.num_connections() == 0
    assert "1.5" not in panel.text
