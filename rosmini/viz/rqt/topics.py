"""`rqt_topic`: the topics of a graph with their types, bandwidths, rates and values (http://wiki.ros.org/rqt_topic)."""

from __future__ import annotations

from io import BytesIO
from typing import TYPE_CHECKING, Any

from rosmini.introspection.fields import class_of
from rosmini.introspection.rates import Arrivals, Sizes
from rosmini.introspection.topics import types
from rosmini.msgs.message import Message
from rosmini.viz.rqt.listening import listen
from rosmini.viz.rqt.table import Table
from rosmini.viz.words import plural

if TYPE_CHECKING:
    from collections.abc import Collection, Iterator

    from rosmini.graph import Graph

COLUMNS = ("Topic", "Type", "Bandwidth", "Hz", "Value")
LONGEST = 60
"""How many characters of a value are shown."""
MOST_ELEMENTS = 5
"""How many elements of an array of messages are shown."""
WINDOW = 10_000


def rqt_topic(
    graph: Graph, *, expand: Collection[str] = (), duration: float = 2.0, title: str = "rqt_topic"
) -> Table:
    """Listen to all topics for ``duration`` seconds of graph time, and show what came.

    Args:
        graph: the graph, which runs meanwhile.
        expand: topics whose fields are shown with their last values.
        duration: how long to listen [s].
        title: the caption.

    Raises:
        ViewError: the duration is not positive.

    """
    known = {name: kind for name, kind in sorted(types(graph)) if class_of(kind) is not None}
    sizes = {name: Sizes(WINDOW) for name in known}
    arrivals = {name: Arrivals(-1) for name in known}
    last: dict[str, Any] = {}

    def subscribe(node: Any) -> None:
        for name, kind in known.items():
            node.subscriber(name, class_of(kind), hearer(name), numpy=False)

    def hearer(name: str) -> Any:
        def hear(message: Any) -> None:
            now = graph.now().to_nsec()
            message.serialize(written := BytesIO())
            sizes[name].heard(now / 1e9, len(written.getvalue()))
            arrivals[name].heard(now)
            last[name] = message

        return hear

    end = listen(graph, "rqt_topic", duration, subscribe) + duration
    rows: list[tuple[str, ...]] = []
    for name, kind in known.items():
        weight, rate = sizes[name].weight(end), arrivals[name].statistics()
        rows.append(
            (name, kind, f"{_bytes(weight.rate)}/s" if weight else "unknown", f"{rate.rate:.2f}" if rate else "unknown",
             "" if name in last else "not heard"),
        )  # fmt: skip
        if name in expand and name in last:
            rows += [
                ("  " * depth + field, kind, "", "", value)
                for depth, field, kind, value in _fields(last[name])
            ]
    return Table(COLUMNS, rows, title=title, noun="topic")


def _bytes(count: float) -> str:
    for unit in ("B", "KB"):
        if count < 1000:
            return f"{count:.2f}{unit}"
        count /= 1000
    return f"{count:.2f}MB"


def _fields(message: Any, depth: int = 1) -> Iterator[tuple[int, str, str, str]]:
    """Yield depth, name, type and value of every field; of a message that is a field, its own are below it."""
    for name, kind in zip(message.__slots__, message._slot_types, strict=True):
        value = getattr(message, name)
        if isinstance(value, Message):
            yield depth, name, kind, ""
            yield from _fields(value, depth + 1)
        elif isinstance(value, list | tuple) and value and isinstance(value[0], Message):
            yield depth, name, kind, plural(len(value), "element")
            for number, one in enumerate(value[:MOST_ELEMENTS]):
                yield depth + 1, f"[{number}]", kind.partition("[")[0], ""
                yield from _fields(one, depth + 2)
        else:
            yield depth, name, kind, value_text(value)


def value_text(value: Any) -> str:
    """Return the value of a field in one short line."""
    if hasattr(value, "to_sec"):
        return f"{value.to_sec():.3f}"
    if isinstance(value, float):
        return f"{value:.4g}"
    if isinstance(value, list | tuple | bytes) and len(value) > MOST_ELEMENTS:
        head = ", ".join(value_text(one) for one in value[:MOST_ELEMENTS])
        return f"({head}, ...), {len(value)} elements"
    text = repr(value) if isinstance(value, str | bytes) else str(value)
    return text if len(text) <= LONGEST else f"{text[: LONGEST - 3]}..."
