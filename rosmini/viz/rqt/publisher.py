"""`rqt_publisher`: publish messages computed from expressions (http://wiki.ros.org/rqt_publisher)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from rosmini.core.errors import RosminiError, nearest
from rosmini.core.graph import Graph
from rosmini.core.graph.clock import Timer
from rosmini.core.names import resolve
from rosmini.ros.introspection.fields import class_of
from rosmini.ros.introspection.topics import types
from rosmini.ros.introspection.types import MESSAGE
from rosmini.viz.view import ViewError
from rosmini.viz.words import plural

from .fields import Fields
from .panel import Panel, bar
from .parts import Box, Control, Part
from .perspective import literal

FASTEST_HZ = 1000.0


class Publication:
    """A topic of a publisher panel; ``fields`` contains an expression for each field of its messages."""

    def __init__(self, panel: MessagePublisher, topic: str, kind: str, rate: float) -> None:
        self.topic, self.type = topic, kind
        self.rate = rate
        """Rate [Hz]; 0: only on request."""
        self.count = 0
        """Number of published messages."""
        self.fields = Fields(class_of(kind))
        self.problem = ""
        self._panel = panel
        self._publisher = panel.node.publisher(topic, self.fields.cls, queue_size=100)
        self._timer: Timer | None = None

    @property
    def enabled(self) -> bool:
        """True if it publishes at its rate."""
        return self._timer is not None

    def fill(self, field: str, expression: str) -> None:
        """Give a field an expression, such as ``0.5 * sin(i / 10)``. Raises ``ViewError``."""
        self.fields.fill(field, expression)
        self.problem = ""

    def enable(self, on: bool = True) -> None:
        """Start or stop publishing at the rate."""
        if self._timer is not None:
            self._timer.shutdown()
            self._timer = None
        if on and self.rate > 0:
            self._timer = self._panel.node.timer(1 / self.rate, self._tick)
        elif on:
            raise ViewError(f"{self.topic} has the rate 0: publish() sends one message; give it a rate first")

    def set_rate(self, hz: float) -> None:
        """Change the rate [Hz]. Raises ``ViewError`` unless it is from 0 to 1000."""
        self.rate = checked_rate(hz)
        if self.enabled:
            self.enable(self.rate > 0)

    def publish(self) -> Any:
        """Publish one message, and return it. Raises ``ViewError``."""
        message = self.fields.message(self.count)
        self._publisher.publish(message)
        self.count += 1
        return message

    def close(self) -> None:
        """Stop publishing and unregister."""
        self.enable(False)
        self._publisher.unregister()

    def _tick(self, _event: object) -> None:
        try:
            self.publish()
        except RosminiError as error:  # 1 / i has no value at first
            self.problem = str(error)
            self.enable(False)


class MessagePublisher(Panel):
    """Publish on any number of topics, each at a rate, with an expression for each field; ``i`` counts the messages.

    >>> from rosmini import Graph
    >>> from rosmini.msgs.std_msgs.msg import Float64
    >>> graph = Graph()
    >>> heard = []
    >>> _ = graph.node("listener").subscriber("wave", Float64, lambda message: heard.append(message.data))
    >>> publisher = MessagePublisher(graph)
    >>> wave = publisher.add("/wave", "std_msgs/Float64", rate=10)
    >>> wave.fill("data", "2 * i")
    >>> wave.enable()
    >>> _ = graph.run(0.35)
    >>> heard
    [0.0, 2.0, 4.0]

    Args:
        graph: the graph.
        name: name of the panel's node.

    """

    tool, heading, plugin = "rqt_publisher", "Message Publisher", "rqt_publisher/Publisher"
    group, summary = "Topics", "publish on topics, from a form"
    instead = "rostopic pub -r 10 /cmd_vel geometry_msgs/Twist '{linear: {x: 0.2}}'"

    def __init__(self, graph: Graph, *, name: str | None = None) -> None:
        super().__init__(graph, name=name)
        self.publications: dict[int, Publication] = {}
        """The topics by number, in insertion order."""
        self._next: dict[str, Any] = {"topic": "/cmd_vel", "type": "geometry_msgs/Twist", "rate": 1.0}
        self._numbered = 0

    def add(self, topic: str, type: str = "", rate: float = 1.0) -> Publication:
        """Add a topic; its type may be left out if the Master knows it. It does not publish until it is enabled.

        Raises ``ViewError`` for a type that no package here defines and an impossible rate, ``IllegalName``.
        """
        self._require()
        topic = resolve(topic, "/")
        kind = type or dict(types(self.graph)).get(topic, "")
        if not kind:
            raise ViewError(f"the type of {topic} is unknown: give one, such as std_msgs/String")
        if class_of(kind) is None:
            hint = nearest(kind, MESSAGE.all()) or "`rosmsg list` lists those that there are"
            raise ViewError(f"no package here defines {kind!r:.80}; {hint}")
        made = Publication(self, topic, kind, checked_rate(rate))
        self._numbered += 1
        self.publications[self._numbered] = made
        return made

    def remove(self, number: int) -> None:
        """Remove a topic. Raises ``ViewError`` for an unknown number."""
        self._publication(number).close()
        del self.publications[number]

    def _publication(self, number: int) -> Publication:
        if number not in self.publications:
            raise ViewError(f"no topic has the number {number}; there are {[*self.publications]}")
        return self.publications[number]

    def parts(self) -> Sequence[Part]:
        """Controls to add a topic, and a box for each topic."""
        new = self._next
        known = dict(types(self.graph))
        kind = known.get(new["topic"], new["type"])
        adding = bar(
            Control("topic", "Topic", "text", new["topic"]),
            Control("type", "Type", "text", kind),
            Control("rate", "Rate [Hz]", "number", new["rate"], minimum=0.0, maximum=FASTEST_HZ),
            Control("add", "Add", "button"),
        )
        return [adding, *(self._box(number, each) for number, each in self.publications.items())]

    def _box(self, number: int, each: Publication) -> Box:
        rate = Control(f"{number}/rate", f"rate of {each.topic} [Hz]", "number", each.rate, minimum=0.0,
                       maximum=FASTEST_HZ, problem=each.problem)  # fmt: skip
        buttons = bar(
            Control(f"{number}/on", f"publish {each.topic}", "check", each.enabled),
            rate,
            Control(f"{number}/once", "Publish once", "button"),
            plural(each.count, "message"),
        )
        title = f"{each.topic} [{each.type}]"
        close = Control(f"{number}/remove", "Remove", "button")
        return Box(title, (buttons, each.fields.table(f"{number}/field")), close)

    def settings(self) -> dict[str, Any]:
        """Return the topics in rqt_publisher's form: the text of a list."""
        kept = [
            {
                "topic_name": each.topic,
                "type_name": each.type,
                "rate": each.rate,
                "enabled": each.enabled,
                "expressions": {f"{each.topic}/{path}": text for path, text in each.fields.given.items()},
            }
            for each in self.publications.values()
        ]
        return {"publishers": repr(kept)}

    def restore(self, settings: dict[str, Any]) -> None:
        """Add the topics of a perspective."""
        for kept in literal(settings.get("publishers")) or ():
            each = self.add(str(kept["topic_name"]), str(kept["type_name"]), float(kept["rate"]))
            for path, text in kept.get("expressions", {}).items():
                each.fill(str(path).removeprefix(f"{each.topic}/"), str(text))
            if kept.get("enabled") and each.rate:
                each.enable()

    def _operate(self, key: Sequence[str], value: Any) -> None:
        if key[0] == "add":
            known = dict(types(self.graph))
            self.add(self._next["topic"], known.get(self._next["topic"], self._next["type"]), self._next["rate"])
        elif len(key) == 1:
            self._next[key[0]] = value
        else:
            self._operate_row(int(key[0]), key[1:], value)

    def _operate_row(self, number: int, key: Sequence[str], value: Any) -> None:
        each = self._publication(number)
        match key[0]:
            case "on":
                each.enable(value)
            case "rate":
                each.set_rate(value)
            case "once":
                each.publish()
            case "remove":
                self.remove(number)
            case _:
                each.fill("/".join(key[1:]), value)


def checked_rate(hz: float) -> float:
    """Return a rate [Hz]. Raises ``ViewError`` unless it is from 0 to 1000."""
    if not 0 <= hz <= FASTEST_HZ:
        raise ViewError(f"a rate is from 0 to {FASTEST_HZ:g} Hz, not {hz!r:.40}")
    return float(hz)
