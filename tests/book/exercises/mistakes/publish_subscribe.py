"""Wrong answers to the exercises of the chapter Publish and subscribe."""

from __future__ import annotations

from collections import deque
from contextlib import suppress
from typing import TYPE_CHECKING, Any

from rosmini.core.graph import Graph
from rosmini.msgs import message_class

if TYPE_CHECKING:
    from collections.abc import Callable


# ---- better_service: a better event service ----


class _Service:
    """The right one; the mistakes differ from it in one point each."""

    def __init__(self) -> None:
        self.callbacks: dict[str, list[Any]] = {}

    def subscribe(self, topic: str, callback: Any) -> None:
        self.callbacks.setdefault(topic, []).append(callback)

    def unsubscribe(self, topic: str, callback: Any) -> None:
        self.callbacks[topic].remove(callback)

    def publish(self, topic: str, event: Any) -> None:
        for callback in list(self.callbacks.get(topic, [])):
            with suppress(Exception):
                callback(event)


class _Fails(_Service):
    def publish(self, topic: str, event: Any) -> None:
        for callback in list(self.callbacks.get(topic, [])):
            callback(event)


class _StopsAtTheFirst(_Service):
    def publish(self, topic: str, event: Any) -> None:
        with suppress(Exception):
            for callback in list(self.callbacks.get(topic, [])):
                callback(event)


class _Skips(_Service):
    def publish(self, topic: str, event: Any) -> None:
        for callback in self.callbacks.get(topic, []):
            with suppress(Exception):
                callback(event)


class _Backwards(_Service):
    def subscribe(self, topic: str, callback: Any) -> None:
        self.callbacks.setdefault(topic, []).insert(0, callback)


class _OneTopic(_Service):
    def subscribe(self, topic: str, callback: Any) -> None:
        super().subscribe("", callback)

    def publish(self, topic: str, event: Any) -> None:
        super().publish("", event)


class _Deaf(_Service):
    def unsubscribe(self, topic: str, callback: Any) -> None:
        self.callbacks[topic] = [*self.callbacks[topic], callback][:-1]


class _UnknownTopic(_Service):
    def publish(self, topic: str, event: Any) -> None:
        for callback in list(self.callbacks[topic]):
            with suppress(Exception):
                callback(event)


# ---- start_history: the last few ----


def _history(*, limit: bool = True, to_all: bool = False, backwards: bool = False) -> Callable[[], Any]:
    def start(graph: Graph, size: int) -> None:
        node = graph.node("history")
        text = message_class("std_msgs/String")
        kept: deque[Any] = deque(maxlen=size if limit else None)

        def newcomer(name: str) -> None:
            for message in list(kept)[:: -1 if backwards else 1]:
                if to_all:
                    history.publish(message)
                else:
                    history.publish_to(name, message)

        history = node.publisher("history", text, queue_size=None, on_connect=newcomer)
        node.subscriber("news", text, kept.append)

    return lambda: start


def _latched(graph: Graph, _: int) -> None:
    node = graph.node("history")
    text = message_class("std_msgs/String")
    history = node.publisher("history", text, latch=True)
    node.subscriber("news", text, history.publish)


# ---- start_alarm: say it once ----


def _alarm(passes: Callable[[float | None, float, float], bool], name: str = "alarm") -> Callable[[], Any]:
    def start(graph: Graph, limit: float) -> None:
        node = graph.node(name)
        number = message_class("std_msgs/Float32")
        alarm = node.publisher("alarm", number, queue_size=10)
        before: list[float | None] = [None]

        def judge(message: Any) -> None:
            if passes(before[0], message.data, limit):
                alarm.publish(message)
            before[0] = message.data

        node.subscriber("temperature", number, judge)

    return lambda: start


def _only_once(graph: Graph, limit: float) -> None:
    said: list[bool] = []

    def once(before: float | None, now: float, limit: float) -> bool:
        new = now > limit and (before is None or before <= limit) and not said
        if new:
            said.append(True)
        return new

    _alarm(once)()(graph, limit)


MISTAKES = {
    "better_service": [
        lambda: _Fails,
        lambda: _StopsAtTheFirst,
        lambda: _Skips,
        lambda: _Backwards,
        lambda: _OneTopic,
        lambda: _Deaf,
        lambda: _UnknownTopic,
    ],
    "arrived": [
        lambda: list(range(1, 11)),
        lambda: [1, 2, 3, 4],
        lambda: [1, 4, 7, 10],
        lambda: [2, 5, 8, 9, 10],
        lambda: [1, 2, 5, 8],
        lambda: [1, 8, 9, 10],
    ],
    "start_history": [
        _history(limit=False),
        _history(to_all=True),
        _history(backwards=True),
        lambda: _latched,
        lambda: lambda graph, _: graph.node("history"),
    ],
    "start_alarm": [
        _alarm(lambda _, now, limit: now > limit),
        _alarm(lambda before, now, limit: before is not None and now > limit >= before),
        _alarm(lambda before, now, limit: now >= limit and (before is None or before < limit)),
        _alarm(lambda before, now, limit: now > limit and (before is None or before < limit)),
        _alarm(lambda before, now, limit: now <= limit and before is not None and before > limit),
        _alarm(lambda before, now, limit: now > limit and (before is None or before <= limit), name="filter"),
        _alarm(lambda before, now, _: now > 30 and (before is None or before <= 30)),
        lambda: _only_once,
    ],
}
