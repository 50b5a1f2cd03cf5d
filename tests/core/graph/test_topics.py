"""Topics: delivery, snapshots, queues, latching, connections, unregistering; on every transport and clock."""

from __future__ import annotations

import gc
import weakref
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from rosmini import Graph
from rosmini.core.errors import GraphEnded, ROSException, SerializationError, TypeMismatch
from rosmini.core.graph import MessageFactory
from rosmini.msgs.geometry_msgs.msg import Point, PointStamped, Twist, Vector3
from rosmini.msgs.rosgraph_msgs.msg import Log
from rosmini.msgs.sensor_msgs.msg import Image, JointState, LaserScan
from rosmini.msgs.std_msgs.msg import Int32, String
from rosmini.msgs.template import template

from .conftest import KINDS, LONG, close, make, settle, until

if TYPE_CHECKING:
    from collections.abc import Callable

    from rosmini.core.graph import Node, Publisher


def connected(node: Node, topic: str, cls: Any, subscribers: int = 1, **options: Any) -> Publisher:
    """A publisher with its subscribers connected."""
    publisher = node.publisher(topic, cls, **options)
    publisher.wait_for_subscribers(subscribers)
    return publisher


# -- delivery ----------------------------------------------------------------------------------------------------


def test_a_message_arrives_with_its_connection_header(graph: Graph) -> None:
    heard: list[Any] = []
    graph.node("listener").subscriber("chatter", String, heard.append)
    connected(graph.node("talker"), "chatter", String).publish("hello")
    until(graph, lambda: heard)
    assert [message.data for message in heard] == ["hello"]
    header = heard[0]._connection_header
    assert {key: header[key] for key in ("callerid", "topic", "type", "md5sum", "latching")} == {
        "callerid": "/talker",
        "topic": "/chatter",
        "type": "std_msgs/String",
        "md5sum": "992ce8a1687cec8c8bd883ec73ca41d1",
        "latching": "0",
    }
    assert header["message_definition"].strip() == "string data"


def test_a_message_is_never_delivered_inside_publish(graph: Graph) -> None:
    log: list[str] = []
    graph.node("listener").subscriber("t", String, lambda _: log.append("heard"))
    publisher = connected(graph.node("talker"), "t", String)
    publisher.publish("x")
    log.append("published")
    until(graph, lambda: len(log) == 2)
    assert log == ["published", "heard"]


def test_a_node_may_publish_to_itself_and_from_inside_a_callback(graph: Graph) -> None:
    node = graph.node("echo")
    heard: list[int] = []
    publisher = node.publisher("n", Int32)

    def again(message: Any) -> None:
        heard.append(message.data)
        if message.data < 5:
            publisher.publish(message.data + 1)

    node.subscriber("n", Int32, again)
    publisher.wait_for_subscribers()
    publisher.publish(0)
    until(graph, lambda: len(heard) == 6)
    assert heard == [0, 1, 2, 3, 4, 5]


def test_the_header_is_numbered_and_otherwise_left_alone(graph: Graph) -> None:
    heard: list[Any] = []
    graph.node("listener").subscriber("p", PointStamped, heard.append)
    publisher = connected(graph.node("talker"), "p", PointStamped)
    message = PointStamped()
    message.header.frame_id = "map"
    for _ in range(3):
        publisher.publish(message)
    until(graph, lambda: len(heard) == 3)
    assert [item.header.seq for item in heard] == [1, 2, 3]
    assert {item.header.frame_id for item in heard} == {"map"}
    assert {item.header.stamp.to_nsec() for item in heard} == {0}


