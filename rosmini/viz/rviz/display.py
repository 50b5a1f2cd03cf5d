"""Displays: each turns messages into primitives and reports its status (http://wiki.ros.org/rviz/DisplayTypes).

A display of a topic names its message class, declares its properties, and draws a message:

    class PointStamped(TopicDisplay, plugin="rviz/PointStamped"):
        message = "geometry_msgs/PointStamped"
        properties = (ALPHA, Property("Radius", 0.2, "radius of the sphere", unit="m", minimum=0.0))

        def draw(self, received: Received, context: Context) -> Iterable[Primitive]:
            yield sphere(received.points([received.message.point]), self["Radius"], self["Color"].rgba(self["Alpha"]))

An exception becomes its status, and the scene continues. Displays are plugins under RViz's names (`rosmini.plugins`).
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

Shown = tuple[str, tuple[Primitive, ...]]
"""The name of a display, and its primitives."""
RESERVED = ("Class", "Name", "Enabled", "Value")
"""Keys of each display in a file that are not properties."""


class Level(enum.IntEnum):
    """Severity of a status; the values are RViz's."""

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
        return f"{self.name}: {self.text}" if self.level is Level.OK else f"{self.name}: {self.level}: {self.text}"


class Display(Plugin, ABC):
    """The base of all displays.

    Args:
        name: its name in the list of displays; the name of its class by default.
        tree: its part of a `.rviz` file.

    """

    properties: ClassVar[tuple[Property, ...]] = ()
    """Properties that can be set, after those of base classes; declaring a property again overrides it."""

    def __init__(self, name: str = "", tree: Mapping[str, Any] | None = None) -> None:
        tree = tree or {}
        self.name = name or str(tree.get("Name", "")) or self.plugin_name.rpartition("/")[2]
        self._values = Properties(type(self).declared(), tree)
        self._enabled = tree.get("Enabled", True) is not False
        self._statuses: dict[str, Status] = {}
        self._running: Context | None = None
        self._subscriptions: list[Callable[[], None]] = []
        self.version = 0
        """Incremented when a property changes, because earlier drawings are then obsolete."""

    @classmethod
    def declared(cls) -> tuple[Property, ...]:
        """All properties, those of the base classes first."""
        found: dict[str, Property] = {}
        for base in reversed(cls.__mro__):
            found.update({each.name: each for each in base.__dict__.get("properties", ())})
        return tuple(found.values())

    # -- to be overridden ----------------------------------------------------------------------------------------

    @abstractmethod
    def primitives(self, context: Context) -> Iterable[Primitive]:
        """Return the primitives to draw now, in the fixed frame. May raise `DisplayError`, which becomes a status."""

    def panes(self, _context: Context, _shown: Sequence[Shown] = ()) -> Iterable[Pane]:
        """Return pictures beside the scene, such as camera images; `_shown` contains the other displays' primitives."""
        return ()

    def start(self, context: Context) -> None:
        """Start, when the display is switched on. Subscribe here, through `subscribe`."""

    def reset(self) -> None:
        """Discard received messages: time jumped back, or the fixed frame changed."""

    def update(self, context: Context) -> None:
        """Do work before drawing, for instance on messages that waited for a transform."""

    # -- properties ----------------------------------------------------------------------------------------------

    def __getitem__(self, name: str) -> Any:
        """Return the value of a property, by its name in RViz or its path, `Line Style/Line Width`."""
        return self._values[name]

    def __setitem__(self, name: str, value: Any) -> None:
        """Set a property. Raises `DisplayError` if it does not exist, or the value has another type."""
        self._values[name] = value
        self.version += 1
        self.changed(name)

    def __contains__(self, name: object) -> bool:
        return name in self._values

    def changed(self, name: str) -> None:
        """React to a change of a property; earlier drawings are obsolete in any case."""

    @property
    def errors(self) -> list[str]:
        """Errors in its part of a file, in words."""
        return self._values.errors

    def unknown(self) -> list[str]:
        """Return the undeclared properties in its part of a file; they are preserved."""
        return self._values.unknown(RESERVED)

    def tree(self) -> dict[str, Any]:
        """Return its part of a `.rviz` file."""
        kept = self._values.tree()
        return {**kept, "Class": self.plugin_name, "Name": self.name, "Enabled": self.enabled, "Value": self.enabled}

    # -- running -------------------------------------------------------------------------------------------------

    @property
    def enabled(self) -> bool:
        """True if it is switched on."""
        return self._enabled

    @enabled.setter
    def enabled(self, value: bool) -> None:
        self._enabled = value
        self.restart()

    @property
    def is_running(self) -> bool:
        """True if it is switched on and part of a running scene."""
        return self._running is not None

    def attach(self, context: Context) -> None:
        """Add the display to a scene. Only scenes call this."""
        self.detach()
        if self.enabled:
            self._running = context
            try:
                self.start(context)
            except Exception as error:  # an error in one display must not stop the scene
                self.fail("Start", error)
        self._context = context

    def detach(self) -> None:
        """Leave the graph: cancel all subscriptions and discard received messages."""
        for end in self._subscriptions:
            end()
        self._subscriptions.clear()
        self._statuses.clear()
        self._running = None
        self.reset()

    _context: Context | None = None

    def restart(self) -> None:
        """Restart with the current properties, if the display is part of a scene."""
        if self._context is not None:
            self._context.refresh()
            self.attach(self._context)

    def subscribe(
        self, context: Context, topic: str, kind: str, callback: Callable[[Any], object], queue_size: int | None = None
    ) -> None:
        """Subscribe while the display is switched on. Raises the errors of `Node.subscriber`."""
        self._subscriptions.append(context.subscribe(topic, kind, callback, queue_size))

    # -- status --------------------------------------------------------------------------------------------------

    @property
    def statuses(self) -> tuple[Status, ...]:
        """Its status, line by line."""
        return tuple(self._statuses.values())

    @property
    def level(self) -> Level:
        """The worst of its statuses."""
        return max((each.level for each in self._statuses.values()), default=Level.OK)

    def set_status(self, level: Level, name: str, text: str) -> None:
        """Set the status of one item."""
        self._statuses[name] = Status(level, name, text)

    def clear_status(self, name: str) -> None:
        """Remove the status of one item."""
        self._statuses.pop(name, None)

    def fail(self, name: str, error: Exception) -> None:
        """Turn an error into a status."""
        said = str(error).partition("\n")[0]
        self.set_status(
            Level.ERROR, name, said if isinstance(error, DisplayError) else f"{type(error).__name__}: {said}"
        )


class FailedDisplay(Display):
    """Replaces a display of an unknown class: it draws nothing, and its part of a file is preserved."""

    def __init__(self, kind: str, tree: Mapping[str, Any], reason: str = "") -> None:
        super().__init__(str(tree.get("Name", "")) or kind.rpartition("/")[2], tree)
        self.kind = kind
        self._reason = f" {reason}" if reason else ""

    def start(self, _context: Context) -> None:
        """Report why nothing is shown."""
        text = f"The class required for this display, '{self.kind}', could not be loaded.{self._reason}"
        self.set_status(Level.ERROR, "Class", text)

    def primitives(self, _context: Context) -> Iterable[Primitive]:
        """Return nothing."""
        return ()

    def unknown(self) -> list[str]:
        """Return nothing: all of it is unknown, and its class is reported."""
        return []

    def tree(self) -> dict[str, Any]:
        """Return the part of the file."""
        return {**super().tree(), "Class": self.kind}
