"""What a graph that records knows: events, their causes, and whose line it was."""

from __future__ import annotations

import pytest

from rosmini import Graph
from rosmini.core.graph import MessageFactory
from rosmini.core.graph.observers import history as history_module
from rosmini.msgs.geometry_msgs.msg import Twist
from rosmini.msgs.sensor_msgs.msg import LaserScan
from rosmini.msgs.std_msgs.msg import String
from rosmini.msgs.std_srvs.srv import SetBool


@pytest.fixture
def graph():
    with Graph() as graph:
        yield graph


def stopper(graph):
    """A node that answers each scan with a command, and the publisher of scans."""
    node = graph.node("stop")
    commands = node.publisher("cmd_vel", Twist)

    def on_scan(_):
        commands.publish(Twist())

    node.subscriber("scan", LaserScan, on_scan)
    laser = graph.node("laser")
    scans = laser.publisher("scan", LaserScan)
    scans.wait_for_subscribers()
    return scans


def chain(history, event):
    found = []
    while event is not None:
        found.append((event.kind, event.who, event.about, event.count))
        event = history.event(event.cause)
    return found


@pytest.mark.parametrize("is_heard", [True, False])
def test_a_command_is_caused_by_the_scan_that_its_callback_got(graph, is_heard):
    recording = graph.record()
    scans = stopper(graph)
    if is_heard:
        graph.node("robot").subscriber("cmd_vel", Twist, lambda _: None)
    graph.run(0.1)
    for _ in range(3):
        scans.publish(LaserScan())
        graph.run(0.1)
    history = recording.history
    (event,) = history.last("/cmd_vel")
    assert chain(history, event) == [
        ("publication", "/stop", "/cmd_vel", 3),
        ("delivery", "/laser", "/scan", 3),
        ("publication", "/laser", "/scan", 3),
    ]
    assert event.text == "all 0"
    assert (event.place.file, event.place.function, event.place.text) == (
        "test_history.py",
        "on_scan",
        "commands.publish(Twist())",
    )
    delivery = history.event(event.cause)
    assert delivery.place.function == "on_scan"
    assert delivery.time == event.time == pytest.approx(1000.3)


def test_what_begins_while_nodes_run_is_recorded_and_ends(graph):
    scans = stopper(graph)
    scans.publish(LaserScan())
    graph.run(0.1)
    with graph.record() as recording:
        scans.publish(LaserScan())
        graph.run(0.1)
    scans.publish(LaserScan())
    graph.run(0.1)
    assert [event.about for event in recording.events] == ["/scan", "/scan", "/cmd_vel"]
    assert graph.scheduler.history is None


def test_each_subscriber_gets_its_own_delivery_of_one_publication(graph):
    recording = graph.record()
    talker = graph.node("talker").publisher("chatter", String, latch=True)
    for name in ("a", "b", "c"):
        graph.node(name).subscriber("chatter", String, lambda _: None)
    graph.run(0.1)
    talker.publish("hello")
    graph.run(0.1)
    (publication,) = recording.history.last("/chatter")
    delivered = [event for event in recording.events if event.kind == "delivery"]
    assert [event.whom for event in delivered] == ["/a", "/b", "/c"]
    assert {event.cause for event in delivered} == {publication.number}


def test_a_message_that_is_made_again_for_a_late_subscriber_has_the_same_cause(graph):
    recording = graph.record()
    talker = graph.node("talker").publisher("chatter", String, latch=True)
    for name in ("early", "late", "later"):
        graph.node(name).subscriber("chatter", String, lambda _: None)
        graph.run(0.1)
        if name == "early":
            talker.publish(MessageFactory(lambda: String("hello")))
            graph.run(0.1)
    (publication,) = recording.history.last("/chatter")
    delivered = [(event.whom, event.cause) for event in recording.events if event.kind == "delivery"]
    assert delivered == [(name, publication.number) for name in ("/early", "/late", "/later")]


