"""`rqt_bag`: the messages of a bag over time, a row for each topic (http://wiki.ros.org/rqt_bag)."""

from __future__ import annotations

import os
from collections.abc import Collection, Sequence
from dataclasses import dataclass
from itertools import pairwise
from optparse import Values
from typing import Any

from rosmini.core.graph import Graph
from rosmini.core.verbs import Call
from rosmini.ros.bag import Bag
from rosmini.viz.figures import WIDTH, say, step_of, ticks
from rosmini.viz.metrics import text_width
from rosmini.viz.rounding import fixed
from rosmini.viz.style import LABEL_SIZE, TEXT_SIZE, variable
from rosmini.viz.svg import document, element, escape, number
from rosmini.viz.view import Picture, View, ViewError
from rosmini.viz.words import plural

from .panel import Panel, bar
from .parts import Control, Drawing, Part, Words, drawn

KIND = "rosmini-bag"
ROW, BAR = 34.0, 14.0
"""Height of a row, and of the messages in it [px]."""
MARGIN, SPACE = 12.0, 14.0
MERGED = 3.0
"""Messages at most this far apart are drawn as one bar [px]."""
TICK = 1.6
"""Minimum width of a message [px]."""
NARROWEST = 200.0
SHOWN_GAPS = 3
"""Number of gaps of a topic that the text names; the picture shows all."""
COLOURS = ["ink", "muted", "group-fill", "group-line", "node-fill", "node-line", "bad-fill", "bad-line"]


@dataclass(frozen=True)
class Row:
    """A topic: its type, the times of its messages, and the gaps between them [s from the start of the bag]."""

    topic: str
    type: str
    times: tuple[float, ...]
    gaps: tuple[tuple[float, float], ...]

    @property
    def rate(self) -> float | None:
        """Average rate of the messages [Hz]; the median would mislead if messages come in bursts."""
        if len(self.times) < 3 or self.times[-1] <= self.times[0]:
            return None
        return (len(self.times) - 1) / (self.times[-1] - self.times[0])

    def text(self) -> str:
        """Return the number, rate, times and gaps of the messages."""
        if not self.times:
            return f"{self.topic} [{self.type}]: no messages"
        rate = "" if self.rate is None else f", {fixed(self.rate, 1)} Hz on average"
        span = f"{fixed(self.times[0], 1)} s"
        if len(self.times) > 1:
            span += f" to {fixed(self.times[-1], 1)} s"
        ranked = sorted(self.gaps, key=lambda gap: gap[0] - gap[1])
        named = sorted(ranked[:SHOWN_GAPS])
        listed = ", ".join(f"{fixed(start, 1)} to {fixed(end, 1)} s" for start, end in named)
        more = f" and {len(self.gaps) - SHOWN_GAPS} more" if len(self.gaps) > SHOWN_GAPS else ""
        gaps = f"; {plural(len(self.gaps), 'gap')}: {listed}{more}" if self.gaps else ""
        return f"{self.topic} [{self.type}]: {plural(len(self.times), 'message')}{rate}, {span}{gaps}"


def rqt_bag(
    source: Bag | str | os.PathLike[str],
    *,
    topics: Collection[str] | None = None,
    gap: float = 3.0,
    title: str | None = None,
    width: float = WIDTH,
) -> Picture:
    """Draw when the messages of a bag were recorded: a row for each topic, a mark for each message, gaps framed.

    Args:
        source: a bag, or its path.
        topics: topics to draw; by default all.
        gap: a time without a message is a gap if it is longer than this factor times the usual period
            and longer than a hundredth of the bag.
        title: a caption under the picture, and the first words of its text form.
        width: width of the picture [CSS px].

    Raises:
        ViewError: there is nothing to draw, or `gap` is not above 1.
        ROSBagException: the bag cannot be read, or has no such topic.

    """
    if not gap > 1:
        raise ViewError(f"gap must be above 1, since it is how many usual periods, not {gap}")
    if not isinstance(source, Bag):
        with Bag(source) as bag:
            return rqt_bag(bag, topics=topics, gap=gap, title=title, width=width)
    rows, duration = _rows(source, topics, gap)
    count = sum(len(row.times) for row in rows)
    name = title or "rqt_bag"
    text = "\n".join(
        [f"{name}: {plural(count, 'message')} of {plural(len(rows), 'topic')} in {fixed(duration, 1)} s"]
        + [row.text() for row in rows]
    )
    said = "; ".join(row.text() for row in rows[:6]) + (" and more" if len(rows) > 6 else "")
    alt = f"Timeline of a bag, {fixed(duration, 1)} s long, with a row for each topic: {said}."
    return Picture(_draw(rows, duration, width, name, alt), text=text, alt=alt, caption=title)