# -- snapshots ---------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("latch", [True, False])
@pytest.mark.parametrize("vandal_takes_arrays", [True, False])
def test_what_a_subscriber_does_to_its_message_other_nodes_do_not_see(
    graph: Graph, vandal_takes_arrays: bool, latch: bool
) -> None:
    """What one does to names, parts and arrays; those who come late do not see it either."""
    heard: list[Any] = []

    def vandal(message: Any) -> None:
        message.header.frame_id = "nowhere"
        message.name[0] = "spoilt"
        message.name.append("more")
        message.position = []

    node = graph.node("listener")
    node.subscriber("joints", JointState, vandal, numpy=vandal_takes_arrays)
    graph.node("other").subscriber("joints", JointState, vandal)
    graph.node("third").subscriber("joints", JointState, heard.append)
    publisher = connected(graph.node("talker"), "joints", JointState, 3, latch=latch)
    message = JointState(name=["left", "right"], position=[1.0, 2.0])
    message.header.frame_id = "base_link"
    publisher.publish(message)
    until(graph, lambda: len(heard) == 1)
    if latch:
        graph.node("late").subscriber("joints", JointState, heard.append, numpy=not vandal_takes_arrays)
        until(graph, lambda: len(heard) == 2)
    for each in [*heard, message]:
        assert (each.header.frame_id, each.name, list(each.position)) == ("base_link", ["left", "right"], [1.0, 2.0])


@pytest.mark.parametrize("late", [True, False])
def test_what_is_published_late_is_made_when_somebody_comes_and_is_the_same(
    graph: Graph, late: bool, capfd: pytest.CaptureFixture[str]
) -> None:
    """Against a publisher that makes everything at once: the same messages, to whoever is there and who comes."""
    made: list[str] = []
    heard: dict[str, list[Any]] = {"first": [], "second": []}
    publisher = graph.node("talker").publisher("places", PointStamped, latch=True)

    def publish(name: str) -> None:
        def make() -> Any:
            made.append(name)
            message = PointStamped()
            message.header.frame_id = name
            return message

        publisher.publish(MessageFactory(make) if late else make())

    publish("a")
    publish("b")
    assert made == ([] if late else ["a", "b"])
    graph.node("early").subscriber("places", PointStamped, heard["first"].append)
    until(graph, lambda: heard["first"])
    publish("c")
    publish("d")
    until(graph, lambda: len(heard["first"]) == 3)
    graph.node("next").subscriber("places", PointStamped, heard["second"].append)
    until(graph, lambda: heard["second"])
    seen = {name: [(one.header.frame_id, one.header.seq) for one in some] for name, some in heard.items()}
    assert seen == {"first": [("b", 1), ("c", 2), ("d", 3)], "second": [("d", 4)]}
    assert made == (["b", "c", "d", "d"] if late else ["a", "b", "c", "d"])
    assert "nobody was connected" not in capfd.readouterr().err


def test_no_warning_about_the_start_comes_after_the_last_subscriber_left(
    graph: Graph, capfd: pytest.CaptureFixture[str]
) -> None:
    subscriber = graph.node("listener").subscriber("chatter", String, print)
    publisher = connected(graph.node("talker"), "chatter", String)
    subscriber.unregister()
    until(graph, lambda: publisher.num_connections() == 0)
    publisher.publish(String("too late"))
    settle(graph)
    assert "nobody was connected" not in capfd.readouterr().err


def test_a_later_message_replaces_one_that_was_not_made_yet(graph: Graph) -> None:
    publisher = graph.node("talker").publisher("chatter", String, latch=True)
    publisher.publish(MessageFactory(lambda: String("old")))
    publisher.publish("new")
    heard: list[str] = []
    graph.node("listener").subscriber("chatter", String, lambda message: heard.append(message.data))
    until(graph, lambda: heard)
    assert heard == ["new"]


def test_a_message_for_a_node_that_has_gone_replaces_nothing(graph: Graph) -> None:
    publisher = graph.node("talker").publisher("chatter", String, latch=True)
    publisher.publish("latched")
    publisher.publish_to("/gone", MessageFactory(lambda: String("for /gone")))
    heard: list[str] = []
    graph.node("listener").subscriber("chatter", String, lambda message: heard.append(message.data))
    until(graph, lambda: heard)
    assert heard == ["latched"]


@pytest.mark.parametrize("arrays_first", [True, False])
def test_the_first_subscriber_of_a_node_decides_what_all_of_them_get(
    graph: Graph, arrays_first: bool, capfd: pytest.CaptureFixture[str]
) -> None:
    heard: list[Any] = []
    node = graph.node("listener")
    node.subscriber("joints", JointState, heard.append, numpy=arrays_first)
    node.subscriber("joints", JointState, heard.append, numpy=not arrays_first)
    publisher = connected(graph.node("talker"), "joints", JointState)
    publisher.publish(JointState(position=[1.0, 2.0]))
    until(graph, lambda: len(heard) == 2)
    assert heard[0] is heard[1]
    assert isinstance(heard[0].position, np.ndarray if arrays_first else tuple)
    assert "/listener subscribes to /joints already, as sensor_msgs/JointState" in capfd.readouterr().err


