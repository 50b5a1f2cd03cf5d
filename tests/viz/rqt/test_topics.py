"""rqt_topic: what comes on the topics of a graph."""

import pytest

from rosmini import Graph
from rosmini.msgs.geometry_msgs.msg import PoseArray, Twist
from rosmini.msgs.std_msgs.msg import ByteMultiArray, Float64MultiArray, String
from rosmini.viz import ViewError
from rosmini.viz.rqt.topics import rqt_topic


def row(text, name):
    """The words of the row that begins with a name."""
    return next(words for line in text.splitlines()[1:] if (words := line.split()) and words[0] == name)


def test_rate_and_bandwidth_of_what_came():
    with Graph() as graph:
        node = graph.node("driver")
        publisher = node.publisher("cmd_vel", Twist)
        node.publisher("mute", String)
        node.timer(0.1, lambda _: publisher.publish(Twist()))
        before = graph.now().to_sec()
        table = rqt_topic(graph)
        assert graph.now().to_sec() - before == pytest.approx(2.0)
        assert row(table.text, "/cmd_vel")[1:] == ["geometry_msgs/Twist", "480.00B/s", "10.00"]  # 48 B each
        assert row(table.text, "/mute")[1:] == ["std_msgs/String", "unknown", "unknown", "not", "heard"]


def test_the_last_values_of_a_topic_that_is_expanded():
    with Graph() as graph:
        node = graph.node("arrays")
        numbers = node.publisher("numbers", Float64MultiArray, latch=True)
        numbers.publish(Float64MultiArray(data=[1.5] * 7))
        node.publisher("bytes", ByteMultiArray, latch=True).publish(ByteMultiArray(data=[1, 2]))
        poses = PoseArray()
        poses.header.frame_id = "a" * 100
        node.publisher("poses", PoseArray, latch=True).publish(poses)
        text = rqt_topic(graph, expand=["/numbers", "/poses", "/bytes"], duration=0.5).text
    assert "(1.5, 1.5, 1.5, 1.5, 1.5, ...), 7 elements" in text
    assert "frame_id" in text
    assert f"'{'a' * 56}..." in text
    with Graph() as graph, pytest.raises(ViewError, match="positive"):
        rqt_topic(graph, duration=0)