def _rows(bag: Bag, topics: Collection[str] | None, gap: float) -> tuple[list[Row], float]:
    names = sorted({conn.topic for conn in bag.connections()})
    for topic in topics or ():
        if topic not in names:
            raise bag.no_topic(topic)
    index, reader = bag.index, bag.reader()
    if index.start is None or index.end is None:
        raise ViewError("this bag contains no message to draw")
    duration = (index.end - index.start) / 1e9
    rows = []
    for topic in names:
        if topics is not None and topic not in topics:
            continue
        here = bag.connections(topic)
        stamps = sorted(stamp for conn in here for stamp in reader.times(conn.id))
        times = tuple((stamp - index.start) / 1e9 for stamp in stamps)
        rows.append(Row(topic, here[0].type, times, gaps(times, gap, duration / 100)))
    return rows, duration


def gaps(times: Sequence[float], factor: float, least: float = 0.0) -> tuple[tuple[float, float], ...]:
    """Return the gaps longer than `factor` usual periods and `least` [s]; fewer than four messages have none.

    The usual period is the third quartile: of messages in bursts, the time from burst to burst.
    """
    if len(times) < 4:
        return ()
    periods = sorted(after - before for before, after in pairwise(times))
    longest = max(least, factor * periods[int(0.75 * (len(periods) - 1))]) + 1e-9
    return tuple((before, after) for before, after in pairwise(times) if longest < after - before)


def bars(places: Sequence[float]) -> list[tuple[float, float]]:
    """Return the bars (left, right) of messages at sorted `places` [px]; messages close together share one."""
    found: list[tuple[float, float]] = []
    for place in places:
        left, right = place - TICK / 2, place + TICK / 2
        if found and left - found[-1][1] <= MERGED:
            found[-1] = (found[-1][0], right)
        else:
            found.append((left, right))
    return found


def _draw(rows: list[Row], duration: float, width: float, title: str, alt: str) -> str:
    labels = max(max(text_width(row.topic, TEXT_SIZE), text_width(row.type, LABEL_SIZE)) for row in rows)
    figures = [(_count(row), _rate(row)) for row in rows]
    counts = max(text_width(part, LABEL_SIZE) for pair in figures for part in pair)
    left = MARGIN + labels + SPACE
    room = max(NARROWEST, width - left - SPACE - counts - MARGIN)
    width = left + room + SPACE + counts + MARGIN
    scale = room / (duration or 1.0)
    bottom = MARGIN + ROW * len(rows)
    parts = [_axis(left, bottom, room, scale, duration)]
    for number_, (row, pair) in enumerate(zip(rows, figures, strict=True)):
        parts.append(_row(row, pair, MARGIN + ROW * number_, left, room, scale))
    height = bottom + 40.0
    css = "".join(
        f".{KIND} .{name}{{{rules}}}"
        for name, rules in (
            ("t", f"fill:{variable('ink')};font-size:{TEXT_SIZE:g}px"),
            ("s", f"fill:{variable('muted')};font-size:{LABEL_SIZE:g}px"),
            ("g", f"stroke:{variable('group-line')};stroke-opacity:.4;fill:none"),
            ("r", f"fill:{variable('group-fill')}"),
            ("m", f"fill:{variable('node-line')}"),
            ("x", f"fill:{variable('bad-fill')};stroke:{variable('bad-line')};stroke-dasharray:3 2"),
        )
    )
    return document(
        "".join(parts), width=width, height=height, title=title, alt=alt, css=css, colours=COLOURS, kind=KIND
    )