def test_topics_connect_by_md5_sum_and_give_each_end_its_own_type(graph: Graph) -> None:
    """As in rospy and roscpp: ``geometry_msgs/Point`` and ``Vector3`` have the same fields."""
    heard: list[Any] = []
    graph.node("listener").subscriber("t", Vector3, heard.append)
    publisher = connected(graph.node("talker"), "t", Point)
    publisher.publish(Point(1.0, 2.0, 3.0))
    publisher.publish(Vector3(4.0, 5.0, 6.0))
    until(graph, lambda: len(heard) == 2)
    assert heard == [Vector3(1.0, 2.0, 3.0), Vector3(4.0, 5.0, 6.0)]
    assert heard[0]._connection_header["type"] == "geometry_msgs/Point"
    node = graph.node("both")
    node.publisher("u", Point)
    assert node.publisher("u", Vector3).message_class is Point
    node.subscriber("u", Vector3, heard.append)
    node.subscriber("u", Point, heard.append)
    with pytest.raises(TypeMismatch, match="already subscribes to /u as geometry_msgs/Vector3, not std_msgs/String"):
        node.subscriber("u", String)


def test_a_publishers_own_headers_reach_those_who_connect_afterwards(graph: Graph) -> None:
    heard: list[Any] = []
    node = graph.node("talker")
    node.publisher("t", String, latch=True, headers={"cookie": "abc", "callerid": "/somebody"}).publish("x")
    graph.node("listener").subscriber("t", String, heard.append)
    until(graph, lambda: heard)
    header = heard[0]._connection_header
    assert (header["cookie"], header["callerid"], header["latching"]) == ("abc", "/somebody", "1")
    assert list(header) == sorted(header)


def test_numeric_arrays_are_numpy_arrays_that_cannot_be_made_writable(graph: Graph) -> None:
    heard: list[Any] = []
    for name in ("one", "two"):
        graph.node(name).subscriber("scan", LaserScan, heard.append)
    publisher = connected(graph.node("talker"), "scan", LaserScan, 2)
    ranges = np.array([1.0, 2.0, 3.0], dtype=np.float32)
    publisher.publish(LaserScan(ranges=ranges))
    ranges[0] = 99.0
    until(graph, lambda: len(heard) == 2)
    for message in heard:
        assert isinstance(message.ranges, np.ndarray)
        assert message.ranges.dtype == np.float32
        assert message.ranges.tolist() == [1.0, 2.0, 3.0]
        with pytest.raises(ValueError, match="read-only"):
            message.ranges[0] = 5.0
        with pytest.raises(ValueError, match="WRITEABLE"):
            message.ranges.flags.writeable = True
    heard[0].ranges = None
    assert heard[1].ranges is not None


def test_without_numpy_arrays_arrive_as_rospy_gives_them(graph: Graph) -> None:
    heard: list[Any] = []
    node = graph.node("listener")
    node.subscriber("scan", LaserScan, heard.append, numpy=False)
    node.subscriber("image", Image, heard.append, numpy=False)
    talker = graph.node("talker")
    connected(talker, "scan", LaserScan).publish(LaserScan(ranges=[1.0, 2.5]))
    until(graph, lambda: len(heard) == 1)
    connected(talker, "image", Image).publish(Image(data=b"\x01\x02"))
    until(graph, lambda: len(heard) == 2)
    assert heard[0].ranges == (1.0, 2.5)
    assert heard[1].data == b"\x01\x02"


# -- queues ------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("size", [0, 1, 10, None])
def test_a_burst_is_delivered_whatever_the_publishers_queue_size_is(graph: Graph, size: int | None) -> None:
    heard: list[int] = []
    graph.node("listener").subscriber("n", Int32, lambda message: heard.append(message.data))
    publisher = connected(graph.node("talker"), "n", Int32, queue_size=size)
    for number in range(100):
        publisher.publish(number)
    until(graph, lambda: heard[-1:] == [99])
    assert heard == list(range(100))


