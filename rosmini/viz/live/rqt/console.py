"""`rqt_console` that goes on: log messages as they come (http://wiki.ros.org/rqt_console)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

from rosmini.core.graph.console import Console
from rosmini.core.graph.rosout import LEVELS, NAMES
from rosmini.viz.rqt.console import location_of, rqt_console
from rosmini.viz.view import ViewError

from .panel import Panel, bar
from .parts import Control, Row, Rows, Words

if TYPE_CHECKING:
    from collections.abc import Sequence

    from rosmini.core.graph import Graph

    from .parts import Part

SHOWN = 100
"""How many messages are shown, the newest."""
FILTERS = {"node": "Node", "text": "Text", "exclude": "Exclude", "highlight": "Highlight"}


class LogConsole(Panel):
    """What nodes log from now on, with the filters of :func:`rosmini.viz.rqt.console.rqt_console`.

    Args:
        graph: the graph.
        level: the lowest level that is shown.
        name: of the panel's node.

    """

    tool: ClassVar[str] = "rqt_console"
    heading: ClassVar[str] = "Console"
    plugin: ClassVar[str] = "rqt_console/Console"

    def __init__(self, graph: Graph, *, level: str = "DEBUG", name: str | None = None) -> None:
        super().__init__(graph, name=name)
        self.log = Console(graph, node=self.node)
        self.filters: dict[str, Any] = {"level": level, "regex": False, **dict.fromkeys(FILTERS, "")}
        """What is shown: options of `rqt_console`."""
        self._paused: list[Any] | None = None

    @property
    def paused(self) -> bool:
        """Whether what comes is kept, but not shown yet."""
        return self._paused is not None

    def pause(self, on: bool = True) -> None:
        """Show nothing new for a while, or again."""
        self._paused = self.log.messages if on else None

    def clear(self) -> None:
        """Forget all messages."""
        self.log.clear()
        self._paused = [] if self.paused else None

    def filter(self, **filters: Any) -> None:
        """Show other messages: level, node, text, exclude, highlight, regex. Raises ``ViewError``."""
        unknown = set(filters) - set(self.filters)
        if unknown:
            raise ViewError(f"no filter {', '.join(sorted(unknown))}; there are {', '.join(self.filters)}")
        wanted = self.filters | filters
        rqt_console([], **wanted)
        self.filters = wanted

    def parts(self) -> Sequence[Part]:
        """The filters, and the messages that pass them."""
        chosen = self.filters
        table = rqt_console(
            self.log.messages if self._paused is None else self._paused, limit=SHOWN, **chosen
        )
        texts = [Control(key, label, "text", chosen[key]) for key, label in FILTERS.items()]
        rows = tuple(
            Row(
                (
                    f"{message.header.stamp.to_sec():.3f}",
                    NAMES[message.level],
                    message.name,
                    message.msg,
                    location_of(message),
                ),
                mark="marked" if mark else NAMES[message.level],
            )
            for message, mark in zip(table.rows, table.marks, strict=True)
        )
        return [
            bar(Control("level", "Level", "choice", chosen["level"], tuple(LEVELS)), *texts),
            bar(
                Control("regex", "Regular expressions", "check", chosen["regex"]),
                Control("pause", "Pause", "check", self.paused),
                Control("clear", "Clear", "button"),
            ),
            Words(f"{table.counted}{', paused' if self.paused else ''}"),
            Rows(
                ("Stamp", "Severity", "Node", "Message", "Location"),
                rows,
                "Log messages",
                "no message passes the filters",
            ),
        ]

    def settings(self) -> dict[str, Any]:
        """The filters."""
        return dict(self.filters)

    def restore(self, settings: dict[str, Any]) -> None:
        """Take the filters."""
        self.filter(
            **{name: value for name, value in settings.items() if type(value) is type(self.filters.get(name))}
        )

    def _operate(self, key: Sequence[str], value: Any) -> None:
        match key[0]:
            case "pause":
                self.pause(value)
            case "clear":
                self.clear()
            case _:
                self.filter(**{key[0]: value})
