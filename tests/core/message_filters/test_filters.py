"""Filters on nodes, in both clocks."""

from __future__ import annotations

import pytest

from rosmini.core.graph import Graph
from rosmini.core.message_filters import (
    ApproximateTimeSynchronizer,
    Cache,
    MessageFilterError,
    SimpleFilter,
    Subscriber,
    TimeSynchronizer,
)
from rosmini.core.time import Time
from rosmini.msgs.geometry_msgs.msg import PointStamped
from rosmini.msgs.std_msgs.msg import Header, String


@pytest.fixture(params=[True, False], ids=["simulated", "wall"])
def graph(request):
    made = Graph(simulated=request.param, rate=1.0 if request.param else 20.0)
    made.notebook = False
    yield made
    made.shutdown("the test is over")


@pytest.fixture
def sim():
    made = Graph()
    made.notebook = False
    yield made
    made.shutdown("the test is over")


def at(seconds, name=""):
    return PointStamped(header=Header(stamp=Time.from_sec(seconds), frame_id=name))


def publishers(node, *topics):
    made = [node.publisher(topic, PointStamped, queue_size=100) for topic in topics]
    for publisher in made:
        publisher.wait_for_subscribers()
    return made


def test_camera_and_laser_are_brought_together(graph):
    node = graph.node("fusion")
    inputs = [Subscriber(node, topic, PointStamped) for topic in ("camera", "laser")]
    pairs = []
    ApproximateTimeSynchronizer(inputs, 10, 0.05).registerCallback(
        lambda one, two, extra: pairs.append((one.header.stamp.to_sec(), two.header.stamp.to_sec(), extra)), 7
    )
    camera, laser = publishers(graph.node("robot"), "camera", "laser")
    for count in range(5):
        camera.publish(at(count / 10))
        laser.publish(at(count / 10 + 0.02))
    graph.run(100.0, until=lambda: len(pairs) == 5)
    assert pairs == [pytest.approx((count / 10, count / 10 + 0.02, 7), abs=1e-6) for count in range(5)]
    assert inputs[0].getTopic() == "camera"
    for one in inputs:
        one.unregister()
        one.unregister()
    assert inputs[0].sub.num_connections() == 0


def test_a_callback_that_blocks_gets_one_set_after_another(graph):
    node = graph.node("slow")
    inputs = [Subscriber(node, topic, PointStamped) for topic in ("a", "b")]
    events = []

    def callback(one, _):
        events.append(("begin", one.header.frame_id))
        node.sleep(0.5)
        events.append(("end", one.header.frame_id))

    TimeSynchronizer(inputs, 10).registerCallback(callback)
    a, b = publishers(graph.node("robot"), "a", "b")
    for name in "123":
        a.publish(at(float(name), name))
        b.publish(at(float(name), name))
    graph.run(100.0, until=lambda: len(events) == 6)
    assert events == [(what, name) for name in "123" for what in ("begin", "end")]


def test_sets_behind_one_that_fails_are_not_kept_back():
    inputs = [SimpleFilter(), SimpleFilter()]
    synchroniser = TimeSynchronizer(inputs, 10)
    seen = []

    def callback(one, _):
        seen.append(one.header.frame_id)
        if len(seen) == 1:
            for each in inputs:
                each.signalMessage(at(2, "two"))
            raise ValueError("no good")

    synchroniser.registerCallback(callback)
    inputs[0].signalMessage(at(1, "one"))
    with pytest.raises(ValueError, match="no good"):
        inputs[1].signalMessage(at(1, "one"))
    assert seen == ["one", "two"]


def test_messages_without_a_header(sim, capsys):
    node = sim.node("fusion")
    source, other = SimpleFilter(), SimpleFilter()
    strict = Cache(source, 5, node=node)
    lenient = Cache(source, 5, allow_headerless=True, node=node)
    sim.run(2.5)
    for _ in range(3):
        source.signalMessage(String("x"))
    assert strict.getLast() is None
    assert capsys.readouterr().err.count("have no header") == 1
    assert lenient.getLatestTime() == node.now()
    assert lenient.getLast().data == "x"
    ApproximateTimeSynchronizer([source, other], 5, 0.1, allow_headerless=True)
    with pytest.raises(MessageFilterError, match="node="):
        source.signalMessage(String("x"))


def test_a_stamp_that_is_changed_later_does_not_change_the_cache():
    source = SimpleFilter()
    cache = Cache(source, 3)
    message = at(1.0, "one")
    source.signalMessage(message)
    message.header.stamp.secs = 99
    assert cache.getLatestTime() == Time(1)
    assert cache.getInterval(Time(1), Time(1)) == [message]
    with pytest.raises(MessageFilterError, match="earlier time first"):
        cache.getInterval(Time(2), Time(1))


def test_filters_of_filters(sim):
    """A cache takes the output of a custom filter and passes it to a synchroniser, which finds the node through it."""
    node = sim.node("n")

    class Later(SimpleFilter):
        def __init__(self, source):
            super().__init__()
            self.node = source.node
            source.registerCallback(lambda message: self.signalMessage(at(message.header.stamp.to_sec() + 1, "later")))

    first, second = (Subscriber(node, topic, PointStamped) for topic in "ab")
    synchroniser = TimeSynchronizer([Cache(Later(first), 3), second], 3)
    pairs = []
    synchroniser.registerCallback(lambda *pair: pairs.append([one.header.frame_id for one in pair]))
    a, b = publishers(sim.node("robot"), "a", "b")
    a.publish(at(1))
    b.publish(at(2, "b"))
    sim.run(1.0)
    assert pairs == [["later", "b"]]
    assert synchroniser.node is node
    with pytest.raises(MessageFilterError, match="made for 2 filters"):
        synchroniser.connectInput([first])


def test_an_input_without_stamps_is_reported_once(sim, capsys):
    node = sim.node("fusion")
    inputs = [Subscriber(node, topic, PointStamped) for topic in ("camera", "laser")]
    TimeSynchronizer(inputs, 10)
    camera, laser = publishers(sim.node("robot"), "camera", "laser")
    for count in range(1, 30):
        camera.publish(at(count))
        laser.publish(at(0))
    sim.run(1)
    said = capsys.readouterr().err
    assert said.count("stamp 0") == 1
    assert "input 1" in said