def test_a_publishers_queue_drops_the_oldest_once_the_connection_is_full() -> None:
    with Graph() as graph:
        node = graph.node("listener")
        waiting = node.waiter("the test")
        heard: list[int] = []
        log: list[str] = []

        def slow(message: Any) -> None:
            heard.append(int(message.data[:3]))
            node.wait(waiting)

        node.subscriber("big", String, slow)
        graph.node("log").subscriber("/rosout", Log, lambda message: log.append(message.msg))
        publisher = connected(graph.node("talker"), "big", String, queue_size=3)
        body = "x" * 2**20
        for number in range(50):
            publisher.publish(f"{number:03}{body}")
            settle(graph)
        waiting.wake()
        settle(graph)
        (sender,) = graph.nodes["/talker"].publications["/big"].senders.values()
        assert heard[-3:] == [47, 48, 49], "the queue keeps the newest"
        assert heard[:4] == [0, 1, 2, 3], "the buffers keep the oldest"
        assert len(heard) == 50 - sender.dropped < 20
        assert [text for text in log if "queue_size=3" in text and "/big" in text] == log[-1:]


def test_a_subscribers_queue_drops_the_oldest_while_its_callback_blocks(graph: Graph) -> None:
    heard: list[int] = []
    others: list[int] = []
    node = graph.node("listener")
    waiting = node.waiter("the test")

    def slow(message: Any) -> None:
        heard.append(message.data)
        if message.data == 0:
            node.wait(waiting)

    node.subscriber("n", Int32, slow, queue_size=2)
    graph.node("other").subscriber("n", Int32, lambda message: others.append(message.data))
    publisher = connected(graph.node("talker"), "n", Int32, 2, queue_size=None)
    publisher.publish(0)
    until(graph, lambda: heard == [0])
    for number in range(1, 7):
        publisher.publish(number)
        settle(graph)
    assert heard == [0], "the lane is busy: nothing else of this connection runs"
    assert others == [0, 1, 2, 3, 4, 5, 6], "the others go on"
    waiting.wake()
    until(graph, lambda: len(heard) == 3)
    settle(graph)
    assert heard == [0, 5, 6]


def test_a_subscribers_queue_drops_nothing_of_a_burst_that_its_callback_keeps_up_with() -> None:
    heard: list[int] = []
    with Graph() as graph:
        graph.node("listener").subscriber("n", Int32, lambda message: heard.append(message.data), queue_size=1)
        publisher = connected(graph.node("talker"), "n", Int32)
        for number in range(100):
            publisher.publish(number)
        settle(graph)
    assert heard == list(range(100))


def test_drops_of_a_subscribers_queue_are_logged_once_on_rosout_and_not_on_the_console(
    capsys: pytest.CaptureFixture[str],
) -> None:
    heard: list[int] = []
    log: list[str] = []
    with Graph() as graph:
        node = graph.node("listener")

        def slow(message: Any) -> None:
            heard.append(message.data)
            node.sleep(1.0)

        node.subscriber("n", Int32, slow, queue_size=2)
        graph.node("log").subscriber("/rosout", Log, lambda message: log.append(message.msg))
        publisher = connected(graph.node("talker"), "n", Int32)
        for number in range(20):
            publisher.publish(number)
        graph.run(0.5)
        publisher.publish(20)
        graph.run(5.0)
        (connection,) = node.subscriptions["/n"].connections.values()
        assert heard == [0, 19, 20]
        assert connection.dropped == 18
    (text,) = log
    assert all(part in text for part in ("/listener", "/talker", "/n", "queue_size=2"))
    assert capsys.readouterr() == ("", "")


def test_a_callback_may_sleep_while_messages_come_on_another_connection(graph: Graph) -> None:
    log: list[str] = []
    node = graph.node("listener")

    def slow(message: Any) -> None:
        log.append(f"{message.data} begins")
        while message.data == "slow" and "quick ends" not in log:
            node.sleep(0.5)
        log.append(f"{message.data} ends")

    node.subscriber("t", String, slow)
    one, two = graph.node("one"), graph.node("two")
    first, second = connected(one, "t", String), connected(two, "t", String)
    first.publish("slow")
    until(graph, lambda: log)
    second.publish("quick")
    until(graph, lambda: len(log) == 4)
    assert log == ["slow begins", "quick begins", "quick ends", "slow ends"]