def _count(row: Row) -> str:
    return f"{len(row.times):,}"


def _rate(row: Row) -> str:
    return "" if row.rate is None else f"{fixed(row.rate, 1)} Hz"


def _text(words: str, x: float, y: float, kind: str, anchor: str | None = None) -> str:
    return element("text", escape(words), class_=kind, x=x, y=y, text_anchor=anchor)


def _axis(left: float, bottom: float, room: float, scale: float, duration: float) -> str:
    if duration <= 0:
        return _text("all at one time", left, bottom + 20, "s")
    values = ticks(0.0, duration, step_of(duration, max(2, int(room / 70))))
    parts = []
    for value, label in zip(values, say(values), strict=True):
        x = left + value * scale
        parts.append(element("path", class_="g", d=f"M{number(x)},{number(MARGIN)}V{number(bottom + 4)}"))
        parts.append(_text(label, x, bottom + 18, "s", "middle"))
    parts.append(_text("time since the start of the bag (s)", left + room / 2, bottom + 34, "s", "middle"))
    return "".join(parts)


def _row(row: Row, figures: tuple[str, str], top: float, left: float, room: float, scale: float) -> str:
    middle = top + ROW / 2
    high = middle - BAR / 2
    parts = [
        _text(row.topic, MARGIN, middle - 2, "t"),
        _text(row.type, MARGIN, middle + 12, "s"),
        element("rect", class_="r", x=left, y=high, width=room, height=BAR),
    ]
    for start, end in row.gaps:
        x, wide = left + start * scale, (end - start) * scale
        if wide >= MERGED:
            parts.append(element("rect", class_="x", x=x, y=high, width=wide, height=BAR))
    shapes = [
        f"M{number(a)},{number(high)}H{number(b)}V{number(high + BAR)}H{number(a)}Z"
        for a, b in bars([left + time * scale for time in row.times])
    ]
    if shapes:
        parts.append(element("path", class_="m", d="".join(shapes)))
    right = left + room + SPACE
    count, rate = figures
    parts.append(_text(count, right, middle - 2 if rate else middle + 4, "t"))
    if rate:
        parts.append(_text(rate, right, middle + 12, "s"))
    return "".join(parts)


class BagTimeline(Panel):
    """The times of the messages in a bag: a row for each topic.

    Args:
        graph: the graph.
        path: bag shown at first.
        name: name of the panel's node.

    Raises:
        ViewError: the file cannot be opened, or contains no message.
        ROSBagException: the file is not a bag.

    """

    tool, heading, plugin = "rqt_bag", "Bag", "rqt_bag/Bag"
    group, summary = "Logging", "the messages of a bag over time"
    usage, example = "FILE", "house.bag"

    def __init__(self, graph: Graph, path: str = "", *, name: str | None = None) -> None:
        super().__init__(graph, name=name)
        self.path = ""
        self._bag: Drawing | None = None
        if path:
            self.load(path)

    @classmethod
    def arguments(cls, given: Values) -> tuple[list[str], dict[str, Any]]:
        """Return the file."""
        return given.words, {}

    @classmethod
    def still(cls, given: Values, call: Call) -> View:
        """Draw the bag."""
        del call
        return rqt_bag(given.words[0], title=given.title)

    def load(self, path: str) -> None:
        """Show another bag. Raises ``ViewError``, ``ROSBagException``."""
        try:
            self._bag = drawn(rqt_bag(path))
        except OSError as error:
            raise ViewError(f"{path} cannot be opened: {error.strerror}") from error
        self.path = path

    def parts(self) -> Sequence[Part]:
        """The file name, and a row for each topic."""
        shown = self._bag or Words("name a file: it is read when you have typed it")
        return [bar(Control("file", "File", "text", self.path)), shown]

    def _operate(self, _key: Sequence[str], value: Any) -> None:
        self.load(value)

    def settings(self) -> dict[str, Any]:
        """Return the file name."""
        return {"path": self.path}

    def restore(self, settings: dict[str, Any]) -> None:
        """Show the file of a perspective."""
        if settings.get("path"):
            self.load(str(settings["path"]))