def test_a_handler_acts_on_its_request_and_the_caller_on_the_answer(graph):
    recording = graph.record()
    lamp = graph.node("lamp")
    light = lamp.publisher("light", String)

    def switch(request):
        light.publish("on" if request.data else "off")
        lamp.sleep(0.5)
        light.publish("steady")
        return True, "done"

    lamp.service("switch", SetBool, switch)
    user = graph.node("user")
    words = user.publisher("words", String)

    def use():
        user.service_client("switch", SetBool)(True)
        words.publish("thanks")
        user.sleep(1)
        words.publish("still here")

    user.run(use)
    graph.run(3)
    history = recording.history
    (request,) = history.last("/switch")
    assert (request.who, request.whom, request.text) == ("/user", "/lamp", "True")
    assert request.answer == "success: True, message: 'done'"
    assert [event.cause for event in history.last("/light", 2)] == [request.number] * 2
    thanks, later = history.last("/words", 2)
    assert thanks.cause == request.number
    assert later.cause is None
    assert later.lane == "/user use"


def test_waiting_for_a_message_makes_it_the_cause(graph):
    recording = graph.record()
    node = graph.node("node")
    echo = node.publisher("echo", String)

    def wait():
        echo.publish(node.wait_for_message("chatter", String).data)

    node.run(wait)
    talker = graph.node("talker").publisher("chatter", String)
    talker.wait_for_subscribers()
    talker.publish("hello")
    graph.run(0.1)
    (event,) = recording.history.last("/echo")
    assert [kind for kind, *_ in chain(recording.history, event)] == ["publication", "delivery", "publication"]


def test_a_loop_of_its_own_has_no_cause_but_what_it_had_heard_is_known(graph):
    recording = graph.record()
    node = graph.node("loop")
    node.subscriber("scan", LaserScan, lambda _: None)
    commands = node.publisher("cmd_vel", Twist)
    node.timer(0.2, lambda _: commands.publish(Twist()))
    scans = graph.node("laser").publisher("scan", LaserScan)
    scans.wait_for_subscribers()
    scans.publish(LaserScan())
    graph.run(1)
    history = recording.history
    (event,) = history.last("/cmd_vel")
    assert event.cause is None
    (heard,) = event.heard
    assert (history.event(heard).about, history.event(heard).count) == ("/scan", 1)


def test_a_callback_that_blocks_lends_its_cause_to_nobody(graph):
    recording = graph.record()
    slow = graph.node("slow")
    slow.subscriber("chatter", String, lambda _: slow.sleep(1))
    other = graph.node("other")
    ticks = other.publisher("ticks", String)
    talker = graph.node("talker").publisher("chatter", String)
    talker.wait_for_subscribers()
    talker.publish("hello")
    graph.scheduler.call_at(graph.scheduler.now_ns() + 500_000_000, lambda: ticks.publish("tick"))
    graph.run(2)
    (event,) = recording.history.last("/ticks")
    assert (event.cause, event.lane) == (None, "")


def test_what_is_forgotten_is_forgotten(graph, monkeypatch):
    monkeypatch.setattr(history_module, "KEPT_EVENTS", 10)
    recording = graph.record()
    talker = graph.node("talker").publisher("chatter", String)
    for number in range(100):
        talker.publish(str(number))
    history = recording.history
    assert len(recording.events) == 10
    assert len(history.last("/chatter", 1000)) == history_module.KEPT_PUBLICATIONS
    assert history.last("/chatter")[0].count == 100
    assert history.event(0) is None
    assert history.event(10**9) is None


def test_what_a_callback_hands_to_another_lane_has_the_same_cause(graph):
    recording = graph.record()
    node = graph.node("node")
    work = node.publisher("work", String)
    ticks = node.publisher("ticks", String)

    def slowly():
        node.sleep(0.5)
        work.publish("done")

    def on_order(_):
        node.run(slowly)
        node.timer(0.2, lambda _: ticks.publish("tick"))

    node.subscriber("order", String, on_order)
    orders = graph.node("boss").publisher("order", String)
    orders.wait_for_subscribers()
    orders.publish("go")
    graph.run(1)
    history = recording.history
    assert [kind for kind, *_ in chain(history, history.last("/work")[0])] == ["publication", "delivery", "publication"]
    assert history.last("/ticks")[0].cause is None