# -- latching ----------------------------------------------------------------------------------------------------


def test_a_latched_message_reaches_each_late_subscriber_of_a_node_once(graph: Graph) -> None:
    publisher = graph.node("talker").publisher("t", String, latch=True)
    publisher.publish("old")
    publisher.publish("new")
    heard: list[list[Any]] = [[], []]
    node = graph.node("late")
    for mine in heard:
        node.subscriber("t", String, mine.append)
        until(graph, lambda mine=mine: mine)
    settle(graph)
    ((first,), (second,)) = heard
    assert first is second
    assert (first.data, first._connection_header["latching"]) == ("new", "1")


def test_without_latch_the_first_message_is_lost_with_one_warning(
    graph: Graph, capsys: pytest.CaptureFixture[str]
) -> None:
    publisher = graph.node("talker").publisher("chatter", String)
    publisher.publish("one")
    publisher.publish("two")
    heard: list[Any] = []
    graph.node("late").subscriber("chatter", String, heard.append)
    publisher.wait_for_subscribers()
    settle(graph)
    assert heard == []
    said = capsys.readouterr().err
    assert said.count("/chatter while nobody was connected") == 1
    assert "wait_for_subscribers()" in said
    assert "latch=True" in said


# -- connections -------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("first", "told"), [("talker", "listener: lost /talker"), ("listener", "talker: lost /listener")]
)
def test_connection_counts_and_callbacks_at_both_ends(graph: Graph, first: str, told: str) -> None:
    seen: list[str] = []

    def callbacks(name: str) -> dict[str, Any]:
        return {
            "on_connect": lambda peer: seen.append(f"{name}: found {peer}"),
            "on_disconnect": lambda peer: seen.append(f"{name}: lost {peer}"),
        }

    publisher = graph.node("talker").publisher("t", String, **callbacks("talker"))
    subscriber = graph.node("listener").subscriber("t", String, **callbacks("listener"))
    until(graph, lambda: len(seen) == 2)
    assert sorted(seen) == ["listener: found /talker", "talker: found /listener"]
    assert (publisher.num_connections(), subscriber.num_connections()) == (1, 1)
    seen.clear()
    (publisher if first == "talker" else subscriber).unregister()
    until(graph, lambda: seen)
    assert seen == [told]
    assert (publisher.num_connections(), subscriber.num_connections()) == (0, 0)


def test_a_connect_callback_may_publish_to_the_newcomer_alone(graph: Graph) -> None:
    heard: dict[str, list[str]] = {"one": [], "two": []}
    publisher = graph.node("talker").publisher(
        "t", String, on_connect=lambda peer: publisher.publish_to(peer, String(f"welcome {peer}"))
    )
    for name, mine in heard.items():
        graph.node(name).subscriber("t", String, lambda message, mine=mine: mine.append(message.data))
        until(graph, lambda mine=mine: mine)
    settle(graph)
    assert heard == {"one": ["welcome /one"], "two": ["welcome /two"]}


def test_waiting_for_subscribers_gives_up_with_what_is_there(graph: Graph) -> None:
    publisher = graph.node("talker").publisher("t", String)
    graph.node("listener").subscriber("t", String)
    publisher.wait_for_subscribers(1, timeout=LONG_ENOUGH)
    with pytest.raises(ROSException, match=r"after 2 s .* 2 subscribers of /t: 1 of 2 subscribers"):
        publisher.wait_for_subscribers(2, timeout=2.0)


# -- leaving -----------------------------------------------------------------------------------------------------


def test_what_was_published_before_unregistering_still_arrives(graph: Graph) -> None:
    heard: list[str] = []
    subscriber = graph.node("listener").subscriber("t", String, lambda message: heard.append(message.data))
    publisher = connected(graph.node("talker"), "t", String)
    until(graph, subscriber.num_connections)
    publisher.publish("last words")
    publisher.unregister()
    publisher.unregister()
    until(graph, lambda: heard)
    with pytest.raises(ROSException, match=r"publish\(\) on /t after unregister\(\): make a new publisher"):
        publisher.publish("more")


