"""Wrong answers to the exercises of the chapter Publish and subscribe: right ones with a fault put in."""

from __future__ import annotations

from contextlib import suppress
from typing import TYPE_CHECKING, Any

from rosmini.book.checks import Script

from .published import solution

if TYPE_CHECKING:
    from collections.abc import Callable

HISTORY = solution("publish_subscribe", "history")

ALARM = solution("publish_subscribe", "alarm")


def wrong(name: str, right: str, old: str, new: str) -> Callable[[], Script]:
    """Return what makes a script with one place of it changed."""
    assert old in right
    return lambda: Script(name, right.replace(old, new))


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


MISTAKES = {
    "history": [
        wrong("history.py", HISTORY, "maxlen=3", "maxlen=4"),
        wrong("history.py", HISTORY, "maxlen=3", "maxlen=1"),
        wrong("history.py", HISTORY, "list(orders)", "reversed(orders)"),
        wrong("history.py", HISTORY, "publish_to_peer(order)", "publish(order)"),
        wrong("history.py", HISTORY, "Newcomers(), ", "latch=True, "),
        wrong("history.py", HISTORY, '"order"', '"orders"'),
        wrong("history.py", HISTORY, "orders.append)", "print)"),
        wrong("history.py", HISTORY, 'init_node("history")', 'init_node("memory")'),
    ],
    "alarm": [
        wrong("alarm.py", ALARM, "is_near and not was_near", "is_near"),
        wrong("alarm.py", ALARM, "is_near and not was_near", "was_near and not is_near"),
        wrong("alarm.py", ALARM, "< 1.0", "< 0.5"),
        wrong("alarm.py", ALARM, "< 1.0", "> 1.0"),
        wrong("alarm.py", ALARM, "    was_near = is_near", "    was_near = was_near or is_near"),
        wrong("alarm.py", ALARM, "ranges[0] < 1.0", "range[0] < 1.0"),
        wrong("alarm.py", ALARM, '"alarm", Float32', '"alarms", Float32'),
    ],
    "better_service": [
        lambda: _Fails,
        lambda: _StopsAtTheFirst,
        lambda: _Skips,
        lambda: _Backwards,
        lambda: _OneTopic,
        lambda: _Deaf,
        lambda: _UnknownTopic,
    ],
}
