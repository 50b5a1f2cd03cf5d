"""The message publisher: rates, expressions, several topics."""

import pytest

from rosmini.msgs.geometry_msgs.msg import Twist
from rosmini.msgs.std_msgs.msg import String
from rosmini.viz.rqt.publisher import MessagePublisher
from rosmini.viz.view import ViewError


@pytest.fixture
def publisher(graph):
    return MessagePublisher(graph)


@pytest.fixture
def speeds(graph):
    found = []
    graph.node("listener").subscriber("/cmd_vel", Twist, lambda twist: found.append(twist.linear.x))
    return found


def test_the_page_adds_fills_and_enables(publisher, graph, speeds):
    publisher.set("topic", "/cmd_vel")
    publisher.set("type", "geometry_msgs/Twist")
    publisher.set("rate", "10")
    publisher.set("add")
    publisher.set("1/field/linear/x", "i / 4")
    publisher.set("1/on", True)
    graph.run(0.35)
    assert speeds == [0.0, 0.25, 0.5]
    publisher.set("1/on", False)
    graph.run(1.0)
    assert len(speeds) == 3
    publisher.set("1/once")
    graph.run(0.1)
    assert speeds[3:] == [0.75]
    assert "[ ] publish /cmd_vel  rate of /cmd_vel [Hz]: 10  4 messages" in publisher.text


def test_a_rate_can_be_changed_while_it_publishes(publisher, graph, speeds):
    row = publisher.add("/cmd_vel", "geometry_msgs/Twist", rate=1)
    row.enable()
    row.set_rate(10)
    graph.run(0.55)
    assert len(speeds) == 5
    row.set_rate(0)
    assert not row.enabled
    graph.run(1)
    assert len(speeds) == 5
    with pytest.raises(ViewError, match="rate 0"):
        row.enable()


def test_several_topics_and_one_that_is_removed(publisher, graph, speeds):
    publisher.add("/cmd_vel", "geometry_msgs/Twist", rate=10).enable()
    said = []
    graph.node("reader").subscriber("/text", String, lambda message: said.append(message.data))
    text = publisher.add("/text", "std_msgs/String", rate=10)
    text.fill("data", "'n%d' % i")
    text.enable()
    publisher.set("1/remove")
    graph.run(0.25)
    assert said == ["n0", "n1"]
    assert speeds == []
    assert list(publisher.publications) == [2]
    assert "/cmd_vel" not in dict(graph.master.getSystemState("/test")[2][0])


def test_an_expression_that_fails_later_stops_its_topic_only_and_says_why(publisher, graph):
    row = publisher.add("/x", "std_msgs/Float64", rate=10)
    row.fill("data", "1 / (2 - i)")
    row.enable()
    graph.run(1)
    assert not row.enabled
    assert row.count == 2
    assert "division by zero" in publisher.text
    assert 'aria-invalid="true"' in publisher.markup(live=True)
    row.fill("data", "1")
    assert "division by zero" not in publisher.text


@pytest.mark.parametrize(
    ("topic", "kind", "match"),
    [("/x", "", "the type of /x is unknown"), ("/x", "std_msgs/Sting", "did you mean std_msgs/String")],
)
def test_what_cannot_be_added_is_refused(publisher, topic, kind, match):
    with pytest.raises(ViewError, match=match):
        publisher.add(topic, kind)
    assert publisher.publications == {}


def test_impossible_rates_and_rows_are_refused(publisher):
    row = publisher.add("/x", "std_msgs/Float64")
    for rate in (-1, 1e6, float("nan")):
        with pytest.raises(ViewError, match="a rate is from 0 to 1000"):
            row.set_rate(rate)
    with pytest.raises(ViewError, match="number 7"):
        publisher.remove(7)


def test_a_new_panel_takes_the_place_of_the_old_one(publisher, graph, speeds):
    publisher.add("/cmd_vel", "geometry_msgs/Twist", rate=10).enable()
    MessagePublisher(graph)
    graph.run(0.5)
    assert speeds == []
    assert "was shut down" in publisher.text
    with pytest.raises(ViewError, match="has ended"):
        publisher.set("add")