def test_publishers_that_leave_and_come_back_while_messages_are_on_their_way_are_heard(graph: Graph) -> None:
    heard: list[str] = []
    talker, listener, topics = graph.node("talker"), graph.node("listener"), ("a", "b", "c")
    for topic in topics:
        listener.subscriber(topic, String, lambda message: heard.append(message.data))
    first = [connected(talker, topic, String, queue_size=10) for topic in topics]
    for publisher in first:
        publisher.publish("on its way")
    for publisher in first:
        publisher.unregister()
    second = [talker.publisher(topic, String, queue_size=10) for topic in topics]
    settle(graph)
    until(graph, lambda: [each.num_connections() for each in second] == [1, 1, 1])
    for publisher in second:
        publisher.publish("back")
    until(graph, lambda: len(heard) == 6)
    assert sorted(heard) == ["back"] * 3 + ["on its way"] * 3


def test_the_topic_is_left_with_the_last_handle(graph: Graph) -> None:
    talker, listener = graph.node("talker"), graph.node("listener")
    publishers = [talker.publisher("t", String) for _ in range(2)]
    subscribers = [listener.subscriber("t", String) for _ in range(2)]
    publishers[0].wait_for_subscribers()

    def registered() -> tuple[bool, bool]:
        publishing, subscribing, _ = graph.master.getSystemState("/test")[2]
        return "/t" in dict(publishing), "/t" in dict(subscribing)

    publishers[0].unregister()
    subscribers[0].unregister()
    assert registered() == (True, True)
    assert publishers[1].num_connections() == 1
    publishers[1].unregister()
    subscribers[1].unregister()
    assert registered() == (False, False)


@pytest.mark.parametrize("first", ["publisher", "subscriber"])
def test_both_ends_can_leave_in_any_order_and_come_back(graph: Graph, first: str) -> None:
    talker, listener, heard = graph.node("talker"), graph.node("listener"), []
    for turn in range(3):
        subscriber = listener.subscriber("t", String, lambda message: heard.append(message.data))
        publisher = connected(talker, "t", String)
        publisher.publish(f"turn {turn}")
        until(graph, lambda turn=turn: len(heard) == turn + 1)
        ends = [publisher, subscriber] if first == "publisher" else [subscriber, publisher]
        for end in ends:
            end.unregister()
    settle(graph)
    assert heard == ["turn 0", "turn 1", "turn 2"]


def test_a_subscriber_that_leaves_at_once_is_never_connected(graph: Graph) -> None:
    publisher = graph.node("talker").publisher("t", String)
    seen: list[str] = []
    graph.node("listener").subscriber("t", String, on_connect=seen.append).unregister()
    settle(graph)
    assert publisher.num_connections() == 0
    assert seen == []


def test_unregistering_inside_a_callback(graph: Graph) -> None:
    heard: list[str] = []
    node = graph.node("listener")

    def once(message: Any) -> None:
        heard.append(message.data)
        subscriber.unregister()

    subscriber = node.subscriber("t", String, once)
    publisher = connected(graph.node("talker"), "t", String)
    publisher.publish("one")
    publisher.publish("two")
    settle(graph)
    assert heard == ["one"]


# -- waiting -----------------------------------------------------------------------------------------------------


def test_wait_for_message_returns_it_and_leaves_the_topic(graph: Graph) -> None:
    talker, listener = graph.node("talker"), graph.node("listener")
    publisher = talker.publisher("t", String)
    talker.timer(1.0, lambda _: publisher.publish("now"))
    assert listener.wait_for_message("t", String).data == "now"
    assert "/t" not in dict(graph.master.getSystemState("/test")[2][1])
    assert listener.wait_for_message("t", String, timeout=LONG_ENOUGH).data == "now"


LONG_ENOUGH = LONG


