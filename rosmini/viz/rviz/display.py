"""Displays: each turns messages and frames into primitives, and says how it is doing (http://wiki.ros.org/rviz/DisplayTypes).

A display of a topic names its message class, declares its properties, and draws a message:

    class PointStamped(TopicDisplay, plugin="rviz/PointStamped"):
        message = "geometry_msgs/PointStamped"
        properties = (ALPHA, Property("Radius", 0.2, "radius of the sphere", unit="m", minimum=0.0))

        def draw(self, heard: Heard, context: Context) -> Iterable[Primitive]:
            yield sphere(heard.points([heard.message.point]), self["Radius"], self["Color"].rgba(self["Alpha"]))

What it raises becomes its status; the scene goes on. Displays are plugins by the names of RViz (`rosmini.plugins`).
"""

from __future__ import annotations

import enum
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, ClassVar, NamedTuple

from rosmini.core.plugins import Plugin

from .context import Context
from .primitives import DisplayError, Pane, Primitive
from .properties import Properties, Property

__all__ = ["Context", "Display", "DisplayError", "Level", "Status"]

Shown = tuple[str, tuple[Primitive, ...]]
"""The name of a display, and what it draws."""
RESERVED = ("Class", "Name", "Enabled", "Value")
"""What a file has of each display beside its properties."""


class Level(enum.IntEnum):
    """How bad a status is; the value is RViz's."""

    OK = 0
    WARN = 1
    ERROR = 2

    def __str__(self) -> str:
        return ("Ok", "Warn", "Error")[self]


class Status(NamedTuple):
    """One line of a display's status."""

    level: Level
    name: str
    text: str

    def __str__(self) -> str:
        return (
            f"{self.name}: {self.text}"
            if self.level is Level.OK
            else f"{self.name}: {self.level}: {self.text}"
        )


