"""Drawings of concepts, boxes and arrows at fixed places: the publish/subscribe pattern."""

from __future__ import annotations

from collections.abc import Iterable

from rosmini.viz import style
from rosmini.viz.graph_drawing import arrow, box, drawing, rule, text
from rosmini.viz.layout import Layout, Rect, Route
from rosmini.viz.layout.model import Point
from rosmini.viz.svg import element

SERVICE = Rect(210.0, 0.0, 190.0, 210.0)
STORE = Rect(228.0, 142.0, 154.0, 50.0)
PUBLISHERS = (Rect(0.0, 20.0, 110.0, 46.0), Rect(0.0, 144.0, 110.0, 46.0))
SUBSCRIBERS = (Rect(500.0, 20.0, 110.0, 46.0), Rect(500.0, 144.0, 110.0, 46.0))
COLOURS = ["ink", "line", "label", "node-fill", "node-line", "topic-fill", "topic-line", "group-fill", "group-line"]
ALT = (
    "Two publishers at the left, an event service in the middle that stores subscriptions, and two subscribers at the "
    "right. Publishers call publish() of the service. Subscribers call subscribe() and unsubscribe() of the service. "
    "The service calls notify() of the subscribers. No arrow joins a publisher and a subscriber."
)


def publish_subscribe() -> str:
    """Draw the pattern (Eugster and others, 2003)."""
    parts = [named_box(rect, "Publisher", "node") for rect in PUBLISHERS]
    parts += [named_box(rect, "Subscriber", "node") for rect in SUBSCRIBERS]
    parts += [named_box(SERVICE, "Event service", "topic", 28.0), named_box(STORE, "subscriptions", "group")]
    for rect in PUBLISHERS:
        parts.append(_call(rect.right, SERVICE.x, rect.centre[1], "publish()"))
    for rect in SUBSCRIBERS:
        y = rect.centre[1]
        parts.append(_call(SERVICE.right, rect.x, y - 13, "notify()"))
        parts.append(_call(rect.x, SERVICE.right, y + 13, "subscribe()", below=True))
    title = "The publish/subscribe pattern"
    layout = Layout(SUBSCRIBERS[0].right, SERVICE.height)
    return diagram(parts, layout, title, ALT)


def diagram(parts: Iterable[str], layout: Layout, title: str, alt: str) -> str:
    """Return the drawing of boxes and arrows."""
    css = "".join(
        rule(f".ps-{kind} rect", fill=f"{kind}-fill", stroke=f"{kind}-line") for kind in ("node", "topic", "group")
    )
    css += rule(".ps-call path:first-of-type", stroke="line") + rule(".ps-call path:last-of-type", fill="line")
    css += rule(".ps-call text", fill="label") + rule(".ps-name", fill="ink")
    return drawing(parts, layout, title=title, alt=alt, css=css, colours=COLOURS)


def named_box(rect: Rect, words: str, kind: str, down: float | None = None) -> str:
    """Return a box with its name in the middle, or `down` from its top."""
    x, y = rect.centre
    name = text(words, x, y + 4.5 if down is None else rect.y + down, kind="ps-name")
    return element("g", box(rect, kind, 6.0) + name, class_=f"ps-{kind}")


def _call(start: float, end: float, y: float, words: str, *, below: bool = False) -> str:
    """Return a horizontal arrow with a label above or below."""
    return straight((start, y), (end, y), words, ((start + end) / 2, y + (15 if below else -6)))


def straight(start: Point, end: Point, words: str = "", place: Point = (0.0, 0.0), anchor: str = "middle") -> str:
    """Return a straight arrow with a label at `place`."""
    (x, y), (x2, y2) = start, end
    dx, dy = (x2 - x) / 3, (y2 - y) / 3
    route = Route(((x, y), (x + dx, y + dy), (x2 - dx, y2 - dy), (x2, y2)))
    label = text(words, *place, size=style.LABEL_SIZE, colour="label", anchor=anchor) if words else ""
    return element("g", arrow(route) + label, class_="ps-call")
