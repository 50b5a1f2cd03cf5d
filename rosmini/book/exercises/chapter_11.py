"""What is right in the exercises of chapter 11, Nodes and the Master."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rosmini.book.checks import exercise, expect
from rosmini.graph import Graph
from rosmini.msgs import message_class

if TYPE_CHECKING:
    from collections.abc import Callable

ADDRESS = "http://by-hand:1/"


def _string() -> Any:
    return message_class("std_msgs/String")


def _int32() -> Any:
    return message_class("std_msgs/Int32")


# ---- 11.1: rosnode list ----


def _all_registered(master: Any) -> list[str]:
    state = master.getSystemState("/check")[2]
    return sorted({node for registry in state for _, nodes in registry for node in nodes})


def _only(registry: int) -> Callable[[], Any]:
    return lambda: (
        lambda master: sorted(
            {node for _, nodes in master.getSystemState("/check")[2][registry] for node in nodes}
        )
    )


@exercise(
    "11.1",
    praise="This is what `rosnode list` does: it asks the Master, and only the Master.",
    mistakes=[
        _only(0),
        _only(1),
        _only(2),
        lambda: lambda master: _all_registered(master)[::-1],
        lambda: lambda _: ["/listener", "/rosout", "/talker"],
        lambda: lambda master: set(_all_registered(master)),
        lambda: lambda master: master.getSystemState("/check")[2],
        lambda: (
            lambda master: sorted(
                node
                for registry in master.getSystemState("/check")[2]
                for _, nodes in registry
                for node in nodes
            )
        ),
    ],
)
def node_list(answer: Any) -> None:
    """The names of all nodes that a Master knows, sorted."""
    with Graph() as graph:
        master = graph.master
        graph.node("talker").publisher("chatter", _string())
        master.registerPublisher("/only_publishes", "/a", "std_msgs/String", ADDRESS)
        master.registerSubscriber("/only_subscribes", "/b", "std_msgs/String", ADDRESS)
        master.registerService("/only_serves", "/c", "rosrpc://by-hand:1", ADDRESS)
        found = answer(master)
        expected = _all_registered(master)
    expect(
        isinstance(found, list),
        f"It returned a {type(found).__name__}, not a list.",
        "sorted(...) makes a list",
    )
    expect(
        all(isinstance(name, str) for name in found),
        "The list holds something else than names.",
        "the value of getSystemState is three lists; each entry of them is [name, [node, node, ...]]",
    )
    missing = [name for name in expected if name not in found]
    expect(
        not missing,
        f"A node is missing: {', '.join(missing)}.",
        "a node may only publish, only subscribe, or only offer a service: look at all three lists",
    )
    extra = [name for name in found if name not in expected]
    expect(not extra, f"Not known to that Master: {', '.join(extra)}.", "ask the master that you are given")
    expect(len(found) == len(set(found)), "Some nodes are there twice.", "a set keeps one of each")
    expect(found == sorted(found), "The names are not in alphabetical order.", "sorted(...)")


# ---- 11.2: a node in the middle ----


def _doubler(factor: int = 2, topic: str = "doubled", name: str = "doubler") -> Callable[[], Any]:
    def start(graph: Graph) -> None:
        node = graph.node(name)
        result = node.publisher(topic, _int32(), queue_size=10)
        node.subscriber("number", _int32(), lambda message: result.publish(factor * message.data))

    return lambda: start


def _fixed_doubler(graph: Graph) -> None:
    node = graph.node("doubler")
    result = node.publisher("doubled", _int32(), queue_size=10)
    node.subscriber("number", _int32(), lambda _: result.publish(6))


@exercise(
    "11.2",
    praise="Neither end knows that your node exists: they know the topics only.",
    mistakes=[
        _doubler(factor=3),
        _doubler(topic="double"),
        _doubler(name="twice"),
        lambda: _fixed_doubler,
        lambda: lambda graph: graph.node("doubler"),
        lambda: lambda graph: graph.run(0.1),
    ],
)
def doubler(answer: Any) -> None:
    """A node that publishes twice each number that it receives."""
    got: list[int] = []
    with Graph() as graph:
        answer(graph)
        expect("/doubler" in graph.nodes, "There is no node /doubler.", 'graph.node("doubler")')
        sink = graph.node("sink").subscriber("doubled", _int32(), lambda message: got.append(message.data))
        feed = graph.node("feed").publisher("number", _int32())
        graph.run(0.1)
        expect(feed.num_connections(), "Nobody subscribes to /number.", "subscriber(...) with the type Int32")
        expect(sink.num_connections(), "Nobody publishes /doubled.", "publisher(...) with the type Int32")
        for number in (3, -5, 21):
            feed.publish(number)
        graph.run(0.1)
    expect(
        got == [6, -10, 42],
        f"For 3, -5 and 21 it published {', '.join(map(str, got)) or 'nothing'}, not 6, -10, 42.",
        "the number is message.data; publish from the callback",
    )


# ---- 11.3: the reader as the Master ----


def _introduced_at_the_master(publisher: Any, subscriber: Any, topic: str) -> None:
    graph = publisher.graph
    graph.master.registerSubscriber(subscriber.name, topic, "std_msgs/String", subscriber.uri)
    graph.master.registerPublisher(publisher.name, topic, "std_msgs/String", publisher.uri)


def _wrong_uri(_: Any, subscriber: Any, topic: str) -> None:
    subscriber.slave.publisherUpdate("/master", topic, [subscriber.uri])


def _asked_the_publisher(publisher: Any, subscriber: Any, topic: str) -> None:
    publisher.slave.publisherUpdate("/master", topic, [subscriber.uri])


@exercise(
    "11.3",
    praise="That one call is all that the Master ever says to a subscriber.",
    mistakes=[
        lambda: _introduced_at_the_master,
        lambda: _wrong_uri,
        lambda: _asked_the_publisher,
        lambda: lambda publisher, subscriber, topic: [publisher, subscriber, topic],
    ],
)
def introduce(answer: Any) -> None:
    """A publisher and a subscriber are brought together without the Master."""
    got: list[str] = []
    with Graph() as graph:
        talker, listener = graph.node("crier"), graph.node("passer_by")
        listener.subscriber("news", _string(), lambda message: got.append(message.data))
        graph.master.unregisterSubscriber("/passer_by", "/news", listener.uri)
        news = talker.publisher("news", _string(), latch=True)
        graph.master.unregisterPublisher("/crier", "/news", talker.uri)
        answer(talker, listener, "/news")
        news.publish("extra")
        graph.run(0.1)
        known = [topic for registry in graph.master.getSystemState("/check")[2][:2] for topic, _ in registry]
    expect(
        "/news" not in known,
        "You registered them at the Master. Leave the Master out of it.",
        "speak to the subscriber itself, through its slave API",
    )
    expect(
        got == ["extra"],
        "The subscriber still does not know the publisher.",
        "subscriber.slave.publisherUpdate(caller, topic, list of addresses); a node's address is its uri",
    )


# ---- 11.4: the first message ----


def _hasty(publisher: Any) -> None:
    publisher.publish("hello")


def _twice(publisher: Any) -> None:
    publisher.wait_for_subscribers()
    publisher.publish("hello")
    publisher.publish("hello")


def _waits_only(publisher: Any) -> None:
    publisher.wait_for_subscribers()


@exercise(
    "11.4",
    praise="It waited for the connection, not for some seconds and good luck.",
    mistakes=[lambda: _hasty, lambda: _twice, lambda: _waits_only],
)
def say_hello(answer: Any) -> None:
    """A single message arrives, though the publisher was made a moment ago and the subscriber comes late."""
    got: list[str] = []
    with Graph() as graph:
        publisher = graph.node("talker").publisher("chatter", _string(), queue_size=10)
        late = graph.node("late")

        def arrive() -> None:
            late.sleep(7.0)
            late.subscriber("chatter", _string(), lambda message: got.append(message.data))

        late.run(arrive)
        answer(publisher)
        graph.run(10.0)
    expect(
        got, "The message was lost: nobody was connected when you published.", "wait for a subscriber first"
    )
    expect(got == ["hello"], f"What arrived is {got!r}, not one 'hello'.", "publish once")
