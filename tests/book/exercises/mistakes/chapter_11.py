"""Wrong answers to the exercises of chapter 11, which their checks have to refuse."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rosmini.book.exercises.chapter_11 import _all_registered
from rosmini.graph import Graph
from rosmini.msgs.std_msgs.msg import Int32

if TYPE_CHECKING:
    from collections.abc import Callable


def _only(registry: int) -> Callable[[], Any]:
    return lambda: (
        lambda master: sorted(
            {node for _, nodes in master.getSystemState("/check")[2][registry] for node in nodes}
        )
    )


# ---- 11.2: a node in the middle ----


def _doubler(factor: int = 2, topic: str = "doubled", name: str = "doubler") -> Callable[[], Any]:
    def start(graph: Graph) -> None:
        node = graph.node(name)
        result = node.publisher(topic, Int32, queue_size=10)
        node.subscriber("number", Int32, lambda message: result.publish(factor * message.data))

    return lambda: start


def _fixed_doubler(graph: Graph) -> None:
    node = graph.node("doubler")
    result = node.publisher("doubled", Int32, queue_size=10)
    node.subscriber("number", Int32, lambda _: result.publish(6))


# ---- 11.3: the reader as the Master ----


def _introduced_at_the_master(publisher: Any, subscriber: Any, topic: str) -> None:
    graph = publisher.graph
    graph.master.registerSubscriber(subscriber.name, topic, "std_msgs/String", subscriber.uri)
    graph.master.registerPublisher(publisher.name, topic, "std_msgs/String", publisher.uri)


def _wrong_uri(_: Any, subscriber: Any, topic: str) -> None:
    subscriber.slave.publisherUpdate("/master", topic, [subscriber.uri])


def _asked_the_publisher(publisher: Any, subscriber: Any, topic: str) -> None:
    publisher.slave.publisherUpdate("/master", topic, [subscriber.uri])


# ---- 11.4: the first message ----


def _hasty(publisher: Any) -> None:
    publisher.publish("hello")


def _twice(publisher: Any) -> None:
    publisher.wait_for_subscribers()
    publisher.publish("hello")
    publisher.publish("hello")


def _waits_only(publisher: Any) -> None:
    publisher.wait_for_subscribers()


MISTAKES = {
    "11.1": [
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
    "11.2": [
        _doubler(factor=3),
        _doubler(topic="double"),
        _doubler(name="twice"),
        lambda: _fixed_doubler,
        lambda: lambda graph: graph.node("doubler"),
        lambda: lambda graph: graph.run(0.1),
    ],
    "11.3": [
        lambda: _introduced_at_the_master,
        lambda: _wrong_uri,
        lambda: _asked_the_publisher,
        lambda: lambda publisher, subscriber, topic: [publisher, subscriber, topic],
    ],
    "11.4": [lambda: _hasty, lambda: _twice, lambda: _waits_only],
}