def test_wait_for_message_gives_up_and_says_who_publishes(graph: Graph) -> None:
    node = graph.node("listener")
    with pytest.raises(ROSException, match=r"after 1 s while waiting for a message on /t: nobody publishes it"):
        node.wait_for_message("t", String, timeout=1.0)
    graph.node("talker").publisher("t", String)
    with pytest.raises(ROSException, match="/talker publishes it"):
        node.wait_for_message("t", String, timeout=1.0)
    assert "/t" not in dict(graph.master.getSystemState("/test")[2][1])


def test_waiting_for_what_can_never_come_ends_in_simulated_time(simulated: Graph) -> None:
    node = simulated.node("listener")
    simulated.node("other").run(lambda: simulated.nodes["/other"].wait_for_message("b", String), name="main of other")
    with pytest.raises(GraphEnded) as caught:
        node.wait_for_message("t", String)
    text = str(caught.value)
    assert "waited for a message on /t, but nothing is left to happen" in text
    assert "main of other was waiting for a message on /b" in text
    assert "/t" not in dict(simulated.master.getSystemState("/test")[2][1])


# -- bad input ---------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("cls", "arguments", "fields", "kinds", "text"),
    [
        (String, ("a", "b"), {}, TypeError, "String"),
        (String, (Int32(1),), {}, TypeError, "/t carries std_msgs/String.* a std_msgs/Int32"),
        (String, (), {"dta": "x"}, AttributeError, "dta"),
        (String, (1,), {}, SerializationError, "data"),
        (String, (), {"data": 1.5}, SerializationError, "data"),
        (Twist, (Vector3(x="fast"), Vector3()), {}, SerializationError, r"linear\.x.*'fast'"),
    ],
)
def test_wrong_arguments_of_publish_name_what_is_wrong(
    graph: Graph, cls: Any, arguments: tuple[Any, ...], fields: dict[str, Any], kinds: type[Exception], text: str
) -> None:
    publisher = graph.node("talker").publisher("t", cls)
    with pytest.raises(kinds, match=text):
        publisher.publish(*arguments, **fields)


def test_one_node_cannot_use_a_topic_with_two_types(graph: Graph) -> None:
    node = graph.node("node")
    node.publisher("t", String)
    node.subscriber("s", String)
    with pytest.raises(TypeMismatch, match=r"/node already publishes /t as std_msgs/String, not std_msgs/Int32"):
        node.publisher("t", Int32)
    with pytest.raises(TypeMismatch, match=r"/node already subscribes to /s as std_msgs/String, not std_msgs/Int32"):
        node.subscriber("s", Int32)


MISMATCH = (
    "/talker publishes /t as std_msgs/String, but /listener subscribes to it as std_msgs/Int32",
    "- string data",
    "+ int32 data",
    "Use the same type at both ends",
)


def test_types_that_differ_are_an_error_where_the_graph_is_driven(
    graph: Graph, capsys: pytest.CaptureFixture[str]
) -> None:
    publisher = graph.node("talker").publisher("t", String)
    subscriber = graph.node("listener").subscriber("t", Int32)
    with pytest.raises(TypeMismatch) as caught:
        publisher.wait_for_subscribers(timeout=LONG_ENOUGH)
    said = capsys.readouterr()
    for line in MISMATCH:
        assert line in str(caught.value), "the subscriber's end"
        assert line in said.err, "the publisher's end"
    assert (publisher.num_connections(), subscriber.num_connections()) == (0, 0)
    settle(graph)


def test_types_that_differ_are_logged_at_both_ends(lenient: Graph, capsys: pytest.CaptureFixture[str]) -> None:
    logs: list[Any] = []
    lenient.node("watcher").subscriber("/rosout", lenient.log_class, logs.append)
    talker, listener = lenient.node("talker"), lenient.node("listener")
    settle(lenient)
    talker.publisher("t", String)
    listener.subscriber("t", Int32)

    def errors_logged() -> list[Any]:
        return [log for log in logs if log.level == 8 and "Will keep trying" not in log.msg]

    until(lenient, lambda: len(errors_logged()) == 2)
    errors = errors_logged()
    assert {log.name for log in errors} == {"/talker", "/listener"}
    for line in MISMATCH:
        assert all(line in log.msg for log in errors)
    capsys.readouterr()


# -- any type ----------------------------------------------------------------------------------------------------


