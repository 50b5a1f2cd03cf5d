"""What is right in the exercises of chapter 11, Nodes and the Master."""

from __future__ import annotations

from typing import Any

from rosmini.book.checks import exercise, expect, expect_heard, expect_node, expect_type
from rosmini.graph import Graph
from rosmini.msgs.std_msgs.msg import Int32, String

ADDRESS = "http://by-hand:1/"


# ---- 11.1: rosnode list ----


def _all_registered(master: Any) -> list[str]:
    state = master.getSystemState("/check")[2]
    return sorted({node for registry in state for _, nodes in registry for node in nodes})


@exercise("11.1", praise="This is what `rosnode list` does: it asks the Master, and only the Master.")
def node_list(answer: Any) -> None:
    """The names of all nodes that a Master knows, sorted."""
    with Graph() as graph:
        master = graph.master
        graph.node("talker").publisher("chatter", String)
        master.registerPublisher("/only_publishes", "/a", "std_msgs/String", ADDRESS)
        master.registerSubscriber("/only_subscribes", "/b", "std_msgs/String", ADDRESS)
        master.registerService("/only_serves", "/c", "rosrpc://by-hand:1", ADDRESS)
        found = answer(master)
        expected = _all_registered(master)
    expect_type(found, list, "It returned", "a list", "sorted(...) makes a list")
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


@exercise("11.2", praise="Neither end knows that your node exists: they know the topics only.")
def doubler(answer: Any) -> None:
    """A node that publishes twice each number that it receives."""
    got: list[int] = []
    with Graph() as graph:
        answer(graph)
        expect_node(graph, "/doubler")
        sink = graph.node("sink").subscriber("doubled", Int32, lambda message: got.append(message.data))
        feed = graph.node("feed").publisher("number", Int32)
        graph.run(0.1)
        expect_heard(feed)
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


@exercise("11.3", praise="That one call is all that the Master ever says to a subscriber.")
def introduce(answer: Any) -> None:
    """A publisher and a subscriber are brought together without the Master."""
    got: list[str] = []
    with Graph() as graph:
        talker, listener = graph.node("crier"), graph.node("passer_by")
        listener.subscriber("news", String, lambda message: got.append(message.data))
        graph.master.unregisterSubscriber("/passer_by", "/news", listener.uri)
        news = talker.publisher("news", String, latch=True)
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


@exercise("11.4", praise="It waited for the connection, not for some seconds and good luck.")
def say_hello(answer: Any) -> None:
    """A single message arrives, though the publisher was made a moment ago and the subscriber comes late."""
    got: list[str] = []
    with Graph() as graph:
        publisher = graph.node("talker").publisher("chatter", String, queue_size=10)
        late = graph.node("late")

        def arrive() -> None:
            late.sleep(7.0)
            late.subscriber("chatter", String, lambda message: got.append(message.data))

        late.run(arrive)
        answer(publisher)
        graph.run(10.0)
    expect(
        got, "The message was lost: nobody was connected when you published.", "wait for a subscriber first"
    )
    expect(got == ["hello"], f"What arrived is {got!r}, not one 'hello'.", "publish once")