class Display(Plugin, ABC):
    """The base of all displays.

    Args:
        name: what the list of displays calls it; its class's name by default.
        tree: its part of a `.rviz` file.

    """

    properties: ClassVar[tuple[Property, ...]] = ()
    """What can be set. Those of the base classes come first, unless a class declares one of that name itself."""

    def __init__(self, name: str = "", tree: Mapping[str, Any] | None = None) -> None:
        tree = tree or {}
        self.name = name or str(tree.get("Name", "")) or self.plugin_name.rpartition("/")[2]
        self._values = Properties(type(self).declared(), tree)
        self._enabled = tree.get("Enabled", True) is not False
        self._statuses: dict[str, Status] = {}
        self._running: Context | None = None
        self._subscriptions: list[Callable[[], None]] = []
        self.version = 0
        """Counts the changes of properties: what was drawn before is obsolete."""

    @classmethod
    def declared(cls) -> tuple[Property, ...]:
        """All properties, those of the base classes first."""
        found: dict[str, Property] = {}
        for base in reversed(cls.__mro__):
            found.update({each.name: each for each in base.__dict__.get("properties", ())})
        return tuple(found.values())

    # -- what a display says and does: to be overridden ----------------------------------------------------------

    @abstractmethod
    def primitives(self, context: Context) -> Iterable[Primitive]:
        """What there is to draw now, in the fixed frame. May raise `DisplayError`, which becomes a status."""

    def panes(self, _context: Context, _shown: Sequence[Shown] = ()) -> Iterable[Pane]:
        """Pictures beside the scene: images of cameras, plots; `_shown` is what the other displays draw."""
        return ()

    def start(self, context: Context) -> None:
        """Begin: the display was switched on. Subscribe here, through `listen`."""

    def reset(self) -> None:
        """Forget what was received: time jumped back, or the fixed frame is another."""

    def update(self, context: Context) -> None:
        """Do what is to be done before drawing, for instance with messages that waited for a transform."""

    # -- properties ----------------------------------------------------------------------------------------------

    def __getitem__(self, name: str) -> Any:
        """The value of a property, by its name as in RViz or its path, `Line Style/Line Width`."""
        return self._values[name]

    def __setitem__(self, name: str, value: Any) -> None:
        """Set a property. Raises `DisplayError` if there is none of that name, or the value is of another type."""
        self._values[name] = value
        self.version += 1
        self.changed(name)

    def __contains__(self, name: object) -> bool:
        return name in self._values

    def changed(self, name: str) -> None:
        """Learn that a property was set; what was drawn before is obsolete anyhow."""

    @property
    def wrong(self) -> list[str]:
        """What its part of a file had and could not be taken, in words."""
        return self._values.wrong

    def unknown(self) -> list[str]:
        """The properties of its part of a file that nobody declares; they are kept."""
        return self._values.unknown(RESERVED)

    def tree(self) -> dict[str, Any]:
        """Its part of a `.rviz` file."""
        kept = self._values.tree()
        return {
            **kept,
            "Class": self.plugin_name,
            "Name": self.name,
            "Enabled": self.enabled,
            "Value": self.enabled,
        }

    # -- running -------------------------------------------------------------------------------------------------

    @property
    def enabled(self) -> bool:
        """Whether it is switched on."""
        return self._enabled

    @enabled.setter
    def enabled(self, value: bool) -> None:
        self._enabled = value
        self.restart()

    @property
    def is_running(self) -> bool:
        """Whether it is switched on and part of a scene that goes on."""
        return self._running is not None

    def attach(self, context: Context) -> None:
        """Become a part of a scene. For the scene only."""
        self.detach()
        if self.enabled:
            self._running = context
            try:
                self.start(context)
            except Exception as error:  # the scene stands, whatever one display does
                self.fail("Start", error)
        self._context = context

    def detach(self) -> None:
        """Leave the graph: nothing is subscribed to any more, and what was received is forgotten."""
        for end in self._subscriptions:
            end()
        self._subscriptions.clear()
        self._statuses.clear()
        self._running = None
        self.reset()

    _context: Context | None = None

    def restart(self) -> None:
        """Begin again with the present properties, if the display is part of a scene."""
        if self._context is not None:
            self._context.refresh()
            self.attach(self._context)

    def listen(
        self,
        context: Context,
        topic: str,
        kind: str,
        callback: Callable[[Any], object],
        queue_size: int | None = None,
    ) -> None:
        """Subscribe for as long as the display is switched on. Raises as `Node.subscriber` does."""
        self._subscriptions.append(context.subscribe(topic, kind, callback, queue_size))

    # -- status --------------------------------------------------------------------------------------------------

    @property
    def statuses(self) -> tuple[Status, ...]:
        """How it is doing, line by line."""
        return tuple(self._statuses.values())

    @property
    def level(self) -> Level:
        """The worst of its statuses."""
        return max((each.level for each in self._statuses.values()), default=Level.OK)

    def set_status(self, level: Level, name: str, text: str) -> None:
        """Say how one thing is doing."""
        self._statuses[name] = Status(level, name, text)

    def clear_status(self, name: str) -> None:
        """Say no more about one thing."""
        self._statuses.pop(name, None)

    def fail(self, name: str, error: Exception) -> None:
        """Make an error one of the statuses."""
        said = str(error).partition("\n")[0]
        self.set_status(
            Level.ERROR, name, said if isinstance(error, DisplayError) else f"{type(error).__name__}: {said}"
        )


class FailedDisplay(Display):
    """Stands in for a display of a class that is not known here: it draws nothing, and its part of a file is kept."""

    def __init__(self, kind: str, tree: Mapping[str, Any], reason: str = "") -> None:
        super().__init__(str(tree.get("Name", "")) or kind.rpartition("/")[2], tree)
        self.kind = kind
        self._reason = f" {reason}" if reason else ""

    def start(self, _context: Context) -> None:
        """Say why nothing is shown."""
        text = f"The class required for this display, '{self.kind}', could not be loaded.{self._reason}"
        self.set_status(Level.ERROR, "Class", text)

    def primitives(self, _context: Context) -> Iterable[Primitive]:
        """Nothing."""
        return ()

    def unknown(self) -> list[str]:
        """Nothing: all of it is unknown, and its class was named."""
        return []

    def tree(self) -> dict[str, Any]:
        """What the file had."""
        return {**super().tree(), "Class": self.kind}
