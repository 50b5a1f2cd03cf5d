"""Chains of causes in words."""

from __future__ import annotations

import re
from collections.abc import Iterator

import pytest

from rosmini import Graph
from rosmini.msgs.geometry_msgs.msg import Twist
from rosmini.msgs.sensor_msgs.msg import LaserScan
from rosmini.msgs.std_msgs.msg import String
from rosmini.ros.introspection.why import NothingRecorded, explain
from tests.core.graph.byte_transport import ByteTransport


@pytest.fixture
def graph() -> Iterator[Graph]:
    with Graph() as made:
        made.record()
        yield made


def history(graph: Graph):
    return graph.scheduler.history


def robot(graph: Graph) -> None:
    """A laser that scans by a timer, and a node that answers each scan with a command."""
    stop = graph.node("stop")
    commands = stop.publisher("cmd_vel", Twist)

    def on_scan(_: object) -> None:
        commands.publish(Twist())

    stop.subscriber("scan", LaserScan, on_scan)
    laser = graph.node("laser")
    scans = laser.publisher("scan", LaserScan)

    def tick(_: object) -> None:
        scans.publish(LaserScan())

    laser.timer(0.2, tick)
    graph.node("robot").subscriber("cmd_vel", Twist, lambda _: None)


def test_the_whole_chain_is_told_from_the_end_to_the_start(graph: Graph) -> None:
    robot(graph)
    graph.run(1.05)
    (why,) = explain(history(graph), "/cmd_vel")
    lines = str(why).splitlines()
    told = [re.findall(r"/\w+|message \d+|timer|[\d.]+ s$", line) for line in lines if not line.startswith("    ")]
    assert told == [
        ["/stop", "message 5", "/cmd_vel", "1001.000 s"],
        ["/stop", "message 5", "/scan", "/laser", "1001.000 s"],
        ["/laser", "message 5", "/scan", "1001.000 s"],
        ["/laser", "timer"],
    ]
    assert lines[1].startswith("    test_why.py, line ")
    assert lines[1].endswith(", in on_scan: commands.publish(Twist())")
    assert lines[3].startswith("    in its callback on_scan (test_why.py, line ")


def test_the_last_ones_and_the_depth(graph: Graph) -> None:
    robot(graph)
    graph.run(1.05)
    found = explain(history(graph), "/cmd_vel", 3)
    assert [why.steps[0].time for why in found] == pytest.approx([1000.6, 1000.8, 1001.0])
    (short,) = explain(history(graph), "/cmd_vel", depth=1)
    assert len(short.steps) == 2
    assert "--depth" in short.end


def test_a_loop_of_its_own_tells_what_it_had_heard(graph: Graph) -> None:
    loop = graph.node("loop")
    loop.subscriber("scan", LaserScan, lambda _: None)
    commands = loop.publisher("cmd_vel", Twist, latch=True)

    def drive() -> None:
        while True:
            loop.sleep(0.5)
            commands.publish(Twist())

    loop.run(drive)
    robot(graph)
    graph.nodes["/stop"].shutdown()
    graph.run(1.05)
    (why,) = explain(history(graph), "/cmd_vel")
    assert "/loop" in why.end
    (heard,) = (step.what for step in why.heard)
    assert re.findall(r"/\w+|message \d+", heard) == ["/loop", "message 4", "/scan", "/laser"]
    assert f"before that: {heard}, at 1000.800 s" in str(why)


def test_an_unknown_name_is_answered_with_the_nearest(graph: Graph) -> None:
    with pytest.raises(NothingRecorded, match=r"/chatter.*no topic yet"):
        explain(history(graph), "/chatter")
    graph.node("talker").publisher("chatter", String, latch=True).publish("hello")
    with pytest.raises(NothingRecorded, match="/chatter"):
        explain(history(graph), "/chater")


def test_the_picture_has_the_first_cause_above(graph: Graph) -> None:
    robot(graph)
    graph.run(1.05)
    (why,) = explain(history(graph), "/cmd_vel")
    picture = why.show(title="Figure 1: why")
    assert picture.text == str(why)
    assert picture.caption == "Figure 1: why"
    first, last = (picture.svg.rindex("/laser published message 5"), picture.svg.rindex("/stop published message 5"))
    assert first < last
    assert picture.alt.startswith("Chain of causes, the first one first. /laser published message 5 on /scan")


def test_what_came_over_a_wire_has_no_cause_before_it() -> None:
    with Graph(transports=(ByteTransport,)) as graph:
        graph.record()
        echo = graph.node("echo")
        answers = echo.publisher("echo", String, latch=True)
        echo.subscriber("chatter", String, lambda message: answers.publish(message.data))
        talker = graph.node("talker").publisher("chatter", String)
        talker.wait_for_subscribers()
        talker.publish("hello")
        graph.run(0.1)
        (why,) = explain(history(graph), "/echo")
    published, got = (step.what for step in why.steps)
    assert "/echo" in published and "message 1" in published and published.endswith("'hello'")
    assert re.findall(r"/\w+", got) == ["/echo", "/chatter", "/talker"]
    assert "/talker" in why.end and "wire" in why.end
