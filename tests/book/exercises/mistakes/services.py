"""Wrong answers to the exercises of the chapter Services."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rosmini.book.exercises.services import PICTURE
from rosmini.core.errors import ROSException, ServiceException
from rosmini.core.graph import Graph, Node
from rosmini.msgs.std_msgs.msg import String
from rosmini.msgs.std_srvs.srv import Empty, Trigger

if TYPE_CHECKING:
    from collections.abc import Callable


def _picture_but(old: str, new: str) -> Callable[[], Any]:
    return lambda: PICTURE.replace(old, new)


# ---- counter: two services that share something ----


def _counter(
    *, first: int = 0, step: int = 1, cleared: int = 0, name: str = "counter", success: bool = True, clears: bool = True
) -> Callable[[], Any]:
    def start(graph: Graph) -> None:
        node = graph.node(name)
        calls = [first]

        def count(_: Any) -> tuple[bool, str]:
            calls[0] += step
            return success, str(calls[0])

        def clear(_: Any) -> list[Any]:
            calls[0] = cleared
            return []

        node.service("count", Trigger, count)
        if clears:
            node.service("clear", Empty, clear)

    return lambda: start


def _number_as_message(graph: Graph) -> None:
    node = graph.node("counter")
    node.service("count", Trigger, lambda _: (True, 1))
    node.service("clear", Empty, lambda _: [])


# ---- who_is_it: a client that is ready for everything ----


def _careful(
    *, wait: bool = True, catch: bool = True, look: bool = True, limit: float | None = None
) -> Callable[[], Any]:
    def ask(node: Node, seconds: float) -> str:
        if wait:
            try:
                node.wait_for_service("who", timeout=seconds if limit is None else limit)
            except ROSException:
                return "nobody"
        try:
            answer = node.service_client("who", Trigger)()
        except ServiceException:
            if catch:
                return "no answer"
            raise
        return str(answer.message) if answer.success or not look else "no answer"

    return lambda: ask


# ---- secretary: a service that remembers a topic ----


def _secretary(
    *, first: bool = False, before: str = "nothing yet", topic: str = "status", known: bool = True
) -> Callable[[], Any]:
    def start(graph: Graph) -> None:
        node = graph.node("secretary")
        heard: list[str] = []

        def tell(_: Any) -> tuple[bool, str]:
            return (known, heard[0 if first else -1]) if heard else (False, before)

        node.subscriber(topic, String, lambda message: heard.append(message.data))
        node.service("last_status", Trigger, tell)

    return lambda: start


def _waiting_secretary(graph: Graph) -> None:
    node = graph.node("secretary")
    node.subscriber("status", String)

    def tell(_: Any) -> tuple[bool, str]:
        try:
            return True, node.wait_for_message("status", String, timeout=1.0).data
        except ROSException:
            return False, "nothing yet"

    node.service("last_status", Trigger, tell)


MISTAKES = {
    "service_type": [
        _picture_but("---\n", ""),
        _picture_but("uint32", "int32"),
        _picture_but("bool colour\n", ""),
        _picture_but("uint32 width\nbool colour", "bool colour\nuint32 width"),
        _picture_but("sensor_msgs/", ""),
        _picture_but("Image image", "Image picture"),
        _picture_but("---\nbool success", "bool success\n---"),
        _picture_but("string message", "string message\nstring encoding"),
        lambda: ["uint32 width", "bool colour"],
    ],
    "counter": [
        _counter(first=-1),
        _counter(step=0),
        _counter(cleared=1),
        _counter(name="count"),
        _counter(success=False),
        _counter(clears=False),
        lambda: _number_as_message,
        lambda: lambda graph: graph.node("counter"),
    ],
    "who_is_it": [
        _careful(wait=False),
        _careful(catch=False),
        _careful(look=False),
        _careful(limit=1.0),
        _careful(limit=60.0),
        lambda: lambda node, seconds: "nobody",
    ],
    "secretary": [
        _secretary(first=True),
        _secretary(before=""),
        _secretary(topic="state"),
        _secretary(known=False),
        lambda: _waiting_secretary,
        lambda: lambda graph: graph.node("secretary"),
    ],
}
