"""The plot that goes on."""

import pytest

from rosmini.msgs.geometry_msgs.msg import Point
from rosmini.viz.rqt.plot import Plot
from rosmini.viz.view import ViewError


@pytest.fixture
def tick(graph):
    node = graph.node("source")
    publisher = node.publisher("/point", Point)
    count = [0]

    def publish(_):
        count[0] += 1
        publisher.publish(Point(x=count[0], y=-count[0]))

    return node.timer(0.1, publish)


def test_lines_are_drawn_from_what_comes(graph, tick):
    plot = Plot(graph, "/point/x:y")
    assert plot.fields == ("/point/x", "/point/y")
    assert "no value received yet" in plot.text
    graph.run(1.05)
    assert "/point/x: 9 points, from 1.00 to 9.00" in plot.text or "/point/x: 10 points" in plot.text
    assert "<svg" in plot.markup(live=True)


def test_only_the_last_seconds_are_kept(graph, tick):
    plot = Plot(graph, "/point/x", seconds=1.0)
    graph.run(5.05)
    points = int(plot.text.split("/point/x: ")[1].split()[0])
    assert 9 <= points <= 11


def test_the_page_adds_removes_pauses_and_clears(graph, tick):
    plot = Plot(graph)
    plot.set("field", "/point/x")
    plot.set("add")
    graph.run(1.0)
    plot.set("pause", True)
    before = plot.text
    graph.run(2.0)
    assert plot.text == before
    plot.set("pause", False)
    assert plot.text != before
    plot.set("clear")
    assert "no value" in plot.text
    plot.set("remove//point/x")
    assert plot.fields == ()
    with pytest.raises(ViewError, match="is not plotted"):
        plot.remove("/point/x")


def test_what_cannot_be_plotted_is_refused(graph, tick):
    plot = Plot(graph)
    with pytest.raises(ViewError, match="nothing to hear"):
        plot.add("/nothing/x")
    with pytest.raises(ViewError, match="messages on /point are geometry_msgs/Point and have no w"):
        plot.add("/point/w")
    plot.add("/rosout/msg")
    graph.nodes["/source"].loginfo("a text")
    graph.run(0.2)
    assert "is a str and no number" in plot.text
