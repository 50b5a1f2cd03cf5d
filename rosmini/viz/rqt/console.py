"""`rqt_console`: log messages as a table, with the filters of the real tool (http://wiki.ros.org/rqt_console)."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterable, Sequence
from itertools import zip_longest
from optparse import Values
from typing import Any, Literal, get_args

from rosmini.core.errors import nearest
from rosmini.core.graph import Graph
from rosmini.core.graph.observers.console import Console
from rosmini.core.graph.rosout import LEVELS, NAMES
from rosmini.core.verbs import Parser
from rosmini.viz.rqt.selection import matches
from rosmini.viz.view import ViewError
from rosmini.viz.words import plural

from .panel import Panel, bar
from .parts import Control, Part, Row, Rows, Words, cell_text
from .table import Table

Column = Literal["stamp", "severity", "node", "message", "location", "topics"]
COLUMNS: tuple[Column, ...] = ("stamp", "severity", "node", "message", "location")

ALT_MESSAGES = 3
"""Number of messages that the alt text contains."""


def rqt_console(
    source: object,
    *,
    level: str | Collection[str] = "DEBUG",
    node: str = "/",
    text: str = "",
    exclude: str = "",
    highlight: str = "",
    regex: bool = False,
    topic: str = "/",
    location: str = "",
    start: Any = None,
    end: Any = None,
    columns: Sequence[Column] = COLUMNS,
    limit: int | None = None,
    title: str | None = None,
) -> LogTable:
    """Show log messages as rqt_console does, the oldest first.

    Args:
        source: the console of ``graph.console()``, or messages of the type ``rosgraph_msgs/Log``.
        level: the lowest level to show ("WARN"), or a collection of the levels to show.
        node: filter for nodes: names or regular expressions with commas between, `-` excludes. "/" is all.
        text: show only messages that contain this.
        exclude: hide messages that contain this.
        highlight: mark messages that contain this.
        regex: the three above are regular expressions; otherwise they ignore case.
        topic: filter for the topics that the message's node publishes, in the form of `node`.
        location: show only messages whose `file:line function` contains this; outside functions it is `file:line`.
        start: show nothing earlier, in seconds of the messages' time, or as a `rosmini.Time`.
        end: show nothing later.
        columns: the columns, in order.
        limit: show the newest `limit` messages that pass the filters.
        title: a caption under the table, and the first words of its text form.

    Raises:
        ViewError: the source has no log messages, or a level, a column or a pattern is not known.

    """
    messages = _messages(source)
    levels = _levels(level)
    for column in columns:
        _check(column, get_args(Column), "column")
    wanted, unwanted, marked = (_matcher(pattern, regex) for pattern in (text, exclude, highlight))
    rows = [
        message
        for message in messages
        if message.level in levels
        and matches(message.name, node)
        and (not text or wanted(message.msg))
        and not (exclude and unwanted(message.msg))
        and (topic in ("", "/") or any(matches(name, topic) for name in message.topics))
        and location in location_of(message)
        and (start is None or message.header.stamp.to_sec() >= _seconds(start))
        and (end is None or message.header.stamp.to_sec() <= _seconds(end))
    ]
    marks = [bool(highlight) and marked(message.msg) for message in rows]
    if limit is not None:
        rows, marks = rows[max(0, len(rows) - limit) :], marks[max(0, len(rows) - limit) :]
    return LogTable(rows, marks, columns, total=len(messages), title=title)


class LogTable(Table):
    """A table of the log messages that pass the filters, out of `total`."""

    def __init__(
        self,
        messages: Sequence[Any],
        marks: Sequence[bool],
        columns: Sequence[Column],
        *,
        total: int,
        title: str | None,
    ) -> None:
        rows = tuple(
            Row(tuple(_cell(message, column) for column in columns), level=NAMES[message.level], is_marked=is_marked)
            for message, is_marked in zip(messages, marks, strict=True)
        )
        titles = tuple(column.capitalize() for column in columns)
        part = Rows(titles, rows, "Log messages", "no message passes the filters")
        super().__init__(part, title=title or "", noun="message")
        self.messages = list(messages)
        self.total = total

    @property
    def counted(self) -> str:
        """Number of messages shown, and number of all."""
        if len(self) == self.total:
            return plural(self.total, "message")
        return f"{len(self)} of {plural(self.total, 'message')}"

    @property
    def caption(self) -> str:
        """The title, if given, and the count."""
        return super().caption if self.title else self.counted

    @property
    def text(self) -> str:
        """A line with the count, then the lines of each message; `*` marks highlighted messages."""
        cells = [[cell_text(cell).split("\n") for cell in row.cells] for row in self.part.rows]
        widths = [max(len(line) for cell in column for line in cell) for column in zip(*cells, strict=True)]
        lines = [f"{self.title or 'rqt_console'}: {self.counted}"]
        for row, parts in zip(self.part.rows, cells, strict=True):
            for number, shown in enumerate(zip_longest(*parts, fillvalue="")):
                joined = "  ".join(cell.ljust(width) for cell, width in zip(shown, widths, strict=True))
                lines.append(f"{'*' if row.is_marked and number == 0 else ' '} {joined}".rstrip())
        return "\n".join(lines)

    @property
    def alt(self) -> str:
        """Counts by level, and the first messages."""
        counts = [(name, sum(message.level == LEVELS[name] for message in self.messages)) for name in LEVELS]
        found = ", ".join(f"{count} {name}" for name, count in counts if count)
        first = "; ".join(f"{message.name}: {message.msg}" for message in self.messages[:ALT_MESSAGES])
        return f"Table of log messages, {self.counted}{f' ({found})' if found else ''}. {first}".strip()


def _cell(message: Any, column: Column) -> str:
    match column:
        case "stamp":
            return f"{message.header.stamp.to_sec():.3f}"
        case "severity":
            return NAMES[message.level]
        case "node":
            return str(message.name)
        case "message":
            return str(message.msg)
        case "location":
            return location_of(message)
        case "topics":
            return ", ".join(message.topics)


def location_of(message: Any) -> str:
    """Return the place of the call: the file without its folder, which differs between machines, line and function."""
    if not message.file:
        return ""
    name = message.file.replace("\\", "/").rpartition("/")[2]
    function = "" if message.function == "<module>" else message.function
    return f"{name}:{message.line} {function}".rstrip()


# ---- checking arguments ----


def _messages(source: object) -> list[Any]:
    messages = getattr(source, "messages", source)
    if isinstance(messages, Iterable):
        found = list(messages)
        if all(getattr(message, "_type", None) == "rosgraph_msgs/Log" for message in found):
            return found
    raise ViewError(
        f"{type(source).__name__} has no log messages: give what graph.console() returned, or messages of the type "
        "rosgraph_msgs/Log"
    )


def _levels(level: str | Collection[str]) -> set[int]:
    names = [level] if isinstance(level, str) else list(level)
    for name in names:
        _check(name.upper(), LEVELS, "level")
    if isinstance(level, str):
        return {number for number in NAMES if number >= LEVELS[level.upper()]}
    return {LEVELS[name.upper()] for name in names}


def _check(name: str, known: Iterable[str], what: str) -> None:
    names = list(known)
    if name not in names:
        hint = nearest(name, names)
        raise ViewError(f"rqt_console has no {what} {name!r}{': ' + hint if hint else ''}. It has {', '.join(names)}.")


def _matcher(pattern: str, regex: bool) -> Callable[[str], bool]:
    if not regex:
        folded = pattern.casefold()
        return lambda text: folded in text.casefold()
    try:
        expression = re.compile(pattern)
    except re.error as error:
        raise ViewError(f"{pattern!r} is not a regular expression: {error}") from error
    return lambda text: expression.search(text) is not None


def _seconds(when: Any) -> float:
    return float(when.to_sec() if hasattr(when, "to_sec") else when)


SHOWN = 100
"""Maximum number of messages shown: the newest."""
FILTERS = {"node": "Node", "text": "Text", "exclude": "Exclude", "highlight": "Highlight"}


class LogConsole(Panel):
    """Log messages from now on, with the filters of :func:`rosmini.viz.rqt.console.rqt_console`.

    Args:
        graph: the graph.
        level: lowest level shown.
        name: name of the panel's node.

    """

    tool, heading, plugin = "rqt_console", "Console", "rqt_console/Console"
    group, summary = "Logging", "what nodes log"
    example, listen_s = "--level WARN --duration 10", 5.0

    def __init__(self, graph: Graph, *, level: str = "DEBUG", name: str | None = None) -> None:
        super().__init__(graph, name=name)
        self.log = Console(graph, node=self.node)
        self.filters: dict[str, Any] = {"level": level, "regex": False, **dict.fromkeys(FILTERS, "")}
        """Options of `rqt_console` that select the messages."""
        self._paused: list[Any] | None = None

    @classmethod
    def add_options(cls, parser: Parser) -> None:
        """Add the level."""
        parser.add_option("--level", default="DEBUG", metavar="LEVEL", help="the lowest level: DEBUG to FATAL")

    @classmethod
    def arguments(cls, given: Values) -> tuple[list[str], dict[str, Any]]:
        """Return the level."""
        return [], {"level": given.level}

    def view(self, title: str | None = None, **options: Any) -> LogTable:
        """Return the messages that pass the filters."""
        messages = self.log.messages if self._paused is None else self._paused
        return rqt_console(messages, title=title, **options, **self.filters)

    @property
    def paused(self) -> bool:
        """True if new messages are kept but not shown."""
        return self._paused is not None

    def pause(self, on: bool = True) -> None:
        """Stop or resume showing new messages."""
        self._paused = self.log.messages if on else None

    def clear(self) -> None:
        """Remove all messages."""
        self.log.clear()
        self._paused = [] if self.paused else None

    def filter(self, **filters: Any) -> None:
        """Change filters: level, node, text, exclude, highlight, regex. Raises ``ViewError``."""
        unknown = set(filters) - set(self.filters)
        if unknown:
            raise ViewError(f"no filter {', '.join(sorted(unknown))}; there are {', '.join(self.filters)}")
        wanted = self.filters | filters
        rqt_console([], **wanted)
        self.filters = wanted

    def parts(self) -> Sequence[Part]:
        """The filters, and the messages that pass them."""
        chosen = self.filters
        table = self.view(limit=SHOWN)
        texts = [Control(key, label, "text", chosen[key]) for key, label in FILTERS.items()]
        return [
            bar(Control("level", "Level", "choice", chosen["level"], tuple(LEVELS)), *texts),
            bar(
                Control("regex", "Regular expressions", "check", chosen["regex"]),
                Control("pause", "Pause", "check", self.paused),
                Control("clear", "Clear", "button"),
            ),
            Words(f"{table.counted}{', paused' if self.paused else ''}"),
            table.part,
        ]

    def settings(self) -> dict[str, Any]:
        """Return the filters."""
        return dict(self.filters)

    def restore(self, settings: dict[str, Any]) -> None:
        """Restore the filters."""
        self.filter(**{name: value for name, value in settings.items() if type(value) is type(self.filters.get(name))})

    def _operate(self, key: Sequence[str], value: Any) -> None:
        match key[0]:
            case "pause":
                self.pause(value)
            case "clear":
                self.clear()
            case _:
                self.filter(**{key[0]: value})