class Whatever:
    """A type that a subscriber may ask for when it takes any: what rospy calls AnyMsg."""

    __slots__ = ("_connection_header", "size")
    _type = _md5sum = "*"
    _full_text = ""

    def __init__(self, frozen: Any) -> None:
        self.size = len(frozen._encode(frozen))


def test_a_subscriber_may_take_any_type(graph: Graph) -> None:
    heard: list[Any] = []
    node = graph.node("listener")
    node.subscriber("t", Whatever, heard.append, receipt=lambda _: Whatever)
    node.subscriber("u", Whatever, heard.append, receipt=lambda _: Whatever)
    talker = graph.node("talker")
    texts, numbers = connected(talker, "t", String), connected(talker, "u", Int32)
    texts.publish("four")
    until(graph, lambda: len(heard) == 1)
    numbers.publish(1)
    until(graph, lambda: len(heard) == 2)
    assert [(message._connection_header["type"], message.size) for message in heard] == [
        ("std_msgs/String", 8),
        ("std_msgs/Int32", 4),
    ]
    assert dict(graph.master.getTopicTypes("/test")[2])["/t"] == "std_msgs/String"


# -- the end -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", KINDS)
def test_a_closed_graph_is_collected_with_all_that_was_in_it(kind: str) -> None:
    blocked = {"time to pass", "spin", "a message on /never"}

    def use(graph: Graph, node: Node) -> None:
        node.subscriber("t", String, lambda _: node.sleep(1000.0))
        connected(node, "t", String).publish("x")
        node.timer(1.0, lambda _: None)
        node.run(node.spin)
        node.run(lambda: node.wait_for_message("never", String))
        node.on_shutdown(lambda: None)
        until(graph, lambda: {wait.reason for wait in graph.scheduler.waiting()} >= blocked)
        close(graph)

    graph = make(kind)
    node = graph.node("node")
    use(graph, node)
    graph_gone, node_gone = weakref.ref(graph), weakref.ref(node)
    del graph, node
    gc.collect()
    assert graph_gone() is None
    assert node_gone() is None


def test_a_graph_can_be_used_again_after_it_was_shut_down(build: Callable[..., Graph]) -> None:
    graph = build()
    for _ in range(2):
        heard: list[Any] = []
        graph.node("listener").subscriber("t", String, heard.append)
        connected(graph.node("talker"), "t", String).publish("x")
        until(graph, lambda heard=heard: heard)
        close(graph)


def test_an_open_connection_outlives_its_registration_and_is_not_doubled(graph: Graph) -> None:
    talker, listener = graph.node("talker"), graph.node("listener")
    heard: list[str] = []
    subscriber = listener.subscriber("chatter", String, lambda message: heard.append(message.data))
    publisher = connected(talker, "chatter", String)
    until(graph, subscriber.num_connections)
    for uris in ([], [talker.uri], [talker.uri]):
        listener.slave.publisherUpdate("/master", "/chatter", uris)
        settle(graph)
        publisher.publish("still here")
    until(graph, lambda: len(heard) >= 3)
    settle(graph)
    assert heard == ["still here"] * 3
    assert publisher.num_connections() == 1


def test_what_a_template_made_reaches_everybody_with_numbers_in_its_header(graph: Graph) -> None:
    heard: dict[str, list[Any]] = {"one": [], "two": []}
    for name, messages in heard.items():
        graph.node(name).subscriber("point", PointStamped, messages.append)
    publisher = connected(graph.node("sender"), "point", PointStamped, 2, queue_size=10)
    made = template(PointStamped(), "point.x")
    for x in range(3):
        publisher.publish(MessageFactory(partial(made, float(x)), is_frozen=True))
    until(graph, lambda: all(len(messages) == 3 for messages in heard.values()))
    for messages in heard.values():
        assert [(m.header.seq, m.point.x) for m in messages] == [(1, 0.0), (2, 1.0), (3, 2.0)]
        assert {m._connection_header["callerid"] for m in messages} == {"/sender"}
    publisher.unregister()
    with pytest.raises(ROSException, match="unregister"):
        publisher.publish(MessageFactory(partial(made, 0.0), is_frozen=True))
